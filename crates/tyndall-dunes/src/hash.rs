//! The random words of the automata: one u32 as a pure function of (seed, step, stream, cell).
//!
//! [`tyndall_core::rng`] needs 64-bit products, which WGSL lacks, and ten rounds; a cell of a sand bed needs a byte or
//! two. So the automata use a 32-bit finaliser with two multiplications (the constants are those that C. Wellons found
//! by search for the least bias, public domain): a bijection, in u32 arithmetic only, the same in WGSL.
//!
//! - key of a step: `mix(mix(mix(seed) + step) + stream)`; computed once, goes to shaders as a uniform.
//! - word of a cell: `mix(cell * 0x9E3779B9 ^ key)`.
//! - next word of the same grain: `mix(word + 0x632BE5AB)`.

/// Odd multiplier that spreads neighbouring cell numbers over all bits: 2^32 over the golden ratio.
const CELL_FACTOR: u32 = 0x9E37_79B9;
/// Added before a word is mixed again.
const NEXT: u32 = 0x632B_E5AB;

/// A bijection of u32 whose every output bit depends on every input bit.
#[inline(always)]
#[must_use]
pub const fn mix(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x7FEB_352D);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846C_A68B);
    x ^ (x >> 16)
}

/// Key of all words of one step; `stream` tells apart independent uses.
#[must_use]
pub const fn step_key(seed: u32, step: u32, stream: u32) -> u32 {
    mix(mix(mix(seed).wrapping_add(step)).wrapping_add(stream))
}

/// Word of a cell under a key.
#[inline(always)]
#[must_use]
pub const fn cell_word(key: u32, cell: u32) -> u32 {
    mix(cell.wrapping_mul(CELL_FACTOR) ^ key)
}

/// The word after `word` of the same grain.
#[inline(always)]
#[must_use]
pub const fn next_word(word: u32) -> u32 {
    mix(word.wrapping_add(NEXT))
}

/// 64-bit FNV-1a of a text, the same on every system.
pub(crate) fn fnv1a(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xCBF2_9CE4_8422_2325, |hash, &byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Computed from the definition with integers of unlimited size in another language.
    #[test]
    fn the_mixer_gives_its_known_answers() {
        let expected = [0, 0x6889_90C0, 0xD113_2181, 0x6768_824A];
        assert_eq!([0, 1, 2, u32::MAX].map(mix), expected, "words 0, 1, 2 and the last");
    }

    #[test]
    fn words_of_neighbouring_cells_are_uncorrelated() {
        let key = step_key(1, 2, 3);
        let unit = |cell: u32| f64::from(cell_word(key, cell)) / 4_294_967_296.0 - 0.5;
        let count = 65_536_u32;
        for distance in [1, 2, 255, 256, 1024] {
            let sum: f64 = (0..count).map(|cell| unit(cell) * unit(cell + distance)).sum();
            // A product has variance 1/144, so five standard errors of the mean are 5 / (12 sqrt(65536)).
            let mean = sum / f64::from(count);
            assert!(mean.abs() < 5.0 / (12.0 * 256.0), "distance {distance}: covariance {mean}");
        }
    }

    #[test]
    fn every_byte_of_a_word_is_uniform() {
        for shift in [0, 8, 16, 24] {
            let mut counts = [0_u32; 256];
            for cell in 0..65_536 {
                counts[(cell_word(step_key(9, 0, 0), cell) >> shift & 255) as usize] += 1;
            }
            let chi2: f64 = counts.iter().map(|&n| (f64::from(n) - 256.0).powi(2) / 256.0).sum();
            // 255 degrees of freedom: mean 255, deviation 22.6; five of them.
            assert!((chi2 - 255.0).abs() < 113.0, "byte at bit {shift}: chi squared {chi2}");
        }
    }

    #[test]
    fn seed_step_and_stream_each_change_the_key() {
        let base = step_key(1, 2, 3);
        for other in [step_key(2, 2, 3), step_key(1, 3, 3), step_key(1, 2, 4)] {
            assert_ne!(base, other, "a coordinate of the counter has no effect");
        }
    }
}

//! Counter-based random numbers: Philox4x32-10 of Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC 2011.
//!
//! A number is a pure function of (seed, step, cell, stream). Nothing is stored, so any number of threads in any order
//! gives the same bits, on every system.

const MULTIPLIERS: [u32; 2] = [0xD251_1F53, 0xCD9E_8D57];
const KEY_STEPS: [u32; 2] = [0x9E37_79B9, 0xBB67_AE85];
const ROUNDS: usize = 10;

/// The Philox4x32-10 bijection: four random words for a counter under a key.
#[must_use]
pub fn philox4x32(mut counter: [u32; 4], mut key: [u32; 2]) -> [u32; 4] {
    for _ in 0..ROUNDS {
        let (high0, low0) = wide_product(MULTIPLIERS[0], counter[0]);
        let (high1, low1) = wide_product(MULTIPLIERS[1], counter[2]);
        counter = [high1 ^ counter[1] ^ key[0], low1, high0 ^ counter[3] ^ key[1], low0];
        key = [key[0].wrapping_add(KEY_STEPS[0]), key[1].wrapping_add(KEY_STEPS[1])];
    }
    counter
}

#[expect(clippy::cast_possible_truncation, reason = "the two halves of a 64-bit product")]
fn wide_product(a: u32, b: u32) -> (u32, u32) {
    let product = u64::from(a) * u64::from(b);
    ((product >> 32) as u32, product as u32)
}

/// Random numbers of one simulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CellRng {
    seed: u64,
}

impl CellRng {
    /// Numbers of the simulation with this seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self { seed }
    }

    /// Four random words for a cell at a step; `stream` tells apart independent uses in one step.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "64-bit values are split into their two halves")]
    pub fn words(self, step: u32, cell: u64, stream: u32) -> [u32; 4] {
        philox4x32([cell as u32, (cell >> 32) as u32, step, stream], [self.seed as u32, (self.seed >> 32) as u32])
    }

    /// A hash of cell indices of its own for a step, a stream and a bit plane.
    #[must_use]
    pub fn word_hash(self, step: u32, stream: u32, plane: u32) -> WordHash {
        // Cells count from 0 upwards, so the planes stand in the upper half of the cell's number.
        let [offset, mask, ..] = self.words(step, u64::from(plane.wrapping_add(1)) << 32, stream);
        WordHash { offset, mask }
    }

    /// A number in 0..1, uniform over the multiples of 2^-24, for a cell at a step.
    #[must_use]
    pub fn uniform(self, step: u32, cell: u64, stream: u32) -> f32 {
        unit_from_word(self.words(step, cell, stream)[0])
    }
}

/// A cheap hash of 32-bit indices for work that needs millions of words a step: 32 random words of one bit each for the
/// price of two multiplications, in u32 arithmetic that shaders share.
///
/// Philox gives the two keys once per (seed, step, stream, plane); the words are those of a bijection of the index that
/// mixes one key in before and one between two rounds of multiply and xor-shift, with multipliers found by C. Wellons's
/// search for small avalanche bias. Not for cryptography, and not for one long stream: take new keys for each use.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WordHash {
    offset: u32,
    mask: u32,
}

impl WordHash {
    /// The random word of an index.
    #[must_use]
    #[inline]
    pub fn word(self, index: u32) -> u32 {
        let mut x = index.wrapping_add(self.offset);
        x ^= x >> 16;
        x = x.wrapping_mul(0x7FEB_352D);
        x ^= x >> 15;
        x ^= self.mask;
        x = x.wrapping_mul(0x846C_A68B);
        x ^ (x >> 16)
    }

    /// The keys `[offset, mask]`, for a shader.
    #[must_use]
    pub fn keys(self) -> [u32; 2] {
        [self.offset, self.mask]
    }
}

/// The PCG permutation of O'Neill 2014, 32-bit RXS-M-XS, as a hash of one word: for noise that shaders compute too. WGSL:
/// `shaders/common/noise.wgsl`.
#[must_use]
pub const fn noise_pcg(word: u32) -> u32 {
    let state = word.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let mixed = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (mixed >> 22) ^ mixed
}

/// The word's upper 24 bits as a number in 0..1; exact in f32, so the same on every system.
#[must_use]
pub fn unit_from_word(word: u32) -> f32 {
    (word >> 8) as f32 * (1.0 / 16_777_216.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Known answers of the Random123 distribution for philox4x32-10.
    #[test]
    fn philox_gives_the_published_known_answers() {
        let ones = u32::MAX;
        assert_eq!(philox4x32([0; 4], [0; 2]), [0x6627_e8d5, 0xe169_c58d, 0xbc57_ac4c, 0x9b00_dbd8]);
        assert_eq!(philox4x32([ones; 4], [ones; 2]), [0x408f_276d, 0x41c8_3b0e, 0xa20b_c7c6, 0x6d54_51fd]);
        assert_eq!(
            philox4x32([0x243f_6a88, 0x85a3_08d3, 0x1319_8a2e, 0x0370_7344], [0xa409_3822, 0x299f_31d0]),
            [0xd16c_fe09, 0x94fd_cceb, 0x5001_e420, 0x2412_6ea1]
        );
    }

    #[test]
    fn uniform_numbers_have_the_mean_and_variance_of_their_law() {
        let rng = CellRng::new(7);
        let count = 100_000_u32;
        let numbers: Vec<f64> = (0..count).map(|cell| f64::from(rng.uniform(3, u64::from(cell), 0))).collect();
        let mean = numbers.iter().sum::<f64>() / f64::from(count);
        let variance = numbers.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / f64::from(count);
        // Five standard errors: 0.2887 / sqrt(1e5) = 9.1e-4 for the mean, 2.4e-4 for the variance.
        assert!((mean - 0.5).abs() < 5.0 * 9.1e-4, "mean {mean}");
        assert!((variance - 1.0 / 12.0).abs() < 5.0 * 2.4e-4, "variance {variance}");
    }

    /// Share of words 0 to 99,999 with each of the 32 bits set, against the binomial law.
    fn assert_fair_bits(word: impl Fn(u32) -> u32, what: &str) {
        let count = 100_000_u32;
        for bit in 0..32 {
            let share = (0..count).filter(|&i| (word(i) >> bit) & 1 == 1).count() as f64 / f64::from(count);
            // Five standard errors; 32 bits and a handful of calls leave a chance of 1e-4 for a failure by luck.
            assert!((share - 0.5).abs() < 5.0 * 0.5 / f64::from(count).sqrt(), "{what}, bit {bit}: {share}");
        }
    }

    #[test]
    fn hashed_words_are_fair_and_independent_between_neighbours_planes_and_steps() {
        let rng = CellRng::new(11);
        let (here, plane, step) = (rng.word_hash(5, 1, 0), rng.word_hash(5, 1, 1), rng.word_hash(6, 1, 0));
        assert_fair_bits(|i| here.word(i), "words");
        for lag in [1, 2, 16, 256, 65_536] {
            assert_fair_bits(|i| here.word(i) ^ here.word(i + lag), "neighbours");
        }
        assert_fair_bits(|i| here.word(i) ^ here.word(i).rotate_left(1), "bits of a word");
        assert_fair_bits(|i| here.word(i) ^ plane.word(i), "planes");
        assert_fair_bits(|i| here.word(i) ^ step.word(i), "steps");
    }

    #[test]
    fn hashed_bytes_are_uniform() {
        let hash = CellRng::new(3).word_hash(0, 0, 0);
        for byte in 0..4 {
            let mut counts = [0_u32; 256];
            (0..256_000_u32).for_each(|i| counts[(hash.word(i) >> (8 * byte)) as usize & 255] += 1);
            let chi2: f64 = counts.iter().map(|&n| (f64::from(n) - 1000.0).powi(2) / 1000.0).sum();
            // 255 degrees of freedom: mean 255, standard deviation 22.6.
            assert!((chi2 - 255.0).abs() < 5.0 * 22.6, "byte {byte}: chi^2 = {chi2}");
        }
    }

    #[test]
    fn seed_step_cell_and_stream_each_change_the_number() {
        let base = CellRng::new(1).words(2, 3, 4);
        assert_ne!(base, CellRng::new(2).words(2, 3, 4));
        assert_ne!(base, CellRng::new(1).words(3, 3, 4));
        assert_ne!(base, CellRng::new(1).words(2, 1 << 40, 4));
        assert_ne!(base, CellRng::new(1).words(2, 3, 5));
    }
}

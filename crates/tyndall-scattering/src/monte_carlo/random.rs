//! The random numbers of one path: a pure function of seed, direction, batch and path.
//!
//! The first few numbers of a path decide where and whither its first scattering goes, and most of its variance. They come
//! from an additive recurrence with the irrational steps of Roberts 2018 (powers of the root of x^7 = x + 1), which fills
//! its cube evenly, shifted by random offsets that belong to the batch (Cranley and Patterson 1976); batches are then
//! independent, and the spread of their means is an honest standard error. All other numbers are Philox.

use tyndall_core::rng::philox4x32;

/// Numbers of a path that are spread evenly over a batch.
const EVEN: usize = 6;

/// Steps of the recurrence: x^-1 .. x^-6 for the root x of x^7 = x + 1.
const STEPS: [f64; EVEN] = [
    0.898_653_712_628_699_3,
    0.807_578_495_221_344_8,
    0.725_733_412_969_759_8,
    0.652_183_025_943_971_7,
    0.586_086_697_577_969_5,
    0.526_688_986_700_735_9,
];

/// Counter word that tells the offsets of a batch from the numbers of its paths.
const OFFSETS: u32 = u32::MAX;

/// The offsets of one batch.
#[derive(Clone, Copy, Debug)]
pub(super) struct BatchRandom {
    key: [u32; 2],
    direction: u32,
    batch: u32,
    offsets: [f64; EVEN],
}

impl BatchRandom {
    #[expect(clippy::cast_possible_truncation, reason = "the two halves of a 64-bit seed")]
    pub(super) fn new(seed: u64, direction: u32, batch: u32) -> Self {
        let key = [seed as u32, (seed >> 32) as u32];
        let words = [0, 1].map(|half| philox4x32([OFFSETS, batch, direction, half], key));
        let offsets = std::array::from_fn(|i| unit(words[i / 4][i % 4]));
        Self { key, direction, batch, offsets }
    }

    /// The numbers of one path.
    pub(super) fn path(&self, path: u32) -> PathRandom<'_> {
        PathRandom { batch: self, path, drawn: 0, words: [0; 4], used: 4 }
    }
}

/// The numbers of one path, in order.
#[derive(Clone, Debug)]
pub(super) struct PathRandom<'a> {
    batch: &'a BatchRandom,
    path: u32,
    drawn: u32,
    words: [u32; 4],
    used: usize,
}

impl PathRandom<'_> {
    /// The next number, 0 < x < 1.
    pub(super) fn next(&mut self) -> f64 {
        let index = self.drawn as usize;
        self.drawn += 1;
        if index < EVEN {
            let even = self.batch.offsets[index] + STEPS[index] * f64::from(self.path);
            // The offset is no multiple of 2^-32, so that the sum is never a whole number.
            return even.fract();
        }
        if self.used == 4 {
            let BatchRandom { key, direction, batch, .. } = *self.batch;
            self.words = philox4x32([self.path, batch, direction, self.drawn], key);
            self.used = 0;
        }
        self.used += 1;
        unit(self.words[self.used - 1])
    }
}

/// A word as a number, 0 < x < 1.
fn unit(word: u32) -> f64 {
    (f64::from(word) + 0.5) / 4_294_967_296.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_steps_are_powers_of_the_root_of_their_equation() {
        let root = 1.0 / STEPS[0];
        assert!((root.powi(7) - root - 1.0).abs() < 1e-9, "{root}");
        for (i, step) in STEPS.into_iter().enumerate() {
            let power = root.powi(-i32::try_from(i + 1).expect("small"));
            assert!((step - power).abs() < 1e-9, "{i}: {step} {power}");
        }
    }

    #[test]
    fn the_numbers_of_a_batch_have_the_moments_of_a_uniform_distribution() {
        let batch = BatchRandom::new(9, 2, 5);
        for draw in 0..12 {
            let values: Vec<f64> = (0..20_000)
                .map(|path| {
                    let mut random = batch.path(path);
                    (0..draw).for_each(|_| {
                        random.next();
                    });
                    random.next()
                })
                .collect();
            let mean = values.iter().sum::<f64>() / 20_000.0;
            let square = values.iter().map(|v| v * v).sum::<f64>() / 20_000.0;
            // Five standard errors of independent numbers: 0.289 / sqrt(20000) and 0.298 / sqrt(20000).
            assert!((mean - 0.5).abs() < 0.0103 && (square - 1.0 / 3.0).abs() < 0.0106, "{draw}: {mean} {square}");
            assert!(values.iter().all(|v| (0.0..1.0).contains(v)), "{draw}");
        }
    }

    #[test]
    fn seed_direction_batch_and_path_each_change_the_numbers() {
        let draw = |seed, direction, batch, path| {
            let batch = BatchRandom::new(seed, direction, batch);
            let mut random = batch.path(path);
            (0..8).map(|_| random.next()).sum::<f64>()
        };
        let base = draw(1, 2, 3, 4);
        for other in [draw(2, 2, 3, 4), draw(1, 3, 3, 4), draw(1, 2, 4, 4), draw(1, 2, 3, 5)] {
            assert!((other - base).abs() > 1e-9, "{base} {other}");
        }
    }
}

//! Times and what is told of them.

use std::time::Instant;

/// Times of the same work, in milliseconds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Samples {
    sorted_ms: Vec<f64>,
}

impl Samples {
    /// Half of the times are below.
    #[must_use]
    pub fn median_ms(&self) -> f64 {
        let count = self.sorted_ms.len();
        if count == 0 {
            return f64::NAN;
        }
        0.5 * (self.sorted_ms[(count - 1) / 2] + self.sorted_ms[count / 2])
    }

    /// 95 of 100 times are at or below.
    #[must_use]
    pub fn p95_ms(&self) -> f64 {
        let rank = (95 * self.sorted_ms.len()).div_ceil(100);
        rank.checked_sub(1).map_or(f64::NAN, |index| self.sorted_ms[index])
    }

    /// The times over `calls`, for work that does the same that often.
    #[must_use]
    pub fn per_call(&self, calls: usize) -> Self {
        Self { sorted_ms: self.sorted_ms.iter().map(|ms| ms / calls as f64).collect() }
    }
}

impl FromIterator<f64> for Samples {
    fn from_iter<T: IntoIterator<Item = f64>>(times_ms: T) -> Self {
        let mut sorted_ms: Vec<_> = times_ms.into_iter().collect();
        sorted_ms.sort_by(f64::total_cmp);
        Self { sorted_ms }
    }
}

/// Times `work` that often, after one run that warms caches.
pub fn measure<T>(count: usize, mut work: impl FnMut() -> T) -> Samples {
    std::hint::black_box(work());
    let mut once = || {
        let started = Instant::now();
        std::hint::black_box(work());
        1e3 * started.elapsed().as_secs_f64()
    };
    (0..count).map(|_| once()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn median_and_p95_are_those_of_the_definition() {
        let samples: Samples = (1..=100).rev().map(f64::from).collect();
        assert!((samples.median_ms() - 50.5).abs() < 1e-12, "the middle of 50 and 51");
        assert!((samples.p95_ms() - 95.0).abs() < 1e-12, "95 of 100 are at or below 95");
        let one: Samples = [7.0].into_iter().collect();
        assert!((one.median_ms() - 7.0).abs() < 1e-12 && (one.p95_ms() - 7.0).abs() < 1e-12, "{one:?}");
    }

    #[test]
    fn no_times_have_no_median() {
        let none = Samples::default();
        assert!(none.median_ms().is_nan() && none.p95_ms().is_nan(), "nothing was measured");
    }

    #[test]
    fn work_is_done_once_more_than_it_is_timed() {
        let mut runs = 0;
        let samples = measure(3, || runs += 1);
        assert_eq!((runs, samples.sorted_ms.len()), (4, 3), "one run to warm up");
    }
}

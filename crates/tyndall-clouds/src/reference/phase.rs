//! Any phase function, as a table that can be sampled.

use std::f64::consts::PI;

use crate::error::CloudError;

/// Bins of equal angle; 0.04 degrees each.
const BINS: usize = 4096;
/// Values from which a bin's mean is taken.
const POINTS: usize = 4;

/// A phase function of the scattering angle: constant within narrow bins, so that what is sampled is what is evaluated.
#[derive(Clone, Debug)]
pub struct TabulatedPhase {
    /// Cosines of the bins' edges, from 1 down to -1.
    cosines: Vec<f64>,
    /// Value in each bin (1/sr).
    values: Vec<f64>,
    /// Probability of an angle before each bin's end.
    cumulative: Vec<f64>,
}

impl TabulatedPhase {
    /// From a function of the scattering angle's cosine; its scale does not matter, the table integrates to one.
    ///
    /// # Errors
    /// When a value is negative or not finite, or all are zero.
    pub fn new(phase: impl Fn(f64) -> f64) -> Result<Self, CloudError> {
        let angle = |place: f64| place * PI / BINS as f64;
        let cosines: Vec<f64> = (0..=BINS).map(|edge| angle(edge as f64).cos()).collect();
        let mut values = Vec::with_capacity(BINS);
        for bin in 0..BINS {
            let part = |point: usize| phase(angle(bin as f64 + (point as f64 + 0.5) / POINTS as f64).cos());
            values.push((0..POINTS).map(part).sum::<f64>() / POINTS as f64);
        }
        let mut sum = 0.0;
        let mut cumulative = Vec::with_capacity(BINS);
        for (value, edge) in values.iter().zip(cosines.windows(2)) {
            crate::error::in_range("phase function", *value, (0.0, 1e12), " 1/sr")?;
            sum += 2.0 * PI * value * (edge[0] - edge[1]);
            cumulative.push(sum);
        }
        crate::error::in_range("integral of the phase function", sum, (1e-12, 1e12), "")?;
        values.iter_mut().chain(&mut cumulative).for_each(|value| *value /= sum);
        Ok(Self { cosines, values, cumulative })
    }

    /// Value at the cosine of the scattering angle (1/sr).
    #[must_use]
    pub fn value(&self, cosine: f64) -> f64 {
        let bin = self.cosines.partition_point(|edge| *edge > cosine);
        self.values[bin.clamp(1, BINS) - 1]
    }

    /// Cosine of a scattering angle for a number in 0..1.
    #[must_use]
    pub fn sample(&self, number: f64) -> f64 {
        let bin = self.cumulative.partition_point(|end| *end < number).min(BINS - 1);
        let before = bin.checked_sub(1).map_or(0.0, |bin| self.cumulative[bin]);
        let share = ((number - before) / (self.cumulative[bin] - before).max(1e-300)).clamp(0.0, 1.0);
        self.cosines[bin] + share * (self.cosines[bin + 1] - self.cosines[bin])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn henyey_greenstein(g: f64) -> TabulatedPhase {
        TabulatedPhase::new(|cosine| (1.0 - g * g) / (1.0 + g * g - 2.0 * g * cosine).powf(1.5)).unwrap()
    }

    #[test]
    fn samples_have_the_mean_cosine_of_the_function() {
        for g in [-0.5, 0.0, 0.85, 0.95] {
            let phase = henyey_greenstein(g);
            let count = 20_000;
            let mean = (0..count).map(|i| phase.sample((f64::from(i) + 0.5) / f64::from(count))).sum::<f64>();
            assert!((mean / f64::from(count) - g).abs() < 1e-3, "g = {g}: {}", mean / f64::from(count));
        }
    }

    #[test]
    fn values_are_those_of_the_normalised_function() {
        let phase = henyey_greenstein(0.85);
        for cosine in [-1.0, -0.3, 0.5, 0.99, 1.0] {
            let exact = (1.0 - 0.85 * 0.85) / (4.0 * PI * f64::powf(1.0 + 0.85 * 0.85 - 1.7 * cosine, 1.5));
            assert!((phase.value(cosine) / exact - 1.0).abs() < 5e-3, "{cosine}: {} {exact}", phase.value(cosine));
        }
    }

    #[test]
    fn a_phase_function_below_zero_is_refused() {
        assert!(TabulatedPhase::new(|cosine| cosine).is_err(), "negative backwards");
        assert!(TabulatedPhase::new(|_| 0.0).is_err(), "nothing");
    }
}

//! FLIP's filters: all of them products of one across and one along the picture, whose edge pixels go on for ever.

use std::f64::consts::PI;

use rayon::prelude::*;

/// Width of the features that are looked for (degrees of view).
const FEATURE_DEG: f64 = 0.082;

/// Contrast sensitivity of `Yy`, `Cx` and `Cz`: sums of Gaussians of weight `a` and width `b` (degrees squared).
const SENSITIVITY: [&[[f64; 2]]; 3] = [&[[1.0, 0.0047]], &[[1.0, 0.0053]], &[[34.1, 0.04], [13.5, 0.025]]];

/// One channel of a picture.
#[derive(Clone, Debug)]
pub(super) struct Plane {
    /// Pixels in a row.
    pub(super) width: usize,
    /// Values, row by row.
    pub(super) values: Vec<f64>,
}

impl Plane {
    /// The plane filtered by one kernel along its rows and another along its columns.
    pub(super) fn filtered(&self, across: &Kernel, along: &Kernel) -> Self {
        let rows: Vec<f64> = self.values.par_chunks_exact(self.width).flat_map_iter(|row| across.of(row)).collect();
        let height = rows.len() / self.width;
        let mut columns: Vec<Vec<f64>> = Vec::new();
        let column = |x: usize| along.of(&(0..height).map(|y| rows[y * self.width + x]).collect::<Vec<_>>());
        (0..self.width).into_par_iter().map(column).collect_into_vec(&mut columns);
        let values = (0..rows.len()).map(|index| columns[index % self.width][index / self.width]).collect();
        Self { width: self.width, values }
    }
}

/// Weights from `-radius` to `radius` pixels.
#[derive(Clone, Debug)]
pub(super) struct Kernel(Vec<f64>);

impl Kernel {
    fn new(radius: usize, weight: impl Fn(f64) -> f64) -> Self {
        Self((0..=2 * radius).map(|index| weight(index as f64 - radius as f64)).collect())
    }

    /// Weights over their sum.
    fn normalised(self) -> Self {
        let sum: f64 = self.0.iter().sum();
        Self(self.0.into_iter().map(|weight| weight / sum).collect())
    }

    /// Positive weights over their sum, and negative ones over theirs.
    fn balanced(self) -> Self {
        let sum = |sign: f64| self.0.iter().map(|weight| (sign * weight).max(0.0)).sum::<f64>();
        let (above, below) = (sum(1.0), sum(-1.0));
        Self(self.0.iter().map(|weight| weight / if *weight > 0.0 { above } else { below }).collect())
    }

    /// A line, filtered.
    fn of(&self, line: &[f64]) -> Vec<f64> {
        let radius = self.0.len() / 2;
        let last = line.len().saturating_sub(1);
        let place = |middle: usize, tap: usize| (middle + tap).saturating_sub(radius).min(last);
        (0..line.len())
            .map(|middle| self.0.iter().enumerate().map(|(tap, weight)| weight * line[place(middle, tap)]).sum())
            .collect()
    }
}

/// For each channel, what its blur is a sum of: weights, and kernels that serve rows and columns.
pub(super) fn sensitivity_kernels(pixels_per_degree: f64) -> [Vec<(f64, Kernel)>; 3] {
    let widest = SENSITIVITY.iter().copied().flatten().map(|[_, b]| *b).fold(0.0, f64::max);
    let radius = whole((3.0 * (widest / (2.0 * PI * PI)).sqrt() * pixels_per_degree).ceil());
    SENSITIVITY.map(|parts| {
        let kernels: Vec<(f64, Kernel)> = parts
            .iter()
            .map(|[a, b]| {
                let gaussian = Kernel::new(radius, |x| (-(PI * x / pixels_per_degree).powi(2) / b).exp());
                let sum: f64 = gaussian.0.iter().sum();
                (a * (PI / b).sqrt() * sum * sum, gaussian.normalised())
            })
            .collect();
        let sum: f64 = kernels.iter().map(|(weight, _)| weight).sum();
        kernels.into_iter().map(|(weight, kernel)| (weight / sum, kernel)).collect()
    })
}

/// First and second derivatives of a Gaussian, which find edges and points, and the Gaussian for the other axis.
#[derive(Clone, Debug)]
pub(super) struct FeatureFilters {
    pub(super) edge: Kernel,
    pub(super) point: Kernel,
    pub(super) smooth: Kernel,
}

impl FeatureFilters {
    pub(super) fn new(pixels_per_degree: f64) -> Self {
        let deviation = 0.5 * FEATURE_DEG * pixels_per_degree;
        let radius = whole((3.0 * deviation).ceil());
        let gaussian = |x: f64| (-0.5 * (x / deviation).powi(2)).exp();
        Self {
            edge: Kernel::new(radius, |x| -x * gaussian(x)).balanced(),
            point: Kernel::new(radius, |x| ((x / deviation).powi(2) - 1.0) * gaussian(x)).balanced(),
            smooth: Kernel::new(radius, gaussian).normalised(),
        }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "a few pixels to a few thousand")]
fn whole(radius: f64) -> usize {
    radius.clamp(0.0, 4096.0) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blurs_keep_even_planes_and_feature_filters_see_nothing_there() {
        let even = Plane { width: 9, values: vec![0.7; 63] };
        for parts in sensitivity_kernels(67.0) {
            let sum: f64 = parts.iter().map(|(weight, kernel)| weight * even.filtered(kernel, kernel).values[31]).sum();
            assert!((sum - 0.7).abs() < 1e-12, "{sum}");
        }
        let filters = FeatureFilters::new(67.0);
        for kernel in [&filters.edge, &filters.point] {
            let seen = even.filtered(kernel, &filters.smooth).values[31];
            assert!(seen.abs() < 1e-12, "{seen}");
        }
    }

    #[test]
    fn a_step_of_height_1_has_an_edge_of_strength_1_beside_it() {
        let values = (0..40 * 5).map(|index| f64::from(u8::from(index % 40 >= 20))).collect();
        let step = Plane { width: 40, values };
        let filters = FeatureFilters::new(67.0);
        let seen = step.filtered(&filters.edge, &filters.smooth);
        let most = seen.values.iter().copied().map(f64::abs).fold(0.0, f64::max);
        assert!((most - 1.0).abs() < 0.01, "{most}");
        let along = step.filtered(&filters.smooth, &filters.edge);
        assert!(along.values.iter().all(|value| value.abs() < 1e-12), "nothing changes along the columns");
    }
}

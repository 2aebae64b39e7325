//! Steeper edges of the same mass: smoothing leaves edges so wide that turbulence would tear them into separate puffs.

use rayon::prelude::*;
use tyndall_core::grid::Grid3;

use crate::error::{CloudError, in_range};
use crate::narrow::narrow;

/// Steps of the histogram by which the level is found, over shares of 0 to 1.
const BINS: usize = 1024;
/// Halvings of the interval in which the level is sought: to 1e-6.
const HALVINGS: u32 = 20;

/// Extinction (1/m) deep in clouds: the mean over their matter.
#[must_use]
pub fn deep_extinction_per_m(extinction: &Grid3<f32>) -> f64 {
    let sums = |(mass, squares): (f64, f64), value: &f32| {
        let value = f64::from(*value);
        (mass + value, squares + value * value)
    };
    let (mass, squares) = extinction.cells().iter().fold((0.0, 0.0), sums);
    if mass > 0.0 { squares / mass } else { 1.0 }
}

/// Extinction whose edges rise `steepness` times as fast, 1 to 4, about a level at which the whole mass stays the same. What
/// is denser than `deep_per_m` and what is empty stay as they are.
///
/// # Errors
/// When the steepness is outside its range or `deep_per_m` is not positive.
pub fn steepened(extinction: &Grid3<f32>, deep_per_m: f64, steepness: f64) -> Result<Grid3<f32>, CloudError> {
    in_range("steepness of edges", steepness, (1.0, 4.0), "")?;
    in_range("extinction deep in clouds", deep_per_m, (1e-12, 1e12), " 1/m")?;
    let level = level(extinction, deep_per_m, steepness);
    let (deep, factor) = (narrow(deep_per_m), narrow(steepness));
    let start = narrow(level - 0.5 / steepness) * deep;
    let value = |value: &f32| if *value >= deep { *value } else { (factor * (value - start)).clamp(0.0, deep) };
    let cells = extinction.cells().par_iter().map(value).collect();
    Ok(Grid3::from_cells(extinction.size(), cells).unwrap_or_else(|| extinction.clone()))
}

/// Share about which edges become steeper.
fn level(extinction: &Grid3<f32>, deep_per_m: f64, steepness: f64) -> f64 {
    let mut counts = [0.0_f64; BINS];
    let scale = BINS as f64 / deep_per_m;
    for value in extinction.cells().iter().filter(|value| **value > 0.0) {
        if let Some(count) = counts.get_mut(whole(scale * f64::from(*value))) {
            *count += 1.0;
        }
    }
    // What the edges gain at a level.
    let gain = |level: f64| {
        let share = |bin: usize| (bin as f64 + 0.5) / BINS as f64;
        let steep = |share: f64| (0.5 + steepness * (share - level)).clamp(0.0, 1.0);
        counts.iter().enumerate().map(|(bin, count)| count * (steep(share(bin)) - share(bin))).sum::<f64>()
    };
    // At the lowest level every share grows, at the highest none does.
    let (mut low, mut high) = (0.5 / steepness, 1.0 + 0.5 / steepness);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if gain(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// The whole part of a share in bins.
#[expect(clippy::cast_possible_truncation, reason = "floats saturate, and what is beyond the last bin is left out")]
fn whole(bins: f64) -> usize {
    bins as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ball of cloud with a soft edge.
    fn blob() -> Grid3<f32> {
        let cells = crate::grid_size::cells([24, 24, 24]).map(|cell| {
            let distance = cell.iter().map(|part| (*part as f32 - 11.5).powi(2)).sum::<f32>().sqrt();
            0.05 * (1.0 - (distance - 4.0) / 6.0).clamp(0.0, 1.0)
        });
        Grid3::from_cells([24, 24, 24], cells.collect()).unwrap()
    }

    fn mass(grid: &Grid3<f32>) -> f64 {
        grid.cells().iter().map(|value| f64::from(*value)).sum()
    }

    #[test]
    fn steeper_edges_hold_the_same_mass_in_fewer_cells() {
        let soft = blob();
        for steepness in [1.3, 2.0, 3.5] {
            let steep = steepened(&soft, 0.05, steepness).unwrap();
            // Bins are 1/1024 of the range wide.
            assert!((mass(&steep) / mass(&soft) - 1.0).abs() < 1e-3, "{steepness}: {} {}", mass(&steep), mass(&soft));
            let filled = |grid: &Grid3<f32>| grid.cells().iter().filter(|value| **value > 0.0).count();
            assert!(filled(&steep) < filled(&soft), "{steepness}: fewer cells have cloud");
        }
    }

    #[test]
    fn edges_as_steep_as_before_and_an_empty_sky_stay_as_they_are() {
        let soft = blob();
        let same = steepened(&soft, 0.05, 1.0).unwrap();
        let largest = same.cells().iter().zip(soft.cells()).fold(0.0, |most, (a, b)| f32::max(most, (a - b).abs()));
        assert!(largest < 1e-6, "{largest}");
        let empty = Grid3::filled([4, 4, 4], 0.0);
        assert_eq!(steepened(&empty, deep_extinction_per_m(&empty), 2.0).unwrap(), empty, "nothing comes of nothing");
    }

    #[test]
    fn the_depth_of_clouds_is_that_of_most_of_their_matter() {
        let mut grid = Grid3::filled([10, 10, 10], 0.0);
        (0..300).for_each(|index| grid.cells_mut()[index] = 0.08);
        (300..400).for_each(|index| grid.cells_mut()[index] = 0.001);
        assert!((deep_extinction_per_m(&grid) - 0.08).abs() < 1e-3, "{}", deep_extinction_per_m(&grid));
    }

    #[test]
    fn a_steepness_below_one_is_refused() {
        let text = steepened(&blob(), 0.05, 0.5).unwrap_err().to_string();
        assert_eq!(text, "steepness of edges = 0.5 is outside 1 to 4");
    }
}

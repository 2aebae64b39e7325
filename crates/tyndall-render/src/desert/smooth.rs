//! Takes the steps of single slabs out of a bed and leaves crests sharp.
//!
//! Heights are moved towards their surroundings as far as a slab's thickness explains the difference; at a crest it is many
//! times larger, and nothing moves there. Three passes of a kernel one cell wide.

use tyndall_dunes::Edges;
use tyndall_dunes::measure::HeightGrid;

const PASSES: u32 = 3;

/// Weights of the five cells around one.
const KERNEL: [f32; 5] = [1.0 / 16.0, 4.0 / 16.0, 6.0 / 16.0, 4.0 / 16.0, 1.0 / 16.0];

/// A bed without steps up to about `step_cells`.
#[must_use]
pub fn smooth_bed(bed: HeightGrid, step_cells: f32, edges: Edges) -> HeightGrid {
    let size = bed.size();
    let mut heights = bed.heights().to_vec();
    for _ in 0..PASSES {
        let around = blur(&heights, size, edges);
        for (height, around) in heights.iter_mut().zip(around) {
            let off = around - *height;
            let unexplained = (off / (1.5 * step_cells).max(1e-6)).powi(4);
            *height += off / (1.0 + unexplained);
        }
    }
    HeightGrid::new(size, heights).unwrap_or(bed)
}

/// Means over about one cell on each side; rows, then columns.
#[must_use]
pub fn blur(values: &[f32], [nx, ny]: [usize; 2], edges: Edges) -> Vec<f32> {
    let index = |at: usize, tap: usize, count: usize| match edges {
        Edges::Periodic => (at + tap + count - 2) % count,
        Edges::Open => (at + tap).saturating_sub(2).min(count - 1),
    };
    let cells = || (0..ny).flat_map(move |y| (0..nx).map(move |x| (x, y)));
    let weighted =
        |value: &dyn Fn(usize) -> f32| KERNEL.iter().enumerate().map(|(tap, weight)| weight * value(tap)).sum();
    let rows: Vec<f32> = cells().map(|(x, y)| weighted(&|tap| values[y * nx + index(x, tap, nx)])).collect();
    cells().map(|(x, y)| weighted(&|tap| rows[index(y, tap, ny) * nx + x])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use tyndall_dunes::hash::cell_word;

    const SLAB: f32 = 1.0 / 12.0;

    /// A ridge of 60 cells across 128, windward slope 0.2, lee slope 0.65, in whole slabs that lie here or there by chance.
    fn ridge(with_slabs: bool) -> HeightGrid {
        let height = |index: u32| {
            let x = (index % 128) as f32 - 64.0;
            let smooth = (12.0 + if x < 0.0 { 0.2 * x } else { -0.65 * x }).max(0.0) + 4.0;
            let chance = (cell_word(3, index) >> 8) as f32 / 16_777_216.0;
            if with_slabs { (smooth / SLAB + chance).floor() * SLAB } else { smooth }
        };
        HeightGrid::new([128, 128], (0..128 * 128).map(height).collect()).expect("as many heights as cells")
    }

    #[test]
    fn steps_of_slabs_vanish_from_slopes() {
        let (exact, rough) = (ridge(false), ridge(true));
        let smooth = smooth_bed(rough.clone(), SLAB, Edges::Periodic);
        let worst = |bed: &HeightGrid| {
            // On the windward slope, away from its ends.
            let cells = (0..128).flat_map(|y| (20..55).map(move |x| (x, y)));
            let squares: Vec<f64> =
                cells.map(|(x, y)| (bed.gradient(x, y)[0] - exact.gradient(x, y)[0]).powi(2)).collect();
            (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
        };
        let (before, after) = (worst(&rough), worst(&smooth));
        // 0.007 is 0.4 degrees, as much as a slope of 11 degrees changes its light by 3 per cent under a sun at 15.
        assert!(before > 0.02 && after < 0.007, "slope noise {before} before, {after} after");
    }

    #[test]
    fn crests_stay_sharp() {
        let (exact, smooth) = (ridge(false), smooth_bed(ridge(true), SLAB, Edges::Periodic));
        let drop = (0..128).map(|y| exact.at(64, y) - smooth.at(64, y)).sum::<f64>() / 128.0;
        // Three passes of the plain kernel take half a cell off this crest.
        assert!(drop.abs() < 0.1, "the crest is {drop} cells lower");
    }

    #[test]
    fn smoothing_an_even_slope_does_not_move_it() {
        let plane =
            HeightGrid::new([32, 32], (0..1024).map(|index| (index % 32) as f32 * 0.3).collect()).expect("1024");
        let smooth = smooth_bed(plane.clone(), SLAB, Edges::Open);
        for (x, y) in [(10, 10), (16, 3), (20, 31)] {
            assert!((smooth.at(x, y) - plane.at(x, y)).abs() < 1e-5, "({x}, {y}): {}", smooth.at(x, y));
        }
    }
}

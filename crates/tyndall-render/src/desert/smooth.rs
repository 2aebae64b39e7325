//! Takes the steps of slabs out of a bed and leaves crests sharp.
//!
//! Heights are moved towards their surroundings as far as a few slabs explain the difference; at a crest it is many times
//! larger, and nothing moves there. Kernels of growing width, the way of wavelets "with holes", take out lumps of several cells.

use tyndall_dunes::Edges;
use tyndall_dunes::measure::HeightGrid;

/// Distance of the kernel's taps (cells) in each pass.
const STRIDES: [usize; 5] = [1, 1, 2, 2, 3];

/// Slabs that a difference may have to count as an accident.
const SLABS: f32 = 2.0;

/// Weights of five taps.
const KERNEL: [f32; 5] = [1.0 / 16.0, 4.0 / 16.0, 6.0 / 16.0, 4.0 / 16.0, 1.0 / 16.0];

/// A bed without steps of slabs that are `slab_cells` thick.
#[must_use]
pub fn smooth_bed(bed: HeightGrid, slab_cells: f32, edges: Edges) -> HeightGrid {
    let size = bed.size();
    let mut heights = bed.heights().to_vec();
    for stride in STRIDES {
        let around = blur(&heights, size, edges, stride);
        for (height, around) in heights.iter_mut().zip(around) {
            let off = around - *height;
            let unexplained = (off / (SLABS * slab_cells).max(1e-6)).powi(4);
            *height += off / (1.0 + unexplained);
        }
    }
    HeightGrid::new(size, heights).unwrap_or(bed)
}

/// Means over about `stride` cells on each side; rows, then columns.
#[must_use]
pub fn blur(values: &[f32], [nx, ny]: [usize; 2], edges: Edges, stride: usize) -> Vec<f32> {
    let index = |at: usize, tap: usize, count: usize| match edges {
        Edges::Periodic => (at + tap * stride + 2 * stride * count - 2 * stride) % count,
        Edges::Open => (at + tap * stride).saturating_sub(2 * stride).min(count - 1),
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
        let noise = |bed: &HeightGrid| {
            // On the windward slope, away from its ends.
            let cells = (0..128).flat_map(|y| (20..50).map(move |x| (x, y)));
            let squares: Vec<f64> =
                cells.map(|(x, y)| (bed.gradient(x, y)[0] - exact.gradient(x, y)[0]).powi(2)).collect();
            (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
        };
        let (before, after) = (noise(&rough), noise(&smooth));
        // 0.003 is 0.2 degrees: light under a sun at 15 degrees changes by 1 per cent.
        assert!(before > 0.02 && after < 0.003, "slope noise {before} before, {after} after");
    }

    #[test]
    fn crests_stay_sharp() {
        let (exact, smooth) = (ridge(false), smooth_bed(ridge(true), SLAB, Edges::Periodic));
        let drop = (0..128).map(|y| exact.at(64, y) - smooth.at(64, y)).sum::<f64>() / 128.0;
        // The plain kernels would take 1.5 cells off this crest.
        assert!(drop.abs() < 0.15, "the crest is {drop} cells lower");
    }

    #[test]
    fn smoothing_an_even_slope_does_not_move_it() {
        let heights = (0..4096).map(|index| (index % 64) as f32 * 0.3).collect();
        let plane = HeightGrid::new([64, 64], heights).expect("as many heights as cells");
        let smooth = smooth_bed(plane.clone(), SLAB, Edges::Open);
        for (x, y) in [(30, 10), (32, 3), (33, 63)] {
            assert!((smooth.at(x, y) - plane.at(x, y)).abs() < 1e-4, "({x}, {y}): {}", smooth.at(x, y));
        }
    }
}

//! Means over the cells around, and a quick way to take the steps of slabs out of a bed; [`crate::smooth`] is the thorough one.
//!
//! Heights are moved towards their surroundings as far as a few slabs explain the difference; at a crest it is many times
//! larger, and nothing moves there. Kernels of growing width, the way of wavelets "with holes", take out lumps of several cells.

use rayon::prelude::*;

use crate::edges::Edges;
use crate::measure::HeightGrid;

/// Distance of the kernel's taps (cells) in each pass.
const STRIDES: [usize; 5] = [1, 1, 2, 2, 3];

/// Slabs that a difference may have to count as an accident.
const SLABS: f32 = 2.0;

/// Weights of five taps.
const KERNEL: [f32; 5] = [1.0 / 16.0, 4.0 / 16.0, 6.0 / 16.0, 4.0 / 16.0, 1.0 / 16.0];

/// A bed without steps of slabs that are `slab_cells` thick.
#[must_use]
pub fn quick_smooth_bed(bed: &HeightGrid, slab_cells: f32, edges: Edges) -> HeightGrid {
    let size = bed.size();
    let mut heights = bed.heights().to_vec();
    for stride in STRIDES {
        let around = blur(&heights, size, edges, stride);
        heights.par_chunks_mut(size[0]).zip(around.par_chunks(size[0])).for_each(|(row, around)| {
            for (height, around) in row.iter_mut().zip(around) {
                let off = around - *height;
                let unexplained = (off / (SLABS * slab_cells).max(1e-6)).powi(4);
                *height += off / (1.0 + unexplained);
            }
        });
    }
    HeightGrid::new(size, heights).unwrap_or_else(|| bed.clone())
}

/// Means over about `stride` cells on each side; rows, then columns.
#[must_use]
pub fn blur(values: &[f32], [nx, ny]: [usize; 2], edges: Edges, stride: usize) -> Vec<f32> {
    let mut rows = vec![0.0; values.len()];
    rows.par_chunks_mut(nx).zip(values.par_chunks(nx)).for_each(|(blurred, row)| {
        let padded: Vec<f32> = (0..nx + 4 * stride).map(|at| row[tap(at, nx, edges, stride)]).collect();
        weigh(blurred, [0, 1, 2, 3, 4].map(|tap| &padded[tap * stride..]));
    });
    let row = |y: usize| &rows[y * nx..(y + 1) * nx];
    let mut blurred = vec![0.0; values.len()];
    blurred.par_chunks_mut(nx).enumerate().for_each(|(y, blurred)| {
        weigh(blurred, [0, 1, 2, 3, 4].map(|index| row(tap(y + index * stride, ny, edges, stride))));
    });
    blurred
}

/// The cell at a place of a row that begins two strides before its first cell.
fn tap(at: usize, count: usize, edges: Edges, stride: usize) -> usize {
    match edges {
        Edges::Periodic => (at + 2 * stride * (count - 1)) % count,
        Edges::Open => at.saturating_sub(2 * stride).min(count - 1),
    }
}

/// Sums of five rows by the kernel's weights; whole rows at a time, so that processors add several cells at once.
fn weigh(sums: &mut [f32], rows: [&[f32]; 5]) {
    let count = sums.len();
    let [a, b, c, d, e] = rows.map(|row| &row[..count]);
    for (index, sum) in sums.iter_mut().enumerate() {
        *sum = KERNEL[0] * a[index]
            + KERNEL[1] * b[index]
            + KERNEL[2] * c[index]
            + KERNEL[3] * d[index]
            + KERNEL[4] * e[index];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hash::cell_word;

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
        let smooth = quick_smooth_bed(&rough, SLAB, Edges::Periodic);
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
    fn means_are_those_of_the_kernel_at_every_edge() {
        let size = [12, 7];
        let values: Vec<f32> = (0..84).map(|index| (cell_word(5, index) >> 24) as f32).collect();
        for (edges, stride) in [(Edges::Periodic, 1_usize), (Edges::Periodic, 4), (Edges::Open, 1), (Edges::Open, 3)] {
            let at = |place: usize, tap: usize, count: usize| {
                let at = place.cast_signed() + (tap.cast_signed() - 2) * stride.cast_signed();
                match edges {
                    Edges::Periodic => at.rem_euclid(count.cast_signed()).cast_unsigned(),
                    Edges::Open => at.clamp(0, count.cast_signed() - 1).cast_unsigned(),
                }
            };
            for (index, found) in blur(&values, size, edges, stride).into_iter().enumerate() {
                let taps = (0..5).flat_map(|row| (0..5).map(move |column| (row, column)));
                let expected: f32 = taps
                    .map(|(row, column)| {
                        let cell = at(index / 12, row, 7) * 12 + at(index % 12, column, 12);
                        KERNEL[row] * KERNEL[column] * values[cell]
                    })
                    .sum();
                assert!((found - expected).abs() < 1e-3, "{edges:?}, {stride}, cell {index}: {found}, {expected}");
            }
        }
    }

    #[test]
    fn crests_stay_sharp() {
        let (exact, smooth) = (ridge(false), quick_smooth_bed(&ridge(true), SLAB, Edges::Periodic));
        let drop = (0..128).map(|y| exact.at(64, y) - smooth.at(64, y)).sum::<f64>() / 128.0;
        // The plain kernels would take 1.5 cells off this crest.
        assert!(drop.abs() < 0.15, "the crest is {drop} cells lower");
    }

    #[test]
    fn smoothing_an_even_slope_does_not_move_it() {
        let heights = (0..4096).map(|index| (index % 64) as f32 * 0.3).collect();
        let plane = HeightGrid::new([64, 64], heights).expect("as many heights as cells");
        let smooth = quick_smooth_bed(&plane, SLAB, Edges::Open);
        for (x, y) in [(30, 10), (32, 3), (33, 63)] {
            assert!((smooth.at(x, y) - plane.at(x, y)).abs() < 1e-4, "({x}, {y}): {}", smooth.at(x, y));
        }
    }
}

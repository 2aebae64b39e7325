//! The surface that a bed of slabs stands for: even slopes without the steps of slabs, with creases where crests are.
//!
//! After the mesh smoothing of Jones, Durand and Desbrun 2003: each cell's neighbours predict its height by the planes that
//! touch the bed there, and predictions count the less the further they are off. Beside a crest the planes of the other side
//! are far off, so windward slope and slip face are each drawn to their own plane and meet in a crease; a plane stays as it
//! is. Passes over near neighbours, then over every second and every third cell further out, and over near ones again to
//! take out the grain of the wide passes. About 0.2 us a cell. For pictures and maps only: nothing here is exact to the quantum.

pub mod repose;

use rayon::prelude::*;

use crate::edges::Edges;
use crate::measure::HeightGrid;

/// A pass over neighbours within [`TAPS`] times a stride.
#[derive(Clone, Copy)]
struct Pass {
    /// Cells from one neighbour to the next.
    stride: usize,
    /// Standard deviation of the weights by distance (cells).
    spread_cells: f32,
    /// How far off a prediction may be (slabs).
    off_slabs: f32,
}

const PASSES: [Pass; 4] = [
    Pass { stride: 1, spread_cells: 1.5, off_slabs: 4.8 },
    Pass { stride: 2, spread_cells: 3.5, off_slabs: 3.6 },
    Pass { stride: 3, spread_cells: 5.0, off_slabs: 2.4 },
    Pass { stride: 1, spread_cells: 2.0, off_slabs: 1.4 },
];

/// Neighbours on each side.
const TAPS: isize = 4;

/// Least and most that predictions may be off (cells): slopes are rough beyond the slabs, and crests are as high as a cell.
const OFF_CELLS: [f32; 2] = [0.02, 0.5];

/// Weights that soften the bed before its slopes are taken.
const SOFT: [f32; 5] = [1.0 / 16.0, 4.0 / 16.0, 6.0 / 16.0, 4.0 / 16.0, 1.0 / 16.0];

/// A bed without steps of slabs that are `slab_cells` thick.
#[must_use]
pub fn smooth_bed(bed: &HeightGrid, slab_cells: f32, edges: Edges) -> HeightGrid {
    let size = bed.size();
    let pass = |heights: Vec<f32>, pass: Pass| {
        let off_cells = (pass.off_slabs * slab_cells).clamp(OFF_CELLS[0], OFF_CELLS[1]);
        predicted(&heights, size, edges, pass, off_cells)
    };
    let smooth = PASSES.into_iter().fold(bed.heights().to_vec(), pass);
    HeightGrid::new(size, smooth).unwrap_or_else(|| bed.clone())
}

/// Heights as their neighbours predict them.
fn predicted(heights: &[f32], size: [usize; 2], edges: Edges, pass: Pass, off_cells: f32) -> Vec<f32> {
    let soft = along_columns(&along_rows(heights, size, edges, &SOFT), size, edges, &SOFT);
    let slope = [-0.5, 0.0, 0.5];
    let margin = TAPS.unsigned_abs() * pass.stride;
    // No prediction counts that is so far off as one from beyond an open edge.
    let padded = |grid: &[f32], beyond: f32| pad_rows(grid, size[0], edges, margin, beyond);
    let planes = Planes {
        size,
        edges,
        margin,
        heights: padded(heights, 1e9),
        east: padded(&along_rows(&soft, size, edges, &slope), 0.0),
        north: padded(&along_columns(&soft, size, edges, &slope), 0.0),
        taps: taps(pass),
        // The bell exp(-e^2 / 2) as (1 - e^2 / 8)^4, which ends.
        narrowness: 1.0 / (8.0 * off_cells * off_cells),
    };
    let mut out = vec![0.0; heights.len()];
    out.par_chunks_mut(size[0]).enumerate().for_each(|(y, out)| {
        pulp::Arch::new().dispatch(PredictRow { planes: &planes, y, out });
    });
    out
}

/// A neighbour: offset (cells) and weight.
#[derive(Clone, Copy)]
struct Tap {
    offset: [isize; 2],
    weight: f32,
}

/// Neighbours within a circle.
fn taps(pass: Pass) -> Vec<Tap> {
    let stride = pass.stride.cast_signed();
    let offsets = (-TAPS..=TAPS).flat_map(|y| (-TAPS..=TAPS).map(move |x| [x, y]));
    let inside = offsets.filter(|[x, y]| x * x + y * y <= TAPS * TAPS);
    let weight = |[x, y]: [isize; 2]| {
        (-0.5 * ((x * x + y * y) * stride * stride) as f32 / (pass.spread_cells * pass.spread_cells)).exp()
    };
    inside.map(|[x, y]| Tap { offset: [x * stride, y * stride], weight: weight([x, y]) }).collect()
}

/// Planes that touch a bed, in rows with a margin at either end.
struct Planes {
    size: [usize; 2],
    edges: Edges,
    margin: usize,
    heights: Vec<f32>,
    east: Vec<f32>,
    north: Vec<f32>,
    taps: Vec<Tap>,
    narrowness: f32,
}

impl Planes {
    /// Where in the padded grids the row begins that a tap reads for row `y`; `None` beyond an open edge.
    #[inline(always)]
    fn start(&self, y: usize, [dx, dy]: [isize; 2]) -> Option<usize> {
        let ny = self.size[1].cast_signed();
        let row = y.cast_signed() + dy;
        let inside = self.edges == Edges::Periodic || (0..ny).contains(&row);
        let width = self.size[0] + 2 * self.margin;
        inside.then(|| row.rem_euclid(ny).cast_unsigned() * width + self.margin.wrapping_add_signed(dx))
    }
}

/// A row of predictions, for the widest vector instructions that this computer has.
struct PredictRow<'a> {
    planes: &'a Planes,
    y: usize,
    out: &'a mut [f32],
}

impl pulp::NullaryFnOnce for PredictRow<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let (planes, nx) = (self.planes, self.out.len());
        let Some(own) = planes.start(self.y, [0, 0]).map(|start| &planes.heights[start..][..nx]) else { return };
        let mut weights = vec![0.0_f32; nx];
        for tap in &planes.taps {
            let Some(start) = planes.start(self.y, tap.offset) else { continue };
            let [dx, dy] = tap.offset.map(|cells| cells as f32);
            let heights = &planes.heights[start..][..nx];
            let (east, north) = (&planes.east[start..][..nx], &planes.north[start..][..nx]);
            for x in 0..nx {
                let height = heights[x] - dx * east[x] - dy * north[x];
                let off = height - own[x];
                let near = (1.0 - off * off * planes.narrowness).max(0.0);
                let weight = tap.weight * (near * near) * (near * near);
                self.out[x] += weight * height;
                weights[x] += weight;
            }
        }
        // A cell agrees with itself, so no sum is 0.
        for (out, weight) in self.out.iter_mut().zip(weights) {
            *out /= weight;
        }
    }
}

/// Rows with `margin` more cells at either end: the other end of the row, or `beyond` an open edge.
fn pad_rows(grid: &[f32], nx: usize, edges: Edges, margin: usize, beyond: f32) -> Vec<f32> {
    let mut padded = Vec::with_capacity((nx + 2 * margin) * (grid.len() / nx));
    for row in grid.chunks_exact(nx) {
        let at = |x: usize| if edges == Edges::Periodic { row[x % nx] } else { beyond };
        let before = margin.div_ceil(nx) * nx - margin;
        padded.extend((before..before + margin).map(at));
        padded.extend_from_slice(row);
        padded.extend((0..margin).map(at));
    }
    padded
}

/// The cell that a tap of a kernel reads: the next one round, or the last at an open edge.
fn tap_cell(at: usize, tap: usize, (count, edges): (usize, Edges), taps: usize) -> usize {
    let cell = (at + tap).cast_signed() - (taps / 2).cast_signed();
    let last = count.cast_signed() - 1;
    match edges {
        Edges::Periodic => cell.rem_euclid(count.cast_signed()),
        Edges::Open => cell.clamp(0, last),
    }
    .cast_unsigned()
}

/// Weighted sums over the cells around each in its row.
fn along_rows(grid: &[f32], [nx, _]: [usize; 2], edges: Edges, kernel: &[f32]) -> Vec<f32> {
    let mut out = vec![0.0; grid.len()];
    let reach = kernel.len() / 2;
    out.par_chunks_mut(nx).zip(grid.par_chunks(nx)).for_each(|(out, row)| {
        let cells: Vec<f32> = (0..nx + 2 * reach).map(|x| row[tap_cell(x, 0, (nx, edges), kernel.len())]).collect();
        for (tap, weight) in kernel.iter().enumerate() {
            for (out, cell) in out.iter_mut().zip(&cells[tap..]) {
                *out += weight * cell;
            }
        }
    });
    out
}

/// The same in columns.
fn along_columns(grid: &[f32], [nx, ny]: [usize; 2], edges: Edges, kernel: &[f32]) -> Vec<f32> {
    let mut out = vec![0.0; grid.len()];
    out.par_chunks_mut(nx).enumerate().for_each(|(y, out)| {
        for (tap, weight) in kernel.iter().enumerate() {
            let row = tap_cell(y, tap, (ny, edges), kernel.len());
            for (out, cell) in out.iter_mut().zip(&grid[row * nx..]) {
                *out += weight * cell;
            }
        }
    });
    out
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
        HeightGrid::new([128, 128], (0..128 * 128).map(height).collect()).unwrap()
    }

    fn rms(values: impl Iterator<Item = f64>) -> f64 {
        let squares: Vec<f64> = values.map(|value| value * value).collect();
        (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
    }

    fn patch(x: std::ops::Range<isize>) -> impl Iterator<Item = (isize, isize)> {
        (0..128).flat_map(move |y| x.clone().map(move |x| (x, y)))
    }

    #[test]
    fn steps_of_slabs_vanish_from_slopes_and_from_slip_faces() {
        let (exact, rough) = (ridge(false), ridge(true));
        let smooth = smooth_bed(&rough, SLAB, Edges::Periodic);
        let noise = |bed: &HeightGrid, x: std::ops::Range<isize>| {
            rms(patch(x).map(|(x, y)| bed.gradient(x, y)[0] - exact.gradient(x, y)[0]))
        };
        let (before, after) = (noise(&rough, 20..50), noise(&smooth, 20..50));
        // 0.003 is 0.2 degrees: light under a sun at 15 degrees changes by 1 per cent.
        assert!(before > 0.02 && after < 0.003, "slope noise {before} before, {after} after");
        // The whole slip face, up to two cells from the crest: half a degree.
        let face = noise(&smooth, 66..79);
        assert!(face < 0.012, "slope noise {face} on the slip face");
    }

    #[test]
    fn crests_stay_sharp() {
        let (exact, smooth) = (ridge(false), smooth_bed(&ridge(true), SLAB, Edges::Periodic));
        let drop = (0..128).map(|y| exact.at(64, y) - smooth.at(64, y)).sum::<f64>() / 128.0;
        // Plain kernels of this width would take 1.5 cells off this crest.
        assert!(drop.abs() < 0.15, "the crest is {drop} cells lower");
        let bend = (0..128).map(|y| smooth.gradient(62, y)[0] - smooth.gradient(66, y)[0]).sum::<f64>() / 128.0;
        assert!((bend - 0.85).abs() < 0.03, "two cells from the crest slopes differ by {bend}, not 0.85");
    }

    #[test]
    fn smoothing_keeps_planes_and_nearly_all_sand() {
        let heights = (0..4096).map(|index| (index % 64) as f32 * 0.3).collect();
        let plane = HeightGrid::new([64, 64], heights).unwrap();
        let smooth = smooth_bed(&plane, SLAB, Edges::Open);
        for (x, y) in [(30, 10), (32, 3), (33, 63), (30, 0)] {
            assert!((smooth.at(x, y) - plane.at(x, y)).abs() < 1e-4, "({x}, {y}): {}", smooth.at(x, y));
        }
        let rough = ridge(true);
        let lost = 1.0 - smooth_bed(&rough, SLAB, Edges::Periodic).mean_cells() / rough.mean_cells();
        assert!(lost.abs() < 2e-3, "{lost} of the sand is lost");
    }
}

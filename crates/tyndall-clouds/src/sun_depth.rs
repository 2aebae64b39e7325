//! The light volume: how much cloud lies between each cell and the sun.
//!
//! Slices of the grid, across the axis that is nearest to the sun's direction, are walked from the sun outwards. The sum so
//! far stands on a lattice that slides along with the rays, so that density is interpolated once on its way into the sum
//! and once out of it; interpolating the sum from slice to slice, the usual way, would blur every shadow more with each
//! slice. Additions and multiplications only, in a fixed order: the same bits on any number of threads.
//!
//! The result is density times cells; times extinction and the side of a cell it is an optical depth. A cell counts half of
//! itself, which is the mean over it (the paper reads after the ball's whole own attenuation, which is too dark). Sides are
//! open: a wrapped grid's neighbours throw no shadow.
#![expect(clippy::inline_always, reason = "only what is inlined is compiled for the processor's wider instructions")]

use rayon::prelude::*;
use tyndall_core::grid::Grid3;

use crate::error::{CloudError, in_range, same_size};
use crate::narrow::narrow;

/// Rows that one task works on.
const ROWS_PER_TASK: usize = 64;

/// Density times cells from each cell's centre towards the sun, for a grid of densities at cells' centres.
///
/// `to_sun` points east, north and up; its length does not matter.
///
/// # Errors
/// When `to_sun` is zero or not finite.
pub fn sun_depth(density: &Grid3<f32>, to_sun: [f64; 3]) -> Result<Grid3<f32>, CloudError> {
    let mut depth = Grid3::filled(density.size(), 0.0);
    sun_depth_into(density, to_sun, &mut depth)?;
    Ok(depth)
}

/// [`sun_depth`] into a grid that is there already: fresh memory costs as much as the work.
///
/// # Errors
/// Also when `depth` has another size.
pub fn sun_depth_into(density: &Grid3<f32>, to_sun: [f64; 3], depth: &mut Grid3<f32>) -> Result<(), CloudError> {
    same_size("the light volume", depth, density.size())?;
    let length = to_sun.iter().map(|part| part * part).sum::<f64>().sqrt();
    in_range("length of the sun's direction", length, (1e-100, 1e100), "")?;
    let [east, north, up] = to_sun.map(|part| part / length);
    if up.abs() >= east.abs().max(north.abs()) {
        walk(density, &Walk::new(Axis::Height, up, north, east), depth);
    } else if north.abs() >= east.abs() {
        walk(density, &Walk::new(Axis::North, north, up, east), depth);
    } else {
        let [nx, ny, nz] = density.size();
        let mut turned = Grid3::filled([ny, nx, nz], 0.0);
        exchange_east_and_north(density, &mut turned);
        let mut turned_depth = Grid3::filled([ny, nx, nz], 0.0);
        walk(&turned, &Walk::new(Axis::North, east, up, north), &mut turned_depth);
        exchange_east_and_north(&turned_depth, depth);
    }
    Ok(())
}

/// Axis across which the slices lie; x never, because it runs fastest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Axis {
    North,
    Height,
}

/// How a ray goes from slice to slice.
#[derive(Clone, Copy, Debug)]
struct Walk {
    axis: Axis,
    /// Whether the last slice is the nearest to the sun.
    from_last: bool,
    /// Cells across rows and along x that a ray towards the sun moves in a slice.
    drift: [f64; 2],
    /// Length of a ray within a slice (cells).
    length: f32,
}

impl Walk {
    fn new(axis: Axis, along: f64, across_rows: f64, along_rows: f64) -> Self {
        let drift = [across_rows / along.abs(), along_rows / along.abs()];
        Self { axis, from_last: along > 0.0, drift, length: narrow(1.0 / along.abs()) }
    }
}

/// The sliding lattice along one axis.
#[derive(Clone, Copy, Debug)]
struct Slide {
    /// Place of the grid's first cell on the lattice.
    base: usize,
    /// Distance of the cells from there, below 1.
    fraction: f32,
}

impl Slide {
    /// The lattice's length for `count` cells and `slices` slices.
    fn lattice(drift: f64, count: usize, slices: usize) -> usize {
        count + whole(drift.abs() * slices as f64) + 2
    }

    fn new(drift: f64, slice: usize, slices: usize) -> Self {
        // A ray that drifts backwards begins at the lattice's far end.
        let offset = drift * slice as f64 + if drift < 0.0 { whole(-drift * slices as f64) as f64 + 1.0 } else { 0.0 };
        Self { base: whole(offset), fraction: narrow(offset - offset.floor()) }
    }

    fn weights(self) -> [f32; 2] {
        [1.0 - self.fraction, self.fraction]
    }
}

/// The whole part of a number of cells.
#[expect(clippy::cast_possible_truncation, reason = "drifts are at most a cell a slice and never negative here")]
fn whole(cells: f64) -> usize {
    cells as usize
}

/// Sums up one grid, slice by slice.
fn walk(density: &Grid3<f32>, walk: &Walk, depth: &mut Grid3<f32>) {
    let [nx, ny, nz] = density.size();
    let (slices, rows) = if walk.axis == Axis::Height { (nz, ny) } else { (ny, nz) };
    let row_index =
        |slice: usize, row: usize| if walk.axis == Axis::Height { slice * ny + row } else { row * ny + slice };
    let [row_count, width] = [Slide::lattice(walk.drift[0], rows, slices), Slide::lattice(walk.drift[1], nx, slices)];
    let mut sum = vec![0.0_f32; row_count * width];
    let mut targets = slice_rows(depth, walk.axis);
    let arch = pulp::Arch::new();
    for step in 0..slices {
        let slice = if walk.from_last { slices - 1 - step } else { step };
        let [across, along] = walk.drift.map(|drift| Slide::new(drift, step, slices));
        let row = |row: usize| &density.cells()[row_index(slice, row) * nx..][..nx];
        targets[slice].par_chunks_mut(ROWS_PER_TASK).enumerate().for_each(|(task, targets)| {
            let first = task * ROWS_PER_TASK;
            arch.dispatch(ReadRows { sum: &sum, width, across, along, length: walk.length, first, row: &row, targets });
        });
        let touched = &mut sum[across.base * width..(across.base + rows + 1) * width];
        touched.par_chunks_mut(ROWS_PER_TASK * width).enumerate().for_each(|(task, lattice)| {
            let first = task * ROWS_PER_TASK;
            arch.dispatch(AddRows { lattice, width, across, along, length: walk.length, first, rows, row: &row });
        });
    }
}

/// The rows of a grid, slice by slice.
fn slice_rows(grid: &mut Grid3<f32>, axis: Axis) -> Vec<Vec<&mut [f32]>> {
    let [nx, ny, nz] = grid.size();
    let mut slices: Vec<Vec<&mut [f32]>> = Vec::new();
    slices.resize_with(if axis == Axis::Height { nz } else { ny }, Vec::new);
    for (index, row) in grid.cells_mut().chunks_exact_mut(nx).enumerate() {
        slices[if axis == Axis::Height { index / ny } else { index % ny }].push(row);
    }
    slices
}

/// Takes the sum so far to the cells of some rows of a slice, and adds half of each cell.
struct ReadRows<'a, 'b, Row> {
    sum: &'a [f32],
    width: usize,
    across: Slide,
    along: Slide,
    length: f32,
    first: usize,
    row: &'a Row,
    targets: &'a mut [&'b mut [f32]],
}

impl<'grid, Row: Fn(usize) -> &'grid [f32]> pulp::WithSimd for ReadRows<'_, '_, Row> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _simd: S) {
        let [[top, bottom], [left, right]] = [self.across.weights(), self.along.weights()];
        let weights = [top * left, top * right, bottom * left, bottom * right];
        for (index, target) in self.targets.iter_mut().enumerate() {
            let nx = target.len();
            let density = &(self.row)(self.first + index)[..nx];
            let start = (self.first + index + self.across.base) * self.width + self.along.base;
            let (near, far) = (&self.sum[start..][..=nx], &self.sum[start + self.width..][..=nx]);
            let (near_right, far_right) = (&near[1..][..nx], &far[1..][..nx]);
            let (near, far) = (&near[..nx], &far[..nx]);
            for (x, depth) in target.iter_mut().enumerate() {
                let before =
                    weights[0] * near[x] + weights[1] * near_right[x] + weights[2] * far[x] + weights[3] * far_right[x];
                *depth = before + 0.5 * self.length * density[x];
            }
        }
    }
}

/// Adds the cells of a slice to some rows of the lattice.
struct AddRows<'a, Row> {
    lattice: &'a mut [f32],
    width: usize,
    across: Slide,
    along: Slide,
    length: f32,
    first: usize,
    rows: usize,
    row: &'a Row,
}

impl<'grid, Row: Fn(usize) -> &'grid [f32]> pulp::WithSimd for AddRows<'_, Row> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _simd: S) {
        let [same, before] = self.across.weights();
        for (index, lattice) in self.lattice.chunks_exact_mut(self.width).enumerate() {
            let place = self.first + index;
            // Row `place` of the lattice lies between the grid's rows `place` and the one before.
            for (row, weight) in [(Some(place), same), (place.checked_sub(1), before)] {
                let Some(row) = row.filter(|&row| row < self.rows && weight > 0.0) else { continue };
                let weights = self.along.weights().map(|along| along * weight * self.length);
                add_row((self.row)(row), weights, &mut lattice[self.along.base..]);
            }
        }
    }
}

/// Adds a row between the lattice's places.
#[inline(always)]
fn add_row(row: &[f32], [same, before]: [f32; 2], lattice: &mut [f32]) {
    let nx = row.len();
    lattice[0] += same * row[0];
    lattice[nx] += before * row[nx - 1];
    let (right, left) = (&row[1..], &row[..nx - 1]);
    for ((sum, right), left) in lattice[1..nx].iter_mut().zip(right).zip(left) {
        *sum += same * right + before * left;
    }
}

/// Side of the blocks in which x and y are exchanged: a cache line.
const BLOCK: usize = 16;

/// The grid with x and y exchanged, in blocks that stay in the cache.
fn exchange_east_and_north(grid: &Grid3<f32>, turned: &mut Grid3<f32>) {
    let [nx, ny, _] = grid.size();
    turned.cells_mut().par_chunks_exact_mut(nx * ny).zip(grid.cells().par_chunks_exact(nx * ny)).for_each(
        |(turned, plane)| {
            for (first_x, turned) in (0..nx).step_by(BLOCK).zip(turned.chunks_mut(BLOCK * ny)) {
                for (first_y, plane) in (0..ny).step_by(BLOCK).zip(plane.chunks(BLOCK * nx)) {
                    exchange_block(plane, nx, first_x, turned, ny, first_y);
                }
            }
        },
    );
}

/// One block: up to [`BLOCK`] rows of the plane, from column `first_x` on.
fn exchange_block(plane: &[f32], nx: usize, first_x: usize, turned: &mut [f32], ny: usize, first_y: usize) {
    let height = plane.len() / nx;
    for (x, row) in turned.chunks_exact_mut(ny).enumerate() {
        for (y, value) in row[first_y..first_y + height].iter_mut().enumerate() {
            *value = plane[y * nx + first_x + x];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid_size::cells;

    #[test]
    fn under_an_overhead_sun_the_depth_is_the_sum_of_the_cells_above_and_half_of_the_own() {
        let size = [5, 4, 12];
        let values = (0..240).map(|i| (i * 37 % 11) as f32).collect();
        let density = Grid3::from_cells(size, values).unwrap();
        let depth = sun_depth(&density, [0.0, 0.0, 3.0]).unwrap();
        for [x, y, z] in cells(size) {
            let above: f32 = (z + 1..12).map(|z| density[[x, y, z]]).sum();
            let wanted = above + 0.5 * density[[x, y, z]];
            assert!((depth[[x, y, z]] - wanted).abs() < 1e-4, "({x}, {y}, {z})");
        }
    }

    /// A soft ball of density, whose columns are known.
    fn blob(size: [usize; 3], centre: [f64; 3], sigma: f64) -> Grid3<f32> {
        let place = |cell: [usize; 3], axis: usize| cell[axis] as f64 + 0.5 - centre[axis];
        let value = |cell| (-(0..3).map(|axis| place(cell, axis).powi(2)).sum::<f64>() / (2.0 * sigma * sigma)).exp();
        Grid3::from_cells(size, cells(size).map(|cell| narrow(value(cell))).collect()).unwrap()
    }

    /// Standard normal distribution function by its series, for |t| <= 6.
    fn normal_integral(t: f64) -> f64 {
        let count = 4000;
        let step = (t + 6.0) / f64::from(count);
        let f = |i: i32| (-0.5 * (-6.0 + (f64::from(i) + 0.5) * step).powi(2)).exp();
        (0..count).map(f).sum::<f64>() * step
    }

    #[test]
    fn the_depth_in_a_soft_ball_is_its_columns_integral_for_every_direction() {
        let (size, centre, sigma) = ([44, 40, 42], [22.0, 20.0, 21.0], 4.0);
        let density = blob(size, centre, sigma);
        for to_sun in [
            [0.3, -0.4, 0.87],
            [-0.9, 0.1, 0.2],
            [0.2, 0.95, -0.15],
            [1.0, 0.9, 0.8],
            [0.0, -1.0, 0.0],
            [-0.5, 0.5, -0.7],
        ] {
            let depth = sun_depth(&density, to_sun).unwrap();
            let length = to_sun.iter().map(|part| part * part).sum::<f64>().sqrt();
            let whole = (2.0 * std::f64::consts::PI).sqrt() * sigma;
            for cell in cells(size).step_by(53).filter(|cell| cell.iter().all(|&i| (8..32).contains(&i))) {
                let from = [0, 1, 2].map(|axis| cell[axis] as f64 + 0.5 - centre[axis]);
                let along: f64 = (0..3).map(|axis| from[axis] * to_sun[axis] / length).sum();
                let off2 = from.iter().map(|part| part * part).sum::<f64>() - along * along;
                let wanted =
                    sigma * (-off2 / (2.0 * sigma * sigma)).exp() * normal_integral(-(along / sigma).max(-6.0));
                let found = f64::from(depth[cell]);
                // Two linear interpolations widen the variance of 16 cells^2 by at most 1/2 along both axes across the ray.
                assert!((found - wanted).abs() < 0.03 * whole, "{to_sun:?}, {cell:?}: {found} {wanted}");
            }
        }
    }

    #[test]
    fn in_even_fog_the_depth_is_the_way_to_the_ceiling() {
        let density = Grid3::filled([30, 30, 10], 2.0_f32);
        let depth = sun_depth(&density, [0.3, 0.2, 0.8]).unwrap();
        let length = f64::sqrt(0.09 + 0.04 + 0.64) / 0.8;
        for z in 0..10 {
            let wanted = 2.0 * length * (9.5 - z as f64);
            let found = f64::from(depth[[12, 12, z]]);
            assert!((found - wanted).abs() < 1e-3, "height {z}: {found} {wanted}");
        }
    }

    #[test]
    fn threads_do_not_change_a_bit() {
        let density = blob([70, 130, 20], [30.0, 60.0, 10.0], 9.0);
        let run = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| sun_depth(&density, [0.7, 0.3, 0.2]).unwrap())
        };
        let bits = |grid: &Grid3<f32>| grid.cells().iter().map(|value| value.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&run(1)), bits(&run(3)), "one thread and three");
    }

    #[test]
    fn a_sun_without_direction_is_refused() {
        for to_sun in [[0.0; 3], [f64::NAN, 0.0, 1.0]] {
            let text = sun_depth(&Grid3::filled([2, 2, 2], 0.0), to_sun).unwrap_err().to_string();
            assert!(text.starts_with("length of the sun's direction"), "{text}");
        }
    }
}

//! Metaballs of one radius on the cells of a grid: equation (3) of the paper as a convolution.
//!
//! rho(P) = sum of `q_j f(|P - C_j| / R)`, taken at the centres of cells. Rows at equal distance are added first, so that the
//! 27 taps of the usual R = 2 cells cost 12 multiplications. The sum of a ball's taps is not quite its mass (2 % too much for
//! R = 2, 6 % too little for R = 1.5), so all taps are scaled by that ratio and mass is kept. Balls that stand outside the grid do not exist, and what
//! spills over its sides is lost, or comes in at the other side of a wrapped grid.
#![expect(clippy::inline_always, reason = "only what is inlined is compiled for the processor's wider instructions")]

use rayon::prelude::*;
use tyndall_core::grid::Grid3;
use tyndall_core::metaball::{BALL_MASS, ball_field};

use crate::edges::Edges;
use crate::error::{CloudError, in_range, same_size};
use crate::narrow::narrow;

/// Smallest and largest radius of a lattice's balls (cells).
pub const RADIUS_RANGE_CELLS: (f64, f64) = (1.0, 4.0);
/// Cells that the largest ball reaches to each side.
const MAX_REACH: usize = 3;

/// Rows at the same distance across (|dy|, |dz|) and their weights along x, for dx = 0 to the reach.
struct RowClass {
    across: [usize; 2],
    weights: [f32; MAX_REACH + 1],
}

/// Density at the cells' centres of balls with radius `radius_cells` and central densities `q` at the same places.
///
/// # Errors
/// When the radius is outside [`RADIUS_RANGE_CELLS`].
pub fn ball_density(q: &Grid3<f32>, radius_cells: f64, edges: Edges) -> Result<Grid3<f32>, CloudError> {
    let mut density = Grid3::filled(q.size(), 0.0);
    ball_density_into(q, radius_cells, edges, &mut density)?;
    Ok(density)
}

/// [`ball_density`] into a grid that is there already: fresh memory costs as much as the work.
///
/// # Errors
/// Also when `density` has another size.
pub fn ball_density_into(
    q: &Grid3<f32>,
    radius_cells: f64,
    edges: Edges,
    density: &mut Grid3<f32>,
) -> Result<(), CloudError> {
    same_size("the density", density, q.size())?;
    in_range("radius of the metaballs", radius_cells, RADIUS_RANGE_CELLS, " cells")?;
    let classes = row_classes(radius_cells);
    let [nx, ny, _] = q.size();
    let arch = pulp::Arch::new();
    density.cells_mut().par_chunks_exact_mut(nx * ny).enumerate().for_each(|(z, cells)| {
        arch.dispatch(Plane { q, classes: &classes, edges, z, cells });
    });
    Ok(())
}

fn row_classes(radius_cells: f64) -> Vec<RowClass> {
    let mass_scale = mass_scale(radius_cells);
    let side = || 0..=MAX_REACH;
    let pairs = side().flat_map(|dz| side().map(move |dy| [dy, dz]));
    let weight = |[dy, dz]: [usize; 2], dx: usize| {
        let distance = ((dx * dx + dy * dy + dz * dz) as f64).sqrt();
        narrow(mass_scale * ball_field(distance / radius_cells))
    };
    let class = |across| RowClass { across, weights: [0, 1, 2, 3].map(|dx| weight(across, dx)) };
    pairs.map(class).filter(|class| class.weights[0] > 0.0).collect()
}

/// Mass of a ball over the sum of its field at the cells' centres.
fn mass_scale(radius_cells: f64) -> f64 {
    let reach = MAX_REACH as f64;
    let side = || (0..=2 * MAX_REACH).map(|tap| (tap as f64 - reach).powi(2));
    let taps = side().flat_map(|x2| side().flat_map(move |y2| side().map(move |z2| x2 + y2 + z2)));
    let sum: f64 = taps.map(|distance2| ball_field(distance2.sqrt() / radius_cells)).sum();
    BALL_MASS * radius_cells.powi(3) / sum
}

/// One height of the result.
struct Plane<'a> {
    q: &'a Grid3<f32>,
    classes: &'a [RowClass],
    edges: Edges,
    z: usize,
    cells: &'a mut [f32],
}

impl pulp::WithSimd for Plane<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _simd: S) {
        let [nx, ny, nz] = self.q.size();
        let mut padded = vec![0.0; nx + 2 * MAX_REACH];
        for (y, row) in self.cells.chunks_exact_mut(nx).enumerate() {
            row.fill(0.0);
            for class in self.classes {
                let [dy, dz] = class.across;
                let inner = &mut padded[MAX_REACH..MAX_REACH + nx];
                inner.fill(0.0);
                let heights = neighbours(self.z, dz, nz, Edges::Open).into_iter().flatten();
                let across = neighbours(y, dy, ny, self.edges);
                for row in heights.flat_map(|z| across.into_iter().flatten().map(move |y| z * ny + y)) {
                    add(inner, &self.q.cells()[row * nx..][..nx]);
                }
                if self.edges == Edges::Wrap {
                    wrap_padding(&mut padded);
                }
                spread(&padded, class.weights, row);
            }
        }
    }
}

/// Copies the other end of a row into its padding.
fn wrap_padding(padded: &mut [f32]) {
    let nx = padded.len() - 2 * MAX_REACH;
    for guard in 0..MAX_REACH {
        padded[guard] = padded[MAX_REACH + (guard + MAX_REACH * nx - MAX_REACH) % nx];
        padded[MAX_REACH + nx + guard] = padded[MAX_REACH + guard % nx];
    }
}

/// The cells at `distance` before and after `index`; one of them when the distance is 0.
fn neighbours(index: usize, distance: usize, count: usize, edges: Edges) -> [Option<usize>; 2] {
    let wrap = |place: usize| (edges == Edges::Wrap).then_some(place % count);
    let before = index.checked_sub(distance).or_else(|| wrap(index + MAX_REACH * count - distance));
    let after = Some(index + distance).filter(|&place| place < count).or_else(|| wrap(index + distance));
    [before, if distance == 0 { None } else { after }]
}

#[inline(always)]
fn add(sums: &mut [f32], row: &[f32]) {
    for (sum, value) in sums.iter_mut().zip(row) {
        *sum += value;
    }
}

/// Adds the weighted values along x.
#[inline(always)]
fn spread(padded: &[f32], weights: [f32; MAX_REACH + 1], row: &mut [f32]) {
    let at = |offset: usize| &padded[offset..offset + row.len()];
    let middle = at(MAX_REACH);
    let sides = [1, 2, 3].map(|dx| (at(MAX_REACH - dx), at(MAX_REACH + dx)));
    for (x, sum) in row.iter_mut().enumerate() {
        *sum += weights[0] * middle[x];
    }
    for ((before, after), weight) in sides.into_iter().zip(&weights[1..]).filter(|(_, weight)| **weight > 0.0) {
        for (x, sum) in row.iter_mut().enumerate() {
            *sum += weight * (before[x] + after[x]);
        }
    }
}

#[cfg(test)]
mod tests {
    use tyndall_core::rng::CellRng;

    use super::*;
    use crate::grid_size::cells;

    fn random(size: [usize; 3]) -> Grid3<f32> {
        let values = (0..size.iter().product::<usize>()).map(|i| CellRng::new(2).uniform(0, i as u64, 0)).collect();
        Grid3::from_cells(size, values).unwrap()
    }

    /// Equation (3), ball by ball.
    fn direct(q: &Grid3<f32>, radius: f64, edges: Edges, cell: [usize; 3]) -> f64 {
        let size = q.size();
        let distance = |a: usize, b: usize, axis: usize| {
            let apart = a.abs_diff(b);
            if edges == Edges::Wrap && axis < 2 { apart.min(size[axis] - apart) } else { apart }
        };
        let far2 = |other: [usize; 3]| (0..3).map(|axis| distance(cell[axis], other[axis], axis).pow(2)).sum::<usize>();
        cells(size).map(|other| f64::from(q[other]) * ball_field((far2(other) as f64).sqrt() / radius)).sum()
    }

    #[test]
    fn the_convolution_is_the_sum_over_all_balls() {
        let q = random([17, 9, 10]);
        for radius in [1.0, 1.5, 2.0, 3.1, 4.0] {
            for edges in [Edges::Open, Edges::Wrap] {
                let density = ball_density(&q, radius, edges).unwrap();
                for cell in cells(q.size()).step_by(7) {
                    let wanted = mass_scale(radius) * direct(&q, radius, edges, cell);
                    let found = f64::from(density[cell]);
                    assert!((found - wanted).abs() < 1e-5 * (1.0 + wanted), "R = {radius}, {cell:?}: {found} {wanted}");
                }
            }
        }
    }

    #[test]
    fn a_ball_keeps_its_mass_and_the_scale_that_does_it_is_small() {
        let q = Grid3::filled([16, 16, 16], 1.0);
        for (radius, scale) in [(1.5_f64, 1.069), (2.0, 0.979), (3.0, 0.996), (4.0, 1.0)] {
            let found = f64::from(ball_density(&q, radius, Edges::Open).unwrap()[[8, 8, 8]]);
            let mean = BALL_MASS * radius.powi(3);
            assert!((found / mean - 1.0).abs() < 1e-5, "R = {radius}: {found} {mean}");
            assert!((mass_scale(radius) - scale).abs() < 0.003, "R = {radius}: {}", mass_scale(radius));
        }
    }

    #[test]
    fn radii_beyond_the_lattice_are_refused() {
        let text = ball_density(&random([2, 2, 2]), 4.5, Edges::Open).unwrap_err().to_string();
        assert_eq!(text, "radius of the metaballs = 4.5 cells is outside 1 to 4 cells");
    }
}

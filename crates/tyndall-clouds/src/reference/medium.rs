//! A grid of extinction in a box.

use rayon::prelude::*;
use tyndall_core::grid::Grid3;
use tyndall_core::metaball::ball_field;

use super::vector::Vec3;
use crate::error::{CloudError, in_range};
use crate::narrow::narrow;

/// Extinction in a box with one corner in the origin: linear between the centres of cells, constant in the outer half cells,
/// nothing outside.
#[derive(Clone, Debug)]
pub struct Medium {
    extinction: Grid3<f32>,
    spacing: f64,
    largest: f64,
}

impl Medium {
    /// From extinction (1/length) at the centres of cells whose side is `spacing`.
    ///
    /// # Errors
    /// When the spacing or an extinction is negative or not finite.
    pub fn new(extinction: Grid3<f32>, spacing: f64) -> Result<Self, CloudError> {
        in_range("side of a cell", spacing, (1e-9, 1e9), "")?;
        for &value in extinction.cells() {
            in_range("extinction", f64::from(value), (0.0, 1e9), "")?;
        }
        let largest = f64::from(extinction.cells().iter().copied().fold(0.0, f32::max));
        Ok(Self { extinction, spacing, largest })
    }

    /// Sides of the box.
    #[must_use]
    pub fn extent(&self) -> [f64; 3] {
        self.extinction.size().map(|count| count as f64 * self.spacing)
    }

    /// Side of a cell.
    #[must_use]
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// The largest extinction of all cells, which none between them exceeds.
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.largest
    }

    /// Extinction at a point.
    #[must_use]
    pub fn extinction(&self, point: [f64; 3]) -> f64 {
        let size = self.extinction.size();
        let mut corner = [0; 3];
        let mut next = [0; 3];
        let mut share = [0.0; 3];
        for axis in 0..3 {
            let place = point[axis] / self.spacing;
            if !(0.0..=size[axis] as f64).contains(&place) {
                return 0.0;
            }
            let centred = (place - 0.5).clamp(0.0, size[axis] as f64 - 1.0);
            corner[axis] = cell_index(centred).min(size[axis] - 1);
            next[axis] = (corner[axis] + 1).min(size[axis] - 1);
            share[axis] = centred - corner[axis] as f64;
        }
        let value = |x: usize, y: usize, z: usize| f64::from(self.extinction[[x, y, z]]);
        let row = |y, z| value(corner[0], y, z) * (1.0 - share[0]) + value(next[0], y, z) * share[0];
        let plane = |z| row(corner[1], z) * (1.0 - share[1]) + row(next[1], z) * share[1];
        plane(corner[2]) * (1.0 - share[2]) + plane(next[2]) * share[2]
    }

    /// The part of a ray within the box: distances at which it enters and leaves.
    #[must_use]
    pub fn crossing(&self, origin: [f64; 3], direction: [f64; 3]) -> Option<[f64; 2]> {
        let (extent, mut crossing) = (self.extent(), [0.0_f64, f64::INFINITY]);
        for axis in 0..3 {
            if direction[axis].abs() < 1e-300 {
                if !(0.0..=extent[axis]).contains(&origin[axis]) {
                    return None;
                }
                continue;
            }
            let [a, b] = [0.0, extent[axis]].map(|side| (side - origin[axis]) / direction[axis]);
            crossing = [crossing[0].max(a.min(b)), crossing[1].min(a.max(b))];
        }
        (crossing[0] < crossing[1]).then_some(crossing)
    }

    /// Optical depth from a point to the end of the box, by midpoints `step` apart or less.
    #[must_use]
    pub fn optical_depth(&self, origin: Vec3, direction: Vec3, step: f64) -> f64 {
        let Some([near, far]) = self.crossing(origin, direction) else { return 0.0 };
        let count = ((far - near) / step).ceil().max(1.0);
        let step = (far - near) / count;
        let mut sum = 0.0;
        let mut distance = near + 0.5 * step;
        while distance < far {
            sum += self.extinction(super::vector::along(origin, direction, distance));
            distance += step;
        }
        sum * step
    }
}

/// The whole part of a place in a grid.
#[expect(clippy::cast_possible_truncation, reason = "clamped to the grid by the caller")]
fn cell_index(place: f64) -> usize {
    place as usize
}

/// The medium of balls on a lattice: `q` is the extinction in the middle of the ball of each cell, whose centre stands
/// `centre` of a cell from its corner along each axis; sampled `samples` times per cell. Equation (3), ball by ball.
///
/// # Errors
/// When a number is out of its range, or an extinction is negative.
pub fn ball_medium(q: &Grid3<f32>, radius_cells: f64, centre: f64, samples: usize) -> Result<Medium, CloudError> {
    in_range("radius of the metaballs", radius_cells, (0.1, 100.0), " cells")?;
    in_range("samples per cell", samples as f64, (1.0, 16.0), "")?;
    let [nx, ny, nz] = q.size();
    let (size, density) = ([nx * samples, ny * samples, nz * samples], samples as f64);
    let mut extinction = Grid3::filled(size, 0.0_f32);
    extinction.cells_mut().par_chunks_exact_mut(size[0]).enumerate().for_each(|(row, target)| {
        let place = [row % size[1], row / size[1]].map(|index| (index as f64 + 0.5) / density);
        let near = |axis: usize, count: usize| {
            let middle = place[axis] - centre;
            let first = cell_index((middle - radius_cells).ceil().max(0.0));
            (first..count).take_while(move |&cell| cell as f64 <= middle + radius_cells)
        };
        let rows = near(1, nz).flat_map(|z| near(0, ny).map(move |y| [y, z]));
        for [y, z] in rows {
            let across = (place[0] - y as f64 - centre).hypot(place[1] - z as f64 - centre);
            for x in (0..nx).filter(|&x| q[[x, y, z]] > 0.0) {
                add_ball(target, density, [x as f64 + centre, across], radius_cells, f64::from(q[[x, y, z]]));
            }
        }
    });
    Medium::new(extinction, 1.0 / density)
}

/// Adds a ball to a row of samples at (index + 1/2) / `density` cells; `apart` is where its centre stands along the row and
/// how far it is from the row (cells).
fn add_ball(row: &mut [f32], density: f64, [middle, across]: [f64; 2], radius: f64, q: f64) {
    let reach = (radius * radius - across * across).max(0.0).sqrt();
    let [first, end] = [middle - reach, middle + reach].map(|place| (place * density + 0.5).max(0.0));
    let (first, end) = (cell_index(first), cell_index(end).min(row.len()));
    for (index, sum) in row.iter_mut().enumerate().take(end).skip(first) {
        let away = (index as f64 + 0.5) / density - middle;
        *sum += narrow(q * ball_field(away.hypot(across) / radius));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tyndall_core::metaball::{BALL_MASS, ball_column};

    #[test]
    fn a_sampled_ball_has_its_mass_and_its_columns() {
        let mut q = Grid3::filled([9, 9, 9], 0.0);
        q[[4, 4, 4]] = 0.5;
        let medium = ball_medium(&q, 2.5, 0.5, 6).unwrap();
        let mass = medium.extinction.cells().iter().map(|v| f64::from(*v)).sum::<f64>() / 216.0;
        assert!((mass / (0.5 * BALL_MASS * 2.5_f64.powi(3)) - 1.0).abs() < 1e-3, "{mass}");
        for b in [0.0, 0.4, 0.8] {
            let found = medium.optical_depth([4.5 + 2.5 * b, 4.5, -3.0], [0.0, 0.0, 1.0], 0.02);
            // Linear interpolation between samples 1/15 of the radius apart.
            assert!((found - 0.5 * 2.5 * ball_column(b)).abs() < 0.01, "b = {b}: {found}");
        }
    }

    #[test]
    fn rays_beside_the_box_cross_nothing() {
        let medium = Medium::new(Grid3::filled([4, 4, 4], 1.0), 0.5).unwrap();
        assert!(medium.crossing([5.0, 1.0, -1.0], [0.0, 0.0, 1.0]).is_none(), "beside");
        let [near, far] = medium.crossing([1.0, 1.0, -1.0], [0.0, 0.0, 1.0]).unwrap();
        assert!((near - 1.0).abs() < 1e-12 && (far - 3.0).abs() < 1e-12, "{near} {far}");
        assert!((medium.optical_depth([1.0, 1.0, 0.5], [0.0, 0.0, 1.0], 0.1) - 1.5).abs() < 1e-9, "from within");
        assert!(Medium::new(Grid3::filled([1, 1, 1], -1.0), 1.0).is_err(), "negative extinction");
    }
}

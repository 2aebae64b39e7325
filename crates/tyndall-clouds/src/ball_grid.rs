//! The extinction of any list of metaballs on a grid: equation (3), ball by ball.
//!
//! Values are those at the cells' centres, without the lattice's correction of mass: what a march of the balls themselves
//! would meet there. A ball smaller than a cell would slip between the centres; it is drawn with the radius of a cell and
//! the same mass. Costs 64 evaluations for a ball of two cells' radius, on all cores, with the same bits on any number.

use rayon::prelude::*;
use tyndall_core::grid::Grid3;

use crate::edges::Edges;
use crate::error::CloudError;
use crate::grid_size::{MAX_BALL_CELLS, MAX_BALL_SIDE_CELLS};
use crate::metaballs::{Metaball, Metaballs};
use crate::narrow::narrow;

/// A box of cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallGrid {
    /// Cells east, north and up.
    pub size: [usize; 3],
    /// Side of a cell (m).
    pub cell_m: f64,
    /// Where the west, south and bottom sides meet (m).
    pub low_corner_m: [f64; 3],
    /// What lies beyond the sides.
    pub edges: Edges,
}

impl BallGrid {
    /// The smallest box around balls, with one empty cell all around; its sides lie at multiples of a cell.
    ///
    /// # Errors
    /// [`CloudError::NoBalls`] for an empty list, [`CloudError::BallBox`] when the box has more than [`MAX_BALL_CELLS`] cells.
    #[expect(clippy::cast_possible_truncation, reason = "counts of cells are checked before the cast")]
    pub fn around(list: &Metaballs, cell_m: f64) -> Result<Self, CloudError> {
        if list.balls.is_empty() {
            return Err(CloudError::NoBalls);
        }
        let reach = |ball: &Metaball| f64::from(ball.radius_m).max(cell_m);
        let low = [0, 1, 2].map(|axis: usize| {
            let least = |low: f64, ball: &Metaball| low.min(f64::from(ball.centre_m[axis]) - reach(ball));
            (list.balls.iter().fold(f64::INFINITY, least) / cell_m).floor() - 1.0
        });
        let high = [0, 1, 2].map(|axis: usize| {
            let most = |high: f64, ball: &Metaball| high.max(f64::from(ball.centre_m[axis]) + reach(ball));
            (list.balls.iter().fold(f64::NEG_INFINITY, most) / cell_m).ceil() + 1.0
        });
        let sides = [0, 1, 2].map(|axis| high[axis] - low[axis]);
        if sides.iter().product::<f64>() > MAX_BALL_CELLS as f64
            || sides.iter().any(|side| *side > MAX_BALL_SIDE_CELLS as f64)
        {
            return Err(CloudError::BallBox { sides, cell_m });
        }
        let size = sides.map(|side| side as usize);
        Ok(Self { size, cell_m, low_corner_m: low.map(|place| place * cell_m), edges: Edges::Open })
    }

    /// Extinction (1/m) of the balls at the cells' centres; what reaches out of the box is lost, or enters at the other side
    /// of one that wraps.
    #[must_use]
    pub fn extinction_per_m(&self, list: &Metaballs) -> Grid3<f32> {
        let [nx, ny, nz] = self.size;
        let balls: Vec<PlacedBall> = list.balls.iter().map(|ball| self.placed(ball)).collect();
        let mut of_plane = vec![Vec::new(); nz];
        for (index, ball) in balls.iter().enumerate() {
            for plane in ball.cells(2).filter_map(|z| usize::try_from(z).ok()).filter(|z| *z < nz) {
                of_plane[plane].push(index);
            }
        }
        let mut extinction = Grid3::filled(self.size, 0.0);
        let planes = extinction.cells_mut().par_chunks_exact_mut(nx * ny).zip(of_plane).enumerate();
        planes.for_each(|(z, (cells, indices))| {
            for index in indices {
                self.add(&balls[index], z as f64 + 0.5, cells);
            }
        });
        extinction
    }

    /// A ball in cells from the low corner.
    fn placed(&self, ball: &Metaball) -> PlacedBall {
        let radius = f64::from(ball.radius_m) / self.cell_m;
        let drawn = radius.max(1.0);
        PlacedBall {
            centre: [0, 1, 2].map(|axis| (f64::from(ball.centre_m[axis]) - self.low_corner_m[axis]) / self.cell_m),
            radius: drawn,
            peak_per_m: f64::from(ball.extinction_per_m) * (radius / drawn).powi(3),
        }
    }

    /// Adds a ball to the cells of the plane at height `z`.
    fn add(&self, ball: &PlacedBall, z: f64, cells: &mut [f32]) {
        let [nx, ny, _] = self.size;
        let per_radius2 = ball.radius.powi(-2);
        let rise2 = (z - ball.centre[2]).powi(2);
        for y in ball.cells(1) {
            let Some(row) = self.inside(y, ny) else { continue };
            let across2 = rise2 + (y as f64 + 0.5 - ball.centre[1]).powi(2);
            for x in ball.cells(0) {
                let Some(column) = self.inside(x, nx) else { continue };
                let w = 1.0 - (across2 + (x as f64 + 0.5 - ball.centre[0]).powi(2)) * per_radius2;
                if w > 0.0 {
                    cells[row * nx + column] += narrow(ball.peak_per_m * w * w * (5.0 + 4.0 * w) / 9.0);
                }
            }
        }
    }

    /// The cell of a place along an axis, if there is one.
    fn inside(&self, place: i64, count: usize) -> Option<usize> {
        let count = i64::try_from(count).ok()?;
        let place = if self.edges == Edges::Wrap { place.rem_euclid(count) } else { place };
        usize::try_from(place).ok().filter(|_| place < count)
    }
}

/// A ball in cells.
struct PlacedBall {
    centre: [f64; 3],
    radius: f64,
    peak_per_m: f64,
}

impl PlacedBall {
    /// Cells along an axis whose centres may lie in the ball.
    #[expect(clippy::cast_possible_truncation, reason = "a cast of a float saturates, and saturated cells lie outside")]
    fn cells(&self, axis: usize) -> std::ops::Range<i64> {
        let (first, end) = (self.centre[axis] - self.radius - 0.5, self.centre[axis] + self.radius + 0.5);
        (first.floor().max(-4096.0) as i64)..(end.ceil().min(8192.0) as i64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ball_density;
    use crate::grid_size::cells;

    fn ball(centre_m: [f32; 3], radius_m: f32, extinction_per_m: f32) -> Metaball {
        Metaball { centre_m, radius_m, extinction_per_m }
    }

    #[test]
    fn the_grid_has_the_sum_of_fields_at_the_middles_of_cells() {
        let list =
            Metaballs { balls: vec![ball([3.0, 40.0, 900.0], 31.0, 0.02), ball([-12.5, 55.0, 931.0], 22.0, 0.05)] };
        let grid = BallGrid::around(&list, 7.0).unwrap();
        let extinction = grid.extinction_per_m(&list);
        for cell in cells(grid.size) {
            let point = [0, 1, 2].map(|axis| grid.low_corner_m[axis] + (cell[axis] as f64 + 0.5) * 7.0);
            let gap = f64::from(extinction[cell]) - list.extinction_per_m(point);
            assert!(gap.abs() < 1e-7, "{cell:?}: {gap}");
        }
        let mass_m2: f64 = extinction.cells().iter().map(|value| f64::from(*value)).sum::<f64>() * 7.0_f64.powi(3);
        assert!((mass_m2 / list.mass_m2() - 1.0).abs() < 0.01, "nothing of them lies outside: {mass_m2} m2");
    }

    #[test]
    fn a_lattice_of_balls_is_its_convolution_up_to_the_lattices_mass() {
        let mut q = Grid3::filled([12, 10, 8], 0.0);
        q[[0, 4, 3]] = 0.3;
        q[[11, 9, 5]] = 0.7;
        for edges in [Edges::Open, Edges::Wrap] {
            let grid = BallGrid { size: q.size(), cell_m: 1.0, low_corner_m: [0.0; 3], edges };
            let full = cells(q.size()).filter(|cell| q[*cell] > 0.0);
            let balls = full.map(|cell| ball(cell.map(|place| narrow(place as f64 + 0.5)), 2.0, q[cell])).collect();
            let found = grid.extinction_per_m(&Metaballs { balls });
            let wanted = ball_density(&q, 2.0, edges).unwrap();
            for (found, wanted) in found.cells().iter().zip(wanted.cells()) {
                assert!((found * 0.979 - wanted).abs() < 1e-3, "{edges:?}: {found} {wanted}");
            }
        }
    }

    #[test]
    fn balls_smaller_than_a_cell_keep_their_mass() {
        let list = Metaballs { balls: vec![ball([0.5, 0.5, 0.5], 0.2, 3.0)] };
        let grid = BallGrid::around(&list, 1.0).unwrap();
        let mass_m2: f64 = grid.extinction_per_m(&list).cells().iter().map(|value| f64::from(*value)).sum();
        // Of a ball of one cell only the middle is sampled: 1 for 0.816.
        assert!((mass_m2 / list.mass_m2() - 1.0).abs() < 0.25, "{mass_m2} of {}", list.mass_m2());
    }

    #[test]
    fn boxes_that_are_too_large_are_refused_with_their_size() {
        let list = Metaballs { balls: vec![ball([0.0; 3], 1.0, 1.0), ball([1e6, 0.0, 0.0], 1.0, 1.0)] };
        let text = BallGrid::around(&list, 10.0).unwrap_err().to_string();
        assert!(text.contains("100004 x 4 x 4 cells of 10 m"), "{text}");
        let text = BallGrid::around(&Metaballs::default(), 10.0).unwrap_err().to_string();
        assert_eq!(text, "the list of metaballs is empty");
    }
}

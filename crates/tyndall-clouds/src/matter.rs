//! The matter of clouds as renderers take it, whatever it comes from: the automaton, a grid of a file, a list of balls.

use tyndall_core::grid::Grid3;
use tyndall_core::metaball::BALL_MASS;

use crate::ball_grid::BallGrid;
use crate::edges::Edges;
use crate::error::CloudError;
use crate::grid_size::cells;
use crate::metaballs::{Metaball, Metaballs};
use crate::narrow::narrow;
use crate::simulation::CloudSimulation;

/// Extinction on a grid, where the grid stands, and the metaballs that add up to it.
///
/// Places are metres east and north of the scene's origin, and altitudes.
#[derive(Clone, Debug, PartialEq)]
pub struct CloudMatter {
    /// Extinction at the cells' centres (1/m).
    pub extinction_per_m: Grid3<f32>,
    /// Side of a cell (m).
    pub cell_m: f64,
    /// Where the grid's west, south and bottom sides meet (m).
    pub low_corner_m: [f64; 3],
    /// What lies beyond the sides.
    pub edges: Edges,
    /// Extinction deep in the cloud (1/m), against which its edges are thin.
    pub full_per_m: f64,
    balls: BallSource,
    /// Time since the end of the warm-up that it shows (s); 0 of what stands still.
    pub time_s: f64,
}

/// What the balls are made of when they are asked for: lists are longer than grids.
#[derive(Clone, Debug, PartialEq)]
enum BallSource {
    /// One for each cell with something in it: extinctions in their middles (1/m).
    Lattice { peaks_per_m: Grid3<f32>, radius_m: f64 },
    /// One for each cell with extinction, of the same mass as the cell.
    Cells { radius_m: f64 },
    /// These.
    List(Metaballs),
}

impl CloudMatter {
    /// Of a simulation, between its last two steps: centred on the scene's origin.
    ///
    /// # Errors
    /// When the fraction is outside 0 to 1.
    pub fn of_simulation(simulation: &mut CloudSimulation, fraction: f32) -> Result<Self, CloudError> {
        let extinction_per_m = simulation.extinction_per_m(fraction)?;
        let peaks_per_m = simulation.peaks_per_m(fraction)?;
        let time_s = simulation.time_s() - f64::from(1.0 - fraction) * simulation.params().grid.step_s;
        let params = simulation.params();
        let (grid, cell_m) = (&params.grid, params.grid.cell_m);
        Ok(Self {
            time_s,
            low_corner_m: centred(extinction_per_m.size(), cell_m, grid.floor_m),
            extinction_per_m,
            cell_m,
            edges: grid.edges,
            full_per_m: params.matter.extinction_per_m,
            balls: BallSource::Lattice { peaks_per_m, radius_m: params.matter.ball_radius_cells * cell_m },
        })
    }

    /// Of a grid of extinction (1/m), which balls of radius `radius_m` stand for where balls are needed.
    #[must_use]
    pub fn of_density(
        extinction_per_m: Grid3<f32>,
        cell_m: f64,
        low_corner_m: [f64; 3],
        edges: Edges,
        radius_m: f64,
    ) -> Self {
        let full_per_m = most(&extinction_per_m);
        let balls = BallSource::Cells { radius_m };
        Self { extinction_per_m, cell_m, low_corner_m, edges, full_per_m, time_s: 0.0, balls }
    }

    /// Of balls, sampled on a grid.
    #[must_use]
    pub fn of_balls(list: Metaballs, grid: &BallGrid) -> Self {
        let extinction_per_m = grid.extinction_per_m(&list);
        Self {
            time_s: 0.0,
            full_per_m: most(&extinction_per_m),
            extinction_per_m,
            cell_m: grid.cell_m,
            low_corner_m: grid.low_corner_m,
            edges: grid.edges,
            balls: BallSource::List(list),
        }
    }

    /// Side of the grid east, north and up (m).
    #[must_use]
    pub fn extent_m(&self) -> [f64; 3] {
        self.extinction_per_m.size().map(|count| count as f64 * self.cell_m)
    }

    /// The largest extinction of all cells (1/m).
    #[must_use]
    pub fn most_per_m(&self) -> f64 {
        most(&self.extinction_per_m)
    }

    /// The balls that add up to this cloud.
    #[must_use]
    pub fn balls(&self) -> Metaballs {
        match &self.balls {
            BallSource::List(list) => list.clone(),
            BallSource::Lattice { peaks_per_m, radius_m } => self.balls_of_cells(peaks_per_m, *radius_m, 1.0),
            BallSource::Cells { radius_m } => {
                let share = (self.cell_m / radius_m).powi(3) / BALL_MASS;
                self.balls_of_cells(&self.extinction_per_m, *radius_m, share)
            }
        }
    }

    /// Balls in the middles of cells that have something in them.
    fn balls_of_cells(&self, peaks_per_m: &Grid3<f32>, radius_m: f64, factor: f64) -> Metaballs {
        let filled = cells(peaks_per_m.size()).zip(peaks_per_m.cells()).filter(|(_, peak)| **peak > 0.0);
        let ball = |(cell, peak): ([usize; 3], &f32)| Metaball {
            centre_m: [0, 1, 2].map(|axis| narrow(self.low_corner_m[axis] + (cell[axis] as f64 + 0.5) * self.cell_m)),
            radius_m: narrow(radius_m),
            extinction_per_m: narrow(factor) * peak,
        };
        Metaballs { balls: filled.map(ball).collect() }
    }
}

/// The largest extinction (1/m).
fn most(extinction_per_m: &Grid3<f32>) -> f64 {
    f64::from(extinction_per_m.cells().iter().copied().fold(0.0, f32::max))
}

/// Low corner (m) of a grid that is centred on the scene's origin.
#[must_use]
pub fn centred(size: [usize; 3], cell_m: f64, floor_m: f64) -> [f64; 3] {
    let [east, north, _] = size.map(|count| -0.5 * count as f64 * cell_m);
    [east, north, floor_m]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::CloudParams;

    fn small() -> CloudParams {
        let mut params = CloudParams::default();
        (params.grid.cells_east, params.grid.cells_north, params.grid.cells_up) = (24, 16, 12);
        params.grid.warm_up_steps = 20;
        params.grid.edges = Edges::Open;
        params
    }

    #[test]
    fn balls_add_up_to_the_extinction_of_the_grid() {
        let matter = CloudMatter::of_simulation(&mut CloudSimulation::new(&small()).unwrap(), 1.0).unwrap();
        let balls = matter.balls();
        assert!(!balls.balls.is_empty(), "there is a cloud");
        let most = matter.extinction_per_m.cells().iter().fold(0.0_f32, |most, value| most.max(*value));
        for cell in cells(matter.extinction_per_m.size()).step_by(97) {
            let point = [0, 1, 2].map(|axis| matter.low_corner_m[axis] + (cell[axis] as f64 + 0.5) * matter.cell_m);
            let gap = balls.extinction_per_m(point) - f64::from(matter.extinction_per_m[cell]);
            // The grid's taps are scaled by 2 % so that they keep the balls' mass.
            assert!(gap.abs() < 0.03 * f64::from(most), "{cell:?}: {gap} of {most}");
        }
    }

    #[test]
    fn balls_of_a_density_have_its_mass() {
        let mut density = Grid3::filled([6, 5, 4], 0.0);
        density[[2, 1, 3]] = 0.04;
        density[[5, 4, 0]] = 0.01;
        let matter = CloudMatter::of_density(density, 25.0, [-75.0, -62.5, 800.0], Edges::Open, 50.0);
        let balls = matter.balls();
        assert!((balls.mass_m2() / (0.05 * 25.0_f64.powi(3)) - 1.0).abs() < 1e-5, "{} m2", balls.mass_m2());
        let first = Metaball { centre_m: [62.5, 50.0, 812.5], ..balls.balls[0] };
        assert_eq!(balls.balls[0], first, "bottom layer first");
    }
}

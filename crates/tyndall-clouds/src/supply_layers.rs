//! Layers of probabilities from the ground: terrain, and sources of heat.

use tyndall_core::grid::Grid2;

use crate::error::CloudError;
use crate::narrow::narrow;
use crate::probability::{ProbabilityLayer, ProbabilityRow};

/// Ground that reaches into the grid. Within it there is no cloud; above slopes that the wind climbs, air rises and supplies
/// vapour, above lee slopes it sinks and dries.
#[derive(Clone, Debug, PartialEq)]
pub struct Terrain {
    height_cells: Grid2<f32>,
    /// Rise of the ground per cell along the wind.
    climb: Grid2<f32>,
    lift: TerrainLift,
}

/// How terrain supplies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TerrainLift {
    /// Humidity per step right above ground that climbs one cell per cell.
    pub humidity: f32,
    /// Activation per step at the same place.
    pub activation: f32,
    /// Height above ground at which the lift has fallen to nothing (cells).
    pub depth_cells: f32,
}

impl Terrain {
    /// From the ground's height above the grid's floor in each column, and a wind (cells per step, east and north).
    ///
    /// # Errors
    /// When the map has other columns than the grid of [nx, ny, nz] cells.
    pub fn new(
        size: [usize; 3],
        height_cells: Grid2<f32>,
        wind: [f64; 2],
        lift: TerrainLift,
    ) -> Result<Self, CloudError> {
        check_columns("the terrain", &height_cells, size)?;
        let speed = wind[0].hypot(wind[1]);
        let along = if speed > 0.0 { wind.map(|part| narrow(part / speed)) } else { [0.0; 2] };
        let [nx, ny] = height_cells.size();
        let slope = |x: usize, y: usize| {
            let [west, east] = [x.saturating_sub(1), (x + 1).min(nx - 1)];
            let [south, north] = [y.saturating_sub(1), (y + 1).min(ny - 1)];
            let over = |from: [usize; 2], to: [usize; 2], cells: usize| {
                (height_cells[to] - height_cells[from]) / cells.max(1) as f32
            };
            along[0] * over([west, y], [east, y], east - west) + along[1] * over([x, south], [x, north], north - south)
        };
        let climb = Grid2::from_fn([nx, ny], slope);
        Ok(Self { height_cells, climb, lift })
    }
}

impl ProbabilityLayer for Terrain {
    fn apply(&self, y: usize, z: usize, row: &mut ProbabilityRow) {
        for x in 0..row.extinction.len() {
            let above = z as f32 + 0.5 - self.height_cells[[x, y]];
            if above < 0.0 {
                (row.extinction[x], row.humidity[x], row.activation[x]) = (1.0, 0.0, 0.0);
                continue;
            }
            let share = (1.0 - above / self.lift.depth_cells).max(0.0);
            let climb = self.climb[[x, y]].clamp(-1.0, 1.0) * share;
            row.humidity[x] += self.lift.humidity * climb;
            row.activation[x] += self.lift.activation * climb;
        }
    }
}

/// A warm place on the ground whose air rises and condenses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeatSource {
    /// Place (cells east and north of the grid's low corner).
    pub centre_cells: [f32; 2],
    /// Distance at which it has no effect any more (cells).
    pub radius_cells: f32,
    /// Height at which its air condenses (cells), and how thick the layer is that it supplies.
    pub level_cells: f32,
    /// Thickness of that layer (cells).
    pub depth_cells: f32,
    /// Humidity per step in the middle.
    pub humidity: f32,
    /// Activation per step in the middle.
    pub activation: f32,
}

/// A layer of heat sources; their effects add up.
impl ProbabilityLayer for Vec<HeatSource> {
    fn apply(&self, y: usize, z: usize, row: &mut ProbabilityRow) {
        for source in self {
            let up = (z as f32 + 0.5 - source.level_cells) / source.depth_cells;
            let north = (y as f32 + 0.5 - source.centre_cells[1]) / source.radius_cells;
            if !(0.0..1.0).contains(&up) || north * north >= 1.0 {
                continue;
            }
            for x in 0..row.extinction.len() {
                let east = (x as f32 + 0.5 - source.centre_cells[0]) / source.radius_cells;
                let share = (1.0 - up) * (1.0 - east * east - north * north).max(0.0);
                row.humidity[x] += source.humidity * share;
                row.activation[x] += source.activation * share;
            }
        }
    }
}

fn check_columns(what: &str, map: &Grid2<f32>, size: [usize; 3]) -> Result<(), CloudError> {
    if map.size() == size[..2] {
        return Ok(());
    }
    let (found, expected) = (map.size().to_vec(), size[..2].to_vec());
    Err(CloudError::OtherSize { what: what.to_owned(), found, expected })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Probabilities;

    fn row() -> ProbabilityRow {
        let mut row = ProbabilityRow::zeros(10);
        row.fill(Probabilities { extinction: 0.1, humidity: 0.2, activation: 0.01 });
        row
    }

    #[test]
    fn wind_that_climbs_a_hill_supplies_before_it_and_dries_behind_it() {
        let hill = Grid2::from_fn([10, 4], |x, _| 3.0 - (x as f32 - 5.0).abs() * 0.5);
        let lift = TerrainLift { humidity: 0.4, activation: 0.02, depth_cells: 8.0 };
        let terrain = Terrain::new([10, 4, 12], hill, [2.0, 0.0], lift).unwrap();
        let mut above = row();
        terrain.apply(1, 4, &mut above);
        assert!(above.humidity[3] > 0.25 && above.humidity[7] < 0.15, "windward and lee: {:?}", above.humidity);
        let mut within = row();
        terrain.apply(1, 1, &mut within);
        assert!(within.humidity[5].abs() < 1e-9 && (within.extinction[5] - 1.0).abs() < 1e-9, "no cloud in rock");
    }

    #[test]
    fn a_heat_source_supplies_above_its_level_and_within_its_radius() {
        let source = HeatSource {
            centre_cells: [5.0, 2.0],
            radius_cells: 3.0,
            level_cells: 4.0,
            depth_cells: 4.0,
            humidity: 0.3,
            activation: 0.1,
        };
        let (mut low, mut level) = (row(), row());
        vec![source].apply(1, 3, &mut low);
        assert_eq!(low, row(), "below the level nothing changes");
        vec![source].apply(1, 4, &mut level);
        assert!(level.humidity[4] > 0.4 && (level.humidity[0] - 0.2).abs() < 1e-6, "{:?}", level.humidity);
    }
}

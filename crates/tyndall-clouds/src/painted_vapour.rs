//! The layer of a painted map: takes vapour away or brings it, and drifts with the air that was painted.

use tyndall_core::grid::Grid2;

use crate::edges::Edges;
use crate::ellipsoids::EllipsoidSupply;
use crate::error::CloudError;
use crate::probability::{LayerMotion, ProbabilityLayer, ProbabilityRow};
use crate::wind::Wind;

/// Painted vapour. Below level 1 the supply of the layers below shrinks and cloud vanishes as outside of bubbles; above it
/// comes nearer to that in the middle of a bubble, from the base to the top.
#[derive(Clone, Debug, PartialEq)]
pub struct PaintedVapour {
    levels: Grid2<f32>,
    range: PaintedRange,
    edges: Edges,
    /// Whole cells that it has drifted, and what is left of a cell.
    moved: [i64; 2],
    hidden: [f64; 2],
}

/// Where painted vapour is, and how much of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaintedRange {
    /// Probabilities at level 2, at the base.
    pub supply: EllipsoidSupply,
    /// Probability that cloud vanishes where there is no vapour.
    pub dry_extinction: f32,
    /// Heights between which vapour is brought (cells).
    pub heights_cells: [f32; 2],
}

impl PaintedVapour {
    /// From one level (0 to 2) for each column.
    #[must_use]
    pub fn new(levels: Grid2<f32>, range: PaintedRange, edges: Edges) -> Self {
        Self { levels, range, edges, moved: [0; 2], hidden: [0.0; 2] }
    }

    /// The column that has drifted to a place.
    fn origin(&self, axis: usize, place: usize) -> usize {
        let side = i64::try_from(self.levels.size()[axis]).unwrap_or(i64::MAX);
        let place = i64::try_from(place).unwrap_or(0);
        usize::try_from((place - self.moved[axis]).rem_euclid(side)).unwrap_or(0)
    }
}

impl ProbabilityLayer for PaintedVapour {
    fn apply(&self, y: usize, z: usize, row: &mut ProbabilityRow) {
        let [base, top] = self.range.heights_cells;
        let up = (z as f32 + 0.5 - base) / (top - base).max(1.0);
        let inside = if (0.0..1.0).contains(&up) { 1.0 - up * up } else { 0.0 };
        let (supply, from_y) = (self.range.supply, self.origin(1, y));
        for x in 0..row.extinction.len() {
            let level = self.levels[[self.origin(0, x), from_y]];
            let [extinction, humidity, activation] =
                [&mut row.extinction[x], &mut row.humidity[x], &mut row.activation[x]];
            if level < 1.0 {
                (*humidity, *activation) = (*humidity * level, *activation * level);
                *extinction += (1.0 - level) * (self.range.dry_extinction - *extinction).max(0.0);
            } else {
                let brought = (level - 1.0) * inside;
                *humidity = humidity.max(supply.humidity * brought);
                *activation = activation.max(supply.activation * brought);
                *extinction = extinction.min(*extinction + (supply.extinction - *extinction) * brought);
            }
        }
    }

    #[expect(clippy::cast_possible_truncation, reason = "winds are limited to 64 cells a step")]
    fn blow(&mut self, wind: &Wind) -> LayerMotion {
        let heights = wind.raw_displacements().len().max(1);
        let height = (self.range.heights_cells[0].max(0.0) as usize).min(heights - 1);
        let mut cells = [0; 2];
        for (axis, speed) in wind.speed_cells(height).into_iter().enumerate() {
            self.hidden[axis] += speed;
            let whole = self.hidden[axis].floor();
            self.hidden[axis] -= whole;
            cells[axis] = whole as i64;
            self.moved[axis] += cells[axis];
        }
        match (cells, self.edges) {
            ([0, 0], _) => LayerMotion::Still,
            (_, Edges::Wrap) => LayerMotion::Shifted(cells),
            (_, Edges::Open) => LayerMotion::Changed,
        }
    }

    fn state(&self) -> Vec<f64> {
        vec![self.moved[0] as f64, self.moved[1] as f64, self.hidden[0], self.hidden[1]]
    }

    #[expect(clippy::cast_possible_truncation, reason = "whole numbers that `state` wrote")]
    fn restore(&mut self, state: &[f64]) -> Result<(), CloudError> {
        let &[east, north, hidden_east, hidden_north] = state else {
            let what = "the state of the painted vapour".to_owned();
            return Err(CloudError::WrongLength { what, found: state.len(), expected: 4 });
        };
        (self.moved, self.hidden) = ([east as i64, north as i64], [hidden_east, hidden_north]);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Probabilities, WindProfile};

    fn layer(level: f32) -> PaintedVapour {
        let supply = EllipsoidSupply { extinction: 0.05, humidity: 0.2, activation: 0.01 };
        let range = PaintedRange { supply, dry_extinction: 0.5, heights_cells: [2.0, 10.0] };
        let levels = Grid2::from_fn([16, 8], |x, y| if x == 4 && y == 3 { level } else { 1.0 });
        PaintedVapour::new(levels, range, Edges::Wrap)
    }

    fn row(layer: &PaintedVapour, y: usize, z: usize) -> ProbabilityRow {
        let mut row = ProbabilityRow::zeros(16);
        row.fill(Probabilities { extinction: 0.1, humidity: 0.12, activation: 0.004 });
        layer.apply(y, z, &mut row);
        row
    }

    #[test]
    fn paint_brings_vapour_above_its_base_and_erasing_takes_it_away() {
        let wet = row(&layer(2.0), 3, 2);
        assert!(wet.humidity[4] > 0.19 && wet.activation[4] > 0.0099 && wet.extinction[4] < 0.051, "{wet:?}");
        assert!((row(&layer(2.0), 3, 1).humidity[4] - 0.12).abs() < 1e-6, "nothing below the base");
        let dry = row(&layer(0.0), 3, 5);
        assert!(dry.humidity[4] < 1e-6 && (dry.extinction[4] - 0.5).abs() < 1e-6, "{dry:?}");
        assert!((dry.humidity[5] - 0.12).abs() < 1e-6, "its neighbour is as it was");
    }

    #[test]
    fn paint_drifts_with_the_wind_at_its_base_and_its_drift_is_saved() {
        let mut painted = layer(0.0);
        let wind = Wind::new(WindProfile::uniform([1.5, -0.25]).unwrap(), 12);
        assert_eq!(painted.blow(&wind), LayerMotion::Shifted([1, -1]), "the first step");
        assert_eq!(painted.blow(&wind), LayerMotion::Shifted([2, 0]), "the second");
        assert!(row(&painted, 2, 5).humidity[7] < 1e-6, "3 cells east and 1 south");
        let mut restored = layer(0.0);
        restored.restore(&painted.state()).unwrap();
        assert_eq!(restored, painted, "taken up again");
        assert!(restored.restore(&[1.0]).is_err(), "too short");
    }
}

//! Wind that grows with height and moves clouds by whole cells.
//!
//! The paper shifts all variables: `X'(i, j, k) = X(i - v(z_k), j, k)`. Its v must be a whole number; here each height keeps its
//! exact displacement in units of 2^-32 cells and moves by the difference of the whole parts, so that any speed and
//! direction, changed at any step, is right in the long run and the same on every system.

use std::collections::BTreeMap;

use crate::bit_field::HEIGHTS_PER_LAYER;
use crate::error::{CloudError, in_range};

/// Fastest wind (cells per step).
pub const MAX_CELLS_PER_STEP: f64 = 64.0;

/// Displacements are whole multiples of this part of a cell.
const FRACTIONS: f64 = 4_294_967_296.0;
const FRACTION_BITS: u32 = 32;

/// Wind at one height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WindKnot {
    /// Height above the grid's floor (cells).
    pub height_cells: f64,
    /// Motion east and north (cells per step).
    pub cells_per_step: [f64; 2],
}

/// Wind as a function of height: linear between knots, constant beyond the outer ones, nothing without knots.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WindProfile {
    knots: Vec<WindKnot>,
}

impl WindProfile {
    /// The same wind at all heights (cells per step, east and north).
    ///
    /// # Errors
    /// As for [`WindProfile::new`].
    pub fn uniform(cells_per_step: [f64; 2]) -> Result<Self, CloudError> {
        Self::new(vec![WindKnot { height_cells: 0.0, cells_per_step }])
    }

    /// From knots in rising order.
    ///
    /// # Errors
    /// When heights do not rise, or a wind is not finite or faster than [`MAX_CELLS_PER_STEP`].
    pub fn new(knots: Vec<WindKnot>) -> Result<Self, CloudError> {
        let mut before = f64::NEG_INFINITY;
        for (index, knot) in knots.iter().enumerate() {
            let height_cells = knot.height_cells;
            if !(height_cells.is_finite() && height_cells > before) {
                return Err(CloudError::WindKnots { index, height_cells });
            }
            before = height_cells;
            for value in knot.cells_per_step {
                in_range("wind", value, (-MAX_CELLS_PER_STEP, MAX_CELLS_PER_STEP), " cells per step")?;
            }
        }
        Ok(Self { knots })
    }

    /// The knots.
    #[must_use]
    pub fn knots(&self) -> &[WindKnot] {
        &self.knots
    }

    /// Wind at a height above the grid's floor (cells per step, east and north).
    #[must_use]
    pub fn at(&self, height_cells: f64) -> [f64; 2] {
        let after = self.knots.partition_point(|knot| knot.height_cells <= height_cells);
        match (after.checked_sub(1).map(|index| self.knots[index]), self.knots.get(after)) {
            (Some(low), Some(high)) => {
                let t = (height_cells - low.height_cells) / (high.height_cells - low.height_cells);
                [0, 1].map(|axis| low.cells_per_step[axis] * (1.0 - t) + high.cells_per_step[axis] * t)
            }
            (Some(only), None) => only.cells_per_step,
            (None, Some(only)) => only.cells_per_step,
            (None, None) => [0.0; 2],
        }
    }
}

/// Wind of a grid: the profile, and how far each height has moved since step 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Wind {
    profile: WindProfile,
    /// Motion per step of each height (2^-32 cells).
    speeds: Vec<[i64; 2]>,
    /// Displacement of each height since the start (2^-32 cells).
    displacements: Vec<[i64; 2]>,
}

/// Heights of one layer that move by the same whole number of cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Shift {
    /// Cells east and north.
    pub(crate) cells: [i64; 2],
    /// Which heights of the layer.
    pub(crate) mask: u32,
}

/// How the cells of each layer move in one step.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ShiftPlan {
    layers: Vec<Vec<Shift>>,
}

impl ShiftPlan {
    /// Whether nothing moves.
    #[must_use]
    pub fn is_still(&self) -> bool {
        self.layers.iter().flatten().all(|shift| shift.cells == [0, 0])
    }

    pub(crate) fn layer(&self, layer: usize) -> &[Shift] {
        self.layers.get(layer).map_or(&[], Vec::as_slice)
    }
}

impl Wind {
    /// Still displaced by nothing, for a grid of `nz` heights; the wind of a height is the profile's at the cells' centres.
    #[must_use]
    pub fn new(profile: WindProfile, nz: usize) -> Self {
        let mut wind = Self { profile: WindProfile::default(), speeds: Vec::new(), displacements: vec![[0; 2]; nz] };
        wind.set_profile(profile);
        wind
    }

    /// Changes the wind from the next step on; what has moved stays moved.
    pub fn set_profile(&mut self, profile: WindProfile) {
        let heights = 0..self.displacements.len();
        self.speeds = heights.map(|height| profile.at(height as f64 + 0.5).map(to_fixed)).collect();
        self.profile = profile;
    }

    /// Wind as a function of height.
    #[must_use]
    pub fn profile(&self) -> &WindProfile {
        &self.profile
    }

    /// How far a height has moved since step 0, east and north (cells).
    #[must_use]
    pub fn displacement_cells(&self, height: usize) -> [f64; 2] {
        self.displacements[height].map(|fixed| fixed as f64 / FRACTIONS)
    }

    /// The part of a height's displacement that is less than a cell and not yet seen in the cells (0 to 1).
    #[must_use]
    pub fn hidden_cells(&self, height: usize) -> [f64; 2] {
        self.displacements[height].map(|fixed| (fixed & ((1 << FRACTION_BITS) - 1)) as f64 / FRACTIONS)
    }

    /// Motion of a height in a step (cells, east and north).
    #[must_use]
    pub fn speed_cells(&self, height: usize) -> [f64; 2] {
        self.speeds[height].map(|fixed| fixed as f64 / FRACTIONS)
    }

    /// Displacements in units of 2^-32 cells, [east, north] of each height; for files.
    #[must_use]
    pub fn raw_displacements(&self) -> &[[i64; 2]] {
        &self.displacements
    }

    /// Puts back what [`Wind::raw_displacements`] gave.
    ///
    /// # Errors
    /// When there is not one pair for each height.
    pub fn set_raw_displacements(&mut self, displacements: &[[i64; 2]]) -> Result<(), CloudError> {
        let (found, expected) = (displacements.len(), self.displacements.len());
        if found != expected {
            return Err(CloudError::WrongLength { what: "the list of wind displacements".to_owned(), found, expected });
        }
        self.displacements.copy_from_slice(displacements);
        Ok(())
    }

    /// Moves on by one step and says by how many whole cells.
    pub fn advance(&mut self) -> ShiftPlan {
        let mut layers = vec![BTreeMap::<[i64; 2], u32>::new(); self.speeds.len().div_ceil(HEIGHTS_PER_LAYER)];
        for (height, (displacement, speed)) in self.displacements.iter_mut().zip(&self.speeds).enumerate() {
            let cells = [0, 1].map(|axis| {
                // Displacements wrap after 2^31 cells; the difference of the whole parts is right all the same.
                let moved = displacement[axis].wrapping_add(speed[axis]);
                let whole = (moved >> FRACTION_BITS) - (displacement[axis] >> FRACTION_BITS);
                displacement[axis] = moved;
                whole
            });
            *layers[height / HEIGHTS_PER_LAYER].entry(cells).or_default() |= 1 << (height % HEIGHTS_PER_LAYER);
        }
        let shifts = |layer: BTreeMap<_, _>| layer.into_iter().map(|(cells, mask)| Shift { cells, mask }).collect();
        ShiftPlan { layers: layers.into_iter().map(shifts).collect() }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "winds are limited to 64 cells a step")]
fn to_fixed(cells: f64) -> i64 {
    (cells * FRACTIONS).round() as i64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn knot(height_cells: f64, cells_per_step: [f64; 2]) -> WindKnot {
        WindKnot { height_cells, cells_per_step }
    }

    #[test]
    fn wind_is_linear_between_knots_and_constant_beyond() {
        let profile = WindProfile::new(vec![knot(4.0, [1.0, 0.0]), knot(8.0, [3.0, -2.0])]).unwrap();
        for (height, want) in [(0.0, [1.0, 0.0]), (4.0, [1.0, 0.0]), (7.0, [2.5, -1.5]), (99.0, [3.0, -2.0])] {
            let found = profile.at(height);
            assert!((found[0] - want[0]).abs() + (found[1] - want[1]).abs() < 1e-12, "at {height}: {found:?}");
        }
        assert!(WindProfile::default().at(3.0)[0].abs() < 1e-12, "no knots, no wind");
    }

    #[test]
    fn whole_cells_add_up_to_the_displacement_for_any_speed_and_direction() {
        let profile = WindProfile::new(vec![knot(0.0, [-0.3, 0.7]), knot(40.0, [2.6, -1.9])]).unwrap();
        let mut wind = Wind::new(profile.clone(), 40);
        let mut moved = vec![[0_i64; 2]; 40];
        for _ in 0..777 {
            let plan = wind.advance();
            for (height, moved) in moved.iter_mut().enumerate() {
                let shifts = plan.layer(height / 32).iter();
                let mine: Vec<_> = shifts.filter(|shift| (shift.mask >> (height % 32)) & 1 == 1).collect();
                assert_eq!(mine.len(), 1, "height {height} moves once");
                moved[0] += mine[0].cells[0];
                moved[1] += mine[0].cells[1];
            }
        }
        for (height, moved) in moved.iter().enumerate() {
            let want = profile.at(height as f64 + 0.5).map(|speed| 777.0 * speed);
            for axis in [0, 1] {
                let hidden = wind.hidden_cells(height)[axis];
                assert!((0.0..1.0).contains(&hidden), "height {height}: {hidden}");
                // 777 steps of a speed rounded to 2^-32.
                let found = moved[axis] as f64 + hidden;
                assert!((found - want[axis]).abs() < 1e-6, "height {height}: {found} {want:?}");
            }
        }
    }

    #[test]
    fn a_change_of_wind_does_not_move_what_has_moved() {
        let mut wind = Wind::new(WindProfile::uniform([0.75, 0.0]).unwrap(), 1);
        (0..3).for_each(|_| drop(wind.advance()));
        wind.set_profile(WindProfile::uniform([-0.25, 0.0]).unwrap());
        assert!((wind.displacement_cells(0)[0] - 2.25).abs() < 1e-9, "{:?}", wind.displacement_cells(0));
        wind.advance();
        assert!((wind.displacement_cells(0)[0] - 2.0).abs() < 1e-9, "{:?}", wind.displacement_cells(0));
    }

    #[test]
    fn knots_out_of_order_and_storms_are_refused() {
        let falling = WindProfile::new(vec![knot(4.0, [0.0; 2]), knot(4.0, [1.0; 2])]).unwrap_err().to_string();
        assert!(falling.contains("knot 1") && falling.contains("height 4"), "{falling}");
        let storm = WindProfile::uniform([0.0, 65.0]).unwrap_err().to_string();
        assert!(storm.contains("65") && storm.contains("-64 to 64 cells per step"), "{storm}");
        assert!(WindProfile::uniform([f64::NAN, 0.0]).is_err(), "NaN is no wind");
    }
}

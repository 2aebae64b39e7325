//! The dune rule in integers: what the parameters say, as the automaton and its shader read it.

use super::params::DuneParams;
use crate::DuneError;
use crate::direction::tan_deg;
use crate::error::check_params;

/// Height quanta of a dune field in one cell length.
pub const DUNE_QUANTA_PER_CELL: i32 = 256;
/// Heights stay below this (cells), so that products of differences stay within 32 bits.
pub const MAX_HEIGHT_CELLS: i32 = 8192;
/// Shadows of crests reach at most this far downwind (cells).
pub const SHADOW_REACH_CELLS: i32 = 256;
/// A lee catches hops that pass over its edge up to this far downwind (cells).
pub const CATCH_REACH_CELLS: i32 = 16;
/// A slab sticks after that many hops wherever it is.
pub const MAX_HOPS: u32 = 64;
/// Steps between two looks at the surroundings' mean height and at plants.
pub const SLOW_STEPS: u32 = 16;

/// The rule as integers; every field goes to a shader as it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DuneRule {
    /// Thickness of a slab (quanta).
    pub slab: i32,
    /// Chance to lift (1/256); 256 is always.
    pub lift_256: u32,
    /// Hop at mean height (1/256 cell).
    pub hop_256: i32,
    /// Hop length for a cell of height over the surroundings (1/256).
    pub speed_up_256: i32,
    /// Chance to stick on sand (1/4096).
    pub drop_on_sand_4096: u32,
    /// Chance to stick on bare ground (1/4096).
    pub drop_on_bare_4096: u32,
    /// Fall of the shadow line (quanta per cell).
    pub shadow_fall: i32,
    /// Largest stable difference to a side neighbour and to a diagonal one (quanta).
    pub repose: [i32; 2],
    /// Differences at which sliding ends (quanta).
    pub rest: [i32; 2],
    /// Most passes of sliding in a step.
    pub slide_passes: u32,
    /// Chance that an open upwind edge cell lets a slab in (1/65536).
    pub inflow_65536: u32,
}

impl DuneRule {
    /// The rule for `params`.
    ///
    /// # Errors
    /// [`DuneError::Parameter`] when a parameter is outside its range.
    pub fn new(params: &DuneParams) -> Result<Self, DuneError> {
        check_params(params)?;
        let quanta = f64::from(DUNE_QUANTA_PER_CELL);
        let hop_256 = fixed(params.hop_cells, 256.0);
        Ok(Self {
            slab: fixed(params.slab_cells, quanta).max(1),
            lift_256: fixed(params.lift, 256.0).cast_unsigned(),
            hop_256,
            speed_up_256: fixed(params.speed_up, 256.0),
            drop_on_sand_4096: fixed(params.drop_on_sand, 4096.0).cast_unsigned(),
            drop_on_bare_4096: fixed(params.drop_on_bare, 4096.0).cast_unsigned(),
            shadow_fall: fixed(tan_deg(params.shadow_deg), quanta),
            repose: stable_differences(params.repose_deg),
            rest: stable_differences(params.repose_deg - params.repose_drop_deg),
            slide_passes: params.slide_passes,
            inflow_65536: fixed(params.inflow, 65536.0).cast_unsigned(),
        })
    }

    /// Length of a hop that starts `over_mean` quanta over its surroundings (1/256 cell): from half to three times that
    /// at mean height.
    #[inline(always)]
    #[must_use]
    pub fn hop_length_256(&self, over_mean: i32) -> i32 {
        let over_mean = over_mean.clamp(-(1 << 15), 1 << 15);
        let length = self.hop_256 + ((self.speed_up_256 * over_mean) >> 8);
        length.clamp(self.hop_256 >> 1, 3 * self.hop_256)
    }
}

/// Largest height differences (quanta) that are no steeper than `slope_deg`: to a side and to a diagonal neighbour.
pub(crate) fn stable_differences(slope_deg: f64) -> [i32; 2] {
    let side = tan_deg(slope_deg) * f64::from(DUNE_QUANTA_PER_CELL);
    [side, side * std::f64::consts::SQRT_2].map(|difference| difference.floor() as i32)
}

pub(crate) fn fixed(value: f64, one: f64) -> i32 {
    (value * one).round() as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn repose_differs_little_between_sides_and_diagonals() {
        let [side, diagonal] = DuneRule::new(&DuneParams::default()).unwrap().repose.map(f64::from);
        let slope_deg = |difference: f64, distance: f64| (difference / 256.0 / distance).atan().to_degrees();
        let (side, diagonal) = (slope_deg(side, 1.0), slope_deg(diagonal, std::f64::consts::SQRT_2));
        assert!((33.2..=33.5).contains(&side) && (33.2..=33.5).contains(&diagonal), "{side}, {diagonal} deg");
    }

    #[test]
    fn hops_stay_within_their_limits_at_the_ends_of_every_range() {
        let rule = DuneRule::new(&DuneParams { speed_up: 4.0, hop_cells: 32.0, ..DuneParams::default() }).unwrap();
        assert_eq!(rule.hop_length_256(i32::MAX), 3 * 32 * 256, "longest");
        assert_eq!(rule.hop_length_256(i32::MIN), 16 * 256, "shortest");
        // The product with a direction's part, 2^14.
        assert!((3 * 32 * 256_i32).checked_mul(1 << 14).is_some(), "within 32 bits");
    }
}

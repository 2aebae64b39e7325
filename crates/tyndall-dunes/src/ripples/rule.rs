//! The ripple rule in integers: what [`RippleParams`] say, as the automaton and its shader read it.

use super::RippleParams;
use crate::DuneError;
use crate::error::check_params;

/// Height quanta of a ripple bed in one cell length.
pub const RIPPLE_QUANTA_PER_CELL: i32 = 4096;
/// Longest hop (cells); a grain that the rule would send further lands here.
pub const MAX_HOP_CELLS: i32 = 127;
/// Shadows of crests reach this far downwind (cells).
pub const LEE_REACH_CELLS: i32 = 32;
/// Fractional bits of [`RippleRule::creep_side`] and [`RippleRule::creep_corner`].
pub const CREEP_BITS: u32 = 16;

/// The rule as integers; every field goes to a shader as it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RippleRule {
    /// Hop over a flat bed (1/256 cell).
    pub hop_256: i32,
    /// Hop length for a cell of height (1/256).
    pub hop_per_height_256: i32,
    /// Layer that a cell loses (quanta).
    pub layer: i32,
    /// Share of a height difference that creeps to each of the four neighbours (2^-16).
    pub creep_side: i32,
    /// The same for each of the four diagonal neighbours (2^-16).
    pub creep_corner: i32,
    /// Height difference beyond which creep grows no more (quanta), so that products stay within i32.
    pub creep_limit: i32,
    /// Fall of the shadow line (quanta per cell); 0 is no shadow.
    pub lee_fall: i32,
    /// 1 when the fraction of a hop is a probability, 0 when it is cut off.
    pub dither: i32,
    /// 0 when the wind planes the bed, 1 otherwise.
    pub saltates: i32,
    /// Height of bedrock under the mean bed, negative (quanta).
    pub bedrock: i32,
}

impl RippleRule {
    /// The rule for `params`.
    ///
    /// # Errors
    /// [`DuneError::Parameter`] when a parameter is outside its range.
    pub fn new(params: &RippleParams) -> Result<Self, DuneError> {
        check_params(params)?;
        let quanta = f64::from(RIPPLE_QUANTA_PER_CELL);
        let creep_side = fixed(params.creep / 6.0, f64::from(1 << CREEP_BITS));
        let layer = fixed(params.layer_cells, quanta);
        Ok(Self {
            hop_256: fixed(params.hop_cells, 256.0),
            hop_per_height_256: fixed(params.hop_per_height, 256.0),
            layer,
            creep_side,
            creep_corner: fixed(params.creep / 12.0, f64::from(1 << CREEP_BITS)),
            creep_limit: i32::MAX / creep_side.max(1),
            lee_fall: fixed(params.lee_slope, quanta),
            dither: i32::from(params.dither),
            saltates: i32::from(params.hop_cells <= params.planed_above_cells && layer > 0),
            bedrock: -fixed(params.depth_cells, quanta),
        })
    }

    /// Length of a hop that starts at `height` (1/256 cell), before dithering.
    #[inline(always)]
    #[must_use]
    pub fn hop_length_256(&self, height: i32) -> i32 {
        // The bed stays within 2^19 quanta of its mean (bedrock, 2^22, is deeper than any ripple): see `MAX_RELIEF`.
        let height = height.clamp(-MAX_RELIEF, MAX_RELIEF);
        let grown = self.hop_256 + ((self.hop_per_height_256 * height) >> (RIPPLE_QUANTA_PER_CELL.ilog2()));
        grown.clamp(0, MAX_HOP_CELLS << 8)
    }
}

/// Heights beyond this (quanta, 128 cells) no longer change the hop, so that products stay within i32.
pub const MAX_RELIEF: i32 = 1 << 19;

fn fixed(value: f64, one: f64) -> i32 {
    (value * one).round() as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_stay_within_32_bits_at_the_ends_of_every_range() {
        let extreme = RippleParams { hop_cells: 64.0, hop_per_height: 8.0, creep: 0.75, ..RippleParams::default() };
        let rule = RippleRule::new(&extreme).unwrap();
        assert!(rule.hop_per_height_256.checked_mul(MAX_RELIEF).is_some(), "hop");
        assert!(rule.creep_side.checked_mul(rule.creep_limit).is_some(), "creep");
        assert_eq!(rule.hop_length_256(i32::MAX), MAX_HOP_CELLS << 8, "longest");
        assert_eq!(rule.hop_length_256(i32::MIN), 0, "shortest");
    }

    #[test]
    fn values_out_of_range_are_refused_by_name() {
        let params = RippleParams { creep: 2.0, ..RippleParams::default() };
        let message = RippleRule::new(&params).unwrap_err().to_string();
        assert_eq!(message, "`creep` = 2 is outside 0 to 0.75", "names value and range");
    }
}

//! The rule of Onoue and Nishita 2000 (reference 15 of the paper) after the dune rule of Nishimori and Ouchi 1993.
//!
//! Every cell that the wind reaches loses a layer `N0 (1 + eps + g_N tanh s)`, which lands `L0 (1 + g_L tanh s)` further
//! downwind; s is the slope along the wind. Then creep. The signs of the gains differ between retellings, so both are
//! parameters. Slope alone gives symmetric profiles: it is the wind shadow that makes slip faces.

use super::params::ClassicParams;
use super::rule::{DUNE_QUANTA_PER_CELL, fixed};
use super::transport::Wind;
use crate::DuneError;
use crate::deposits::Bands;
use crate::edges::Edges;
use crate::error::check_params;
use crate::hash::cell_word;
use crate::lattice::Lattice;
use crate::ripples::creep;
use crate::slab::surface::LEE;

/// The rule as integers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ClassicRule {
    /// Hop of a layer (1/256 cell) for each slope of the table.
    pub hop_256: Vec<i32>,
    /// Thickness of a layer (quanta) for each slope of the table.
    pub layer: Vec<i32>,
    /// Share of a height difference that creeps to a side and to a corner neighbour (2^-16).
    pub creep: [i32; 2],
}

/// Steepest slope of the tables (quanta per cell); tanh 3 is 0.995.
const STEEPEST: i32 = 3 * DUNE_QUANTA_PER_CELL;
/// Differences beyond this creep no faster (quanta), so that products stay within 32 bits.
const CREEP_LIMIT: i32 = 1 << 16;

impl ClassicRule {
    /// The rule for `params`.
    ///
    /// # Errors
    /// [`DuneError::Parameter`] when a parameter is outside its range.
    pub fn new(params: &ClassicParams) -> Result<Self, DuneError> {
        check_params(params)?;
        let slopes = (-STEEPEST..=STEEPEST).map(|slope| tanh(f64::from(slope) / f64::from(DUNE_QUANTA_PER_CELL)));
        let hop = |tanh: f64| fixed(params.hop_cells * (1.0 + params.hop_gain * tanh), 256.0);
        let share = (1.0 + params.layer_excess, params.layer_gain);
        let layer = |tanh: f64| {
            fixed(params.layer_cells * (share.0 + share.1 * tanh).max(0.0), f64::from(DUNE_QUANTA_PER_CELL))
        };
        Ok(Self {
            hop_256: slopes.clone().map(hop).collect(),
            layer: slopes.map(layer).collect(),
            creep: [params.creep / 6.0, params.creep / 12.0].map(|share| fixed(share, 65536.0)),
        })
    }
}

/// The hyperbolic tangent from basic arithmetic only, so that tables are the same on every system; to 1e-12.
fn tanh(x: f64) -> f64 {
    // exp(2 x) as the 2^10th power of a short series.
    let small = 2.0 * x / 1024.0;
    let mut power = 1.0 + small * (1.0 + small / 2.0 * (1.0 + small / 3.0 * (1.0 + small / 4.0)));
    for _ in 0..10 {
        power *= power;
    }
    (power - 1.0) / (power + 1.0)
}

/// Moves the layers; `change` receives the change of every height.
pub(super) fn move_layers(rule: &ClassicRule, wind: &Wind<'_>, bedrock: &[i32], bands: &mut Bands, change: &mut [i32]) {
    let lattice = wind.lattice;
    let [ahead_x, ahead_y] = wind.direction.offset(1);
    bands.collect(change, |rows, sink| {
        let cells = rows.start * lattice.nx()..rows.end * lattice.nx();
        for (index, rock) in cells.clone().zip(&bedrock[cells]) {
            let sand = wind.heights[index] - rock;
            if sand <= 0 || wind.surface.kinds[index] & LEE != 0 {
                continue;
            }
            let [x, y] = lattice.position(index).map(|part| part as i32);
            let slope = wind.height_at(x + ahead_x, y + ahead_y) - wind.height_at(x - ahead_x, y - ahead_y);
            let entry = ((slope / 2).clamp(-STEEPEST, STEEPEST) + STEEPEST) as usize;
            let amount = rule.layer[entry].min(sand);
            let word = cell_word(wind.key, index as u32);
            let dither = [(word & 0xFF) as i32, ((word >> 8) & 0xFF) as i32];
            let [dx, dy] = wind.direction.hop(rule.hop_256[entry], dither);
            sink.add(index, -amount);
            if wind.leaves(x + dx, y + dy) {
                sink.leave(amount);
            } else {
                sink.add(lattice.index(x + dx, y + dy), amount);
            }
        }
    });
}

/// Creep of sand between neighbours; a cell never gives more than an eighth of its sand to one of them.
pub(super) fn creep_sand(
    rule: &ClassicRule,
    (lattice, edges): (Lattice, Edges),
    heights: &[i32],
    bedrock: &[i32],
    bands: &mut Bands,
    change: &mut [i32],
) {
    bands.collect(change, |rows, sink| {
        for index in rows.start * lattice.nx()..rows.end * lattice.nx() {
            let [x, y] = lattice.position(index).map(|part| part as i32);
            // Each pair once, from its lower-left cell.
            for ([dx, dy], share) in [([1, 0], 0), ([0, 1], 0), ([1, 1], 1), ([-1, 1], 1)] {
                if edges == Edges::Open && lattice.is_outside(x + dx, y + dy) {
                    continue;
                }
                let other = lattice.index(x + dx, y + dy);
                let gain = creep(heights[other] - heights[index], rule.creep[share], CREEP_LIMIT);
                let giver = if gain > 0 { other } else { index };
                let limit = (heights[giver] - bedrock[giver]).max(0) / 8;
                let gain = gain.clamp(-limit, limit);
                sink.add(index, gain);
                sink.add(other, -gain);
            }
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hyperbolic_tangent_agrees_with_the_library() {
        for step in -300..=300 {
            let x = f64::from(step) * 0.01;
            assert!((tanh(x) - x.tanh()).abs() < 1e-12, "{x}: {}", tanh(x));
        }
    }

    #[test]
    fn on_level_ground_hop_and_layer_are_those_of_the_parameters() {
        let params = ClassicParams::default();
        let rule = ClassicRule::new(&params).unwrap();
        let level = STEEPEST as usize;
        assert_eq!(rule.hop_256[level], 6 * 256, "L0");
        assert_eq!(rule.layer[level], 17, "N0 (1 + eps) = 0.065 cells of 256 quanta");
        assert!(rule.hop_256[level + 100] < rule.hop_256[level], "hops shorten uphill by default");
    }
}

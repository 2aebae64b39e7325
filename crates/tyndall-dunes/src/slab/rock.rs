//! Bedrock that blown sand wears down; what is worn becomes sand.

use rayon::prelude::*;

use super::params::AbrasionParams;
use super::rule::fixed;
use super::surface::{LEE, SAND};
use crate::DuneError;
use crate::error::check_params;
use crate::hash::cell_word;
use crate::lattice::Lattice;

/// How bedrock wears, as integers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rock {
    /// Chance to lose a quantum in a step (1/65536) when soft.
    pub rate_65536: u32,
    /// Hardness of each cell: 255 is not worn.
    pub hardness: Vec<u8>,
}

impl Rock {
    pub(super) fn new(params: &AbrasionParams, lattice: Lattice, map: Option<&[u8]>) -> Result<Self, DuneError> {
        check_params(params)?;
        if let Some(map) = map {
            lattice.check_grid("the map of hardness", map.len())?;
        }
        let even = || vec![fixed(params.hardness, 255.0) as u8; lattice.cells()];
        Ok(Self {
            rate_65536: fixed(params.rate, 65536.0).cast_unsigned(),
            hardness: map.map_or_else(even, <[u8]>::to_vec),
        })
    }

    /// Wears bare rock in the wind; gives back the quanta that became sand. The bed's height stays: rock turns to sand.
    pub(super) fn wear(&self, key: u32, heights: &[i32], kinds: &[u8], cover: Option<&[u8]>, rock: &mut [i32]) -> i64 {
        let cells = rock.par_iter_mut().zip(heights).zip(kinds).enumerate();
        let worn = cells.map(|(index, ((rock, &height), &kind))| {
            if kind & (SAND | LEE) != 0 || height < *rock {
                return 0;
            }
            let plants = cover.map_or(0, |cover| u32::from(cover[index]));
            let softness = 255 - u32::from(self.hardness[index]);
            let chance = (self.rate_65536 * softness / 255) * (255 - plants) / 255;
            let worn = i32::from(cell_word(key, index as u32) >> 16 < chance);
            *rock -= worn;
            i64::from(worn)
        });
        worn.sum()
    }
}

//! Plants on the sand, after Nield and Baas 2008: they hold slabs, steepen slopes, and grow best when slowly buried.

use super::params::VegetationParams;
use super::rule::{DUNE_QUANTA_PER_CELL, fixed, stable_differences};
use crate::DuneError;
use crate::error::check_params;
use crate::hash::{cell_word, step_key};
use crate::lattice::Lattice;

/// Plants of a field.
#[derive(Clone, Debug)]
pub(crate) struct Plants {
    /// Cover of each cell: 0 is bare, 255 full.
    pub(crate) cover: Vec<u8>,
    /// Heights when the plants were last looked at.
    then: Vec<i32>,
    growth: i32,
    best_burial: i32,
    tolerance: i32,
    repose: [i32; 2],
}

impl Plants {
    /// Seedlings on the given share of cells.
    pub(crate) fn new(
        params: &VegetationParams,
        lattice: Lattice,
        seed: u32,
        heights: &[i32],
    ) -> Result<Self, DuneError> {
        check_params(params)?;
        let key = step_key(seed, 0, super::field::PLANT_STREAM);
        let chance = fixed(params.cover, 65536.0).cast_unsigned();
        let seedling = |cell: u32| {
            let word = cell_word(key, cell);
            if word & 0xFFFF < chance { 64 + (word >> 25) as u8 } else { 0 }
        };
        let quanta = f64::from(DUNE_QUANTA_PER_CELL);
        Ok(Self {
            cover: (0..lattice.cells() as u32).map(seedling).collect(),
            then: heights.to_vec(),
            growth: fixed(params.growth, 255.0),
            best_burial: fixed(params.best_burial_cells, quanta),
            tolerance: fixed(params.tolerance_cells, quanta).max(1),
            repose: stable_differences(params.repose_deg),
        })
    }

    /// Growth since the last look: full at the best burial, none at the tolerance away from it, decline beyond, at
    /// most as fast as the growth. Plants do not spring from nothing, and sand as deep as the tolerance kills none at once.
    pub(crate) fn grow(&mut self, heights: &[i32]) {
        for ((cover, then), &now) in self.cover.iter_mut().zip(&mut self.then).zip(heights) {
            if *cover > 0 {
                let off = (now - *then - self.best_burial).abs().min(2 * self.tolerance);
                let change = self.growth * (self.tolerance - off) / self.tolerance;
                *cover = (i32::from(*cover) + change).clamp(0, 255) as u8;
            }
            *then = now;
        }
    }

    /// A stable difference, raised by the plants of a cell; `corner` is 0 for sides and 1 for corners.
    #[inline(always)]
    pub(crate) fn raise(&self, bare: i32, corner: usize, index: usize) -> i32 {
        bare + (((self.repose[corner] - bare).max(0) * i32::from(self.cover[index])) >> 8)
    }
}

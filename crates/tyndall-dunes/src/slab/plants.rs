//! Plants on the sand, after Nield and Baas 2008: they hold slabs, steepen slopes, and grow best when slowly buried.

use super::params::VegetationParams;
use super::rule::{DUNE_QUANTA_PER_CELL, fixed, stable_differences};
use super::streams::PLANT_STREAM;
use crate::DuneError;
use crate::error::check_params;
use crate::hash::{cell_word, step_key};
use crate::lattice::Lattice;

/// How plants grow and hold sand, as integers; every field goes to a shader as it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlantRule {
    /// Growth of the cover between two looks at the best burial.
    pub growth: i32,
    /// Burial between two looks at which plants grow best (quanta).
    pub best_burial: i32,
    /// Burial or erosion away from the best at which they neither grow nor die (quanta), at least 1.
    pub tolerance: i32,
    /// Largest stable difference to a side neighbour and to a diagonal one under full cover (quanta).
    pub repose: [i32; 2],
}

/// Plants of a field.
#[derive(Clone, Debug)]
pub(crate) struct Plants {
    pub(crate) rule: PlantRule,
    /// Cover of each cell: 0 is bare, 255 full.
    pub(crate) cover: Vec<u8>,
    /// Heights when the plants were last looked at.
    pub(crate) heights_then: Vec<i32>,
}

impl Plants {
    /// Clumps of plants on about the given share of cells.
    pub(crate) fn new(
        params: &VegetationParams,
        lattice: Lattice,
        seed: u32,
        heights: &[i32],
    ) -> Result<Self, DuneError> {
        check_params(params)?;
        let quanta = f64::from(DUNE_QUANTA_PER_CELL);
        Ok(Self {
            rule: PlantRule {
                growth: fixed(params.growth, 255.0),
                best_burial: fixed(params.best_burial_cells, quanta),
                tolerance: fixed(params.tolerance_cells, quanta).max(1),
                repose: stable_differences(params.repose_deg),
            },
            cover: clumps(params, lattice, step_key(seed, 0, PLANT_STREAM)),
            heights_then: heights.to_vec(),
        })
    }

    /// Growth since the last look: full at the best burial, none at the tolerance away from it, decline beyond, at
    /// most as fast as the growth. Plants do not spring from nothing, and sand as deep as the tolerance kills none at once.
    pub(crate) fn grow(&mut self, heights: &[i32]) {
        let PlantRule { growth, best_burial, tolerance, .. } = self.rule;
        for ((cover, then), &now) in self.cover.iter_mut().zip(&mut self.heights_then).zip(heights) {
            if *cover > 0 {
                let off = (now - *then - best_burial).abs().min(2 * tolerance);
                let change = growth * (tolerance - off) / tolerance;
                *cover = (i32::from(*cover) + change).clamp(0, 255) as u8;
            }
            *then = now;
        }
    }

    /// A stable difference, raised by the plants of a cell; `corner` is 0 for sides and 1 for corners.
    #[inline(always)]
    pub(crate) fn raise(&self, bare: i32, corner: usize, index: usize) -> i32 {
        bare + (((self.rule.repose[corner] - bare).max(0) * i32::from(self.cover[index])) >> 8)
    }
}

/// Cover by round clumps around random cells, half as dense at the rim as in the middle.
fn clumps(params: &VegetationParams, lattice: Lattice, key: u32) -> Vec<u8> {
    let radius = params.clump_cells as i32;
    let disc = || (-radius..=radius).flat_map(move |y| (-radius..=radius).map(move |x| [x, y]));
    let inside = |[x, y]: &[i32; 2]| x * x + y * y <= radius * radius;
    let area = disc().filter(inside).count() as f64;
    let chance = fixed(params.cover / area, 16_777_216.0).cast_unsigned();
    let mut cover = vec![0; lattice.cells()];
    for index in (0..lattice.cells() as u32).filter(|&index| cell_word(key, index) & 0x00FF_FFFF < chance) {
        let [x, y] = lattice.position(index as usize).map(|part| part as i32);
        for [dx, dy] in disc().filter(inside) {
            let density = 240 - 120 * (dx * dx + dy * dy) / (radius * radius).max(1);
            let cell = &mut cover[lattice.index(x + dx, y + dy)];
            *cell = density.max(i32::from(*cell)) as u8;
        }
    }
    cover
}

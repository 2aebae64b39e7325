//! A bed of sand under the ripple rule.

use rayon::prelude::*;

use super::nishimori_ouchi1993::{Scratch, step_rows};
use super::rule::{RIPPLE_QUANTA_PER_CELL, RippleRule};
use super::{RippleParams, any_direction};
use crate::DuneError;
use crate::direction::Direction;
use crate::hash::{cell_word, step_key};
use crate::lattice::Lattice;
use crate::simulation::{SandSimulation, StateHash};

/// Stream of the hop's dithering along x.
pub(super) const HOP_STREAM: u32 = 0;
/// Stream of the hop's dithering along y; only winds across the lattice use it.
pub(super) const HOP_STREAM_Y: u32 = 1;
/// Stream of the noise at the start.
const NOISE_STREAM: u32 = 2;

/// A periodic bed of sand with ripples; heights in quanta of 1/[`RIPPLE_QUANTA_PER_CELL`] cell over its mean.
#[derive(Clone, Debug)]
pub struct RippleBed {
    lattice: Lattice,
    rule: RippleRule,
    seed: u32,
    wind: Direction,
    step: u32,
    heights: Vec<i32>,
    next: Vec<i32>,
    scratch: Vec<Scratch>,
}

impl RippleBed {
    /// A flat bed with noise, wind along +x.
    ///
    /// # Errors
    /// [`DuneError::Parameter`] when a parameter is outside its range.
    pub fn new(params: &RippleParams) -> Result<Self, DuneError> {
        let rule = RippleRule::new(params)?;
        let side = params.side.cells();
        Self::with_rule(rule, [side, side], params.seed).map(|bed| bed.with_noise(params.noise_cells))
    }

    /// A flat bed of `size` = [nx, ny] cells.
    ///
    /// # Errors
    /// [`DuneError::Side`] when a side is no power of two.
    pub fn with_rule(rule: RippleRule, size: [usize; 2], seed: u32) -> Result<Self, DuneError> {
        let lattice = Lattice::new(size)?;
        let heights = vec![0; lattice.cells()];
        let next = heights.clone();
        Ok(Self { lattice, rule, seed, wind: Direction::EAST, step: 0, heights, next, scratch: Vec::new() })
    }

    fn with_noise(mut self, range_cells: f64) -> Self {
        let key = step_key(self.seed, 0, NOISE_STREAM);
        let range = (range_cells * f64::from(RIPPLE_QUANTA_PER_CELL)).round() as i32;
        for (cell, height) in (0..).zip(&mut self.heights) {
            let unit = (cell_word(key, cell) >> 17) as i32;
            *height = ((unit * (range.min(0xFFFF))) >> 15) - range / 2;
        }
        self
    }

    /// Turns the wind; the lattice stays. Along +x a step is fastest.
    pub fn set_wind_deg(&mut self, angle_deg: f64) {
        self.wind = Direction::from_degrees(angle_deg);
    }

    /// Where the wind blows to.
    pub fn wind(&self) -> Direction {
        self.wind
    }

    /// Keys of the dithering of hops along x and along y in a step; the second counts under winds across the rows only.
    pub fn hop_keys(&self, step: u32) -> [u32; 2] {
        [HOP_STREAM, HOP_STREAM_Y].map(|stream| step_key(self.seed, step, stream))
    }

    /// The rule in integers.
    pub fn rule(&self) -> &RippleRule {
        &self.rule
    }

    /// Heights (quanta), x runs fastest.
    pub fn heights(&self) -> &[i32] {
        &self.heights
    }

    /// Replaces all heights (quanta).
    ///
    /// # Errors
    /// [`DuneError::GridSize`] when their number is wrong, [`DuneError::Height`] when one is beyond 16,384 cells.
    pub fn set_heights(&mut self, heights: &[i32]) -> Result<(), DuneError> {
        self.lattice.check_grid("the heights", heights.len())?;
        let limit_cells = 16_384;
        let limit = (limit_cells * RIPPLE_QUANTA_PER_CELL).unsigned_abs();
        if let Some(index) = heights.iter().position(|height| height.unsigned_abs() > limit) {
            let [x, y] = self.lattice.position(index);
            let value = f64::from(heights[index]) / f64::from(RIPPLE_QUANTA_PER_CELL);
            return Err(DuneError::Height { what: "a height", x, y, value, limit: f64::from(limit_cells) });
        }
        self.heights.copy_from_slice(heights);
        Ok(())
    }

    /// Goes on from these heights (quanta) as after so many steps.
    ///
    /// # Errors
    /// As [`RippleBed::set_heights`]; then nothing changes.
    pub fn set_state(&mut self, heights: &[i32], step: u32) -> Result<(), DuneError> {
        self.set_heights(heights)?;
        self.step = step;
        Ok(())
    }

    /// Heights over the mean bed (cells).
    pub fn heights_cells(&self) -> Vec<f32> {
        self.heights.iter().map(|&height| height as f32 / RIPPLE_QUANTA_PER_CELL as f32).collect()
    }

    fn step_along_rows(&mut self) {
        let (nx, ny) = (self.lattice.nx(), self.lattice.ny());
        let [key, _] = self.hop_keys(self.step);
        // Two rows of each band are computed twice, so bands are as high as the number of threads allows.
        let bands = rayon::current_num_threads().min(ny / 8).max(1);
        let rows = ny.div_ceil(bands);
        self.scratch.resize_with(bands, || Scratch::new(nx));
        let (rule, heights) = (&self.rule, &self.heights);
        let work = self.next.par_chunks_mut(rows * nx).zip(&mut self.scratch).enumerate();
        work.for_each(|(band, (out, scratch))| step_rows(rule, key, heights, band * rows, out, scratch));
    }
}

impl SandSimulation for RippleBed {
    fn lattice(&self) -> Lattice {
        self.lattice
    }

    fn steps_done(&self) -> u32 {
        self.step
    }

    fn step(&mut self) {
        if self.wind == Direction::EAST {
            self.step_along_rows();
        } else {
            let keys = self.hop_keys(self.step);
            any_direction::step(&self.rule, keys, self.wind, self.lattice, &self.heights, &mut self.next);
        }
        std::mem::swap(&mut self.heights, &mut self.next);
        self.step = self.step.wrapping_add(1);
    }

    fn mass_quanta(&self) -> i64 {
        self.heights.iter().map(|&height| i64::from(height)).sum()
    }

    fn state_hash(&self) -> u64 {
        StateHash::new(self.lattice, self.step).with_grid(&self.heights).finish()
    }
}

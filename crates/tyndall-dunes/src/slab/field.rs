//! A field of dunes and its step.

use rayon::prelude::*;

use super::avalanche::{Avalanche, Slope};
use super::onoue_nishita2000::{ClassicRule, creep_sand, move_layers};
use super::params::{AbrasionParams, ClassicParams, DuneModel, DuneParams, VegetationParams};
use super::plants::{PlantRule, Plants};
use super::rock::Rock;
use super::rule::{DUNE_QUANTA_PER_CELL, DuneRule, MAX_HEIGHT_CELLS, SHADOW_REACH_CELLS, SLOW_STEPS, fixed};
use super::streams::{DuneKeys, NOISE_STREAM};
use super::surface::Surface;
use super::surroundings::mean_heights;
use super::transport::{Wind, move_slabs};
use crate::DuneError;
use crate::deposits::Bands;
use crate::direction::Direction;
use crate::edges::Edges;
use crate::hash::{cell_word, step_key};
use crate::lattice::Lattice;
use crate::ledger::Ledger;
use crate::shadow::ShadowLine;
use crate::simulation::{SandSimulation, StateHash};
use crate::wind::WindSchedule;

/// Passes of [`DuneField::settle`] before it gives up: far more than a field has ever needed.
const MOST_SETTLING_PASSES: u32 = 100_000;

/// Cells that a thread takes at a time.
const CHUNK: usize = 1 << 14;

/// A field of dunes; heights in quanta of 1/[`DUNE_QUANTA_PER_CELL`] cell.
#[derive(Clone, Debug)]
pub struct DuneField {
    pub(super) lattice: Lattice,
    rule: DuneRule,
    classic: Option<ClassicRule>,
    edges: Edges,
    seed: u32,
    winds: WindSchedule,
    pub(super) step: u32,
    /// Bed: sand and what lies under it.
    pub(crate) heights: Vec<i32>,
    /// What lies under the sand.
    pub(crate) bedrock: Vec<i32>,
    pub(crate) walls: Option<Vec<u8>>,
    pub(super) plants: Option<Plants>,
    rock: Option<Rock>,
    pub(crate) ledger: Ledger,
    // Working memory; nothing of it is part of the state but `means`.
    pub(super) means: Vec<i32>,
    shadow: ShadowLine,
    surface: Surface,
    change: Vec<i32>,
    bands: Bands,
    avalanche: Avalanche,
}

impl DuneField {
    /// Level sand with noise over level ground, under a wind along +x.
    ///
    /// # Errors
    /// [`DuneError::Parameter`] when a parameter is outside its range.
    pub fn new(params: &DuneParams) -> Result<Self, DuneError> {
        let side = params.side.cells();
        Self::with_size(params, [side, side])
    }

    /// As [`DuneField::new`] with `size` = [nx, ny] cells in place of the parameter's.
    ///
    /// # Errors
    /// As [`DuneField::new`], and [`DuneError::Side`] when a side is no power of two.
    pub fn with_size(params: &DuneParams, size: [usize; 2]) -> Result<Self, DuneError> {
        let rule = DuneRule::new(params)?;
        let lattice = Lattice::new(size)?;
        let heights = noisy_sand(params, lattice);
        let classic = match params.model {
            DuneModel::Slab => None,
            DuneModel::Classic => Some(ClassicRule::new(&ClassicParams::default())?),
        };
        let mut field = Self {
            lattice,
            rule,
            classic,
            edges: params.edges,
            seed: params.seed,
            winds: WindSchedule::steady(0.0),
            step: 0,
            bedrock: vec![0; heights.len()],
            walls: None,
            plants: None,
            rock: None,
            ledger: Ledger::default(),
            means: heights.clone(),
            shadow: ShadowLine::new(lattice),
            surface: Surface::new(lattice),
            change: vec![0; heights.len()],
            bands: Bands::new(lattice),
            avalanche: Avalanche::new(lattice),
            heights,
        };
        field.ledger.start = field.mass_quanta();
        Ok(field)
    }

    /// Sets the winds.
    pub fn set_winds(&mut self, winds: WindSchedule) {
        self.winds = winds;
    }

    /// The winds.
    pub fn winds(&self) -> &WindSchedule {
        &self.winds
    }

    /// Sets the numbers of the classic model; [`DuneParams::model`] selects it.
    ///
    /// # Errors
    /// [`DuneError::Parameter`] when a parameter is outside its range.
    pub fn set_classic(&mut self, params: &ClassicParams) -> Result<(), DuneError> {
        let rule = ClassicRule::new(params)?;
        self.classic = self.classic.is_some().then_some(rule);
        Ok(())
    }

    /// Sows plants, or takes them away when they are not enabled.
    ///
    /// # Errors
    /// [`DuneError::Parameter`] when a parameter is outside its range.
    pub fn set_vegetation(&mut self, params: &VegetationParams) -> Result<(), DuneError> {
        let plants = Plants::new(params, self.lattice, self.seed, &self.heights)?;
        self.plants = params.enabled.then_some(plants);
        Ok(())
    }

    /// Makes bedrock wear under blown sand, with a map of its hardness (0 soft to 255) or evenly hard.
    ///
    /// # Errors
    /// [`DuneError::Parameter`] when a parameter is outside its range, [`DuneError::GridSize`] when the map does not fit.
    pub fn set_abrasion(&mut self, params: &AbrasionParams, hardness: Option<&[u8]>) -> Result<(), DuneError> {
        let rock = Rock::new(params, self.lattice, hardness)?;
        self.rock = params.enabled.then_some(rock);
        Ok(())
    }

    /// Puts the sand, as deep as it lies, on bedrock of these heights (cells).
    ///
    /// # Errors
    /// [`DuneError::GridSize`] when the grid does not fit, [`DuneError::Height`] when a height is no number or too large.
    pub fn set_bedrock_cells(&mut self, bedrock: &[f32]) -> Result<(), DuneError> {
        let bedrock = self.quanta("the bedrock", bedrock)?;
        for ((height, old), &new) in self.heights.iter_mut().zip(&mut self.bedrock).zip(&bedrock) {
            *height += new - *old;
            *old = new;
        }
        self.look_around();
        Ok(())
    }

    /// Replaces the sand by these depths (cells); the ledger starts anew.
    ///
    /// # Errors
    /// [`DuneError::GridSize`] when the grid does not fit, [`DuneError::Height`] when a depth is negative, no number or
    /// too large.
    pub fn set_sand_cells(&mut self, depths: &[f32]) -> Result<(), DuneError> {
        let depths = self.quanta("the sand", depths)?;
        if let Some(index) = depths.iter().position(|&depth| depth < 0) {
            let [x, y] = self.lattice.position(index);
            let value = f64::from(depths[index]) / f64::from(DUNE_QUANTA_PER_CELL);
            return Err(DuneError::Height { what: "the sand", x, y, value, limit: f64::from(MAX_HEIGHT_CELLS) });
        }
        for ((height, rock), depth) in self.heights.iter_mut().zip(&self.bedrock).zip(depths) {
            *height = rock + depth;
        }
        self.ledger = Ledger { start: self.mass_quanta(), ..Ledger::default() };
        self.look_around();
        Ok(())
    }

    /// Marks cells as walls (not 0): no slab enters them. Raise their bedrock too, so that they cast a shadow.
    ///
    /// # Errors
    /// [`DuneError::GridSize`] when the mask does not fit.
    pub fn set_walls(&mut self, walls: &[u8]) -> Result<(), DuneError> {
        self.lattice.check_grid("the mask of walls", walls.len())?;
        self.walls = walls.iter().any(|&wall| wall != 0).then(|| walls.to_vec());
        Ok(())
    }

    fn quanta(&self, what: &'static str, grid: &[f32]) -> Result<Vec<i32>, DuneError> {
        self.lattice.check_grid(what, grid.len())?;
        let limit = f64::from(MAX_HEIGHT_CELLS);
        let convert = |(index, &value): (usize, &f32)| {
            let value = f64::from(value);
            let [x, y] = self.lattice.position(index);
            let inside = value.abs() <= limit;
            let quanta = fixed(value, f64::from(DUNE_QUANTA_PER_CELL));
            if inside { Ok(quanta) } else { Err(DuneError::Height { what, x, y, value, limit }) }
        };
        grid.iter().enumerate().map(convert).collect()
    }

    /// Bed heights (quanta), x runs fastest.
    pub fn heights(&self) -> &[i32] {
        &self.heights
    }

    /// Heights of what lies under the sand (quanta).
    pub fn bedrock(&self) -> &[i32] {
        &self.bedrock
    }

    /// Cover by plants of each cell, 0 to 255, if plants grow.
    pub fn plant_cover(&self) -> Option<&[u8]> {
        self.plants.as_ref().map(|plants| plants.cover.as_slice())
    }

    /// How plants grow and hold sand, if they do.
    pub fn plant_rule(&self) -> Option<&PlantRule> {
        self.plants.as_ref().map(|plants| &plants.rule)
    }

    /// Cells that no slab enters (not 0), if there are any.
    pub fn walls(&self) -> Option<&[u8]> {
        self.walls.as_deref()
    }

    /// How bedrock wears, if it does.
    pub fn rock(&self) -> Option<&Rock> {
        self.rock.as_ref()
    }

    /// Whether slabs move, or the layers of the classic rule.
    pub fn model(&self) -> DuneModel {
        if self.classic.is_some() { DuneModel::Classic } else { DuneModel::Slab }
    }

    /// Keys of the random words of a step.
    pub fn keys(&self, step: u32) -> DuneKeys {
        DuneKeys::new(self.seed, step)
    }

    /// Where the sand came from and went to.
    pub fn ledger(&self) -> Ledger {
        self.ledger
    }

    /// The rule in integers.
    pub fn rule(&self) -> &DuneRule {
        &self.rule
    }

    /// What lies beyond the edges.
    pub fn edges(&self) -> Edges {
        self.edges
    }

    /// Slides until no slope is steeper than repose; gives back the number of passes. Steps slide a few passes only.
    pub fn settle(&mut self) -> u32 {
        self.slide(self.keys(self.step).slide, MOST_SETTLING_PASSES)
    }

    /// Casts the wind's shadow and sorts cells by it.
    fn shade(&mut self, wind: Direction) {
        let (low, high) = relief(&self.heights);
        // Lines from further away end below the lowest bed, so a shorter reach gives the same bits.
        let fall = self.rule.shadow_fall.max(1);
        let mut reach = 4;
        while reach < SHADOW_REACH_CELLS && reach * fall <= high - low {
            reach *= 4;
        }
        self.shadow.cast(&self.heights, wind, fall, reach, self.edges);
        self.surface.classify(&self.heights, &self.bedrock, self.shadow.heights(), self.rule.slab);
        self.surface.find_lee(self.lattice, wind, self.edges);
    }

    fn blow(&mut self, direction: Direction) {
        let keys = self.keys(self.step);
        let wind = Wind {
            rule: &self.rule,
            lattice: self.lattice,
            edges: self.edges,
            direction,
            to_lee: std::array::from_fn(|far| direction.offset(far as i32)),
            heights: &self.heights,
            means: &self.means,
            surface: &self.surface,
            plants: self.plants.as_ref(),
            walls: self.walls.as_deref(),
            key: keys.lift,
            inflow_key: keys.inflow,
        };
        match &self.classic {
            None => move_slabs(&wind, &mut self.bands, &mut self.change),
            Some(rule) => move_layers(rule, &wind, &self.bedrock, &mut self.bands, &mut self.change),
        }
        let crossings = self.bands.crossings();
        self.ledger.entered += crossings.entered;
        self.ledger.left += crossings.left;
        add(&mut self.heights, &self.change);
        if let Some(rule) = &self.classic {
            let site = (self.lattice, self.edges);
            creep_sand(rule, site, &self.heights, &self.bedrock, &mut self.bands, &mut self.change);
            add(&mut self.heights, &self.change);
        }
    }

    fn slide(&mut self, key: u32, passes: u32) -> u32 {
        let slope = Slope {
            bedrock: &self.bedrock,
            plants: self.plants.as_ref(),
            repose: self.rule.repose,
            rest: self.rule.rest,
            edges: self.edges,
        };
        self.avalanche.slide(&mut self.heights, &slope, key, passes)
    }

    fn wear_rock(&mut self) {
        if let Some(rock) = &self.rock {
            let key = self.keys(self.step).abrasion;
            let cover = self.plants.as_ref().map(|plants| plants.cover.as_slice());
            self.ledger.abraded += rock.wear(key, &self.heights, &self.surface.kinds, cover, &mut self.bedrock);
        }
    }

    pub(crate) fn look_around(&mut self) {
        mean_heights(self.lattice, self.edges, &self.heights, &mut self.means);
    }
}

/// The lowest and the highest bed.
fn relief(heights: &[i32]) -> (i32, i32) {
    let chunks = heights.par_chunks(CHUNK).map(|chunk| {
        chunk.iter().fold((i32::MAX, i32::MIN), |(low, high), &height| (low.min(height), high.max(height)))
    });
    chunks.reduce(|| (i32::MAX, i32::MIN), |a, b| (a.0.min(b.0), a.1.max(b.1)))
}

fn add(heights: &mut [i32], change: &[i32]) {
    heights.par_chunks_mut(CHUNK).zip(change.par_chunks(CHUNK)).for_each(|(heights, change)| {
        for (height, change) in heights.iter_mut().zip(change) {
            *height += change;
        }
    });
}

fn noisy_sand(params: &DuneParams, lattice: Lattice) -> Vec<i32> {
    let quanta = f64::from(DUNE_QUANTA_PER_CELL);
    let (mean, range) = (fixed(params.sand_cells, quanta), fixed(params.noise_cells, quanta));
    let key = step_key(params.seed, 0, NOISE_STREAM);
    // Thin sand gets as much noise as it is deep, so that its mean stays.
    let range = range.min(2 * mean);
    let noise = |cell: u32| (((cell_word(key, cell) >> 16) as i32 * range) >> 16) - range / 2;
    (0..lattice.cells() as u32).map(|cell| mean + noise(cell)).collect()
}

impl SandSimulation for DuneField {
    fn lattice(&self) -> Lattice {
        self.lattice
    }

    fn steps_done(&self) -> u32 {
        self.step
    }

    fn step(&mut self) {
        if self.step.is_multiple_of(SLOW_STEPS) {
            self.look_around();
            if let Some(plants) = &mut self.plants {
                plants.grow(&self.heights);
            }
        }
        let direction = self.winds.direction(self.step);
        self.shade(direction);
        self.blow(direction);
        self.wear_rock();
        self.slide(self.keys(self.step).slide, self.rule.slide_passes);
        self.step = self.step.wrapping_add(1);
    }

    fn mass_quanta(&self) -> i64 {
        self.heights.iter().zip(&self.bedrock).map(|(&height, &rock)| i64::from(height - rock)).sum()
    }

    fn state_hash(&self) -> u64 {
        StateHash::new(self.lattice, self.step).with_grid(&self.heights).with_grid(&self.bedrock).finish()
    }
}

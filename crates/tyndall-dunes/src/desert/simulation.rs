//! The field of a scene: from its parameters to its steps, and what is asked of it.

use std::error::Error;

use super::ages::Ages;
use super::by_hand::Touch;
use super::inputs::DesertInputs;
use super::params::DesertParams;
use super::stepper::DuneStepper;
use crate::DuneError;
use crate::brush::check_stroke;
use crate::direction::{DIRECTION_ONE, Direction};
use crate::export::DuneMaps;
use crate::simulation::SandSimulation as _;
use crate::slab::{DUNE_QUANTA_PER_CELL, DuneField};

/// The desert of a scene.
#[derive(Clone, Debug)]
pub struct DesertSimulation {
    params: DesertParams,
    inputs: DesertInputs,
    field: DuneField,
    /// Touches by hand that have been made.
    touched: usize,
    ages: Option<Ages>,
}

impl DesertSimulation {
    /// The desert before its first step.
    ///
    /// # Errors
    /// [`DuneError::Parameter`] when a parameter is outside its range, [`DuneError::Height`] when the terrain is too high.
    pub fn cold(params: &DesertParams, inputs: &DesertInputs) -> Result<Self, DuneError> {
        let mut field = params.field()?;
        if let Some(terrain) = &inputs.terrain {
            field.set_bedrock_cells(&terrain.bedrock_cells(field.lattice(), params.dunes.cell_m)?)?;
            // Plants remember the height they stand at, and the ground has moved.
            field.set_vegetation(&params.plants)?;
        }
        if let Some(winds) = &inputs.winds {
            field.set_winds(winds.clone());
        }
        inputs.touches.iter().try_for_each(|touch| check_stroke(&touch.brush))?;
        let mut simulation = Self { params: params.clone(), inputs: inputs.clone(), field, touched: 0, ages: None };
        simulation.lay_hands_on();
        Ok(simulation)
    }

    /// What it took from files.
    #[must_use]
    pub fn inputs(&self) -> &DesertInputs {
        &self.inputs
    }

    /// The parameters that it was made from.
    #[must_use]
    pub fn params(&self) -> &DesertParams {
        &self.params
    }

    /// The field.
    #[must_use]
    pub fn field(&self) -> &DuneField {
        &self.field
    }

    /// The field, for brushes, bedrock and other winds. Use [`DesertSimulation::advance`] to step: ages see nothing of
    /// steps that are made behind their back.
    pub fn field_mut(&mut self) -> &mut DuneField {
        &mut self.field
    }

    /// Makes steps.
    pub fn advance(&mut self, steps: u32) {
        for _ in 0..steps {
            self.field.step();
            if let Some(ages) = &mut self.ages {
                ages.observe(self.field.heights(), self.field.steps_done());
            }
            self.lay_hands_on();
        }
    }

    /// Makes steps on a device. Fields that note when cells move are looked at after every step, and stay on the processor.
    ///
    /// # Errors
    /// As [`DuneStepper::advance`]; the desert then stands at one of the steps before.
    pub fn advance_by(&mut self, device: &mut dyn DuneStepper, steps: u32) -> Result<(), Box<dyn Error + Send + Sync>> {
        if self.ages.is_some() {
            self.advance(steps);
            return Ok(());
        }
        let last = self.step_count() + steps;
        while self.step_count() < last {
            let now = self.step_count();
            let next = self.inputs.touches.get(self.touched).map_or(last, |touch| touch.step.clamp(now + 1, last));
            self.field = device.advance(&self.field, next - now)?;
            self.lay_hands_on();
        }
        Ok(())
    }

    /// Makes the touches that are due.
    fn lay_hands_on(&mut self) {
        let now = self.field.steps_done();
        while let Some(touch) = self.inputs.touches.get(self.touched).filter(|touch| touch.step <= now) {
            // Strokes were checked at the start, so that none is refused.
            drop(self.field.apply(&touch.brush));
            self.touched += 1;
        }
    }

    /// Touches that have been made.
    pub(super) fn made_touches(&self) -> &[Touch] {
        &self.inputs.touches[..self.touched]
    }

    /// Other touches from here on; those made so far must be the first ones.
    pub(super) fn set_touches(&mut self, touches: Vec<Touch>) {
        self.inputs.touches = touches;
        self.lay_hands_on();
    }

    /// Counts the touches before a state's step as made.
    pub(super) fn skip_touches(&mut self) {
        let now = self.field.steps_done();
        self.touched = self.inputs.touches.partition_point(|touch| touch.step <= now);
    }

    /// Notes from here on when each cell moves last. Steps become a little slower and make the same bits.
    pub fn keep_ages(&mut self) {
        if self.ages.is_none() {
            self.ages = Some(Ages::new(self.field.heights(), self.field.steps_done()));
        }
    }

    /// Steps since each cell's bed moved last, or since [`DesertSimulation::keep_ages`] where it has not; `None` when ages
    /// are not kept.
    #[must_use]
    pub fn age_steps(&self) -> Option<Vec<u32>> {
        let now = self.field.steps_done();
        self.ages.as_ref().map(|ages| ages.moved_at.iter().map(|at| now.wrapping_sub(*at)).collect())
    }

    pub(super) fn moved_at(&self) -> Option<&[u32]> {
        self.ages.as_ref().map(|ages| ages.moved_at.as_slice())
    }

    pub(super) fn set_moved_at(&mut self, moved_at: Option<Vec<u32>>) {
        self.ages = moved_at.map(|moved_at| Ages::with_past(self.field.heights(), moved_at));
    }

    /// Steps since the start.
    #[must_use]
    pub fn step_count(&self) -> u32 {
        self.field.steps_done()
    }

    /// Hash of sand and bedrock: equal ones, equal deserts.
    #[must_use]
    pub fn hash(&self) -> u64 {
        self.field.state_hash()
    }

    /// Length of a cell's side (m).
    #[must_use]
    pub fn cell_m(&self) -> f64 {
        self.params.dunes.cell_m
    }

    /// Cells from west to east and from south to north.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        self.field.lattice().size()
    }

    /// Heights of the bed (m) over the level on which the sand lies, x runs fastest from the south-west.
    #[must_use]
    pub fn heights_m(&self) -> Vec<f32> {
        self.field.heights().iter().map(|&height| self.metres(height)).collect()
    }

    /// Depth of the sand (m).
    #[must_use]
    pub fn sand_m(&self) -> Vec<f32> {
        let sand = self.field.heights().iter().zip(self.field.bedrock());
        sand.map(|(height, rock)| self.metres(height - rock)).collect()
    }

    /// Lowest and highest bed (m).
    #[must_use]
    pub fn height_range_m(&self) -> [f32; 2] {
        let heights = self.field.heights();
        [heights.iter().min(), heights.iter().max()].map(|height| self.metres(height.copied().unwrap_or(0)))
    }

    fn metres(&self, quanta: i32) -> f32 {
        (f64::from(quanta) * self.cell_m() / f64::from(DUNE_QUANTA_PER_CELL)) as f32
    }

    /// Where the wind of the next step blows to.
    #[must_use]
    pub fn wind(&self) -> Direction {
        self.field.winds().direction(self.field.steps_done())
    }

    /// Where the wind of the next step blows to (deg), anticlockwise from east.
    #[must_use]
    pub fn wind_toward_deg(&self) -> f64 {
        let [x, y] = [self.wind().x, self.wind().y].map(|part| f64::from(part) / f64::from(DIRECTION_ONE));
        y.atan2(x).to_degrees()
    }

    /// Maps for other programs.
    ///
    /// # Errors
    /// [`DuneError::Value`] when the width of a cell is outside its range.
    pub fn maps(&self) -> Result<DuneMaps, DuneError> {
        DuneMaps::of(&self.field, self.cell_m())
    }

    /// The desert in a few words: `256 x 256 cells of 1 m, dunes 8.1 m high, 196608 m3 of sand`.
    #[must_use]
    pub fn summary(&self) -> String {
        let ([nx, ny], [low, high], cell_m) = (self.size(), self.height_range_m(), self.cell_m());
        let sand_m3 = self.field.mass_quanta() as f64 / f64::from(DUNE_QUANTA_PER_CELL) * cell_m.powi(3);
        format!("{nx} x {ny} cells of {cell_m} m, {:.1} m from lowest to highest, {sand_m3:.0} m3 of sand", high - low)
    }
}

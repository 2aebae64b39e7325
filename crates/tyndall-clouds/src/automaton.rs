//! The cellular automaton of section 3.2: Dobashi et al. 2000, bit-parallel.
//!
//! A step is the rule on the state before it, then the three draws (extinction, supply of vapour, supply of activation),
//! then the wind. The paper supplies "at specified time intervals": every [`AutomatonConfig::supply_interval`] steps.
//! The same bits come out for any number of threads, and from [`crate::dobashi2000`], which does everything cell by cell.
#![expect(clippy::inline_always, reason = "only what is inlined is compiled for the processor's wider instructions")]

use rayon::prelude::*;
use tyndall_core::rng::CellRng;

use crate::bit_field::{BitField, GUARD, row_stride};
use crate::edges::Edges;
use crate::error::{CloudError, in_range};
use crate::fields::CloudFields;
use crate::probability::{LayerMotion, ProbabilityLayer};
use crate::probability_planes::{
    DrawHashes, Effect, ProbabilityPlanes, draw_hashes, draw_row, draw_row_shifted, quantise,
};
use crate::shift::{Inflow, shift_field};
use crate::transition::{Neighbourhood, transition_row};
use crate::wind::{ShiftPlan, Wind, WindProfile};

/// Words of a field that one task steps.
const WORDS_PER_TASK: usize = 1 << 14;

/// Streams of the random numbers.
pub(crate) const STREAM_EXTINCTION: u32 = 0;
pub(crate) const STREAM_HUMIDITY: u32 = 1;
pub(crate) const STREAM_ACTIVATION: u32 = 2;
pub(crate) const STREAM_INFLOW: u32 = 3;
pub(crate) const STREAM_START: u32 = 4;

/// Everything about an automaton but its cells and probabilities.
#[derive(Clone, Debug, PartialEq)]
pub struct AutomatonConfig {
    /// Cells along east, north and height.
    pub size: [usize; 3],
    /// Seed of all random numbers.
    pub seed: u64,
    /// Steps from one supply of vapour and activation to the next.
    pub supply_interval: u32,
    /// What lies beyond the sides.
    pub edges: Edges,
    /// Share of humid cells in the air that the wind brings into an open grid.
    pub inflow_humidity: f32,
    /// Wind as a function of height.
    pub wind: WindProfile,
}

impl Default for AutomatonConfig {
    /// 128 x 128 x 32 cells, still air.
    fn default() -> Self {
        Self {
            size: [128, 128, 32],
            seed: 1,
            supply_interval: 1,
            edges: Edges::Open,
            inflow_humidity: 0.0,
            wind: WindProfile::default(),
        }
    }
}

/// The automaton: the state of every cell, and what makes the next state of it.
#[derive(Debug)]
pub struct Automaton {
    fields: CloudFields,
    /// Takes the next act, then each field in turn while the wind moves it.
    spare: BitField,
    step: u32,
    rng: CellRng,
    supply_interval: u32,
    edges: Edges,
    inflow: u32,
    wind: Wind,
    stack: Vec<Box<dyn ProbabilityLayer>>,
    planes: Option<ProbabilityPlanes>,
    zeros: Vec<u32>,
}

/// Hashes of the draws of one step; none for a field that is not drawn in it.
#[derive(Clone, Copy)]
struct StepDraws<'a> {
    planes: &'a ProbabilityPlanes,
    extinction: DrawHashes,
    supply: Option<[DrawHashes; 2]>,
}

impl Automaton {
    /// Clear, dry air in which nothing is ever supplied: the pure rule.
    ///
    /// # Errors
    /// When the size is refused, the interval is 0 or the inflow's humidity is no share.
    pub fn new(config: &AutomatonConfig) -> Result<Self, CloudError> {
        let fields = CloudFields::new(config.size)?;
        in_range("supply interval", f64::from(config.supply_interval), (1.0, 1e6), " steps")?;
        in_range("humidity of the inflow", f64::from(config.inflow_humidity), (0.0, 1.0), "")?;
        Ok(Self {
            spare: fields.act.clone(),
            fields,
            step: 0,
            rng: CellRng::new(config.seed),
            supply_interval: config.supply_interval,
            edges: config.edges,
            inflow: quantise(config.inflow_humidity),
            wind: Wind::new(config.wind.clone(), config.size[2]),
            stack: Vec::new(),
            planes: None,
            zeros: vec![0; config.size[0] + 2 * GUARD],
        })
    }

    /// Cells along east, north and height.
    #[must_use]
    pub fn size(&self) -> [usize; 3] {
        self.fields.size()
    }

    /// What lies beyond the sides.
    #[must_use]
    pub fn edges(&self) -> Edges {
        self.edges
    }

    /// Steps made so far.
    #[must_use]
    pub fn step_count(&self) -> u32 {
        self.step
    }

    /// hum, act and cld.
    #[must_use]
    pub fn fields(&self) -> &CloudFields {
        &self.fields
    }

    /// The wind, and how far it has moved each height.
    #[must_use]
    pub fn wind(&self) -> &Wind {
        &self.wind
    }

    /// The wind, to be changed from the next step on.
    pub fn wind_mut(&mut self) -> &mut Wind {
        &mut self.wind
    }

    /// The layers of probabilities, lowest first.
    #[must_use]
    pub fn probabilities(&self) -> &[Box<dyn ProbabilityLayer>] {
        &self.stack
    }

    /// Replaces the layers of probabilities, lowest first.
    pub fn set_probabilities(&mut self, stack: Vec<Box<dyn ProbabilityLayer>>) {
        self.stack = stack;
        self.refresh_probabilities();
    }

    /// Replaces all cells and the step number, as when a saved state is taken up again.
    ///
    /// # Errors
    /// When the fields have another size.
    pub fn restore(&mut self, fields: CloudFields, step: u32) -> Result<(), CloudError> {
        if fields.size() != self.size() {
            let (found, expected) = (fields.size().to_vec(), self.size().to_vec());
            return Err(CloudError::OtherSize { what: "the state".to_owned(), found, expected });
        }
        self.fields = fields;
        self.spare = BitField::new(self.size());
        self.step = step;
        Ok(())
    }

    /// Puts back what [`ProbabilityLayer::state`] of each layer gave; nothing changes when one refuses.
    ///
    /// # Errors
    /// When there are not the numbers of each layer.
    pub fn restore_layers(&mut self, states: &[&[f64]]) -> Result<(), CloudError> {
        let (found, expected) = (states.len(), self.stack.len());
        if found != expected {
            return Err(CloudError::WrongLength { what: "the list of layers".to_owned(), found, expected });
        }
        let before: Vec<_> = self.stack.iter().map(|layer| layer.state()).collect();
        let restored = self.stack.iter_mut().zip(states).try_for_each(|(layer, state)| layer.restore(state));
        if restored.is_err() {
            for (layer, state) in self.stack.iter_mut().zip(&before) {
                layer.restore(state)?;
            }
        }
        self.refresh_probabilities();
        restored
    }

    /// Makes each cell humid or activated with the probabilities of a stack of layers, as a start; what was set stays set.
    pub fn moisten(&mut self, stack: &[Box<dyn ProbabilityLayer>]) {
        let [nx, ny, _] = self.size();
        let planes = ProbabilityPlanes::new(self.size(), stack);
        let hashes = [0, 1].map(|field| draw_hashes(self.rng, self.step, STREAM_START + field));
        let stride = row_stride(nx);
        for layer in 0..self.fields.hum.layer_count() {
            let hum = self.fields.hum.rows_mut(layer).par_chunks_mut(stride);
            let act = self.fields.act.rows_mut(layer).par_chunks_mut(stride);
            hum.zip(act).enumerate().for_each(|(y, (hum, act))| {
                let first = first_column([nx, ny], layer, y);
                let [_, humidity, activation] = planes.row(layer, y);
                draw_row(humidity, (&hashes[0], first), Effect::Set, &mut hum[GUARD..stride - GUARD]);
                draw_row(activation, (&hashes[1], first), Effect::Set, &mut act[GUARD..stride - GUARD]);
            });
        }
    }

    /// Sets hum of one cell, as a brush does.
    pub fn set_humid(&mut self, cell: [usize; 3], humid: bool) {
        self.fields.hum.set(cell, humid);
    }

    /// Activates one cell: the seed of a cloud.
    pub fn activate(&mut self, cell: [usize; 3]) {
        self.fields.act.set(cell, true);
    }

    /// Makes one step and says how the wind has moved the cells.
    pub fn step(&mut self) -> ShiftPlan {
        self.transition_and_draws();
        let plan = self.wind.advance();
        self.move_with_wind(&plan);
        self.step = self.step.wrapping_add(1);
        match self.blow() {
            LayerMotion::Still => {}
            LayerMotion::Shifted(cells) => {
                if let Some(planes) = &mut self.planes {
                    planes.shift(self.fields.size(), cells);
                }
            }
            LayerMotion::Changed => self.refresh_probabilities(),
        }
        plan
    }

    /// Moves the layers, and says how the probabilities of all together changed.
    fn blow(&mut self) -> LayerMotion {
        let wind = &self.wind;
        let motions: Vec<_> = self.stack.iter_mut().map(|layer| layer.blow(wind)).collect();
        let moving = self.stack.iter().zip(&motions).filter(|(layer, _)| !layer.is_even()).map(|(_, motion)| *motion);
        let mut moving = moving.collect::<Vec<_>>().into_iter();
        let first = moving.next().unwrap_or(LayerMotion::Still);
        if moving.all(|motion| motion == first) { first } else { LayerMotion::Changed }
    }

    fn refresh_probabilities(&mut self) {
        self.planes = (!self.stack.is_empty()).then(|| ProbabilityPlanes::new(self.size(), &self.stack));
    }

    /// The rule and the draws, band by band.
    fn transition_and_draws(&mut self) {
        if self.edges == Edges::Wrap {
            self.fields.act.wrap_guards();
        }
        let [nx, ny, _] = self.size();
        let stride = row_stride(nx);
        let rows_per_task = (WORDS_PER_TASK / stride).max(1);
        let (rng, step) = (self.rng, self.step);
        let hashes = |stream| draw_hashes(rng, step, stream);
        let supplied = step.is_multiple_of(self.supply_interval);
        let draws = self.planes.as_ref().map(|planes| StepDraws {
            planes,
            extinction: hashes(STREAM_EXTINCTION),
            supply: supplied.then(|| [hashes(STREAM_HUMIDITY), hashes(STREAM_ACTIVATION)]),
        });
        let CloudFields { hum, act, cld } = &mut self.fields;
        let (act, zeros, arch) = (&*act, &self.zeros[..], pulp::Arch::new());
        for layer in 0..act.layer_count() {
            let band = stride * rows_per_task;
            let hum = hum.rows_mut(layer).par_chunks_mut(band);
            let cld = cld.rows_mut(layer).par_chunks_mut(band);
            let next = self.spare.rows_mut(layer).par_chunks_mut(band);
            hum.zip(cld).zip(next).enumerate().for_each(|(index, ((hum, cld), next))| {
                let first_row = index * rows_per_task;
                arch.dispatch(Band { act, zeros, draws, layer, first_row, size: [nx, ny], hum, cld, next });
            });
        }
        std::mem::swap(&mut self.fields.act, &mut self.spare);
    }

    fn move_with_wind(&mut self, plan: &ShiftPlan) {
        if plan.is_still() {
            return;
        }
        let hashes = draw_hashes(self.rng, self.step, STREAM_INFLOW);
        let inflow = (self.inflow > 0).then_some(Inflow { quantised: self.inflow, hashes: &hashes });
        let CloudFields { hum, act, cld } = &mut self.fields;
        for (field, inflow) in [(hum, inflow), (act, None), (cld, None)] {
            shift_field(field, &mut self.spare, plan, self.edges, inflow);
            std::mem::swap(field, &mut self.spare);
        }
    }
}

/// Some rows of one layer, with guards.
struct Band<'a> {
    act: &'a BitField,
    zeros: &'a [u32],
    draws: Option<StepDraws<'a>>,
    layer: usize,
    first_row: usize,
    /// [nx, ny].
    size: [usize; 2],
    hum: &'a mut [u32],
    cld: &'a mut [u32],
    next: &'a mut [u32],
}

impl pulp::WithSimd for Band<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _simd: S) {
        let [nx, ny] = self.size;
        let stride = row_stride(nx);
        let rows = self.hum.chunks_exact_mut(stride).zip(self.cld.chunks_exact_mut(stride));
        for (index, ((hum, cld), next)) in rows.zip(self.next.chunks_exact_mut(stride)).enumerate() {
            let y = self.first_row + index;
            // The padded part of a row, where no probability ever is above 0.
            let [hum, cld, next] = [hum, cld, next].map(|row| &mut row[GUARD..stride - GUARD]);
            let around = Neighbourhood::new(self.act, self.layer, y, self.zeros);
            transition_row(&around, &mut hum[..nx], &mut cld[..nx], &mut next[..nx]);
            let Some(draws) = &self.draws else { continue };
            let first = first_column([nx, ny], self.layer, y);
            let [extinction, humidity, activation] = draws.planes.row(self.layer, y);
            let east = draws.planes.east();
            let draw = |planes, (hashes, effect), bits: &mut [u32]| match east {
                0 => draw_row(planes, (hashes, first), effect, bits),
                _ => draw_row_shifted(planes, (hashes, first), effect, &mut bits[..nx], east),
            };
            draw(extinction, (&draws.extinction, Effect::Clear), cld);
            if let Some([hum_hashes, act_hashes]) = &draws.supply {
                draw(humidity, (hum_hashes, Effect::Set), hum);
                draw(activation, (act_hashes, Effect::Set), next);
            }
        }
    }
}

/// Number of a row's first column; columns of all layers are numbered by 32 bits, which the limit on cells guarantees.
pub(crate) fn first_column([nx, ny]: [usize; 2], layer: usize, y: usize) -> u32 {
    u32::try_from((layer * ny + y) * nx).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests;

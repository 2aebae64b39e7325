//! The field at any step, for those who ask for one after the other: pictures, programs with a slider, exports.

use tyndall_core::array::NamedArrays;

use super::stepper::{DuneStepper, SteppedBy, Stepping};
use super::{DesertInputs, DesertParams, DesertSimulation, state_step};
use crate::DuneError;

/// Deserts that are kept for strokes that are taken back.
const MOST_KEPT: usize = 8;

/// Whether a desert becomes that of other inputs by going on: what its hands have done so far is the same.
fn leads_to(known: &DesertSimulation, inputs: &DesertInputs, steps: u32) -> bool {
    let (made, now) = (known.made_touches(), known.step_count());
    let rest = inputs.touches.get(made.len()..);
    known.inputs().terrain == inputs.terrain
        && known.inputs().winds == inputs.winds
        && now <= steps
        && inputs.touches.starts_with(made)
        && rest.is_some_and(|rest| rest.iter().all(|touch| touch.step >= now))
}

/// Makes the field of a step, and goes on from there when a later one of the same desert is asked for.
#[derive(Debug, Default)]
pub struct DesertSource {
    start: Option<NamedArrays>,
    simulation: Option<DesertSimulation>,
    /// Deserts before the last strokes by hand, the oldest first.
    before_strokes: Vec<DesertSimulation>,
    keeps_ages: bool,
    stepping: Stepping,
}

impl DesertSource {
    /// Chooses a state to start from when the step that is asked for is not before it, in place of step 0.
    pub fn start_from(&mut self, state: Option<NamedArrays>) {
        let stepping = std::mem::take(&mut self.stepping);
        *self = Self { start: state, keeps_ages: self.keeps_ages, stepping, ..Self::default() };
    }

    /// Chooses who makes steps; the processor unless chosen, and where the device cannot.
    pub fn set_stepper(&mut self, device: Option<Box<dyn DuneStepper>>) {
        self.stepping = Stepping::new(device);
    }

    /// Who makes the steps.
    #[must_use]
    pub fn stepped_by(&self) -> &SteppedBy {
        self.stepping.by()
    }

    /// Notes when each cell moves last, in all that is made from here on; see [`DesertSimulation::keep_ages`].
    pub fn keep_ages(&mut self) {
        (self.keeps_ages, self.simulation) = (true, None);
        self.before_strokes.clear();
    }

    /// The desert after `steps` steps, or `None` when `is_stale`, which is asked between steps with their number, says that
    /// nobody waits for it any longer; what has been made so far is kept.
    ///
    /// # Errors
    /// When parameters and inputs do not fit together, or the state is damaged or that of another desert.
    pub fn at_unless(
        &mut self,
        params: &DesertParams,
        inputs: &DesertInputs,
        steps: u32,
        is_stale: &dyn Fn(u32) -> bool,
    ) -> Result<Option<&DesertSimulation>, DuneError> {
        let earlier = self.nearest(params, inputs, steps).and_then(|place| self.take(place));
        let mut simulation = if let Some(known) = earlier {
            known
        } else {
            self.before_strokes.clear();
            self.stepping.try_again();
            self.begin(params, inputs, steps)?
        };
        self.keep_before_stroke(&simulation, inputs);
        simulation.set_touches(inputs.touches.clone());
        let simulation = self.simulation.insert(simulation);
        while simulation.step_count() < steps {
            if is_stale(simulation.step_count()) {
                return Ok(None);
            }
            self.stepping.advance(simulation, steps - simulation.step_count());
        }
        Ok(Some(simulation))
    }

    /// Whether a step is reached from where the desert stands, and not from its start.
    #[must_use]
    pub fn goes_on_to(&self, params: &DesertParams, inputs: &DesertInputs, steps: u32) -> bool {
        self.nearest(params, inputs, steps).is_some()
    }

    /// Which of the known deserts leads to a step in the fewest steps: 0 is the last one, others stand before strokes.
    fn nearest(&self, params: &DesertParams, inputs: &DesertInputs, steps: u32) -> Option<usize> {
        let known = self.simulation.iter().map(|known| (0, known));
        let known = known.chain((1..).zip(&self.before_strokes));
        let leads = known.filter(|(_, known)| known.params() == params && leads_to(known, inputs, steps));
        leads.max_by_key(|(_, known)| (known.step_count(), known.made_touches().len())).map(|(place, _)| place)
    }

    /// Takes a desert of [`DesertSource::nearest`] out; those before later strokes are forgotten.
    fn take(&mut self, place: usize) -> Option<DesertSimulation> {
        let last = self.simulation.take();
        if place == 0 {
            return last;
        }
        self.before_strokes.truncate(place);
        self.before_strokes.pop()
    }

    /// Keeps a desert before a new stroke is made, so that taking the stroke back is quick.
    fn keep_before_stroke(&mut self, simulation: &DesertSimulation, inputs: &DesertInputs) {
        let made = simulation.made_touches();
        let next = inputs.touches.get(made.len()).filter(|touch| touch.step <= simulation.step_count());
        if next.is_some_and(|next| made.last().is_none_or(|last| last.stroke != next.stroke)) {
            if self.before_strokes.len() == MOST_KEPT {
                self.before_strokes.remove(0);
            }
            self.before_strokes.push(simulation.clone());
        }
    }

    /// Takes up a desert that was made elsewhere.
    pub fn take_up(&mut self, simulation: DesertSimulation) {
        self.simulation = Some(simulation);
    }

    /// The desert as far as it has been made.
    #[must_use]
    pub fn simulation(&self) -> Option<&DesertSimulation> {
        self.simulation.as_ref()
    }

    fn begin(&self, params: &DesertParams, inputs: &DesertInputs, steps: u32) -> Result<DesertSimulation, DuneError> {
        let mut simulation = match &self.start {
            Some(state) if state_step(state)? <= steps => DesertSimulation::from_state(params, inputs, state)?,
            _ => DesertSimulation::cold(params, inputs)?,
        };
        if self.keeps_ages {
            simulation.keep_ages();
        }
        Ok(simulation)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::side::Side;

    fn params() -> DesertParams {
        let mut params = DesertParams::default();
        params.dunes.side = Side::Cells64;
        params
    }

    #[test]
    fn every_step_is_the_same_whichever_was_asked_for_before() {
        let inputs = DesertInputs::default();
        let hash = |source: &mut DesertSource, steps| {
            source.at_unless(&params(), &inputs, steps, &|_| false).unwrap().unwrap().hash()
        };
        let mut source = DesertSource::default();
        let [ten, thirty, ten_again] = [10, 30, 10].map(|steps| hash(&mut source, steps));
        assert_eq!(ten, ten_again, "back");
        assert_eq!(hash(&mut DesertSource::default(), 30), thirty, "in one go");
        let mut half_way = DesertSimulation::cold(&params(), &inputs).unwrap();
        half_way.advance(20);
        source.start_from(Some(half_way.state()));
        assert_eq!([30, 10].map(|steps| hash(&mut source, steps)), [thirty, ten], "from a state, and before it");
    }

    #[test]
    fn strokes_are_made_at_their_step_and_taken_back_alike() {
        use crate::by_hand::{parse_strokes, touches};
        let with = |text: &str| {
            let strokes = parse_strokes(text).unwrap();
            DesertInputs { touches: touches(&strokes, 1.0, [64, 64]).unwrap(), ..DesertInputs::default() }
        };
        let hash = |source: &mut DesertSource, text: &str, steps| {
            source.at_unless(&params(), &with(text), steps, &|_| false).unwrap().unwrap().hash()
        };
        let (one, two) = ("20 dig 6 2 0 0 10 0", "20 dig 6 2 0 0 10 0; 25 add 5 1 -9 3");
        let mut source = DesertSource::default();
        let bare = hash(&mut source, "", 20);
        let dug = hash(&mut source, one, 20);
        assert_ne!(dug, bare, "shown before the next step");
        assert_eq!(hash(&mut source, "", 20), bare, "taken back");
        assert_eq!(source.simulation().map(|known| known.field().ledger().brushed_off), Some(0), "and off the ledger");
        let both = hash(&mut source, two, 30);
        assert_eq!(hash(&mut DesertSource::default(), two, 30), both, "in one go");
        assert_ne!(hash(&mut source, one, 30), both, "without the second");
        let longer = hash(&mut source, "20 dig 6 2 0 0 10 0 10 9", 20);
        assert_eq!(hash(&mut DesertSource::default(), "20 dig 6 2 0 0 10 0 10 9", 20), longer, "a path that grew");
        let mut half_way = DesertSimulation::cold(&params(), &with(two)).unwrap();
        half_way.advance(22);
        let mut rest = DesertSimulation::from_state(&params(), &with(two), &half_way.state()).unwrap();
        rest.advance(8);
        assert_eq!(rest.hash(), both, "from a state after the first");
    }

    #[test]
    fn nobody_waits_for_stale_steps_and_what_was_made_is_kept() {
        let inputs = DesertInputs::default();
        let mut source = DesertSource::default();
        let after_five = |step| step == 5;
        assert!(source.at_unless(&params(), &inputs, 100, &after_five).unwrap().is_none(), "given up");
        assert_eq!(source.simulation().map(DesertSimulation::step_count), Some(5), "five steps are made");
    }
}

//! The field at any step, for those who ask for one after the other: pictures, programs with a slider, exports.

use tyndall_core::array::NamedArrays;

use super::{DesertInputs, DesertParams, DesertSimulation, state_step};
use crate::DuneError;

/// Makes the field of a step, and goes on from there when a later one of the same desert is asked for.
#[derive(Clone, Debug, Default)]
pub struct DesertSource {
    start: Option<NamedArrays>,
    simulation: Option<DesertSimulation>,
    keeps_ages: bool,
}

impl DesertSource {
    /// Chooses a state to start from when the step that is asked for is not before it, in place of step 0.
    pub fn start_from(&mut self, state: Option<NamedArrays>) {
        *self = Self { start: state, simulation: None, keeps_ages: self.keeps_ages };
    }

    /// Notes when each cell moves last, in all that is made from here on; see [`DesertSimulation::keep_ages`].
    pub fn keep_ages(&mut self) {
        (self.keeps_ages, self.simulation) = (true, None);
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
        let is_same = |known: &DesertSimulation| known.params() == params && known.inputs() == inputs;
        let earlier = self.simulation.take().filter(|known| is_same(known) && known.step_count() <= steps);
        let simulation = match earlier {
            Some(known) => known,
            None => self.begin(params, inputs, steps)?,
        };
        let simulation = self.simulation.insert(simulation);
        while simulation.step_count() < steps {
            if is_stale(simulation.step_count()) {
                return Ok(None);
            }
            simulation.advance(1);
        }
        Ok(Some(simulation))
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
    fn nobody_waits_for_stale_steps_and_what_was_made_is_kept() {
        let inputs = DesertInputs::default();
        let mut source = DesertSource::default();
        let after_five = |step| step == 5;
        assert!(source.at_unless(&params(), &inputs, 100, &after_five).unwrap().is_none(), "given up");
        assert_eq!(source.simulation().map(DesertSimulation::step_count), Some(5), "five steps are made");
    }
}

//! Everything of a field that steps change: to carry it elsewhere and back.

use super::field::DuneField;
use super::rule::{DUNE_QUANTA_PER_CELL, MAX_HEIGHT_CELLS};
use crate::DuneError;
use crate::ledger::Ledger;
use crate::simulation::StateHash;

/// What steps change of a field; heights in quanta of 1/[`DUNE_QUANTA_PER_CELL`] cell, x runs fastest.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DuneState {
    /// Steps since the start.
    pub step: u32,
    /// Bed: sand and what lies under it.
    pub heights: Vec<i32>,
    /// What lies under the sand.
    pub bedrock: Vec<i32>,
    /// Mean heights of the surroundings at the last look, every [`SLOW_STEPS`](super::SLOW_STEPS) steps.
    pub means: Vec<i32>,
    /// Plants, where they grow.
    pub plants: Option<PlantState>,
    /// Where the sand came from and went to.
    pub ledger: Ledger,
}

/// What steps change of plants.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlantState {
    /// Cover of each cell, 0 is bare, 255 full.
    pub cover: Vec<u8>,
    /// Heights of the bed when the plants were last looked at (quanta).
    pub heights_then: Vec<i32>,
}

impl DuneField {
    /// A copy of everything that steps change.
    pub fn state(&self) -> DuneState {
        DuneState {
            step: self.step,
            heights: self.heights.clone(),
            bedrock: self.bedrock.clone(),
            means: self.means.clone(),
            plants: self
                .plants
                .as_ref()
                .map(|plants| PlantState { cover: plants.cover.clone(), heights_then: plants.heights_then.clone() }),
            ledger: self.ledger,
        }
    }

    /// Goes on from a state of a field with the same rule, winds and plants; nothing changes when it is refused.
    ///
    /// # Errors
    /// [`DuneError::GridSize`] when a grid does not fit, [`DuneError::Height`] when a height is too large,
    /// [`DuneError::Plants`] when plants grow in one of state and field only.
    pub fn set_state(&mut self, state: DuneState) -> Result<(), DuneError> {
        self.check_heights("a height", &state.heights)?;
        self.check_heights("the bedrock", &state.bedrock)?;
        self.check_heights("a mean height", &state.means)?;
        match (&mut self.plants, state.plants) {
            (None, None) => {}
            (Some(plants), Some(state)) => {
                self.lattice.check_grid("the cover by plants", state.cover.len())?;
                self.lattice.check_grid("the plants' heights", state.heights_then.len())?;
                plants.cover = state.cover;
                plants.heights_then = state.heights_then;
            }
            (plants, _) => return Err(DuneError::Plants { in_field: plants.is_some() }),
        }
        self.step = state.step;
        self.heights = state.heights;
        self.bedrock = state.bedrock;
        self.means = state.means;
        self.ledger = state.ledger;
        Ok(())
    }

    /// Hash of a state, as the field's own would be at it.
    pub(crate) fn hash_of(&self, state: &DuneState) -> u64 {
        StateHash::new(self.lattice, state.step).with_grid(&state.heights).with_grid(&state.bedrock).finish()
    }

    fn check_heights(&self, what: &'static str, heights: &[i32]) -> Result<(), DuneError> {
        self.lattice.check_grid(what, heights.len())?;
        let limit = (MAX_HEIGHT_CELLS * DUNE_QUANTA_PER_CELL).unsigned_abs();
        let Some(index) = heights.iter().position(|height| height.unsigned_abs() > limit) else { return Ok(()) };
        let [x, y] = self.lattice.position(index);
        let value = f64::from(heights[index]) / f64::from(DUNE_QUANTA_PER_CELL);
        Err(DuneError::Height { what, x, y, value, limit: f64::from(MAX_HEIGHT_CELLS) })
    }
}

#[cfg(test)]
mod tests {
    use super::super::{DuneParams, VegetationParams};
    use super::*;
    use crate::simulation::SandSimulation as _;

    fn planted() -> DuneField {
        let mut field = DuneField::with_size(&DuneParams::default(), [64, 32]).unwrap();
        field.set_vegetation(&VegetationParams { enabled: true, ..VegetationParams::default() }).unwrap();
        field
    }

    #[test]
    fn a_field_goes_on_from_a_state_as_if_it_had_never_stopped() {
        let mut first = planted();
        first.run(21);
        let mut second = planted();
        second.set_state(first.state()).unwrap();
        for field in [&mut first, &mut second] {
            field.run(30);
        }
        assert_eq!(first.state(), second.state(), "21 steps here, 30 there");
        assert_eq!(first.state_hash(), second.state_hash(), "hashes too");
    }

    #[test]
    fn states_that_do_not_fit_are_refused_and_change_nothing() {
        let mut field = planted();
        let good = field.state();
        let refused = |field: &mut DuneField, state: DuneState| field.set_state(state).unwrap_err().to_string();
        let short = DuneState { heights: vec![0; 7], ..good.clone() };
        assert_eq!(
            refused(&mut field, short),
            "a height has 7 cells; the bed of 64 x 32 cells needs 2048",
            "names size and need"
        );
        let mut high = good.clone();
        high.bedrock[65] = i32::MIN;
        assert_eq!(
            refused(&mut field, high),
            "the bedrock at cell (1, 1) is -8388608 cells; -8192 to 8192 is allowed",
            "names cell, value, range"
        );
        let bare = DuneState { plants: None, ..good.clone() };
        assert_eq!(
            refused(&mut field, bare),
            "plants grow in the field but not in the state; set the same vegetation first",
            "says what to do"
        );
        assert_eq!(field.state(), good, "nothing has changed");
    }
}

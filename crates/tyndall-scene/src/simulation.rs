//! What of a scene goes on in steps, behind one interface: its state is taken out as named arrays and put back, and programs that
//! only make steps need not know what they simulate.
//!
//! Clouds by the automaton and sand so far; smoke takes the same way.

mod clouds;
mod desert;
mod kind;

use tyndall_clouds::CloudSimulation;
use tyndall_core::array::NamedArrays;
use tyndall_dunes::{DesertInputs, DesertSimulation};

use crate::{Scene, SceneError};
use clouds::CloudRun;
use desert::DesertRun;
pub use kind::SimulationKind;

/// A simulation of a scene. The same scene and the same start give the same bits on any number of threads.
pub trait SceneSimulation: std::fmt::Debug + Send {
    /// What is simulated, as in sentences.
    fn name(&self) -> &'static str;

    /// Steps made since the very beginning.
    fn step_count(&self) -> u32;

    /// Makes a step.
    fn step(&mut self);

    /// Steps from where it began to the moment that a picture of the scene shows.
    fn steps_to_picture(&self) -> u32;

    /// Hash of the cells: equal ones, equal states.
    fn hash(&self) -> u64;

    /// Everything that steps change.
    fn state(&self) -> NamedArrays;

    /// The state in a few words.
    fn summary(&self) -> String;
}

impl Scene {
    /// A simulation of a scene before its first step, or at a state in place of the warm-up. `inputs` is what the desert takes
    /// from files.
    ///
    /// # Errors
    /// [`SceneError::NothingMoves`] when the scene has none of this kind; [`SceneError::Clouds`] and [`SceneError::Sand`] when
    /// the parameters do not fit together, or the state is damaged or that of another grid.
    pub fn simulation(
        &self,
        kind: SimulationKind,
        inputs: &DesertInputs,
        state: Option<&NamedArrays>,
    ) -> Result<Box<dyn SceneSimulation>, SceneError> {
        match (kind, self.cloud_params(), self.dune_params()) {
            (SimulationKind::Clouds, Some(params), _) => {
                Ok(Box::new(CloudRun::new(&params, self.clouds.time_s, state)?))
            }
            (SimulationKind::Desert, _, Some(params)) => {
                Ok(Box::new(DesertRun::new(&params, inputs, self.desert.steps, state)?))
            }
            _ => Err(SceneError::NothingMoves),
        }
    }

    /// Whether the scene goes on from a state of this kind as the one would have that the state comes from.
    ///
    /// # Errors
    /// [`SceneError::NothingMoves`] when the scene has no such simulation; [`SceneError::Clouds`] and [`SceneError::Sand`] when
    /// the state does not say.
    pub fn continues(&self, kind: SimulationKind, state: &NamedArrays) -> Result<bool, SceneError> {
        match (kind, self.cloud_params(), self.dune_params()) {
            (SimulationKind::Clouds, Some(params), _) => Ok(CloudSimulation::continues(&params, state)?),
            (SimulationKind::Desert, _, Some(params)) => Ok(DesertSimulation::continues(&params, state)?),
            _ => Err(SceneError::NothingMoves),
        }
    }
}

//! The field of dunes of a scene.

use tyndall_core::array::NamedArrays;
use tyndall_dunes::{DesertInputs, DesertParams, DesertSimulation};

use super::SceneSimulation;
use crate::SceneError;

/// Sand under the wind.
#[derive(Debug)]
pub(super) struct DesertRun {
    simulation: DesertSimulation,
    steps_to_picture: u32,
}

impl DesertRun {
    /// The picture shows the field after `steps`, and a state that is further as it is.
    pub(super) fn new(
        params: &DesertParams,
        inputs: &DesertInputs,
        steps: u32,
        state: Option<&NamedArrays>,
    ) -> Result<Self, SceneError> {
        let simulation = match state {
            None => {
                let mut simulation = DesertSimulation::cold(params, inputs)?;
                // From the first step on it is known when each cell moved; a state without that cannot tell any more.
                simulation.keep_ages();
                simulation
            }
            Some(state) => DesertSimulation::from_state(params, inputs, state)?,
        };
        let steps_to_picture = steps.saturating_sub(simulation.step_count());
        Ok(Self { simulation, steps_to_picture })
    }
}

impl SceneSimulation for DesertRun {
    fn name(&self) -> &'static str {
        "desert"
    }

    fn step_count(&self) -> u32 {
        self.simulation.step_count()
    }

    fn step(&mut self) {
        self.simulation.advance(1);
    }

    fn steps_to_picture(&self) -> u32 {
        self.steps_to_picture
    }

    fn hash(&self) -> u64 {
        self.simulation.hash()
    }

    fn state(&self) -> NamedArrays {
        self.simulation.state()
    }

    fn summary(&self) -> String {
        self.simulation.summary()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{DesertKind, Scene, Side, SimulationKind};

    fn sandy() -> Scene {
        let mut scene = Scene::default();
        scene.desert.kind = DesertKind::Dunes;
        (scene.dunes.side, scene.desert.steps) = (Side::Cells64, 30);
        scene
    }

    fn simulation(scene: &Scene, state: Option<&NamedArrays>) -> Box<dyn SceneSimulation> {
        scene.simulation(SimulationKind::Desert, &DesertInputs::default(), state).unwrap()
    }

    #[test]
    fn a_desert_goes_on_from_a_state_as_if_it_had_never_stopped() {
        let scene = sandy();
        let mut whole = simulation(&scene, None);
        assert_eq!(whole.steps_to_picture(), 30, "from the beginning");
        (0..9).for_each(|_| whole.step());
        let mut rest = simulation(&scene, Some(&whole.state()));
        assert_eq!((rest.step_count(), rest.steps_to_picture()), (9, 21), "from the state");
        assert!(scene.continues(SimulationKind::Desert, &whole.state()).unwrap(), "the same parameters");
        for simulation in [&mut whole, &mut rest] {
            (0..30).for_each(|_| simulation.step());
        }
        assert_eq!((whole.state(), whole.hash()), (rest.state(), rest.hash()), "all arrays");
        assert_eq!(simulation(&scene, Some(&rest.state())).steps_to_picture(), 0, "further than the picture");
        assert!(whole.summary().starts_with("64 x 64 cells of 1 m, "), "{}", whole.summary());
    }
}

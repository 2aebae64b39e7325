//! The clouds of a scene.

use tyndall_clouds::{CloudParams, CloudSimulation};
use tyndall_core::array::NamedArrays;

use super::SceneSimulation;
use crate::SceneError;

/// Clouds by the automaton.
#[derive(Debug)]
pub(super) struct CloudRun {
    simulation: CloudSimulation,
    steps_to_picture: u32,
}

impl CloudRun {
    pub(super) fn new(params: &CloudParams, time_s: f64, state: Option<&NamedArrays>) -> Result<Self, SceneError> {
        let (steps, _) = params.moment(time_s);
        Ok(match state {
            None => {
                Self { simulation: CloudSimulation::cold(params)?, steps_to_picture: params.grid.warm_up_steps + steps }
            }
            Some(state) => Self { simulation: CloudSimulation::from_state(params, state)?, steps_to_picture: steps },
        })
    }
}

impl SceneSimulation for CloudRun {
    fn name(&self) -> &'static str {
        "clouds"
    }

    fn step_count(&self) -> u32 {
        self.simulation.automaton().step_count()
    }

    fn step(&mut self) {
        self.simulation.advance(1);
    }

    fn steps_to_picture(&self) -> u32 {
        self.steps_to_picture
    }

    fn hash(&self) -> u64 {
        self.simulation.automaton().fields().hash()
    }

    fn state(&self) -> NamedArrays {
        self.simulation.state()
    }

    fn summary(&self) -> String {
        let statistics = self.simulation.statistics();
        let [nx, ny, nz] = self.simulation.automaton().size();
        format!("{nx} x {ny} x {nz} cells, {:.1} % of the sky covered", 100.0 * statistics.cover)
    }
}

#[cfg(test)]
mod tests {
    use tyndall_dunes::DesertInputs;

    use super::*;
    use crate::{CloudKind, Scene, SimulationKind};

    fn cloudy() -> Scene {
        let mut scene = Scene::default();
        scene.clouds.kind = CloudKind::Automaton;
        (scene.cloud_grid.cells_east, scene.cloud_grid.cells_north, scene.cloud_grid.warm_up_steps) = (40, 33, 12);
        scene
    }

    fn simulation(scene: &Scene, state: Option<&NamedArrays>) -> Result<Box<dyn SceneSimulation>, SceneError> {
        scene.simulation(SimulationKind::Clouds, &DesertInputs::default(), state)
    }

    fn run(simulation: &mut dyn SceneSimulation, steps: u32) {
        (0..steps).for_each(|_| simulation.step());
    }

    #[test]
    fn a_scene_goes_on_from_a_state_as_if_it_had_never_stopped() {
        let scene = cloudy();
        let mut whole = simulation(&scene, None).unwrap();
        run(whole.as_mut(), 9);
        let mut rest = simulation(&scene, Some(&whole.state())).unwrap();
        assert!(
            scene.continues(SimulationKind::Clouds, &whole.state()).unwrap() && rest.step_count() == 9,
            "from the same parameters: {rest:?}"
        );
        for simulation in [&mut whole, &mut rest] {
            run(simulation.as_mut(), 8);
        }
        assert_eq!(whole.state(), rest.state(), "all arrays");
        assert_eq!((whole.hash(), whole.step_count()), (rest.hash(), 17), "hash and step");
    }

    #[test]
    fn the_picture_shows_the_time_after_the_warm_up_or_after_the_state_that_takes_its_place() {
        let mut scene = cloudy();
        assert_eq!(simulation(&scene, None).unwrap().steps_to_picture(), 12, "the end of the warm-up");
        scene.clouds.time_s = 2.5 * scene.cloud_grid.step_s;
        let begun = simulation(&scene, None).unwrap();
        assert_eq!(begun.steps_to_picture(), 15, "the step that ends next");
        assert_eq!(simulation(&scene, Some(&begun.state())).unwrap().steps_to_picture(), 3, "no warm-up");
    }

    #[test]
    fn a_scene_without_anything_that_moves_and_states_of_other_grids_are_refused() {
        let text = simulation(&Scene::default(), None).unwrap_err().to_string();
        assert!(text.contains("`clouds.kind`"), "{text}");
        let (scene, mut wide) = (cloudy(), cloudy());
        wide.cloud_grid.cells_east = 41;
        let state = simulation(&scene, None).unwrap().state();
        let text = simulation(&wide, Some(&state)).unwrap_err().to_string();
        assert_eq!(text, "array `cells` has [40, 33, 32] cells; the grid has [41, 33, 32]");
        let mut windy = cloudy();
        windy.cloud_wind.ceiling_speed_m_s += 1.0;
        assert!(!windy.continues(SimulationKind::Clouds, &state).unwrap(), "another wind from here on");
        assert!(simulation(&windy, Some(&state)).is_ok(), "which is allowed");
    }
}

//! What of a scene goes on in steps, behind one interface: its state is taken out as named arrays and put back, and programs that
//! only make steps need not know what they simulate.
//!
//! Clouds by the automaton so far; sand and smoke take the same way.

use tyndall_clouds::{CloudParams, CloudSimulation};
use tyndall_core::array::NamedArrays;

use crate::{CloudKind, Scene, SceneError};

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
    /// The simulation of a scene before its first step, or at a state in place of the warm-up.
    ///
    /// # Errors
    /// [`SceneError::NothingMoves`] when the scene has none; [`SceneError::Clouds`] when the parameters do not fit together, or
    /// the state is damaged or that of another grid.
    pub fn simulation(&self, state: Option<&NamedArrays>) -> Result<Box<dyn SceneSimulation>, SceneError> {
        match (self.clouds.kind, self.cloud_params()) {
            (CloudKind::Automaton, Some(params)) => Ok(Box::new(CloudRun::new(&params, self.clouds.time_s, state)?)),
            _ => Err(SceneError::NothingMoves),
        }
    }

    /// Whether the scene goes on from a state as the one would have that the state comes from.
    ///
    /// # Errors
    /// [`SceneError::NothingMoves`] when the scene has no simulation; [`SceneError::Clouds`] when the state does not say.
    pub fn continues(&self, state: &NamedArrays) -> Result<bool, SceneError> {
        match (self.clouds.kind, self.cloud_params()) {
            (CloudKind::Automaton, Some(params)) => Ok(CloudSimulation::continues(&params, state)?),
            _ => Err(SceneError::NothingMoves),
        }
    }
}

/// Clouds by the automaton.
#[derive(Debug)]
struct CloudRun {
    simulation: CloudSimulation,
    steps_to_picture: u32,
}

impl CloudRun {
    fn new(params: &CloudParams, time_s: f64, state: Option<&NamedArrays>) -> Result<Self, SceneError> {
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
    use super::*;

    fn cloudy() -> Scene {
        let mut scene = Scene::default();
        scene.clouds.kind = CloudKind::Automaton;
        (scene.cloud_grid.cells_east, scene.cloud_grid.cells_north, scene.cloud_grid.warm_up_steps) = (40, 33, 12);
        scene
    }

    fn run(simulation: &mut dyn SceneSimulation, steps: u32) {
        (0..steps).for_each(|_| simulation.step());
    }

    #[test]
    fn a_scene_goes_on_from_a_state_as_if_it_had_never_stopped() {
        let scene = cloudy();
        let mut whole = scene.simulation(None).unwrap();
        run(whole.as_mut(), 9);
        let mut rest = scene.simulation(Some(&whole.state())).unwrap();
        assert!(
            scene.continues(&whole.state()).unwrap() && rest.step_count() == 9,
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
        assert_eq!(scene.simulation(None).unwrap().steps_to_picture(), 12, "the end of the warm-up");
        scene.clouds.time_s = 2.5 * scene.cloud_grid.step_s;
        let simulation = scene.simulation(None).unwrap();
        assert_eq!(simulation.steps_to_picture(), 15, "the step that ends next");
        assert_eq!(scene.simulation(Some(&simulation.state())).unwrap().steps_to_picture(), 3, "no warm-up");
    }

    #[test]
    fn a_scene_without_anything_that_moves_and_states_of_other_grids_are_refused() {
        let text = Scene::default().simulation(None).unwrap_err().to_string();
        assert!(text.contains("`clouds.kind`"), "{text}");
        let (scene, mut wide) = (cloudy(), cloudy());
        wide.cloud_grid.cells_east = 41;
        let state = scene.simulation(None).unwrap().state();
        let text = wide.simulation(Some(&state)).unwrap_err().to_string();
        assert_eq!(text, "array `cells` has [40, 33, 32] cells; the grid has [41, 33, 32]");
        let mut windy = cloudy();
        windy.cloud_wind.ceiling_speed_m_s += 1.0;
        assert!(!windy.continues(&state).unwrap(), "another wind from here on");
        assert!(windy.simulation(Some(&state)).is_ok(), "which is allowed");
    }
}

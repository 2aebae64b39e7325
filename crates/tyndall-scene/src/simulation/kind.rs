//! Which of a scene's simulations is meant.

use tyndall_core::array::NamedArrays;
use tyndall_core::choices;

use crate::{Scene, SceneError};

choices! {
    /// What of a scene goes on in steps.
    pub enum SimulationKind {
        /// The clouds' automaton.
        Clouds = "clouds",
        /// The field of dunes.
        Desert = "desert",
    }
}

impl SimulationKind {
    /// What a state is one of; `None` when it is none at all.
    #[must_use]
    pub fn of_state(state: &NamedArrays) -> Option<Self> {
        let has = |wanted: &str| state.iter().any(|(name, _)| name == wanted);
        [(Self::Clouds, "cells"), (Self::Desert, "height")]
            .into_iter()
            .find(|(_, name)| has(name))
            .map(|(kind, _)| kind)
    }
}

impl Scene {
    /// What of the scene goes on in steps.
    #[must_use]
    pub fn simulations(&self) -> Vec<SimulationKind> {
        let clouds = self.cloud_params().map(|_| SimulationKind::Clouds);
        clouds.into_iter().chain(self.dune_params().map(|_| SimulationKind::Desert)).collect()
    }

    /// The simulation that is meant: the one that is named, the one that the state belongs to, or the only one.
    ///
    /// # Errors
    /// [`SceneError::NothingMoves`] when the scene has none, [`SceneError::NotSimulated`] when it does not have that one,
    /// [`SceneError::StateOfOther`] when the state is of another, [`SceneError::SeveralMove`] when there is a choice.
    pub fn simulated(
        &self,
        named: Option<SimulationKind>,
        state: Option<&NamedArrays>,
    ) -> Result<SimulationKind, SceneError> {
        let present = self.simulations();
        let from_state = state.and_then(SimulationKind::of_state);
        match (named.or(from_state), &present[..]) {
            (_, []) => Err(SceneError::NothingMoves),
            (Some(kind), _) if !present.contains(&kind) && named.is_none() => {
                Err(SceneError::StateOfOther { state: kind.name(), scene: present[0].name() })
            }
            (Some(kind), _) if !present.contains(&kind) => {
                Err(SceneError::NotSimulated { named: kind.name(), present: present[0].name() })
            }
            (Some(kind), _) => match from_state {
                Some(state) if state != kind => {
                    Err(SceneError::StateOfOther { state: state.name(), scene: kind.name() })
                }
                _ => Ok(kind),
            },
            (None, [kind]) => Ok(*kind),
            (None, _) => Err(SceneError::SeveralMove),
        }
    }
}

#[cfg(test)]
mod tests {
    use tyndall_core::array::{Array, ArrayData};

    use super::*;

    fn scene(kinds: &[SimulationKind]) -> Scene {
        let mut scene = Scene::default();
        for kind in kinds {
            match kind {
                SimulationKind::Clouds => scene.set_text("clouds.kind", "automaton").unwrap(),
                SimulationKind::Desert => scene.set_text("desert.kind", "dunes").unwrap(),
            }
        }
        scene
    }

    fn state(name: &str) -> NamedArrays {
        vec![(name.to_owned(), Array::new(vec![], ArrayData::U8(vec![0])).unwrap())]
    }

    #[test]
    fn the_only_simulation_is_meant_and_of_two_the_named_one_or_that_of_the_state() {
        let (sky, sand) = (scene(&[SimulationKind::Clouds]), scene(&[SimulationKind::Desert]));
        let both = scene(SimulationKind::ALL);
        assert_eq!(sky.simulated(None, None).unwrap(), SimulationKind::Clouds, "clouds alone");
        assert_eq!(sand.simulated(None, None).unwrap(), SimulationKind::Desert, "sand alone");
        let named = both.simulated(Some(SimulationKind::Desert), None).unwrap();
        assert_eq!(named, SimulationKind::Desert, "the one that is named");
        for (array, kind) in [("cells", SimulationKind::Clouds), ("height", SimulationKind::Desert)] {
            assert_eq!(both.simulated(None, Some(&state(array))).unwrap(), kind, "a state with `{array}`");
        }
    }

    #[test]
    fn what_is_not_there_or_not_clear_is_refused_with_what_to_do() {
        let refused = |scene: &Scene, named, state: Option<&str>| {
            scene.simulated(named, state.map(self::state).as_ref()).unwrap_err().to_string()
        };
        assert!(refused(&scene(&[]), None, None).contains("nothing in the scene"), "nothing");
        assert!(refused(&scene(SimulationKind::ALL), None, None).contains("clouds or desert"), "two");
        let text = refused(&scene(&[SimulationKind::Clouds]), Some(SimulationKind::Desert), None);
        assert!(text.contains("no desert") && text.contains("clouds"), "{text}");
        let text = refused(&scene(&[SimulationKind::Clouds]), None, Some("height"));
        assert!(text.contains("state is one of desert"), "{text}");
        let text = refused(&scene(SimulationKind::ALL), Some(SimulationKind::Clouds), Some("height"));
        assert!(text.contains("desert") && text.contains("clouds"), "{text}");
    }
}

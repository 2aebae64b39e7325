//! Where the clouds of a scene come from, and what they consist of at a moment.

use std::sync::Arc;

use tyndall_clouds::{CloudMatter, CloudParams, CloudSimulation, state_step};
use tyndall_core::array::NamedArrays;
use tyndall_scene::Scene;

use crate::RenderError;

/// What the matter of clouds follows from.
#[derive(Clone, Debug, PartialEq)]
pub struct CloudSourceRequest {
    /// The simulation.
    pub params: CloudParams,
    /// Time since the end of the warm-up (s).
    pub time_s: f64,
}

impl CloudSourceRequest {
    /// Of a scene; `None` without clouds.
    #[must_use]
    pub fn of(scene: &Scene) -> Option<Self> {
        scene.cloud_params().map(|params| Self { params, time_s: scene.clouds.time_s })
    }
}

/// Makes the clouds' matter, and keeps it until something else is asked for.
#[derive(Debug, Default)]
pub struct CloudSource {
    start: Option<NamedArrays>,
    simulation: Option<CloudSimulation>,
    last: Option<(CloudSourceRequest, Arc<CloudMatter>)>,
}

impl CloudSource {
    /// Chooses a state from which the automaton starts, in place of its beginning and its warm-up: times count from there.
    pub fn start_from(&mut self, state: Option<NamedArrays>) {
        *self = Self { start: state, ..Self::default() };
    }

    /// The matter that was asked for: the same `Arc` as last time when nothing has changed.
    ///
    /// # Errors
    /// When the parameters of the clouds do not fit together.
    pub fn matter(&mut self, request: &CloudSourceRequest) -> Result<Arc<CloudMatter>, RenderError> {
        if let Some((_, matter)) = self.last.as_ref().filter(|(last, _)| last == request) {
            return Ok(Arc::clone(matter));
        }
        let matter = Arc::new(self.simulate(request)?);
        self.last = Some((request.clone(), Arc::clone(&matter)));
        Ok(matter)
    }

    /// The automaton's clouds; it goes on from where it stands when that is not too far.
    fn simulate(&mut self, request: &CloudSourceRequest) -> Result<CloudMatter, RenderError> {
        let CloudSourceRequest { params, time_s } = request;
        let earlier = self.simulation.take().filter(|known| known.params() == params);
        let (steps, fraction) = params.moment(*time_s);
        let first = self.start.as_ref().map_or(Ok(params.grid.warm_up_steps), state_step)?;
        let wanted = first.saturating_add(steps);
        let mut simulation = match (earlier.filter(|known| known.automaton().step_count() <= wanted), &self.start) {
            (Some(known), _) => known,
            (None, Some(state)) => CloudSimulation::from_state(params, state)?,
            (None, None) => CloudSimulation::new(params)?,
        };
        simulation.advance(wanted - simulation.automaton().step_count());
        let matter = CloudMatter::of_simulation(&mut simulation, fraction)?;
        self.simulation = Some(simulation);
        Ok(matter)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_request_gets_the_same_matter_and_another_moment_another() {
        let mut params = CloudParams::default();
        (params.grid.cells_east, params.grid.cells_north, params.grid.cells_up) = (32, 32, 12);
        params.grid.warm_up_steps = 12;
        let mut request = CloudSourceRequest { params, time_s: 0.0 };
        let mut source = CloudSource::default();
        let first = source.matter(&request).unwrap();
        assert!(Arc::ptr_eq(&first, &source.matter(&request).unwrap()), "nothing is computed twice");
        request.time_s = 30.0;
        let later = source.matter(&request).unwrap();
        assert_ne!(first.extinction_per_m, later.extinction_per_m, "a step and a half later");
        request.time_s = 0.0;
        assert_eq!(first, source.matter(&request).unwrap(), "and back again");
    }

    #[test]
    fn a_state_takes_the_place_of_the_warm_up_and_times_count_from_it() {
        let mut params = CloudParams::default();
        (params.grid.cells_east, params.grid.cells_north, params.grid.cells_up) = (32, 32, 12);
        params.grid.warm_up_steps = 12;
        let later = CloudSourceRequest { params: params.clone(), time_s: 50.0 };
        let expected = CloudSource::default().matter(&later).unwrap();
        let mut half_way = CloudSimulation::new(&params).unwrap();
        half_way.advance(1);
        let mut source = CloudSource::default();
        source.start_from(Some(half_way.state()));
        let rest = CloudSourceRequest { time_s: 30.0, ..later };
        assert_eq!(source.matter(&rest).unwrap(), expected, "a step of 20 s and 30 s are 50 s");
    }
}

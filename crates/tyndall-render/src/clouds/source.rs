//! Where the clouds of a scene come from, and what they consist of at a moment.

use std::sync::Arc;

use tyndall_clouds::{CloudMatter, CloudParams, CloudSimulation};
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
    simulation: Option<CloudSimulation>,
    last: Option<(CloudSourceRequest, Arc<CloudMatter>)>,
}

impl CloudSource {
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
        let (steps, fraction) = moment(time_s / params.grid.step_s);
        let wanted = params.grid.warm_up_steps + steps;
        let mut simulation = match earlier.filter(|known| known.automaton().step_count() <= wanted) {
            Some(known) => known,
            None => CloudSimulation::new(params)?,
        };
        simulation.advance(wanted - simulation.automaton().step_count());
        let matter = CloudMatter::of_simulation(&mut simulation, fraction)?;
        self.simulation = Some(simulation);
        Ok(matter)
    }
}

/// Whole steps and the share of the next, of which the simulation shows the time between its last two: the share 1 is the
/// last step itself.
#[expect(clippy::cast_possible_truncation, reason = "times and steps have small ranges")]
fn moment(steps: f64) -> (u32, f32) {
    let last = steps.ceil();
    (last as u32, (1.0 - (last - steps)) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_are_shares_of_the_step_that_ends_next() {
        assert_eq!(moment(0.0), (0, 1.0), "the end of the warm-up");
        assert_eq!(moment(3.0), (3, 1.0), "a whole step");
        assert_eq!(moment(2.25), (3, 0.25), "a quarter of the third");
    }

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
}

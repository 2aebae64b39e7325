//! Where the clouds of a scene come from, and what they consist of at a moment.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::{Duration, Instant};

use tyndall_clouds::statistics::cover;
use tyndall_clouds::{CloudMatter, CloudParams, CloudSimulation, state_step};
use tyndall_core::array::NamedArrays;
use tyndall_scene::{CloudKind, Scene};

use super::file::CloudFileRequest;
use crate::RenderError;

/// Steps whose cover is kept.
const KEPT_STEPS: usize = 2000;

/// What the matter of clouds follows from.
#[derive(Clone, Debug, PartialEq)]
pub enum CloudSourceRequest {
    /// The automaton.
    Automaton {
        /// The simulation.
        params: Box<CloudParams>,
        /// Time since the end of the warm-up (s).
        time_s: f64,
    },
    /// A file.
    File(Box<CloudFileRequest>),
}

impl CloudSourceRequest {
    /// Of a scene; `None` without clouds.
    #[must_use]
    pub fn of(scene: &Scene) -> Option<Self> {
        match scene.clouds.kind {
            CloudKind::None => None,
            CloudKind::Automaton => {
                let params = Box::new(scene.cloud_params()?);
                Some(Self::Automaton { params, time_s: scene.clouds.time_s })
            }
            CloudKind::File => Some(Self::File(Box::new(CloudFileRequest::of(scene)))),
        }
    }
}

/// Makes the clouds' matter, and keeps it until something else is asked for.
#[derive(Debug, Default)]
pub struct CloudSource {
    start: Option<NamedArrays>,
    simulation: Option<CloudSimulation>,
    step_time: Option<Duration>,
    cover: VecDeque<(f64, f64)>,
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
    /// When the parameters of the clouds do not fit together, or their file cannot be read.
    pub fn matter(&mut self, request: &CloudSourceRequest) -> Result<Arc<CloudMatter>, RenderError> {
        loop {
            if let Some(matter) = self.matter_unless(request, &|| false)? {
                return Ok(matter);
            }
        }
    }

    /// [`CloudSource::matter`], or `None` when `is_stale`, which is asked between steps, says that nobody waits for it any
    /// longer; what has been simulated so far is kept.
    ///
    /// # Errors
    /// As for [`CloudSource::matter`].
    pub fn matter_unless(
        &mut self,
        request: &CloudSourceRequest,
        is_stale: &dyn Fn() -> bool,
    ) -> Result<Option<Arc<CloudMatter>>, RenderError> {
        if let Some((_, matter)) = self.last.as_ref().filter(|(last, _)| last == request) {
            return Ok(Some(Arc::clone(matter)));
        }
        let matter = match request {
            CloudSourceRequest::Automaton { params, time_s } => self.simulate(params, *time_s, is_stale)?,
            CloudSourceRequest::File(file) => {
                self.simulation = None;
                Some(file.read()?)
            }
        };
        let matter = matter.map(Arc::new);
        self.last = matter.clone().map(|matter| (request.clone(), matter));
        Ok(matter)
    }

    /// The simulation that the last matter comes from; `None` when it comes from something else.
    #[must_use]
    pub fn simulation(&self) -> Option<&CloudSimulation> {
        self.simulation.as_ref()
    }

    /// How long a step took, on average over the last ones that were made.
    #[must_use]
    pub fn step_time(&self) -> Option<Duration> {
        self.step_time
    }

    /// Time since the end of the warm-up (s) and share of the sky with cloud for each of the last steps.
    #[must_use]
    pub fn cover_history(&self) -> &VecDeque<(f64, f64)> {
        &self.cover
    }

    /// The automaton's clouds; it goes on from where it stands when that is not too far.
    fn simulate(
        &mut self,
        params: &CloudParams,
        time_s: f64,
        is_stale: &dyn Fn() -> bool,
    ) -> Result<Option<CloudMatter>, RenderError> {
        let earlier = self.simulation.take().filter(|known| known.params() == params);
        let (steps, fraction) = params.moment(time_s);
        let first = self.start.as_ref().map_or(Ok(params.grid.warm_up_steps), state_step)?;
        let wanted = first.saturating_add(steps);
        let mut simulation = match (earlier.filter(|known| known.automaton().step_count() <= wanted), &self.start) {
            (Some(known), _) => known,
            (None, start) => {
                self.cover.clear();
                match start {
                    Some(state) => CloudSimulation::from_state(params, state)?,
                    None => CloudSimulation::cold(params)?,
                }
            }
        };
        let is_done = self.advance(&mut simulation, wanted, is_stale);
        let matter = is_done.then(|| CloudMatter::of_simulation(&mut simulation, fraction)).transpose()?;
        self.simulation = Some(simulation);
        Ok(matter)
    }

    /// Makes steps up to a number of them; whether it came so far.
    fn advance(&mut self, simulation: &mut CloudSimulation, wanted: u32, is_stale: &dyn Fn() -> bool) -> bool {
        let (started, first) = (Instant::now(), simulation.automaton().step_count());
        while simulation.automaton().step_count() < wanted && !is_stale() {
            simulation.advance(1);
            if self.cover.len() == KEPT_STEPS {
                self.cover.pop_front();
            }
            self.cover.push_back((simulation.time_s(), cover(&simulation.automaton().fields().cld)));
        }
        let last = simulation.automaton().step_count();
        if last > first {
            self.step_time = Some(started.elapsed() / (last - first));
        }
        last == wanted
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
        let at = |time_s| CloudSourceRequest::Automaton { params: Box::new(params.clone()), time_s };
        let mut source = CloudSource::default();
        let first = source.matter(&at(0.0)).unwrap();
        assert!(Arc::ptr_eq(&first, &source.matter(&at(0.0)).unwrap()), "nothing is computed twice");
        let later = source.matter(&at(30.0)).unwrap();
        assert_ne!(first.extinction_per_m, later.extinction_per_m, "a step and a half later");
        assert_eq!(first, source.matter(&at(0.0)).unwrap(), "and back again");
    }

    #[test]
    fn a_state_takes_the_place_of_the_warm_up_and_times_count_from_it() {
        let mut params = CloudParams::default();
        (params.grid.cells_east, params.grid.cells_north, params.grid.cells_up) = (32, 32, 12);
        params.grid.warm_up_steps = 12;
        let at = |time_s| CloudSourceRequest::Automaton { params: Box::new(params.clone()), time_s };
        let later = at(50.0);
        let expected = CloudSource::default().matter(&later).unwrap();
        let mut half_way = CloudSimulation::new(&params).unwrap();
        half_way.advance(1);
        let mut source = CloudSource::default();
        source.start_from(Some(half_way.state()));
        let rest = at(30.0);
        assert_eq!(source.matter(&rest).unwrap(), expected, "a step of 20 s and 30 s are 50 s");
    }
}

//! Makes beds and tiles of ripples, with as much as possible of what was made for the last one; uses no GPU.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use tyndall_core::array::NamedArrays;
use tyndall_core::table_store::TableStore;
use tyndall_dunes::{DesertInputs, DesertParams, DesertSimulation, DesertSource, DuneStepper};
use tyndall_scene::{DesertSceneParams, RippleParams, Scene};

use super::bed::Bed;
use super::kept;
use super::report::{DesertReport, DesertTimes};
use super::ripple_tile::RippleTile;
use crate::RenderError;
use crate::desert_inputs::desert_inputs;

/// What bed and ripples follow from.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct BedRequest {
    params: DesertParams,
    desert: DesertSceneParams,
    folder: PathBuf,
    ripples: RippleParams,
    /// Whether another bed soon follows, so that this one may be a little less exact.
    is_quick: bool,
}

impl BedRequest {
    /// Of a scene; `None` without a desert. Of quick ones only the sand is exact; see [`Bed::quick`].
    pub(super) fn of(scene: &Scene, is_quick: bool) -> Option<Self> {
        let (desert, ripples) = (scene.desert.clone(), scene.ripples.clone());
        let folder = scene.folder.to_path_buf();
        scene.dune_params().map(|params| Self { params, desert, folder, ripples, is_quick })
    }

    /// Steps of the field.
    pub(super) fn steps(&self) -> u32 {
        self.desert.steps
    }

    /// A scene with the same files.
    fn scene(&self) -> Scene {
        let DesertParams { dunes, classic, wind, plants, rock } = self.params.clone();
        Scene {
            dunes,
            dune_classic: classic,
            dune_wind: wind,
            dune_plants: plants,
            dune_rock: rock,
            desert: self.desert.clone(),
            folder: self.folder.clone().into(),
            ..Scene::default()
        }
    }

    /// The request less what files do not depend on.
    fn of_files(&self) -> Self {
        let desert = DesertSceneParams { steps: 0, ripple_steps: 0, ..self.desert.clone() };
        Self { desert, ripples: RippleParams::default(), is_quick: false, ..self.clone() }
    }
}

/// What is drawn of a desert, and its figures.
#[derive(Clone, Debug)]
pub(super) struct MadeBed {
    pub(super) bed: Arc<Bed>,
    pub(super) tile: Arc<RippleTile>,
    pub(super) report: Arc<DesertReport>,
}

/// Time from which on a field is worth keeping.
const LONG: Duration = Duration::from_secs(1);

/// Least time between two looks at slopes, crests and heaps while beds follow each other quickly.
const FIGURES_EVERY: Duration = Duration::from_millis(400);

/// Makes what requests ask for.
#[derive(Debug, Default)]
pub(super) struct BedMaker {
    store: Option<Arc<dyn TableStore>>,
    fields: DesertSource,
    /// Whether fields begin with a state, and are therefore not kept.
    has_start: bool,
    /// Time that the field has taken since its first step; `None` when it was kept.
    made_in: Option<Duration>,
    inputs: Option<(BedRequest, DesertInputs)>,
    tile: Option<(RippleParams, u32, Arc<RippleTile>)>,
    step_time: Option<Duration>,
    /// Figures that took a while, and when they were found.
    figures: Option<(Instant, Arc<DesertReport>)>,
}

impl BedMaker {
    /// Chooses where fields are kept between runs.
    pub(super) fn set_store(&mut self, store: Option<Arc<dyn TableStore>>) {
        self.store = store;
    }

    /// Chooses a state to start from in place of step 0, for all steps that are not before it.
    pub(super) fn start_from(&mut self, state: Option<NamedArrays>) {
        self.has_start = state.is_some();
        self.fields.start_from(state);
    }

    /// Chooses who makes steps; the processor unless chosen.
    pub(super) fn set_stepper(&mut self, device: Option<Box<dyn DuneStepper>>) {
        self.fields.set_stepper(device);
    }

    /// What a request asks for; `None` when `is_stale`, which is asked between steps with their number, says that nobody
    /// waits for it.
    pub(super) fn make(
        &mut self,
        request: &BedRequest,
        is_stale: &dyn Fn(u32) -> bool,
    ) -> Result<Option<MadeBed>, RenderError> {
        let inputs = self.inputs(request)?;
        if !self.fields.goes_on_to(&request.params, &inputs, request.steps()) {
            self.made_in = Some(Duration::ZERO);
            self.take_kept(request, &inputs)?;
        }
        let (started, first) = (Instant::now(), self.fields.simulation().map_or(0, DesertSimulation::step_count));
        let made = self.fields.at_unless(&request.params, &inputs, request.steps(), is_stale)?;
        let (is_done, last) = (made.is_some(), self.fields.simulation().map_or(0, DesertSimulation::step_count));
        self.made_in = self.made_in.map(|time| time + started.elapsed());
        // Going back starts anew.
        let steps = if last >= first { last - first } else { last };
        if steps > 0 {
            self.step_time = Some(started.elapsed() / steps);
        }
        if is_done {
            self.keep(request, &inputs);
        }
        if is_done { self.look(request, request.is_quick).transpose() } else { Ok(None) }
    }

    /// The field as far as it has come; `None` before there is one.
    pub(super) fn look(&mut self, request: &BedRequest, is_quick: bool) -> Option<Result<MadeBed, RenderError>> {
        let started = Instant::now();
        let tile = match self.tile(request) {
            Ok(tile) => tile,
            Err(error) => return Some(Err(error)),
        };
        let simulation = self.fields.simulation()?;
        let bed = match if is_quick { Bed::quick(simulation) } else { Bed::new(simulation) } {
            Ok(bed) => bed,
            Err(error) => return Some(Err(error)),
        };
        let times = DesertTimes { step: self.step_time, picture: Duration::ZERO };
        let stepped_by = self.fields.stepped_by().clone();
        let known = self.figures.take().filter(|(found, _)| is_quick && found.elapsed() < FIGURES_EVERY);
        let mut report = match &known {
            Some((_, known)) => DesertReport::with_figures_of(known, simulation, times),
            None => DesertReport::new(simulation, times),
        };
        (report.times.picture, report.stepped_by) = (started.elapsed(), stepped_by);
        let report = Arc::new(report);
        self.figures = Some(known.unwrap_or_else(|| (Instant::now(), Arc::clone(&report))));
        Some(Ok(MadeBed { bed: Arc::new(bed), tile, report }))
    }

    /// Starts from the field of an earlier run, if there is one.
    fn take_kept(&mut self, request: &BedRequest, inputs: &DesertInputs) -> Result<(), RenderError> {
        let (params, steps) = (&request.params, request.steps());
        let kept = self.shelf().zip(kept::key(params, inputs, steps));
        let Some((store, key)) = kept else { return Ok(()) };
        if let Some(simulation) = kept::load(store, &key, (params, inputs, steps))? {
            self.fields.take_up(simulation);
            self.made_in = None;
        }
        Ok(())
    }

    /// Where fields are kept that follow from the scene alone.
    fn shelf(&self) -> Option<&dyn TableStore> {
        self.store.as_deref().filter(|_| !self.has_start)
    }

    /// Keeps a field that took long, once.
    fn keep(&mut self, request: &BedRequest, inputs: &DesertInputs) {
        let kept = self.shelf().zip(kept::key(&request.params, inputs, request.steps()));
        if let (Some(made_in), Some((store, key)), Some(simulation)) = (self.made_in, kept, self.fields.simulation())
            && made_in >= LONG
        {
            kept::store(store, &key, simulation);
            self.made_in = None;
        }
    }

    /// What the request takes from files, which are read once.
    fn inputs(&mut self, request: &BedRequest) -> Result<DesertInputs, RenderError> {
        let key = request.of_files();
        if let Some((_, inputs)) = self.inputs.as_ref().filter(|(known, _)| *known == key) {
            return Ok(inputs.clone());
        }
        let inputs = desert_inputs(&request.scene())?;
        self.inputs = Some((key, inputs.clone()));
        Ok(inputs)
    }

    fn tile(&mut self, request: &BedRequest) -> Result<Arc<RippleTile>, RenderError> {
        let (ripples, steps) = (&request.ripples, request.desert.ripple_steps);
        if let Some((_, _, tile)) = self.tile.as_ref().filter(|(known, of, _)| known == ripples && *of == steps) {
            return Ok(Arc::clone(tile));
        }
        let tile = Arc::new(RippleTile::new(ripples, steps)?);
        self.tile = Some((ripples.clone(), steps, Arc::clone(&tile)));
        Ok(tile)
    }
}

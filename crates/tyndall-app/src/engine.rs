//! Everything of ours on the GPU: renderer, targets, timings. Made from the window's device and rebuilt from it.

use std::{
    collections::VecDeque,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    time::Instant,
};

use egui_wgpu::RenderState;
use tyndall_dunes::SteppedBy;
use tyndall_gpu::{Gpu, GpuError, PassTiming};
use tyndall_io::TableFolder;
use tyndall_render::{
    FrameTarget, RenderError, Renderer, RendererConfig,
    clouds::CloudProgress,
    desert::DesertProgress,
    sky::{TableBuilding, TableProgress, Wake},
};
use tyndall_scene::Scene;

use crate::steps_on::StepsOn;

/// Frames whose timings are kept.
pub(crate) const TIMED_FRAMES: usize = 120;

/// Why there is no picture, in words, and what can be done about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Problem {
    /// The reason.
    pub(crate) text: String,
    /// Whether the fault is the GPU's, and the renderer must be made anew.
    pub(crate) rebuild: bool,
    /// Whether the window's device is gone, which no renderer survives.
    pub(crate) lost: bool,
}

impl From<RenderError> for Problem {
    fn from(error: RenderError) -> Self {
        let lost = matches!(error, RenderError::Gpu(GpuError::DeviceLost { .. }));
        let rebuild = matches!(error, RenderError::Gpu(_) | RenderError::Configuration { .. });
        let text = match &error {
            RenderError::Scene(scene) => scene.to_string(),
            other => other.to_string(),
        };
        Self { text, rebuild, lost }
    }
}

impl From<GpuError> for Problem {
    fn from(error: GpuError) -> Self {
        RenderError::from(error).into()
    }
}

/// Timings of one frame.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FrameTimings {
    /// Each pass.
    pub(crate) passes: Vec<PassTiming>,
    /// Size of the picture.
    pub(crate) size_px: [u32; 2],
    /// View pixels along one side of a picture pixel.
    pub(crate) divisor: u32,
}

impl FrameTimings {
    /// All passes together.
    pub(crate) fn total_ms(&self) -> f64 {
        self.passes.iter().map(|pass| pass.ms).sum()
    }
}

/// A renderer on the window's device.
pub(crate) struct Engine {
    /// The device with its budget and its state.
    pub(crate) gpu: Gpu,
    renderer: Renderer,
    /// Whether a table or clouds have come that no frame has shown yet.
    news: Arc<AtomicBool>,
    /// Timings of the last frames, the oldest first.
    pub(crate) timings: VecDeque<FrameTimings>,
    /// The frame whose timings are on their way.
    timed: Option<([u32; 2], u32)>,
    /// Who made the steps of the sand shown last.
    stepped_by: Option<SteppedBy>,
    /// How long making the renderer took.
    pub(crate) start_ms: f64,
}

impl Engine {
    /// Makes a renderer that wakes the window when a table or clouds have come.
    pub(crate) fn new(state: &RenderState, ctx: &egui::Context, steps_on: StepsOn) -> Result<Self, Problem> {
        let started = Instant::now();
        let gpu = Gpu::from_parts(&state.adapter, state.device.clone(), state.queue.clone(), None);
        let mut renderer = Renderer::new(&gpu, RendererConfig::default())?;
        renderer.set_table_store(TableFolder::of_user().map(|folder| Arc::new(folder) as _));
        gpu.check()?;
        let news = Arc::new(AtomicBool::new(false));
        let (sender, ctx) = (Arc::clone(&news), ctx.clone());
        renderer.set_table_building(TableBuilding::Background(Wake::new(move || {
            sender.store(true, Ordering::Release);
            ctx.request_repaint();
        })));
        renderer.set_dune_stepper(steps_on.stepper(gpu.adapter()));
        let start_ms = started.elapsed().as_secs_f64() * 1e3;
        Ok(Self { gpu, renderer, news, timings: VecDeque::new(), timed: None, stepped_by: None, start_ms })
    }

    /// How the slow table of the sky stands.
    pub(crate) fn tables(&self) -> TableProgress {
        self.renderer.table_progress()
    }

    /// How the clouds stand.
    pub(crate) fn clouds(&self) -> &CloudProgress {
        self.renderer.cloud_progress()
    }

    /// How the desert stands.
    pub(crate) fn desert(&self) -> &DesertProgress {
        self.renderer.desert_progress()
    }

    /// Chooses who makes the steps of dunes.
    pub(crate) fn set_steps_on(&mut self, steps_on: StepsOn) {
        self.renderer.set_dune_stepper(steps_on.stepper(self.gpu.adapter()));
    }

    /// Tells once in the log when the device that was to move sand could not.
    fn tell_stepping(&mut self) {
        let by = self.renderer.desert_progress().report.as_ref().map(|report| report.stepped_by.clone());
        if let Some(SteppedBy::ProcessorInstead(reason)) = &by
            && self.stepped_by != by
        {
            tracing::warn!(reason, "the processor moves the sand, not the graphics device");
        }
        self.stepped_by = by;
    }

    /// Chooses whether pictures of sand are soon followed by others, and may be a little less exact.
    pub(crate) fn set_sand_under_way(&mut self, is_under_way: bool) {
        self.renderer.set_sand_under_way(is_under_way);
    }

    /// Whether something is being made that a later frame will show.
    pub(crate) fn is_building(&self) -> bool {
        self.tables().building || self.clouds().building || self.desert().building
    }

    /// Whether drawing the same scene again would show more.
    pub(crate) fn has_news(&self) -> bool {
        let tables = self.tables();
        let has_come = self.news.load(Ordering::Acquire) && self.is_building();
        has_come || (tables.building && tables.needs_frame)
    }

    /// A target for pictures of a size.
    pub(crate) fn target(&self, size_px: [u32; 2]) -> Result<FrameTarget, Problem> {
        Ok(FrameTarget::new(&self.gpu, size_px, RendererConfig::default())?)
    }

    /// Draws and submits; `divisor` goes into the timings.
    pub(crate) fn draw(&mut self, scene: &Scene, target: &mut FrameTarget, divisor: u32) -> Result<(), Problem> {
        self.news.store(false, Ordering::Release);
        // Recording is not waited for: the window's own frame follows in the same queue.
        let _submission = self.renderer.render(&self.gpu, scene, target)?;
        // Callbacks run while polling; without it a loss would go unnoticed.
        self.gpu.poll()?;
        self.gpu.check()?;
        self.tell_stepping();
        self.timed = self.gpu.has_timestamps().then_some((target.size_px(), divisor));
        Ok(())
    }

    /// The display picture of a target, waiting for it.
    pub(crate) fn read(&self, target: &FrameTarget) -> Result<Vec<[u8; 4]>, Problem> {
        Ok(target.read_picture8(&self.gpu)?)
    }

    /// Exposure of the last frame; waits for it.
    pub(crate) fn read_ev100(&self) -> Result<f64, Problem> {
        Ok(self.renderer.read_ev100(&self.gpu)?)
    }

    /// The loss of the device where that is what is behind a problem.
    fn blame(&self, problem: Problem) -> Problem {
        // A loss is told only once all work is off the queue.
        let waited = self.gpu.wait(self.gpu.queue.submit([]));
        waited.and_then(|()| self.gpu.check()).err().map_or(problem, Problem::from)
    }

    /// Whether timings are on their way.
    pub(crate) fn awaits_timings(&self) -> bool {
        self.timed.is_some()
    }

    /// Takes in timings that have arrived, without waiting; whether there were any.
    pub(crate) fn poll_timings(&mut self) -> Result<bool, Problem> {
        let Some((size_px, divisor)) = self.timed else { return Ok(false) };
        self.gpu.poll()?;
        let passes = self.renderer.poll_timings(&self.gpu).map_err(|error| self.blame(error.into()))?;
        let Some(passes) = passes else { return Ok(false) };
        self.timed = None;
        if self.timings.len() == TIMED_FRAMES {
            self.timings.pop_front();
        }
        self.timings.push_back(FrameTimings { passes, size_px, divisor });
        Ok(true)
    }
}

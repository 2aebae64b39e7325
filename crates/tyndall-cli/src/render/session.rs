//! A graphics device with everything that draws frames of one size and format, one after the other.

use tyndall_core::array::NamedArrays;
use tyndall_gpu::{Gpu, GpuOptions};
use tyndall_render::{FrameTarget, Renderer};
use tyndall_scene::{Scene, SimulationKind};

use super::format::OutputFormat;
use super::frame::{Frame, config, read, wait};
use super::memory::check_budget;
use crate::Failure;
use crate::cache::CacheArguments;
use crate::interrupt::Interrupt;
use crate::progress::{Progress, Stage};

/// What frames are drawn with and for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Studio<'a> {
    pub(super) size_px: [u32; 2],
    pub(super) format: OutputFormat,
    pub(super) options: &'a GpuOptions,
    pub(super) cache: CacheArguments,
    /// State that the scene's simulation starts from.
    pub(super) state: Option<&'a NamedArrays>,
    pub(super) interrupt: &'a Interrupt,
    /// Who hears of each stage; nobody where one frame is only a part of the work.
    pub(super) stages: Option<&'a Progress>,
}

/// An open device, and what was made on it.
#[derive(Debug)]
pub(super) struct Session<'a> {
    studio: Studio<'a>,
    gpu: Gpu,
    renderer: Renderer,
    target: FrameTarget,
}

impl<'a> Studio<'a> {
    /// Opens the device and makes everything that all frames share.
    pub(super) fn open(self) -> Result<Session<'a>, Failure> {
        self.stage(Stage::Device)?;
        let gpu = Gpu::open(self.options)?;
        let config = config(self.format);
        check_budget(&gpu, self.size_px, self.format, config)?;

        self.stage(Stage::Pipelines)?;
        let mut renderer = Renderer::new(&gpu, config)?;
        renderer.set_table_store(self.cache.store());
        let state = |kind| self.state.filter(|state| SimulationKind::of_state(state) == Some(kind)).cloned();
        renderer.start_clouds_from(state(SimulationKind::Clouds));
        renderer.start_desert_from(state(SimulationKind::Desert));
        let target = FrameTarget::new(&gpu, self.size_px, config)?;
        Ok(Session { studio: self, gpu, renderer, target })
    }

    fn stage(&self, stage: Stage) -> Result<(), Failure> {
        self.interrupt.check()?;
        self.stages.map_or(Ok(()), |progress| progress.stage(stage))
    }
}

impl Session<'_> {
    /// Draws a frame and fetches its pixels.
    pub(super) fn draw(&mut self, scene: &Scene) -> Result<Frame, Failure> {
        let Self { studio, gpu, renderer, target } = self;
        studio.stage(Stage::Frame)?;
        let submission = renderer.render(gpu, scene, target)?;
        wait(gpu, &submission, studio.interrupt)?;

        studio.stage(Stage::ReadBack)?;
        let pixels = read(gpu, target, studio.format)?;
        let ev100 = renderer.read_ev100(gpu)?;
        let passes = renderer.timings(gpu)?;
        gpu.check()?;
        let adapter = gpu.adapter().name.clone();
        Ok(Frame { size_px: target.size_px(), pixels, adapter, ev100, passes })
    }
}

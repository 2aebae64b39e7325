//! Draws one frame.

use tyndall_core::array::NamedArrays;
use tyndall_gpu::GpuOptions;
use tyndall_scene::Scene;

use super::format::OutputFormat;
use super::frame::{Frame, twice};
use super::session::Studio;
use crate::Failure;
use crate::cache::CacheArguments;
use crate::interrupt::Interrupt;
use crate::progress::Progress;

/// Everything that drawing a frame needs.
#[derive(Debug)]
pub(super) struct Job<'a> {
    pub(super) scene: &'a Scene,
    pub(super) format: OutputFormat,
    pub(super) options: &'a GpuOptions,
    pub(super) cache: CacheArguments,
    pub(super) state: Option<&'a NamedArrays>,
    pub(super) interrupt: &'a Interrupt,
    pub(super) progress: &'a Progress,
}

impl Job<'_> {
    /// Draws the frame; if the device is lost, once more on a new one.
    pub(super) fn run(&self) -> Result<Frame, Failure> {
        twice(|| self.attempt(), |failure| self.progress.warn(&format!("{failure}; trying once more")))
    }

    fn attempt(&self) -> Result<Frame, Failure> {
        let studio = Studio {
            size_px: [self.scene.image.width_px, self.scene.image.height_px],
            format: self.format,
            options: self.options,
            cache: self.cache,
            state: self.state,
            interrupt: self.interrupt,
            stages: Some(self.progress),
        };
        studio.open()?.draw(self.scene)
    }
}

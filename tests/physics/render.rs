//! Frames for the tests of this target.

use tyndall_gpu::Gpu;
use tyndall_render::{FrameFormat, FrameTarget, Renderer, RendererConfig};
use tyndall_scene::{Scene, presets};
use tyndall_tests::gpu;

/// A renderer of 32-bit frames, its target and its device.
pub(crate) struct Studio {
    pub(crate) gpu: &'static Gpu,
    pub(crate) renderer: Renderer,
}

impl Studio {
    pub(crate) fn new() -> Self {
        let renderer = Renderer::new(gpu(), config()).unwrap_or_else(|error| panic!("{error}"));
        Self { gpu: gpu(), renderer }
    }

    /// Draws a scene.
    pub(crate) fn shoot(&mut self, scene: &Scene, size_px: [u32; 2]) -> FrameTarget {
        let mut target = FrameTarget::new(self.gpu, size_px, config()).unwrap_or_else(|error| panic!("{error}"));
        self.renderer.render(self.gpu, scene, &mut target).unwrap_or_else(|error| panic!("{error}"));
        target
    }

    /// Radiance [cd/m^2] of a scene's picture.
    pub(crate) fn radiance(&mut self, scene: &Scene, size_px: [u32; 2]) -> Vec<[f32; 4]> {
        self.shoot(scene, size_px).read_radiance(self.gpu).unwrap_or_else(|error| panic!("{error}"))
    }
}

/// Frames in 32-bit floats, so that laws can be told from rounding.
pub(crate) fn config() -> RendererConfig {
    RendererConfig { frame: FrameFormat::Float, ..RendererConfig::default() }
}

/// A preset with some parameters changed: `&[("sun.elevation_deg", "10")]`. All orders of scattering in preview detail,
/// which obeys the same laws in an eighth of the time.
pub(crate) fn scene(preset: &str, changes: &[(&str, &str)]) -> Scene {
    let found = presets().into_iter().find(|candidate| candidate.name == preset).expect("the preset exists");
    let mut scene = found.load().expect("presets are valid").scene;
    scene.set_text("sky.orders_detail", "preview").expect("the parameter exists");
    for (path, text) in changes {
        scene.set_text(path, text).unwrap_or_else(|error| panic!("{path}: {error}"));
    }
    scene
}

/// Luminance [cd/m^2] of a pixel.
pub(crate) fn luminance([r, g, b, _]: [f32; 4]) -> f64 {
    tyndall_core::spectrum::luminance_from_rec709([f64::from(r), f64::from(g), f64::from(b)])
}

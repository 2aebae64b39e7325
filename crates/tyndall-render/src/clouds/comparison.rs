//! The picture of a scene's clouds beside their random walks: what `tyndall validate clouds` and the app's panel tell.
//!
//! Both see the clouds from the scene's camera, lit by its sun alone, before a black sky, without turbulence and without
//! repetition, in the green channel: clouds are white. Costs the walks, some 40 thousand a second and core.

use tyndall_clouds::Edges;
use tyndall_gpu::Gpu;
use tyndall_scene::{Scene, SkyKind};

use super::reference::{CloudAccuracy, CloudReference};
use crate::environment::sun_above_air;
use crate::{FrameTarget, RenderError, Renderer};

/// How closely to look.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CloudComparison {
    /// Size of the pictures (px).
    pub size_px: [u32; 2],
    /// Walks in each pixel.
    pub paths: u32,
    /// Seed of the walks; the same seed gives the same bits.
    pub seed: u64,
    /// Side of the bins in which pictures are compared (px).
    pub bin: usize,
}

/// What came of a comparison.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CloudVerdict {
    /// How far the picture is from the walks.
    Judged(CloudAccuracy),
    /// The scene has no clouds.
    NoClouds,
    /// The sun gives no light.
    NoSunlight,
    /// No cloud in sunlight is in the camera's view.
    OutOfView,
    /// It was stopped.
    Stopped,
}

impl CloudComparison {
    /// The scene that both see.
    #[must_use]
    pub fn scene(&self, scene: &Scene) -> Scene {
        let mut seen = scene.clone();
        [seen.image.width_px, seen.image.height_px] = self.size_px;
        (seen.sky.kind, seen.clouds.detail, seen.cloud_grid.edges) = (SkyKind::Black, 0.0, Edges::Open);
        seen
    }

    /// Compares the clouds of a scene. `progress` is told the share that is done, and says whether to go on.
    ///
    /// # Errors
    /// When the clouds cannot be made or drawn.
    pub fn run(
        &self,
        (gpu, renderer): (&Gpu, &mut Renderer),
        scene: &Scene,
        progress: &mut dyn FnMut(f64) -> bool,
    ) -> Result<CloudVerdict, RenderError> {
        let scene = self.scene(scene);
        scene.check()?;
        let [_, green, _] = sun_above_air(&scene)?;
        if green <= 0.0 {
            return Ok(CloudVerdict::NoSunlight);
        }
        let Some(reference) = CloudReference::new(&scene)? else { return Ok(CloudVerdict::NoClouds) };
        let mut target = FrameTarget::new(gpu, self.size_px, renderer.config())?;
        renderer.render(gpu, &scene, &mut target)?;
        let picture: Vec<f64> = target.read_radiance(gpu)?.iter().map(|pixel| f64::from(pixel[1]) / green).collect();
        let [width_px, height_px] = self.size_px;
        let mut truth = Vec::with_capacity(picture.len());
        for y in 0..height_px {
            if !progress(f64::from(y) / f64::from(height_px)) {
                return Ok(CloudVerdict::Stopped);
            }
            truth.extend(reference.row(y, (self.paths, self.seed)));
        }
        let accuracy = CloudAccuracy::of(&picture, &truth, width_px as usize, self.bin);
        Ok(accuracy.map_or(CloudVerdict::OutOfView, CloudVerdict::Judged))
    }
}

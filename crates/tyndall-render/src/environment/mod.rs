//! The light from everywhere around the camera, for other programs: panorama and sun.
//!
//! [`Renderer::capture_environment`] draws the panorama: with the same shaders as a picture, pixel by pixel, where the scene
//! is sky and ground alone; from the six faces of a cube ([`cube`]) where things stand in it that only rasterization
//! draws, and for the paper's dome. [`SunLight`] is the light of the sun's disc alone, for a lamp in place of the disc.
//! [`LightUnit`] says in which unit other programs want the numbers.
//!
//! Accuracy: the disc in a panorama holds the sun's light within 0.5 % at any width; a panorama from a cube differs from
//! a direct one by less than 1 % of the light of a pixel away from edges. Not done: panoramas beyond a device's largest
//! texture.

pub mod cube;
mod sun_light;
mod unit;

use tyndall_core::spectrum::rec709_from_spectrum;
use tyndall_gpu::Gpu;
use tyndall_scene::{CloudKind, CloudMethod, LandscapeKind, Scene, SkyMode};

pub use sun_light::SunLight;
pub use unit::{BLENDER_LUMENS_PER_WATT, LightUnit};

use crate::{FrameTarget, RenderError, Renderer, SKY_DEPTH_M, View};

/// Width (px) of the frame of the scene's camera that meters the exposure.
const METER_WIDTH_PX: u32 = 192;

/// Narrowest panorama: four pixels around, two from the zenith to the nadir.
pub const PANORAMA_WIDTH_MIN_PX: u32 = 4;

/// Irradiance (lx, linear Rec.709) of the sun above the air, on a surface that faces it: what clouds in a black sky receive.
///
/// # Errors
/// When the atmosphere's values do not fit together.
pub fn sun_above_air(scene: &Scene) -> Result<[f64; 3], RenderError> {
    let solar = scene.model().coefficients()?.solar_irradiance_w_m2_nm;
    Ok(rec709_from_spectrum(&solar).map(|channel| channel * scene.sun.brightness))
}

/// What lies below the horizon of a panorama.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GroundLight {
    /// The ground as the sun and the sky light it.
    #[default]
    True,
    /// Nothing: for scenes that bring a ground of their own.
    Black,
}

/// What a panorama is to show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EnvironmentOptions {
    /// Columns; half as many rows. An even number.
    pub width_px: u32,
    /// Whether the sun's disc is drawn, if the scene draws it.
    pub disc: bool,
    /// What lies below the horizon.
    pub ground: GroundLight,
}

impl EnvironmentOptions {
    /// Columns and rows.
    ///
    /// # Errors
    /// When the width is odd or below [`PANORAMA_WIDTH_MIN_PX`].
    pub fn size_px(self) -> Result<[u32; 2], RenderError> {
        if self.width_px < PANORAMA_WIDTH_MIN_PX || !self.width_px.is_multiple_of(2) {
            return Err(RenderError::PanoramaWidth { width_px: self.width_px });
        }
        Ok([self.width_px, self.width_px / 2])
    }
}

/// The light around a camera.
#[derive(Clone, Debug, PartialEq)]
pub struct Environment {
    /// Columns and rows.
    pub size_px: [u32; 2],
    /// Radiance, linear Rec.709 with luminance in cd/m^2, and 1; laid out as [`View::Panorama`] says.
    pub rgba: Vec<[f32; 4]>,
    /// Exposure value at ISO 100 of the scene's own picture, metered or manual.
    pub ev100: f64,
    /// The sun's light at the camera, behind clouds where they cover it; `None` when no part of its disc is above the horizon.
    pub sun: Option<SunLight>,
}

impl Renderer {
    /// Draws the light from everywhere around the scene's camera. The renderer must draw 32-bit frames if the disc is to
    /// keep its energy.
    ///
    /// # Errors
    /// When the width is odd or below [`PANORAMA_WIDTH_MIN_PX`], and as [`Renderer::render`].
    pub fn capture_environment(
        &mut self,
        gpu: &Gpu,
        scene: &Scene,
        options: EnvironmentOptions,
    ) -> Result<Environment, RenderError> {
        let size_px = options.size_px()?;
        let ev100 = self.meter_scene(gpu, scene)?;
        let mut scene = scene.clone();
        scene.sun.disc &= options.disc;
        let rgba = if is_rasterized(&scene) {
            cube::panorama(self, gpu, &scene, size_px, options.ground)?
        } else {
            let mut target = FrameTarget::new(gpu, size_px, self.config())?;
            self.render_view(gpu, &scene, View::Panorama, &mut target)?;
            read_light(gpu, &target, options.ground)?
        };
        let sun = self.sun_behind_clouds(&scene)?;
        Ok(Environment { size_px, rgba, ev100, sun })
    }

    /// The sun's light at the camera of a scene that was drawn, behind its clouds.
    fn sun_behind_clouds(&self, scene: &Scene) -> Result<Option<SunLight>, RenderError> {
        let Some(sun) = SunLight::new(scene)? else { return Ok(None) };
        let camera = &scene.grounded().camera;
        let place_m = [camera.x_m, camera.y_m, camera.altitude_m];
        let left = self.clouds().sunlight_left(place_m, scene.sun_direction()?.unit().to_array());
        Ok(Some(SunLight { irradiance: sun.irradiance.map(|light| left * light), ..sun }))
    }

    /// Exposure value at ISO 100 of the picture of the scene's camera, from a small frame of it.
    ///
    /// # Errors
    /// As [`Renderer::render`].
    pub fn meter_scene(&mut self, gpu: &Gpu, scene: &Scene) -> Result<f64, RenderError> {
        let shape = f64::from(scene.image.height_px) / f64::from(scene.image.width_px);
        #[expect(clippy::cast_possible_truncation, reason = "clamped to small sizes")]
        let height_px = (f64::from(METER_WIDTH_PX) * shape).round().clamp(1.0, 1024.0) as u32;
        let mut target = FrameTarget::new(gpu, [METER_WIDTH_PX, height_px], self.config())?;
        self.render(gpu, scene, &mut target)?;
        self.read_ev100(gpu)
    }
}

/// Whether a panorama cannot be drawn pixel by pixel, because something stands in the scene as triangles.
fn is_rasterized(scene: &Scene) -> bool {
    let splats = scene.clouds.kind != CloudKind::None && scene.clouds.method == CloudMethod::Splats;
    splats || scene.sky.mode == SkyMode::VertexDome || scene.landscape.kind != LandscapeKind::None
}

/// Radiance of a target (cd/m^2), black where the ground is if so wanted.
fn read_light(gpu: &Gpu, target: &FrameTarget, ground: GroundLight) -> Result<Vec<[f32; 4]>, RenderError> {
    let mut rgba = target.read_radiance(gpu)?;
    if ground == GroundLight::Black {
        for (pixel, depth_m) in rgba.iter_mut().zip(target.read_depth_m(gpu)?) {
            if depth_m < SKY_DEPTH_M {
                *pixel = [0.0, 0.0, 0.0, 1.0];
            }
        }
    }
    Ok(rgba)
}

//! The sky of the night: refraction, moon, stars, airglow. WGSL: `shaders/sky/night.wgsl` and what it imports.
//!
//! All of it adds to the light of the day, so that nothing switches at sunset. What cannot be seen costs nothing: a moon
//! far below the horizon or beside a high sun lights no air, and by day there are no stars.

mod airglow;
mod colour;
mod moon;
mod refraction;
mod star_lists;
mod stars;

use tyndall_gpu::{Buffer, Gpu, wgpu};
use tyndall_scattering::Atmosphere as Model;
use tyndall_scene::Scene;

use moon::MoonLight;
use refraction::RefractionUniform;
use stars::StarField;

use crate::RenderError;
use crate::frame::gpu_data::Frame;

/// Elevation of the sun (rad) above which the brightest star is lost even in the finest picture's zenith, and the altitude
/// (m) above which the sky is dark by day.
const DAY_ELEVATION: f64 = 0.035;
const DARK_ABOVE_M: f64 = 15_000.0;

/// Uniform structs of this folder.
pub mod gpu_data {
    pub use super::airglow::gpu_data::Airglow;
    pub use super::moon::gpu_data::Moon;
    pub use super::refraction::gpu_data::Refraction;
    pub use super::stars::gpu_data::Stars;
}

/// What the sky of the night needs on the GPU.
#[derive(Debug)]
pub struct Night {
    refraction: RefractionUniform,
    pub(super) moon: MoonLight,
    stars: StarField,
    airglow: Buffer,
    is_drawn: bool,
}

impl Night {
    /// Pipelines and empty tables.
    ///
    /// # Errors
    /// When a shader is wrong or memory does not suffice.
    pub fn new(gpu: &Gpu) -> Result<Self, RenderError> {
        Ok(Self {
            refraction: RefractionUniform::new(gpu)?,
            moon: MoonLight::new(gpu)?,
            stars: StarField::new(gpu)?,
            airglow: airglow::uniform(gpu)?,
            is_drawn: true,
        })
    }

    /// Uploads what a scene changes for a frame whose pixels are `pixel_rad` wide.
    ///
    /// # Errors
    /// When the scene's values do not fit together or memory does not suffice.
    pub fn update(
        &mut self,
        gpu: &Gpu,
        scene: &Scene,
        model: &Model,
        (frame, pixel_rad): (&Frame, f64),
    ) -> Result<(), RenderError> {
        let is_day = scene.sun_direction()?.elevation_rad > DAY_ELEVATION && scene.sun.brightness > 0.0;
        let is_dark = !is_day || scene.camera.altitude_m > DARK_ABOVE_M;
        self.refraction.update(gpu, scene, model.planet_radius_m);
        let has_moon = self.moon.update(gpu, scene, (model, frame))?;
        self.is_drawn = is_dark || has_moon;
        self.stars.update(gpu, scene, (is_dark, pixel_rad))?;
        let airglow = gpu_data::Airglow::new(scene.stars.airglow_cd_m2);
        gpu.queue.write_buffer(&self.airglow, 0, bytemuck::bytes_of(&airglow));
        Ok(())
    }

    /// Whether any light of the night shows in the frame: never by day near the ground, but for the moon.
    pub(super) fn is_drawn(&self) -> bool {
        self.is_drawn
    }

    /// Resources of the shaders that see moonlit air, by their names.
    pub(super) fn moon_bindings(&self) -> [(&'static str, wgpu::BindingResource<'_>); 2] {
        [("moon", self.moon.uniform.as_entire_binding()), ("moon_sky", self.moon.sky.as_binding())]
    }

    /// Resources of the shaders that draw the ground, by their names.
    pub(super) fn ground_bindings(&self) -> [(&'static str, wgpu::BindingResource<'_>); 3] {
        [
            ("moon", self.moon.uniform.as_entire_binding()),
            ("moon_sky", self.moon.sky.as_binding()),
            ("airglow", self.airglow.as_entire_binding()),
        ]
    }

    /// Resources of the shaders that draw the sky, by their names.
    pub(super) fn sky_bindings(&self) -> Vec<(&'static str, wgpu::BindingResource<'_>)> {
        let mut bindings = self.ground_bindings().to_vec();
        bindings.extend([
            ("refraction", self.refraction.buffer.as_entire_binding()),
            ("stars", self.stars.uniform.as_entire_binding()),
            ("stars_cells", self.stars.cells.as_entire_binding()),
            ("stars_list", self.stars.list.as_entire_binding()),
        ]);
        bindings
    }
}

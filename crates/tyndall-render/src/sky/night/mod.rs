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
        })
    }

    /// Uploads what a scene changes; `pixel_rad` is the width of a pixel.
    ///
    /// # Errors
    /// When the scene's values do not fit together or memory does not suffice.
    pub fn update(&mut self, gpu: &Gpu, scene: &Scene, model: &Model, pixel_rad: f64) -> Result<(), RenderError> {
        self.refraction.update(gpu, scene, model.planet_radius_m);
        self.moon.update(gpu, scene, model)?;
        self.stars.update(gpu, scene, pixel_rad)?;
        let airglow = gpu_data::Airglow::new(scene.stars.airglow_cd_m2);
        gpu.queue.write_buffer(&self.airglow, 0, bytemuck::bytes_of(&airglow));
        Ok(())
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

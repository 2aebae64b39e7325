//! What stands outside the air: where it is seen. WGSL: `shaders/sky/refraction.wgsl`.

mod refraction;

use tyndall_gpu::{Gpu, wgpu};
use tyndall_scattering::Atmosphere as Model;
use tyndall_scene::Scene;

pub use refraction::RefractionUniform;

use crate::RenderError;

/// Uniform structs of this folder.
pub mod gpu_data {
    pub use super::refraction::gpu_data::Refraction;
}

/// What the sky of the night needs on the GPU.
#[derive(Debug)]
pub struct Night {
    refraction: RefractionUniform,
}

impl Night {
    /// Empty buffers.
    ///
    /// # Errors
    /// When memory does not suffice.
    pub fn new(gpu: &Gpu) -> Result<Self, RenderError> {
        Ok(Self { refraction: RefractionUniform::new(gpu)? })
    }

    /// Uploads what a scene changes.
    pub fn update(&mut self, gpu: &Gpu, scene: &Scene, model: &Model) {
        self.refraction.update(gpu, scene, model.planet_radius_m);
    }

    /// Resources of the shaders that draw the sky, by their names.
    pub(super) fn bindings(&self) -> Vec<(&'static str, wgpu::BindingResource<'_>)> {
        vec![("refraction", self.refraction.buffer.as_entire_binding())]
    }
}

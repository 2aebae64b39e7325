//! The table of refraction for the observer, as a uniform. WGSL: `shaders/sky/refraction.wgsl`.

use tyndall_gpu::wgpu::BufferUsages;
use tyndall_gpu::{Buffer, Gpu};
use tyndall_scattering::refraction::{REFRACTION_NODES, RefractionTable, RefractiveAir};
use tyndall_scattering::sky_view_map::horizon_elevation;
use tyndall_scene::Scene;

use crate::RenderError;

/// Uniform structs of this file.
pub(super) mod gpu_data {
    use super::REFRACTION_NODES;

    /// Twin of `Refraction` in `shaders/sky/refraction.wgsl`; units and meanings there.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
    #[expect(missing_docs, reason = "documented at the WGSL twin")]
    pub struct Refraction {
        pub lift: [[f32; 4]; REFRACTION_NODES / 4],
        pub horizon_elevation: f32,
        pub padding0: u32,
        pub padding1: u32,
        pub padding2: u32,
    }
}

impl gpu_data::Refraction {
    /// From the table of an observer whose horizon lies at this elevation (rad).
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "the GPU computes in f32")]
    pub fn new(table: &RefractionTable, horizon_elevation: f64) -> Self {
        let mut lift = [[0.0; 4]; REFRACTION_NODES / 4];
        for (four, nodes) in lift.iter_mut().zip(table.nodes().chunks(4)) {
            for (value, node) in four.iter_mut().zip(nodes) {
                *value = *node as f32;
            }
        }
        Self { lift, horizon_elevation: horizon_elevation as f32, padding0: 0, padding1: 0, padding2: 0 }
    }
}

/// The uniform on the GPU, traced anew for another air or altitude.
#[derive(Debug)]
pub(super) struct RefractionUniform {
    pub(super) buffer: Buffer,
    /// Air, radius of the planet (m) and altitude (m).
    holds: Option<(Option<RefractiveAir>, f64, f64)>,
}

impl RefractionUniform {
    /// An empty uniform.
    ///
    /// # Errors
    /// When memory does not suffice.
    pub(super) fn new(gpu: &Gpu) -> Result<Self, RenderError> {
        let bytes = size_of::<gpu_data::Refraction>() as u64;
        let buffer = gpu.buffer("refraction", bytes, BufferUsages::UNIFORM | BufferUsages::COPY_DST)?;
        Ok(Self { buffer, holds: None })
    }

    /// Brings the uniform up to date.
    pub(super) fn update(&mut self, gpu: &Gpu, scene: &Scene, radius_m: f64) {
        let wanted = Some((scene.refractive_air(), radius_m, scene.camera.altitude_m));
        if self.holds == wanted {
            return;
        }
        let altitude_m = scene.camera.altitude_m;
        let horizon = horizon_elevation(radius_m, altitude_m);
        let table = scene
            .refractive_air()
            .map_or_else(|| RefractionTable::straight(horizon), |air| RefractionTable::new(&air, altitude_m));
        let uniform = gpu_data::Refraction::new(&table, horizon);
        gpu.queue.write_buffer(&self.buffer, 0, bytemuck::bytes_of(&uniform));
        self.holds = wanted;
    }
}

//! The stars on the GPU. WGSL: `shaders/sky/stars.wgsl`.

use tyndall_gpu::wgpu::BufferUsages;
use tyndall_gpu::{Buffer, Gpu};
use tyndall_scene::Scene;
use tyndall_scene::astronomy::{Star, bright_stars};

use super::colour::white;
use super::star_lists::{grid_for, star_lists};
use crate::RenderError;

/// Uniform structs of this file.
pub(super) mod gpu_data {
    /// Twin of `Stars` in `shaders/sky/stars.wgsl`; units and meanings there.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
    #[expect(missing_docs, reason = "documented at the WGSL twin")]
    pub struct Stars {
        pub from_world_x: [f32; 4],
        pub from_world_y: [f32; 4],
        pub from_world_z: [f32; 4],
        pub white: [f32; 8],
        pub grid: u32,
        pub factor: f32,
        pub milky_way_cd_m2: f32,
        pub padding: u32,
    }
}

impl gpu_data::Stars {
    /// Of a scene, in lists with so many cells along an edge; 0 for no stars.
    ///
    /// # Errors
    /// When the scene's date does not exist.
    #[expect(clippy::cast_possible_truncation, reason = "the GPU computes in f32")]
    pub fn new(scene: &Scene, grid: u32) -> Result<Self, RenderError> {
        // The rows of the inverse are the columns of the rotation.
        let world = scene.world_from_stars()?;
        let row = |axis: glam::DVec3| axis.extend(0.0).as_vec4().to_array();
        Ok(Self {
            from_world_x: row(world.x_axis),
            from_world_y: row(world.y_axis),
            from_world_z: row(world.z_axis),
            white: white().map(|value| value as f32),
            grid,
            factor: scene.stars.brightness as f32,
            milky_way_cd_m2: scene.stars.milky_way_cd_m2 as f32,
            padding: 0,
        })
    }
}

/// The catalogue in lists, and the uniform.
#[derive(Debug)]
pub(super) struct StarField {
    pub(super) uniform: Buffer,
    pub(super) cells: Buffer,
    pub(super) list: Buffer,
    catalogue: Vec<Star>,
    /// Cells along an edge of the lists, 0 before there are any.
    grid: u32,
}

impl StarField {
    /// Without stars.
    pub(super) fn new(gpu: &Gpu) -> Result<Self, RenderError> {
        let bytes = size_of::<gpu_data::Stars>() as u64;
        Ok(Self {
            uniform: gpu.buffer("stars", bytes, BufferUsages::UNIFORM | BufferUsages::COPY_DST)?,
            cells: storage(gpu, "cells of stars", &[0; 4])?,
            list: storage(gpu, "list of stars", &[0; 16])?,
            catalogue: Vec::new(),
            grid: 0,
        })
    }

    /// Uploads the stars of a scene for pixels of this width (rad); none when the sky is too bright for them.
    pub(super) fn update(
        &mut self,
        gpu: &Gpu,
        scene: &Scene,
        (is_dark, pixel_rad): (bool, f64),
    ) -> Result<(), RenderError> {
        let grid = if scene.stars.visible && is_dark { grid_for(pixel_rad) } else { 0 };
        let uniform = gpu_data::Stars::new(scene, grid)?;
        gpu.queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&uniform));
        if grid == 0 || grid == self.grid {
            return Ok(());
        }
        if self.catalogue.is_empty() {
            self.catalogue = bright_stars();
        }
        let lists = star_lists(&self.catalogue, grid);
        self.cells = storage(gpu, "cells of stars", bytemuck::cast_slice(&lists.cells))?;
        self.list = storage(gpu, "list of stars", bytemuck::cast_slice(&lists.list))?;
        self.grid = grid;
        Ok(())
    }
}

fn storage(gpu: &Gpu, label: &str, bytes: &[u8]) -> Result<Buffer, RenderError> {
    let buffer = gpu.buffer(label, bytes.len() as u64, BufferUsages::STORAGE | BufferUsages::COPY_DST)?;
    gpu.queue.write_buffer(&buffer, 0, bytes);
    Ok(buffer)
}

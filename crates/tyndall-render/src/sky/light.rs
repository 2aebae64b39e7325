//! The table of sunlight and skylight on surfaces near the camera. WGSL: `shaders/sky/light_*.wgsl`.
//!
//! Whatever stands in the air reads it through `sky/light_lookup.wgsl`, with the resources of [`SkyLightTable::bindings`].

use tyndall_gpu::wgpu::{self, BufferUsages, TextureFormat, TextureUsages};
use tyndall_gpu::{Buffer, ComputePipeline, Gpu, PassTimer, Shader, Texture, TextureDesc};
use tyndall_scene::Scene;

use super::SkyTables;
use super::gpu_data::SkyLight;
use crate::RenderError;
use crate::exposure::{daylight_ev100, gain_from_ev100};

/// Texels of the table: suns, and altitudes times layers. WGSL: `shaders/sky/light.wgsl`.
const SIZE_PX: [u32; 2] = [8, 24 * 13];

/// Where surfaces are that the table is to serve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkyLightReach {
    /// Distance (m) from the camera along the ground.
    pub distance_m: f64,
    /// Altitude (m).
    pub top_altitude_m: f64,
}

/// The table, its uniform and the pipeline that fills it.
#[derive(Debug)]
pub struct SkyLightTable {
    fill: ComputePipeline,
    uniform: Buffer,
    table: Texture,
    sampler: wgpu::Sampler,
}

impl SkyLight {
    /// The part of the sky's light that surfaces within reach can meet.
    ///
    /// # Errors
    /// When the scene has no sun position.
    #[expect(clippy::cast_possible_truncation, reason = "the GPU computes in f32")]
    pub fn new(scene: &Scene, reach: SkyLightReach) -> Result<Self, RenderError> {
        let elevation = scene.sun_direction()?.elevation_rad;
        // The zenith turns with the place; a little more, so that the last place is not beyond the last column.
        let turn = (1.1 * reach.distance_m / (1e3 * scene.atmosphere.planet_radius_km)).clamp(1e-4, 1.0);
        // Half floats hold what suits this sun, whatever the film is set to.
        let unit = gain_from_ev100(daylight_ev100(elevation.to_degrees())) / scene.sun.brightness.max(1e-6);
        Ok(Self {
            lowest_mu_sun: (elevation - turn).max(-std::f64::consts::FRAC_PI_2).sin() as f32,
            highest_mu_sun: (elevation + turn).min(std::f64::consts::FRAC_PI_2).sin() as f32,
            top_altitude_m: reach.top_altitude_m.clamp(100.0, 1e3 * scene.atmosphere.top_altitude_km) as f32,
            lux: (1.0 / unit) as f32,
        })
    }
}

impl SkyLightTable {
    /// The pipeline and an empty table.
    ///
    /// # Errors
    /// When the shader is wrong or memory does not suffice.
    pub fn new(gpu: &Gpu) -> Result<Self, RenderError> {
        let shader = Shader::load(gpu, "sky/light_table.wgsl")?;
        let usage = TextureUsages::STORAGE_BINDING | TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_SRC;
        let desc = TextureDesc::new_2d("sky light", SIZE_PX, TextureFormat::Rgba16Float, usage);
        Ok(Self {
            fill: ComputePipeline::new(gpu, &shader, "sky_light_table", &[])?,
            uniform: gpu.buffer(
                "sky light",
                size_of::<SkyLight>() as u64,
                BufferUsages::UNIFORM | BufferUsages::COPY_DST,
            )?,
            table: gpu.texture(&desc)?,
            sampler: linear_sampler(gpu),
        })
    }

    /// Uploads the uniform and records the filling, which takes less than asking whether it is needed would.
    ///
    /// # Errors
    /// When the scene has no sun position or a table does not fit the shader.
    pub fn update(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        timer: &mut PassTimer,
        tables: &SkyTables,
        (scene, reach): (&Scene, SkyLightReach),
    ) -> Result<(), RenderError> {
        gpu.queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&SkyLight::new(scene, reach)?));
        let mut resources = tables.air_bindings();
        resources.push(("sky_light", self.uniform.as_entire_binding()));
        resources.push(("sky_light_texels", self.table.as_binding()));
        let bindings = self.fill.bind(gpu, 0, &resources)?;
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("sky light"),
            timestamp_writes: timer.compute_writes("sky light"),
        });
        pass.set_bind_group(0, &bindings, &[]);
        self.fill.dispatch(&mut pass, [8, 24, 1]);
        Ok(())
    }

    /// What `sky/light_lookup.wgsl` needs, by the names of its variables.
    #[must_use]
    pub fn bindings(&self) -> [(&'static str, wgpu::BindingResource<'_>); 3] {
        [
            ("sky_light", self.uniform.as_entire_binding()),
            ("sky_light_table", self.table.as_binding()),
            ("sky_light_sampler", wgpu::BindingResource::Sampler(&self.sampler)),
        ]
    }

    /// The table, for tests.
    #[must_use]
    pub fn table(&self) -> &Texture {
        &self.table
    }
}

/// Linear in all directions, and constant beyond the outer texels.
pub(crate) fn linear_sampler(gpu: &Gpu) -> wgpu::Sampler {
    gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("linear"),
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        ..Default::default()
    })
}

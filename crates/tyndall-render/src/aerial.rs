//! The volume of air in front of the camera: in-scattered light and transmittance at every distance. WGSL: `shaders/aerial`.
//!
//! [`AerialVolume`] holds four 3-D textures over image plane and distance: light of the air and of all orders, light of
//! aerosol and of haze before their phase functions (so that the aureole stays sharp), and the optical depth in red, green
//! and blue. Landscapes read it through `aerial/lookup.wgsl` with the resources of [`AerialVolume::bindings`]; clouds and
//! shafts are to. It is filled only for another view, sun or medium.

use tyndall_gpu::wgpu::{self, BufferUsages, TextureFormat, TextureUsages};
use tyndall_gpu::{Buffer, ComputePipeline, Gpu, PassTimer, Shader, Texture, TextureDesc};
use tyndall_scattering::aerial::AERIAL_SLICES;
use tyndall_scene::Scene;

use crate::RenderError;
use crate::clouds::CloudRenderer;
use crate::exposure::{daylight_ev100, gain_from_ev100};
use crate::frame::gpu_data::Frame;
use crate::sky::light::linear_sampler;
use crate::sky::{SkyLightReach, SkyTables};

/// Uniform structs of this file.
pub mod gpu_data {
    /// Twin of `Aerial` in `shaders/aerial/aerial.wgsl`; units and meanings there.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
    #[expect(missing_docs, reason = "documented at the WGSL twin")]
    pub struct Aerial {
        pub columns: u32,
        pub rows: u32,
        pub far_m: f32,
        pub unit: f32,
    }
}

/// Names of the volumes in `aerial/volume.wgsl` and `aerial/lookup.wgsl`.
const VOLUMES: [(&str, &str); 4] = [
    ("aerial_light_texels", "aerial_light_volume"),
    ("aerial_aerosol_texels", "aerial_aerosol_volume"),
    ("aerial_haze_texels", "aerial_haze_volume"),
    ("aerial_depth_texels", "aerial_depth_volume"),
];

/// What a volume was filled for: itself, the view, the sun's direction, which tables and which clouds.
type Filled = (gpu_data::Aerial, [f32; 16], [f32; 3], [u64; 2]);

/// The volume, its uniform and the pipelines that fill it.
#[derive(Debug)]
pub struct AerialVolume {
    /// Columns before each slice, diffuse light around it, what it adds, sums.
    steps: [ComputePipeline; 4],
    uniform: Buffer,
    scratch: Buffer,
    volumes: [Texture; 4],
    sampler: wgpu::Sampler,
    filled_for: Option<Filled>,
}

/// What a frame's volume follows from.
#[derive(Clone, Copy, Debug)]
pub struct AerialRequest<'a> {
    /// The scene, its camera's altitude above sea level.
    pub scene: &'a Scene,
    /// Where things stand in the air.
    pub reach: SkyLightReach,
    /// The frame's uniform, and the buffer that holds it.
    pub frame: (&'a Frame, &'a Buffer),
    /// The clouds, prepared for the scene: what they leave of the sunlight.
    pub clouds: &'a CloudRenderer,
}

impl gpu_data::Aerial {
    /// For a scene whose things reach so far.
    ///
    /// # Errors
    /// When the scene has no sun position.
    #[expect(clippy::cast_possible_truncation, reason = "the GPU computes in f32")]
    pub fn new(scene: &Scene, reach: SkyLightReach) -> Result<Self, RenderError> {
        let elevation_deg = scene.sun_direction()?.elevation_rad.to_degrees();
        // Half floats hold what suits this sun, whatever the film is set to.
        let unit = scene.sun.brightness.max(1e-6) / gain_from_ev100(daylight_ev100(elevation_deg));
        Ok(Self {
            columns: scene.sky.aerial_columns,
            rows: scene.sky.aerial_rows,
            far_m: (1.02 * reach.distance_m).min(1e3 * scene.sky.aerial_distance_km) as f32,
            unit: unit as f32,
        })
    }
}

impl AerialVolume {
    /// The pipeline and an empty volume.
    ///
    /// # Errors
    /// When the shader is wrong or memory does not suffice.
    pub fn new(gpu: &Gpu) -> Result<Self, RenderError> {
        let shader = Shader::load(gpu, "aerial/volume.wgsl")?;
        let bytes = size_of::<gpu_data::Aerial>() as u64;
        let step = |entry| ComputePipeline::new(gpu, &shader, entry, &[]);
        Ok(Self {
            steps: [step("aerial_columns")?, step("aerial_diffuse")?, step("aerial_slices")?, step("aerial_sums")?],
            scratch: scratch(gpu, [2, 2])?,
            uniform: gpu.buffer("aerial", bytes, BufferUsages::UNIFORM | BufferUsages::COPY_DST)?,
            volumes: volumes(gpu, [2, 2])?,
            sampler: linear_sampler(gpu),
            filled_for: None,
        })
    }

    /// Uploads the uniform and records the filling when something has changed.
    ///
    /// # Errors
    /// When the scene has no sun position or memory does not suffice.
    pub fn update(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        timer: &mut PassTimer,
        tables: &SkyTables,
        request: AerialRequest<'_>,
    ) -> Result<(), RenderError> {
        let aerial = gpu_data::Aerial::new(request.scene, request.reach)?;
        let sun = request.scene.sun_direction()?.unit().as_vec3().to_array();
        let revisions = [tables.revision(), request.clouds.shadow_revision()];
        let wanted = (aerial, view_key(request.frame.0), sun, revisions);
        if self.filled_for == Some(wanted) {
            return Ok(());
        }
        self.filled_for = None;
        gpu.queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&aerial));
        if self.volumes[0].size_px() != [aerial.columns, aerial.rows] {
            self.volumes = volumes(gpu, [aerial.columns, aerial.rows])?;
            self.scratch = scratch(gpu, [aerial.columns, aerial.rows])?;
        }
        self.record(gpu, encoder, timer, (tables, &request, &aerial))?;
        self.filled_for = Some(wanted);
        Ok(())
    }

    fn record(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        timer: &mut PassTimer,
        (tables, request, aerial): (&SkyTables, &AerialRequest<'_>, &gpu_data::Aerial),
    ) -> Result<(), RenderError> {
        let volume = |index: usize| (VOLUMES[index].0, self.volumes[index].as_binding());
        let own = [("aerial", self.uniform.as_entire_binding()), ("aerial_scratch", self.scratch.as_entire_binding())];
        let air = tables.air_bindings();
        let of_air = |names: &[&str]| air.iter().filter(|(name, _)| names.contains(name)).cloned().collect::<Vec<_>>();
        let colours = ["atmosphere", "sky_view", "column_table", "irradiance_table"];
        let diffuse = ["atmosphere", "orders", "orders_source"];
        let march = ["atmosphere", "column_table"];
        let resources = [
            [of_air(&colours), own.to_vec(), vec![volume(3)]].concat(),
            [of_air(&diffuse), own.to_vec()].concat(),
            [of_air(&march), own.to_vec()].concat(),
            [of_air(&colours), own.to_vec(), (0..4).map(volume).collect()].concat(),
        ];
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("aerial volume"),
            timestamp_writes: timer.compute_writes("aerial volume"),
        });
        for (index, (step, resources)) in self.steps.iter().zip(resources).enumerate() {
            pass.set_bind_group(0, &step.bind(gpu, 0, &resources)?, &[]);
            // The columns alone need the camera.
            if index == 0 {
                let frame = [("frame", request.frame.1.as_entire_binding())];
                pass.set_bind_group(1, &step.bind(gpu, 1, &frame)?, &[]);
            }
            // What the slices add alone needs the clouds.
            if index == 2 {
                pass.set_bind_group(3, &step.bind(gpu, 3, &request.clouds.shadow_bindings())?, &[]);
            }
            step.dispatch(
                &mut pass,
                [aerial.columns, aerial.rows, if index == 1 || index == 2 { slices() } else { 1 }],
            );
        }
        Ok(())
    }

    /// Forgets what the volume holds, so that the next frame fills it again.
    pub fn invalidate(&mut self) {
        self.filled_for = None;
    }

    /// What `aerial/lookup.wgsl` needs beside the atmosphere, by the names of its variables.
    #[must_use]
    pub fn bindings(&self) -> Vec<(&'static str, wgpu::BindingResource<'_>)> {
        let volumes = VOLUMES.iter().zip(&self.volumes).map(|((_, name), volume)| (*name, volume.as_binding()));
        let own = [
            ("aerial", self.uniform.as_entire_binding()),
            ("aerial_sampler", wgpu::BindingResource::Sampler(&self.sampler)),
        ];
        volumes.chain(own).collect()
    }

    /// The volumes, for tests: light, light of aerosol and of haze before their phase functions, optical depth.
    #[must_use]
    pub fn volumes(&self) -> &[Texture; 4] {
        &self.volumes
    }
}

/// What of a frame the volume depends on.
fn view_key(frame: &Frame) -> [f32; 16] {
    let ([a, b, c], [d, e, f], [g, h, i], [j, k, l]) = (frame.right, frame.up, frame.forward, frame.position_m);
    let projection = if frame.projection == 0 { 0.0 } else { 1.0 };
    [a, b, c, d, e, f, g, h, i, j, k, l, frame.tan_half_width, frame.tan_half_height, projection, 0.0]
}

fn volumes(gpu: &Gpu, [columns, rows]: [u32; 2]) -> Result<[Texture; 4], RenderError> {
    let usage = TextureUsages::STORAGE_BINDING | TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_SRC;
    let volume =
        |name| gpu.texture(&TextureDesc::new_3d(name, [columns, rows, slices()], TextureFormat::Rgba16Float, usage));
    let [light, aerosol, haze, depth] = VOLUMES.map(|(_, name)| volume(name));
    Ok([light?, aerosol?, haze?, depth?])
}

/// Room for the steps between the pipelines: ten vectors a slice.
fn scratch(gpu: &Gpu, [columns, rows]: [u32; 2]) -> Result<Buffer, RenderError> {
    let bytes = 160 * u64::from(columns) * u64::from(rows) * u64::from(slices());
    Ok(gpu.buffer("aerial scratch", bytes, BufferUsages::STORAGE)?)
}

#[expect(clippy::cast_possible_truncation, reason = "a small constant")]
const fn slices() -> u32 {
    AERIAL_SLICES as u32
}

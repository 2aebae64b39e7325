//! Clouds in the frame: the paper's automaton, marched at every pixel. WGSL: `shaders/clouds`.
//!
//! What the clouds consist of comes from [`source`], the light in its cells from `tyndall_clouds`, and both stay until they
//! change. A frame marches
//! them from the camera to whatever was drawn before, and lays the result over it: sunlight scattered once by its exact phase
//! function, sunlight scattered more often by diffusion, light of the sky and of the shaded ground at the cloud's altitude, and the air between cloud and camera.
//!
//! A wrapped grid repeats to the horizon. What clouds leave of the light is kept as data ([`CloudRenderer::shadow_bindings`]).

mod billows;
mod building;
pub mod comparison;
pub mod file;
pub mod gpu_data;
mod half;
pub(crate) mod in_air;
pub(crate) mod lamp;
mod maker;
pub mod reference;
mod report;
mod request;
mod shadow;
mod skip;
pub mod source;
mod splats;
mod volume;

pub use building::CloudProgress;
pub use report::{CloudReport, CloudTimes};

use tyndall_clouds::floor_shadow::optical_depth;
use tyndall_core::array::NamedArrays;
use tyndall_gpu::wgpu::{self, BufferUsages, TextureUsages};
use tyndall_gpu::{Buffer, Gpu, PassTimer, RenderPipelineDesc, Shader, Texture, TextureDesc};
use tyndall_scene::{CloudMethod, CloudResolution, Scene};

use crate::night_forms::NightForms;
use crate::sky::{SkyLightReach, SkyLightTable, SkyTables, TableBuilding};
use crate::splats::SplatRasteriser;
use crate::{FrameTarget, RenderError, RendererConfig, View};
use billows::{billow_texture, drift_cells};
use gpu_data::Clouds;
use half::HalfClouds;
use request::VolumeRequest;
use shadow::CloudShadow;
use splats::CloudSplats;
use volume::CloudVolume;

/// The pipeline, the simulation and its textures.
#[derive(Debug)]
pub struct CloudRenderer {
    pipeline: NightForms,
    half: HalfClouds,
    uniform: Buffer,
    sampler: wgpu::Sampler,
    volume: CloudVolume,
    splats: CloudSplats,
    shadow: CloudShadow,
    /// Light of sky and ground at the clouds' altitudes.
    light: SkyLightTable,
    /// Turbulence, from the first frame with clouds on.
    billows: Option<Texture>,
    billow_sampler: wgpu::Sampler,
    /// Copy of the frame without clouds: blending 32-bit floats is not everywhere possible.
    behind: Option<Texture>,
}

/// Bind groups of one frame's clouds.
#[derive(Debug)]
pub struct CloudDrawData {
    method: CloudMethod,
    pipeline: wgpu::RenderPipeline,
    bindings: [wgpu::BindGroup; 4],
    /// What lays clouds of half resolution over the frame.
    over: Option<wgpu::BindGroup>,
}

/// What clouds are drawn with.
#[derive(Clone, Copy, Debug)]
pub struct CloudSurroundings<'a> {
    /// The frame's uniform.
    pub frame: &'a Buffer,
    /// The sky's tables.
    pub tables: &'a SkyTables,
}

impl CloudRenderer {
    /// Makes the pipeline.
    ///
    /// # Errors
    /// When the shader is wrong or memory does not suffice.
    pub fn new(gpu: &Gpu, config: RendererConfig) -> Result<Self, RenderError> {
        let shader = Shader::load(gpu, "clouds/view.wgsl")?;
        let desc = RenderPipelineDesc {
            label: "clouds",
            vertex: "cloud_vertex",
            fragment: "cloud_fragment",
            targets: &[],
            depth: None,
            primitive: wgpu::PrimitiveState::default(),
            constants: &[],
        };
        let pipeline = NightForms::new(gpu, shader, desc, config.frame_format())?;
        let bytes = size_of::<Clouds>() as u64;
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("clouds"),
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..Default::default()
        });
        let billow_sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("turbulence of clouds"),
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::Repeat,
            address_mode_w: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        Ok(Self {
            pipeline,
            half: HalfClouds::new(gpu, config)?,
            billows: None,
            billow_sampler,
            uniform: gpu.buffer("clouds", bytes, BufferUsages::STORAGE | BufferUsages::COPY_DST)?,
            sampler,
            volume: CloudVolume::default(),
            splats: CloudSplats::new(gpu, config)?,
            shadow: CloudShadow::new(gpu)?,
            light: SkyLightTable::new(gpu)?,
            behind: None,
        })
    }

    /// Chooses whether frames wait for the simulation or show the clouds before meanwhile.
    pub fn set_building(&mut self, building: TableBuilding) {
        self.volume.set_building(building);
    }

    /// Chooses a state from which the simulation starts; see [`source::CloudSource::start_from`].
    pub fn start_from(&mut self, state: Option<NamedArrays>) {
        self.volume.start_from(state);
    }

    /// How the clouds stand after the last frame.
    #[must_use]
    pub fn progress(&self) -> &CloudProgress {
        self.volume.progress()
    }

    /// Simulates and binds the clouds of a grounded scene; `None` without clouds, or before a thread has made the first.
    ///
    /// # Errors
    /// When the scene has no sun position, the clouds' values do not fit together or memory does not suffice.
    pub fn prepare(
        &mut self,
        gpu: &Gpu,
        (encoder, timer): (&mut wgpu::CommandEncoder, &mut PassTimer),
        scene: &Scene,
        surroundings: CloudSurroundings<'_>,
        target: &FrameTarget,
    ) -> Result<Option<CloudDrawData>, RenderError> {
        self.shadow.update(gpu, None);
        let Some(request) = VolumeRequest::of(scene)? else {
            self.volume.rest();
            return Ok(None);
        };
        let Some(shown) = self.volume.update(gpu, &request)? else { return Ok(None) };
        let textures = &shown.textures;
        let drift = drift_cells(&shown.request.source, shown.matter.time_s);
        let uniform = Clouds::new(&scene.clouds, &shown.matter, shown.full_per_m, drift);
        gpu.queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&uniform));
        self.shadow.update(gpu, Some(&textures.shadow.1));
        let billows = match &mut self.billows {
            Some(billows) => billows,
            none => none.insert(billow_texture(gpu)?),
        };
        let behind = copy_of_frame(gpu, &mut self.behind, target)?;
        let tables = surroundings.tables;
        let reach = SkyLightReach {
            distance_m: 1e3 * scene.clouds.reach_km,
            top_altitude_m: f64::from(uniform.ceiling_m.max(uniform.floor_m)),
        };
        self.light.update(gpu, encoder, timer, tables, (scene, reach))?;
        let mut sky = tables.view_bindings().to_vec();
        sky.push(("irradiance_table", tables.irradiance.as_binding()));
        sky.extend(tables.moon_bindings());
        sky.extend(self.light.bindings());
        let shade = self.shadow.bindings(Some([&textures.shadow.0, &textures.cells]));
        // The march reads the cells itself.
        let shade: Vec<_> = shade.into_iter().filter(|(name, _)| *name != "cloud_shade_cells").collect();
        let mut own = vec![("clouds", self.uniform.as_entire_binding()), ("cloud_behind", behind.as_binding())];
        own.push(("cloud_depth", target.depth.as_binding()));
        // Clouds that were made to be marched are marched, until a thread has lit their balls.
        let method = if shown.balls.is_some() { scene.clouds.method } else { CloudMethod::Volume };
        let halves = method == CloudMethod::Volume && scene.clouds.resolution == CloudResolution::Half;
        let over = halves.then(|| self.half.bind(gpu, surroundings.frame, behind, target)).transpose()?;
        let pipeline = if method == CloudMethod::Splats {
            let (pipeline, [once, often]) = self.splats.prepare(gpu, target)?;
            own.extend([("splat_once", once.as_binding()), ("splat_often", often.as_binding())]);
            pipeline
        } else {
            own.extend([
                ("cloud_matter", textures.shares.as_binding()),
                ("cloud_cells", textures.cells.as_binding()),
                ("cloud_billows", billows.as_binding()),
                ("cloud_billow_sampler", wgpu::BindingResource::Sampler(&self.billow_sampler)),
                ("cloud_sampler", wgpu::BindingResource::Sampler(&self.sampler)),
                ("cloud_skips", textures.skips.as_binding()),
            ]);
            let forms = if halves { self.half.march() } else { &mut self.pipeline };
            forms.form(gpu, tables.is_night_drawn())?
        };
        let frame = [("frame", surroundings.frame.as_entire_binding())];
        let bindings = [
            pipeline.bind(gpu, 0, &sky)?,
            pipeline.bind(gpu, 1, &frame)?,
            pipeline.bind(gpu, 2, &own)?,
            pipeline.bind(gpu, 3, &shade)?,
        ];
        Ok(Some(CloudDrawData { method, pipeline: pipeline.raw().clone(), bindings, over }))
    }

    /// What `clouds/shadow.wgsl` needs, by the names of its variables: what the clouds of the last scene that was prepared
    /// leave of its light.
    #[must_use]
    pub fn shadow_bindings(&self) -> [(&'static str, wgpu::BindingResource<'_>); 4] {
        let shown = self.volume.shown().filter(|_| self.shadow.is_of_clouds());
        self.shadow.bindings(shown.map(|(shown, _)| [&shown.textures.shadow.0, &shown.textures.cells]))
    }

    /// Changes with what [`CloudRenderer::shadow_bindings`] hold; 0 without clouds.
    #[must_use]
    pub fn shadow_revision(&self) -> u64 {
        self.volume.shown().filter(|_| self.shadow.is_of_clouds()).map_or(0, |(_, revision)| revision)
    }

    /// Share of the sun's light that the clouds of the last scene that was prepared leave to a place (m).
    #[must_use]
    pub fn sunlight_left(&self, place_m: [f64; 3], to_sun: [f64; 3]) -> f64 {
        let shown = self.volume.shown().filter(|_| self.shadow.is_of_clouds());
        shown.map_or(1.0, |(shown, _)| (-optical_depth(&shown.matter, place_m, to_sun)).exp())
    }

    /// Draws what clouds of splats need, up to the depth of what was recorded so far; nothing for those that are marched. May
    /// submit what was recorded and begin the encoder anew.
    ///
    /// # Errors
    /// When memory does not suffice or the device is lost.
    pub fn draw_splats(
        &mut self,
        gpu: &Gpu,
        recording: (&mut wgpu::CommandEncoder, &mut PassTimer),
        (data, scene, view): (&CloudDrawData, &Scene, View),
        target: &FrameTarget,
    ) -> Result<(), RenderError> {
        let balls = self.volume.shown().and_then(|(shown, _)| shown.balls.as_ref());
        match balls.filter(|_| data.method == CloudMethod::Splats) {
            Some(balls) => self.splats.draw(gpu, recording, (balls, scene, view), target),
            None => Ok(()),
        }
    }

    /// Chooses who draws clouds of splats; at first the CPU where the adapter is a software one.
    pub fn set_splat_rasteriser(&mut self, rasteriser: SplatRasteriser) {
        self.splats.renderer_mut().set_rasteriser(rasteriser);
    }

    /// Records the clouds over what the target's frame shows.
    pub fn record(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timer: &mut PassTimer,
        data: &CloudDrawData,
        target: &FrameTarget,
    ) {
        let Some(behind) = &self.behind else { return };
        encoder.copy_texture_to_texture(target.frame.as_image_copy(), behind.as_image_copy(), behind.size());
        if let Some(over) = &data.over {
            self.half.record(encoder, timer, (&data.pipeline, &data.bindings, over), target);
            return;
        }
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("clouds"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: target.frame.view(),
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store },
            })],
            timestamp_writes: timer.render_writes("clouds"),
            ..Default::default()
        });
        pass.set_pipeline(&data.pipeline);
        for (index, group) in (0..).zip(&data.bindings) {
            pass.set_bind_group(index, group, &[]);
        }
        pass.draw(0..3, 0..1);
    }
}

/// A texture like the target's frame.
pub(crate) fn copy_of_frame<'a>(
    gpu: &Gpu,
    held: &'a mut Option<Texture>,
    target: &FrameTarget,
) -> Result<&'a Texture, RenderError> {
    let last = held.take().filter(|last| last.size() == target.frame.size());
    let texture = if let Some(texture) = last {
        texture
    } else {
        let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST;
        gpu.texture(&TextureDesc::new_2d("frame so far", target.size_px(), target.frame.format(), usage))?
    };
    Ok(held.insert(texture))
}

//! The frame: tables, ground and sky, metering, development.

use std::sync::Arc;

use tyndall_core::array::NamedArrays;
use tyndall_core::table_store::TableStore;
use tyndall_dunes::DuneStepper;
use tyndall_gpu::wgpu::{self, BufferUsages};
use tyndall_gpu::{Buffer, Gpu, PassTimer, PassTiming};
use tyndall_scattering::dome::Dome;
use tyndall_scattering::orders::OrdersQuality;
use tyndall_scene::{Orders, OrdersDetail, Scene};

use crate::aerial::{AerialRequest, AerialVolume};
use crate::clouds::{CloudDrawData, CloudProgress, CloudRenderer, CloudSurroundings};
use crate::desert::mesh::Fineness as DesertFineness;
use crate::desert::{DesertDrawData, DesertProgress, DesertRenderer};
use crate::develop::DevelopRenderer;
use crate::exposure::ev100_from_gain;
use crate::frame::{frame_uniform, gpu_data};
use crate::landscape::{LandscapeDrawData, LandscapeRenderer, LandscapeSurroundings};
use crate::sky::gpu_data::{Atmosphere as AtmosphereUniform, SkyView};
use crate::sky::{OrdersRequest, SkyLightTable, SkyRenderer, SkyTables, TableBuilding, TableProgress};
use crate::splats::SplatRasteriser;
use crate::{FrameTarget, RenderError, RendererConfig, View};

/// Passes that a frame can have: five tables, light on surfaces and clouds, the air, three of the landscape, the desert's mesh, scene, blowing sand, clouds, meter, development.
const TIMED_PASSES: u32 = 19;

/// Draws scenes. All pipelines are made at once, so that a wrong shader shows at the start.
#[derive(Debug)]
pub struct Renderer {
    config: RendererConfig,
    frame: Buffer,
    tables: SkyTables,
    light: SkyLightTable,
    air: AerialVolume,
    sky: SkyRenderer,
    landscape: LandscapeRenderer,
    desert: DesertRenderer,
    clouds: CloudRenderer,
    develop: DevelopRenderer,
    timer: PassTimer,
    pre_exposure: f32,
}

impl Renderer {
    /// Makes all pipelines.
    ///
    /// # Errors
    /// When a shader is wrong, memory does not suffice or the device is lost.
    pub fn new(gpu: &Gpu, config: RendererConfig) -> Result<Self, RenderError> {
        let frame_bytes = size_of::<gpu_data::Frame>() as u64;
        Ok(Self {
            config,
            frame: gpu.buffer("frame", frame_bytes, BufferUsages::UNIFORM | BufferUsages::COPY_DST)?,
            tables: SkyTables::new(gpu)?,
            light: SkyLightTable::new(gpu)?,
            air: AerialVolume::new(gpu)?,
            sky: SkyRenderer::new(gpu, config)?,
            landscape: LandscapeRenderer::new(gpu, config)?,
            desert: DesertRenderer::new(gpu, config)?,
            clouds: CloudRenderer::new(gpu, config)?,
            develop: DevelopRenderer::new(gpu, config)?,
            timer: PassTimer::new(gpu, TIMED_PASSES)?,
            pre_exposure: 1.0,
        })
    }

    /// Records and submits one frame of the scene's camera. Tables are rebuilt only when their inputs changed.
    ///
    /// # Errors
    /// When the scene's values do not fit together, the target belongs to another configuration, memory does not
    /// suffice or the device is lost.
    pub fn render(
        &mut self,
        gpu: &Gpu,
        scene: &Scene,
        target: &mut FrameTarget,
    ) -> Result<wgpu::SubmissionIndex, RenderError> {
        self.render_view(gpu, scene, View::Camera, target)
    }

    /// Records and submits one frame of a view from the place of the scene's camera. A panorama is not developed: its
    /// target's picture stays as it was.
    ///
    /// # Errors
    /// As [`Renderer::render`].
    pub fn render_view(
        &mut self,
        gpu: &Gpu,
        scene: &Scene,
        view: View,
        target: &mut FrameTarget,
    ) -> Result<wgpu::SubmissionIndex, RenderError> {
        if target.config != self.config {
            return Err(RenderError::Configuration { target: target.config, renderer: self.config });
        }
        scene.check()?;
        let scene = &self.grounded(scene)?;
        let frame = frame_uniform(scene, view, target.size_px(), self.config)?;
        gpu.queue.write_buffer(&self.frame, 0, bytemuck::bytes_of(&frame));
        self.pre_exposure = frame.pre_exposure;
        target.pre_exposure = frame.pre_exposure;

        self.timer.begin_frame();
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("frame") });
        let model = scene.model();
        let uniforms = (AtmosphereUniform::new(&model, scene.sun.brightness)?, SkyView::new(scene, &model)?);
        let orders = OrdersRequest { model: &model, quality: orders_quality(scene), brightness: scene.sun.brightness };
        self.tables.update_night(gpu, scene, &model, (&frame, pixel_angle(&frame)))?;
        self.tables.update(gpu, &mut encoder, &mut self.timer, uniforms, &orders)?;
        let clouds = self.prepare_clouds(gpu, &mut encoder, scene, target)?;
        let landscape = self.prepare_landscape(gpu, &mut encoder, (scene, view), &frame)?;
        let desert = self.prepare_desert(gpu, &mut encoder, (scene, view), &frame)?;
        self.record_scene(gpu, &mut encoder, (scene, landscape, desert.as_ref()), target)?;
        if let Some(desert) = &desert {
            self.desert.record_blowing(gpu, (&mut encoder, &mut self.timer), desert, target)?;
        }
        if let Some(clouds) = &clouds {
            let recording = (&mut encoder, &mut self.timer);
            self.clouds.draw_splats(gpu, recording, (clouds, scene, view), target)?;
            self.clouds.record(&mut encoder, &mut self.timer, clouds, target);
        }
        if view != View::Panorama {
            let data = self.develop.prepare(gpu, &self.frame, target)?;
            self.develop.record(&mut encoder, &mut self.timer, &data, target);
        }
        self.timer.resolve(&mut encoder);
        let submission = gpu.queue.submit([encoder.finish()]);
        gpu.check()?;
        Ok(submission)
    }

    fn record_scene(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        (scene, landscape, desert): (&Scene, Option<LandscapeDrawData>, Option<&DesertDrawData>),
        target: &FrameTarget,
    ) -> Result<(), RenderError> {
        let dome = Dome { rings: scene.sky.dome_rings, segments: scene.sky.dome_segments };
        let sky = self.sky.prepare(gpu, (&self.tables, &self.clouds), &self.frame, (scene.sky.mode, dome))?;
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("sky and ground"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: target.frame.view(),
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: target.depth.view(),
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Store }),
                stencil_ops: None,
            }),
            timestamp_writes: self.timer.render_writes("sky and ground"),
            ..Default::default()
        });
        if let Some(landscape) = &landscape {
            self.landscape.draw(&mut pass, landscape);
        }
        if let Some(desert) = desert {
            DesertRenderer::draw(&mut pass, desert);
        }
        SkyRenderer::draw(&mut pass, &sky);
        Ok(())
    }

    /// Records what the landscape needs, the light on it included.
    fn prepare_landscape(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        (scene, view): (&Scene, View),
        frame: &gpu_data::Frame,
    ) -> Result<Option<LandscapeDrawData>, RenderError> {
        let size_px = frame.size_px;
        let Some(reach) = crate::landscape::reach(scene, view, size_px) else { return Ok(None) };
        self.light.update(gpu, encoder, &mut self.timer, &self.tables, (scene, reach))?;
        let request = AerialRequest { scene, reach, frame: (frame, &self.frame), clouds: &self.clouds };
        self.air.update(gpu, encoder, &mut self.timer, &self.tables, request)?;
        let surroundings = LandscapeSurroundings {
            frame: &self.frame,
            tables: &self.tables,
            light: &self.light,
            air: &self.air,
            clouds: &self.clouds,
        };
        self.landscape.prepare(gpu, encoder, &mut self.timer, (scene, view, size_px), surroundings)
    }

    /// Records what the desert needs, the light on it included.
    fn prepare_desert(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        (scene, view): (&Scene, View),
        frame: &gpu_data::Frame,
    ) -> Result<Option<DesertDrawData>, RenderError> {
        let size_px = frame.size_px;
        let Some(reach) = self.desert.reach(scene, view, size_px) else { return Ok(None) };
        self.light.update(gpu, encoder, &mut self.timer, &self.tables, (scene, reach))?;
        let request = AerialRequest { scene, reach, frame: (frame, &self.frame), clouds: &self.clouds };
        self.air.update(gpu, encoder, &mut self.timer, &self.tables, request)?;
        let surroundings = LandscapeSurroundings {
            frame: &self.frame,
            tables: &self.tables,
            light: &self.light,
            air: &self.air,
            clouds: &self.clouds,
        };
        self.desert.prepare(gpu, encoder, &mut self.timer, (scene, view, size_px), surroundings)
    }

    /// The scene with its camera at its height over what it stands on: the landscape, or the sand.
    fn grounded(&mut self, scene: &Scene) -> Result<Scene, RenderError> {
        let mut scene = scene.grounded();
        if let Some(ground_m) = self.desert.simulate(&scene)? {
            scene.camera.altitude_m += ground_m;
        }
        Ok(scene)
    }

    /// Simulates and binds the clouds.
    fn prepare_clouds(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        scene: &Scene,
        target: &FrameTarget,
    ) -> Result<Option<CloudDrawData>, RenderError> {
        let surroundings = CloudSurroundings { frame: &self.frame, tables: &self.tables };
        self.clouds.prepare(gpu, (encoder, &mut self.timer), scene, surroundings, target)
    }

    /// GPU time of each pass of the last frame; waits for it. Empty where the adapter has no timestamps.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn timings(&mut self, gpu: &Gpu) -> Result<Vec<PassTiming>, RenderError> {
        Ok(self.timer.read(gpu)?)
    }

    /// GPU times of a frame that has come back since the last call; never waits.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn poll_timings(&mut self, gpu: &Gpu) -> Result<Option<Vec<PassTiming>>, RenderError> {
        Ok(self.timer.poll(gpu)?)
    }

    /// Exposure value at ISO 100 of the last frame, metered or manual.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn read_ev100(&self, gpu: &Gpu) -> Result<f64, RenderError> {
        let gain = f64::from(self.develop.read_gain(gpu)?) * f64::from(self.pre_exposure);
        Ok(ev100_from_gain(gain))
    }

    /// Precision of frames and pictures.
    #[must_use]
    pub fn config(&self) -> RendererConfig {
        self.config
    }

    /// The sky's tables, for tests and plots.
    #[must_use]
    pub fn tables(&self) -> &SkyTables {
        &self.tables
    }

    /// Chooses where slow tables are kept between runs; nowhere unless chosen. A software adapter's table of all orders of
    /// scattering is such a table; GPUs make theirs faster than a file is read. A kept table has the bits of a new one.
    pub fn set_table_store(&mut self, store: Option<Arc<dyn TableStore>>) {
        self.desert.set_store(store.clone());
        self.tables.set_store(store);
    }

    /// Chooses a state from which the clouds' simulation starts, in place of its beginning and its warm-up.
    pub fn start_clouds_from(&mut self, state: Option<NamedArrays>) {
        self.clouds.start_from(state);
    }

    /// Chooses a state from which the desert's simulation starts in place of step 0, where the scene's step is not before it.
    pub fn start_desert_from(&mut self, state: Option<NamedArrays>) {
        self.desert.start_from(state);
    }

    /// Chooses who makes the dunes' steps; the processor unless chosen, and where the device cannot. The sand is the same.
    pub fn set_dune_stepper(&mut self, device: Option<Box<dyn DuneStepper>>) {
        self.desert.set_stepper(device);
    }

    /// Chooses whether the desert's sand is under way, so that each picture of it is soon followed by another. Light
    /// on such a picture is that of coarser cells, ripples are slopes alone, the camera follows the sand in small steps, and figures
    /// of the field are up to half a second old; sand is exact.
    pub fn set_sand_under_way(&mut self, is_under_way: bool) {
        self.desert.set_quick(is_under_way);
    }

    /// Chooses how fine the desert's mesh is where its sand is at rest, for tests.
    pub fn set_desert_fineness(&mut self, fineness: DesertFineness) {
        self.desert.set_fineness(fineness);
    }

    /// The volume of air in front of the camera, for tests and compositors.
    #[must_use]
    pub fn air(&self) -> &AerialVolume {
        &self.air
    }

    /// The clouds, and what they leave of the light.
    #[must_use]
    pub fn clouds(&self) -> &CloudRenderer {
        &self.clouds
    }

    /// The landscape, for tests.
    #[must_use]
    pub fn landscape(&self) -> &LandscapeRenderer {
        &self.landscape
    }

    /// Chooses when the slow table of all orders, the clouds and the desert are made; at first the frame waits for them.
    pub fn set_table_building(&mut self, building: TableBuilding) {
        self.clouds.set_building(building.clone());
        self.desert.set_building(building.clone());
        self.tables.set_building(building);
    }

    /// How the clouds stand after the last frame.
    #[must_use]
    pub fn cloud_progress(&self) -> &CloudProgress {
        self.clouds.progress()
    }

    /// How the desert stands after the last frame.
    #[must_use]
    pub fn desert_progress(&self) -> &DesertProgress {
        self.desert.progress()
    }

    /// How the table of all orders stands after the last frame.
    #[must_use]
    pub fn table_progress(&self) -> TableProgress {
        self.tables.orders().progress()
    }

    /// Chooses who draws clouds of splats, for tests and timings.
    pub fn set_splat_rasteriser(&mut self, rasteriser: SplatRasteriser) {
        self.clouds.set_splat_rasteriser(rasteriser);
    }

    /// Forgets the tables, so that the next frame fills them again; for timing.
    pub fn invalidate_tables(&mut self) {
        self.tables.invalidate();
        self.air.invalidate();
    }
}

/// Width (rad) of the largest pixel of a frame.
fn pixel_angle(frame: &gpu_data::Frame) -> f64 {
    let [width, height] = frame.size_px.map(f64::from);
    if frame.projection == 1 {
        return std::f64::consts::PI * (2.0 / width).max(1.0 / height);
    }
    if frame.projection == 2 {
        // No angle: all lines of sight are parallel, and no star is drawn.
        return 1e-3;
    }
    (2.0 * f64::from(frame.tan_half_width) / width).max(2.0 * f64::from(frame.tan_half_height) / height)
}

/// How finely the orders beyond the first are computed; `None` for the first alone.
fn orders_quality(scene: &Scene) -> Option<OrdersQuality> {
    match (scene.sky.orders, scene.sky.orders_detail) {
        (Orders::Single, _) => None,
        (Orders::Nishita1996, _) => Some(OrdersQuality::nishita1996()),
        (Orders::All, OrdersDetail::Preview) => Some(OrdersQuality::preview()),
        (Orders::All, OrdersDetail::Best) => Some(OrdersQuality::best()),
    }
}

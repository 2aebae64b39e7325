//! The desert: dunes and ripples of sand in the light of the sky. WGSL: `shaders/desert`.
//!
//! The field of dunes is simulated up to the scene's step when it is first drawn, or goes on from the step before. Its heights
//! are smooth splines ([`bed`]), drawn as a mesh of rings around the camera ([`mesh`]) with the exact slope at each pixel;
//! ripples are slopes and heights ([`ripple_tile`]), which hide and shade each other near the
//! camera. The sun's shadow and the sky's openness come from horizons of the field, which a
//! periodic field repeats to the planet's horizon.
//!
//! At night the moon lights it and casts the shadows.
//!
//! Not done: ripples do not change the outline of the sand.

pub mod bed;
mod blowing;
mod building;
pub mod gpu_data;
mod kept;
mod light;
mod maker;
pub mod mesh;
pub mod reflection;
pub mod report;
pub mod ripple_tile;
mod shared_stepper;
mod source;
mod streaks;
pub mod sun_horizon;
mod textures;

use std::sync::Arc;

use tyndall_core::array::NamedArrays;
use tyndall_core::table_store::TableStore;
use tyndall_dunes::DuneStepper;
use tyndall_gpu::wgpu::{self, BufferUsages};
use tyndall_gpu::{Buffer, ComputePipeline, Gpu, PassTimer, RenderPipeline, RenderPipelineDesc, Shader, Texture};
use tyndall_scene::Scene;

use crate::clouds::lamp::Lamp;
use crate::landscape::LandscapeSurroundings;
use crate::night_forms::NightForms;
use crate::sky::{SkyLightReach, TableBuilding};
use crate::target::DEPTH_FORMAT;
use crate::{FrameTarget, RenderError, RendererConfig, View};
use bed::Bed;
use blowing::BlowingRenderer;
use gpu_data::Desert;
use mesh::{DesertMesh, Fineness};
use source::BedSource;
pub use source::DesertProgress;
use textures::{BedTextures, light_texture, sampler, tile_textures};

/// Bytes of a vertex.
const VERTEX_BYTES: u64 = 16;

/// How far the sand under a camera may move before the camera follows, while sand is under way, of the camera's height over it.
const QUICK_STEP: f64 = 0.05;

/// What a map of light is of: the bed's revision, the direction to sun or moon (azimuth from east, elevation), and whether it
/// was made quickly.
type LightKey = (u64, [f64; 2], bool);

/// Pipelines, maps and meshes of the desert.
#[derive(Debug)]
pub struct DesertRenderer {
    fill_mesh: ComputePipeline,
    dunes: NightForms,
    uniform: Buffer,
    source: BedSource,
    blowing: BlowingRenderer,
    /// Maps of the bed, and its revision.
    bed: Option<(u64, BedTextures)>,
    /// Textures of the tile of ripples, and its revision.
    tile: Option<(u64, [Texture; 3])>,
    tile_sampler: wgpu::Sampler,
    /// Light of the sun or the moon.
    light: Option<(LightKey, Texture)>,
    vertices: Option<Buffer>,
    /// What the vertices were computed for, and from where.
    holds: Option<(u64, Desert, [f32; 3])>,
    /// Bits of the place where the camera stands, and the altitude (m) of the sand there.
    stands: Option<([u64; 2], f64)>,
    /// Of meshes of sand at rest.
    fineness: Fineness,
}

/// What is drawn of a frame's desert.
#[derive(Debug)]
pub struct DesertDrawData {
    pipeline: wgpu::RenderPipeline,
    groups: [wgpu::BindGroup; 4],
    mesh: DesertMesh,
    /// What sand in the air reads; `None` without any.
    blowing: Option<blowing::Surroundings>,
}

impl DesertRenderer {
    /// Makes the pipelines.
    ///
    /// # Errors
    /// When a shader is wrong or memory does not suffice.
    pub fn new(gpu: &Gpu, config: RendererConfig) -> Result<Self, RenderError> {
        let depth = wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::GreaterEqual),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        };
        let dunes = NightForms::new(
            gpu,
            Shader::load(gpu, "desert/dunes.wgsl")?,
            RenderPipelineDesc {
                label: "dunes",
                vertex: "dunes_vertex",
                fragment: "dunes_fragment",
                targets: &[],
                depth: Some(depth),
                primitive: wgpu::PrimitiveState {
                    topology: wgpu::PrimitiveTopology::TriangleStrip,
                    // Seen from above strips turn to the left. Slopes that face away are hidden by their crests.
                    front_face: wgpu::FrontFace::Ccw,
                    cull_mode: Some(wgpu::Face::Back),
                    ..wgpu::PrimitiveState::default()
                },
                constants: &[],
            },
            config.frame_format(),
        )?;
        let bytes = size_of::<Desert>() as u64;
        Ok(Self {
            fill_mesh: ComputePipeline::new(gpu, &Shader::load(gpu, "desert/mesh.wgsl")?, "desert_mesh", &[])?,
            dunes,
            uniform: gpu.buffer("desert", bytes, BufferUsages::STORAGE | BufferUsages::COPY_DST)?,
            source: BedSource::default(),
            blowing: BlowingRenderer::new(gpu, config)?,
            bed: None,
            tile: None,
            tile_sampler: sampler(gpu, wgpu::AddressMode::Repeat),
            light: None,
            vertices: None,
            holds: None,
            stands: None,
            fineness: Fineness::Fine,
        })
    }

    /// Chooses where simulated fields are kept between runs; nowhere unless chosen.
    pub fn set_store(&mut self, store: Option<Arc<dyn TableStore>>) {
        self.source.set_store(store);
    }

    /// Chooses a state to start from in place of step 0, for all steps that are not before it.
    pub fn start_from(&mut self, state: Option<NamedArrays>) {
        self.source.start_from(state);
    }

    /// Chooses who makes the dunes' steps: the processor, or a device that gives the same bits.
    pub fn set_stepper(&mut self, device: Option<Box<dyn DuneStepper>>) {
        self.source.set_stepper(device);
    }

    /// Chooses whether pictures of the desert are soon followed by others; see [`Bed::quick`].
    pub fn set_quick(&mut self, is_quick: bool) {
        self.source.set_quick(is_quick);
    }

    /// Chooses how fine meshes of sand at rest are, for tests.
    pub fn set_fineness(&mut self, fineness: Fineness) {
        self.fineness = fineness;
    }

    /// Chooses when the desert is simulated; at first the frame waits for it.
    pub fn set_building(&mut self, building: TableBuilding) {
        self.source.set_building(building);
    }

    /// How the desert stands after the last frame.
    #[must_use]
    pub fn progress(&self) -> &DesertProgress {
        self.source.progress()
    }

    /// Simulates the scene's desert up to its step, and forgets the last one when the scene has none. Returns the altitude (m)
    /// of the sand under the camera.
    ///
    /// # Errors
    /// When parameters do not fit together or a file cannot be read.
    pub fn simulate(&mut self, scene: &Scene) -> Result<Option<f64>, RenderError> {
        self.source.update(scene)?;
        let camera = &scene.camera;
        let place = [camera.x_m, camera.y_m].map(f64::to_bits);
        let ground_m = self.source.bed().map(|bed| bed.at(camera.x_m, camera.y_m)[0]);
        let held_m = self.stands.filter(|(held, _)| self.source.is_quick() && *held == place).map(|(_, held_m)| held_m);
        let stands_m = ground_m.map(|ground_m| {
            // Air and light of all the picture would have to be made anew for each millimetre.
            held_m.filter(|held_m| (held_m - ground_m).abs() < QUICK_STEP * camera.altitude_m).unwrap_or(ground_m)
        });
        self.stands = stands_m.map(|stands_m| (place, stands_m));
        Ok(stands_m)
    }

    /// How far the light on the desert of the last simulation must reach.
    #[must_use]
    pub fn reach(&self, scene: &Scene, view: View, size_px: [u32; 2]) -> Option<SkyLightReach> {
        let bed = self.source.bed()?;
        let mesh = self.mesh(scene, view, size_px, bed);
        Some(SkyLightReach { distance_m: mesh.far_radius_m, top_altitude_m: self.highest_m(bed) })
    }

    /// Records what the desert of a grounded scene needs before it is drawn; `None` without one.
    ///
    /// # Errors
    /// When the scene has no sun position or memory does not suffice.
    pub fn prepare(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        timer: &mut PassTimer,
        (scene, view, size_px): (&Scene, View, [u32; 2]),
        surroundings: LandscapeSurroundings<'_>,
    ) -> Result<Option<DesertDrawData>, RenderError> {
        let (Some(bed), Some(tile)) = (self.source.bed(), self.source.tile()) else { return Ok(None) };
        let mesh = self.mesh(scene, view, size_px, bed);
        let lamp = Lamp::of(scene)?;
        let mut uniform = Desert::new(scene, bed.heights.size(), tile.scale, &mesh, lamp.is_moon);
        if self.source.is_quick() {
            // Slopes of ripples alone show that they are there.
            uniform.relief = 0.0;
        }
        gpu.queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&uniform));
        self.update_maps(gpu, lamp)?;
        self.update_mesh(gpu, encoder, timer, (scene, &mesh, &uniform), surroundings.frame)?;
        let Some((pipeline, groups)) = self.bind(gpu, surroundings)? else { return Ok(None) };
        let blowing = self.prepare_blowing(gpu, scene, lamp, surroundings)?;
        Ok(Some(DesertDrawData { pipeline, groups, mesh, blowing }))
    }

    /// Uploads what has changed of bed, ripples and light.
    fn update_maps(&mut self, gpu: &Gpu, lamp: Lamp) -> Result<(), RenderError> {
        let (Some(bed), Some(tile)) = (self.source.bed(), self.source.tile()) else { return Ok(()) };
        let [of_bed, of_tile] = self.source.revisions();
        if self.bed.as_ref().is_none_or(|(revision, _)| *revision != of_bed) {
            self.bed = Some((of_bed, BedTextures::new(gpu, bed)?));
        }
        if self.tile.as_ref().is_none_or(|(revision, _)| *revision != of_tile) {
            self.tile = Some((of_tile, tile_textures(gpu, tile)?));
        }
        let [east, north, up] = lamp.direction;
        let toward = [north.atan2(east), up.atan2(east.hypot(north))];
        let key = (of_bed, toward, self.source.is_quick());
        if self.light.as_ref().is_none_or(|(held, _)| *held != key) {
            // Horizons of wider cells do for a moment.
            let (size, map) = if self.source.is_quick() {
                light::quick_light_map(bed, toward[0], toward[1])?
            } else {
                let size = bed.heights.size();
                let fineness = sun_horizon::fineness(size);
                let map = light::light_map(bed, toward[0], toward[1])?;
                let map = sun_horizon::with_fine_horizons(bed, &map, toward[0], fineness)?;
                (size.map(|count| count * fineness), map)
            };
            self.light = Some((key, light_texture(gpu, size, &map)?));
        }
        Ok(())
    }

    fn bind(
        &mut self,
        gpu: &Gpu,
        surroundings: LandscapeSurroundings<'_>,
    ) -> Result<Option<(wgpu::RenderPipeline, [wgpu::BindGroup; 4])>, RenderError> {
        let (Some((_, bed)), Some((_, tile)), Some((_, light))) = (&self.bed, &self.tile, &self.light) else {
            return Ok(None);
        };
        let Some(vertices) = &self.vertices else { return Ok(None) };
        let own = [
            ("desert", self.uniform.as_entire_binding()),
            ("bed_heights", bed.heights.as_entire_binding()),
            ("dune_vertices", vertices.as_entire_binding()),
            ("dune_light", light.as_binding()),
            ("ripple_tile", tile[0].as_binding()),
            ("ripple_cross", tile[1].as_binding()),
            ("ripple_heights", tile[2].as_binding()),
            ("ripple_winds", bed.winds.as_binding()),
            ("desert_sampler", wgpu::BindingResource::Sampler(&bed.sampler)),
            ("ripple_sampler", wgpu::BindingResource::Sampler(&self.tile_sampler)),
        ];
        let dunes = self.dunes.form(gpu, surroundings.tables.is_night_drawn())?;
        let [sky, frame, shade] = bind_surroundings(gpu, dunes, surroundings)?;
        Ok(Some((dunes.raw().clone(), [sky, frame, dunes.bind(gpu, 2, &own)?, shade])))
    }

    /// Makes what sand in the air needs; `None` without any.
    fn prepare_blowing(
        &mut self,
        gpu: &Gpu,
        scene: &Scene,
        lamp: Lamp,
        surroundings: LandscapeSurroundings<'_>,
    ) -> Result<Option<blowing::Surroundings>, RenderError> {
        let [revision, _] = self.source.revisions();
        let Some(bed) = self.source.bed() else { return Ok(None) };
        let flies = self.blowing.prepare(gpu, scene, (revision, bed), lamp)?;
        flies.then(|| bind_surroundings(gpu, self.blowing.pipeline(), surroundings)).transpose()
    }

    /// Records sand in the air over what the target's frame shows; nothing where there is none.
    ///
    /// # Errors
    /// When memory does not suffice.
    pub fn record_blowing(
        &mut self,
        gpu: &Gpu,
        recording: (&mut wgpu::CommandEncoder, &mut PassTimer),
        data: &DesertDrawData,
        target: &FrameTarget,
    ) -> Result<(), RenderError> {
        let (Some(surroundings), Some((_, bed))) = (&data.blowing, &self.bed) else { return Ok(()) };
        self.blowing.record(gpu, recording, (surroundings, &self.uniform, &bed.sampler), target)
    }

    fn update_mesh(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        timer: &mut PassTimer,
        (scene, mesh, uniform): (&Scene, &DesertMesh, &Desert),
        frame: &Buffer,
    ) -> Result<(), RenderError> {
        let Some((revision, bed)) = &self.bed else { return Ok(()) };
        #[expect(clippy::cast_possible_truncation, reason = "as the shaders get it")]
        let from = [scene.camera.x_m, scene.camera.y_m, scene.camera.altitude_m].map(|at_m| at_m as f32);
        let wanted = Some((*revision, *uniform, from));
        let bytes = u64::from(mesh.vertices()) * VERTEX_BYTES;
        let fits = self.vertices.as_ref().is_some_and(|buffer| buffer.bytes() >= bytes);
        if fits && self.holds == wanted {
            return Ok(());
        }
        if !fits {
            self.vertices = Some(gpu.buffer("desert vertices", bytes, BufferUsages::STORAGE)?);
        }
        let Some(vertices) = &self.vertices else { return Ok(()) };
        let own = [
            ("desert", self.uniform.as_entire_binding()),
            ("desert_vertices", vertices.as_entire_binding()),
            ("bed_heights", bed.heights.as_entire_binding()),
        ];
        let frame = self.fill_mesh.bind(gpu, 1, &[("frame", frame.as_entire_binding())])?;
        let own = self.fill_mesh.bind(gpu, 2, &own)?;
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("desert mesh"),
            timestamp_writes: timer.compute_writes("desert mesh"),
        });
        pass.set_bind_group(1, &frame, &[]);
        pass.set_bind_group(2, &own, &[]);
        self.fill_mesh.dispatch(&mut pass, [mesh.columns, mesh.rings, 1]);
        drop(pass);
        self.holds = wanted;
        Ok(())
    }

    /// Altitude (m) that no sand is above; while sand is under way in steps, so that what reaches so far need not be made anew.
    fn highest_m(&self, bed: &Bed) -> f64 {
        let highest_m = bed.highest_m();
        if self.source.is_quick() { highest_m.max(1.0).log2().ceil().exp2() } else { highest_m }
    }

    fn mesh(&self, scene: &Scene, view: View, size_px: [u32; 2], bed: &Bed) -> DesertMesh {
        let camera = &scene.camera;
        let clearance_m = camera.altitude_m - bed.at(camera.x_m, camera.y_m)[0];
        let fineness = if self.source.is_quick() { Fineness::Quick } else { self.fineness };
        DesertMesh::new((scene, view, size_px), (clearance_m, self.highest_m(bed)), fineness)
    }

    /// Draws the desert; first of all, for it hides most of what is behind it.
    pub fn draw(pass: &mut wgpu::RenderPass<'_>, data: &DesertDrawData) {
        pass.set_pipeline(&data.pipeline);
        for (index, group) in (0..).zip(&data.groups) {
            pass.set_bind_group(index, group, &[]);
        }
        pass.draw(0..2 * data.mesh.columns, data.mesh.first_ring..data.mesh.rings - 1);
    }
}

/// Binds what a pipeline reads of sky, air, frame and clouds.
fn bind_surroundings(
    gpu: &Gpu,
    pipeline: &RenderPipeline,
    surroundings: LandscapeSurroundings<'_>,
) -> Result<blowing::Surroundings, RenderError> {
    let tables = surroundings.tables;
    let mut sky =
        vec![("atmosphere", tables.atmosphere.as_entire_binding()), ("sky_view", tables.view.as_entire_binding())];
    sky.extend([("column_table", tables.columns.as_binding()), ("irradiance_table", tables.irradiance.as_binding())]);
    // The air, not the sand, shows the sky that the moon lights.
    sky.extend(tables.moon_bindings().into_iter().filter(|(name, _)| *name == "moon"));
    sky.extend(surroundings.light.bindings());
    sky.extend(surroundings.air.bindings());
    let frame = [("frame", surroundings.frame.as_entire_binding())];
    let shade = surroundings.clouds.shadow_bindings();
    Ok([pipeline.bind(gpu, 0, &sky)?, pipeline.bind(gpu, 1, &frame)?, pipeline.bind(gpu, 3, &shade)?])
}

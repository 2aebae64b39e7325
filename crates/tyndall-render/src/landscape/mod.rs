//! Terrain: geometry to see air by. WGSL: `shaders/landscape`.
//!
//! The heights are functions of the place (`tyndall_scene::landscape`), which the shaders compute too: for the vertices of a
//! mesh of rings around the camera, and again, with their exact slope, at each pixel. Light comes from
//! [`SkyLightTable`], shadows of terrain from a map of the whole square. Places lie on the curved
//! planet, so that the landscape meets the sky's horizon.
//!
//! Shadows do not see the planet's curvature (0.3 degrees over 30 km), nor is light that one slope throws on another.

pub mod gpu_data;
pub mod mesh;
mod shadow;

use tyndall_gpu::wgpu::{self, BufferUsages};
use tyndall_gpu::{Buffer, ComputePipeline, Gpu, PassTimer, RenderPipeline, RenderPipelineDesc, Shader, Texture};
use tyndall_scene::Scene;
use tyndall_scene::landscape::Landscape as Model;

use crate::aerial::AerialVolume;
use crate::clouds::CloudRenderer;
use crate::sky::{SkyLightReach, SkyLightTable, SkyTables};
use crate::target::DEPTH_FORMAT;
use crate::{RenderError, RendererConfig, View};
use gpu_data::Landscape;
use mesh::Mesh;
use shadow::{ShadowMap, compute_pass};

/// Bytes of a vertex.
const VERTEX_BYTES: u64 = 16;

/// Pipelines and meshes of the landscape.
#[derive(Debug)]
pub struct LandscapeRenderer {
    fill_mesh: ComputePipeline,
    terrain: RenderPipeline,
    uniform: Buffer,
    vertices: Option<Buffer>,
    shadows: ShadowMap,
    /// What the vertices were computed for, and from where.
    holds: Option<(Landscape, [f32; 3])>,
}

/// What is drawn of a frame's landscape.
#[derive(Debug)]
pub struct LandscapeDrawData {
    terrain: [wgpu::BindGroup; 4],
    mesh: Mesh,
}

/// What a landscape is drawn with.
#[derive(Clone, Copy, Debug)]
pub struct LandscapeSurroundings<'a> {
    /// The frame's uniform.
    pub frame: &'a Buffer,
    /// The sky's tables.
    pub tables: &'a SkyTables,
    /// Light on surfaces, filled for [`reach`].
    pub light: &'a SkyLightTable,
    /// Air in front of the camera, filled for [`reach`].
    pub air: &'a AerialVolume,
    /// The clouds, prepared for the scene.
    pub clouds: &'a CloudRenderer,
}

/// How far the light on the landscape of a grounded scene must reach; `None` without a landscape in sight.
#[must_use]
pub fn reach(scene: &Scene, view: View, size_px: [u32; 2]) -> Option<SkyLightReach> {
    let model = Model::new(&scene.landscape);
    let mesh = Mesh::new(scene, &model, view, size_px)?;
    Some(SkyLightReach { distance_m: mesh.far_radius_m, top_altitude_m: model.highest_m() })
}

impl LandscapeRenderer {
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
        let terrain = RenderPipeline::new(
            gpu,
            &Shader::load(gpu, "landscape/terrain.wgsl")?,
            &RenderPipelineDesc {
                label: "terrain",
                vertex: "terrain_vertex",
                fragment: "terrain_fragment",
                targets: &[config.frame_format().into()],
                depth: Some(depth),
                primitive: wgpu::PrimitiveState {
                    topology: wgpu::PrimitiveTopology::TriangleStrip,
                    ..wgpu::PrimitiveState::default()
                },
                constants: &[],
            },
        )?;
        let bytes = size_of::<Landscape>() as u64;
        Ok(Self {
            fill_mesh: ComputePipeline::new(gpu, &Shader::load(gpu, "landscape/mesh.wgsl")?, "landscape_mesh", &[])?,
            terrain,
            uniform: gpu.buffer("landscape", bytes, BufferUsages::UNIFORM | BufferUsages::COPY_DST)?,
            vertices: None,
            shadows: ShadowMap::new(gpu)?,
            holds: None,
        })
    }

    /// Records what the landscape of a grounded scene needs before it is drawn; `None` when none is in sight.
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
    ) -> Result<Option<LandscapeDrawData>, RenderError> {
        let model = Model::new(&scene.landscape);
        let Some(mesh) = Mesh::new(scene, &model, view, size_px) else { return Ok(None) };
        let uniform = Landscape::new(&model, (&scene.landscape, &scene.ground), &scene.sun_direction()?, &mesh);
        gpu.queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&uniform));
        self.update_mesh(gpu, encoder, timer, (scene, &mesh, &uniform), surroundings.frame)?;
        self.shadows.update(gpu, encoder, timer, (&self.uniform, &uniform))?;
        let (Some(vertices), Some(shadows)) = (&self.vertices, self.shadows.map()) else { return Ok(None) };
        let tables = surroundings.tables;
        let mut sky =
            vec![("atmosphere", tables.atmosphere.as_entire_binding()), ("sky_view", tables.view.as_entire_binding())];
        sky.extend(surroundings.light.bindings());
        sky.extend(surroundings.air.bindings());
        let own = [
            ("landscape", self.uniform.as_entire_binding()),
            ("terrain_vertices", vertices.as_entire_binding()),
            ("shadow_map", shadows.as_binding()),
        ];
        let frame = [("frame", surroundings.frame.as_entire_binding())];
        let terrain = &self.terrain;
        let shade = surroundings.clouds.shadow_bindings();
        let groups = [
            terrain.bind(gpu, 0, &sky)?,
            terrain.bind(gpu, 1, &frame)?,
            terrain.bind(gpu, 2, &own)?,
            terrain.bind(gpu, 3, &shade)?,
        ];
        Ok(Some(LandscapeDrawData { terrain: groups, mesh }))
    }

    fn update_mesh(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        timer: &mut PassTimer,
        (scene, mesh, uniform): (&Scene, &Mesh, &Landscape),
        frame: &Buffer,
    ) -> Result<(), RenderError> {
        // The sun does not move vertices.
        let shape = Landscape { sun_tan_low: 0.0, sun_tan_high: 0.0, sun_heading: [0.0; 2], ..*uniform };
        #[expect(clippy::cast_possible_truncation, reason = "as the shaders get it")]
        let from = [scene.camera.x_m, scene.camera.y_m, scene.camera.altitude_m].map(|at_m| at_m as f32);
        let bytes = u64::from(mesh.vertices()) * VERTEX_BYTES;
        let fits = self.vertices.as_ref().is_some_and(|buffer| buffer.bytes() >= bytes);
        if fits && self.holds == Some((shape, from)) {
            return Ok(());
        }
        if !fits {
            self.vertices = Some(gpu.buffer("landscape vertices", bytes, BufferUsages::STORAGE)?);
        }
        let Some(vertices) = &self.vertices else { return Ok(()) };
        let own =
            [("landscape", self.uniform.as_entire_binding()), ("landscape_vertices", vertices.as_entire_binding())];
        let frame = self.fill_mesh.bind(gpu, 1, &[("frame", frame.as_entire_binding())])?;
        let own = self.fill_mesh.bind(gpu, 2, &own)?;
        let mut pass = compute_pass(encoder, timer, "landscape mesh");
        pass.set_bind_group(1, &frame, &[]);
        pass.set_bind_group(2, &own, &[]);
        self.fill_mesh.dispatch(&mut pass, [mesh.columns, mesh.rings, 1]);
        drop(pass);
        self.holds = Some((shape, from));
        Ok(())
    }

    /// Draws the landscape; first of all, for it hides most of what is behind it.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, data: &LandscapeDrawData) {
        pass.set_pipeline(self.terrain.raw());
        for (index, group) in (0..).zip(&data.terrain) {
            pass.set_bind_group(index, group, &[]);
        }
        pass.draw(0..2 * data.mesh.columns, 0..data.mesh.rings - 1);
    }

    /// The map of the terrain's heights, for tests.
    #[must_use]
    pub fn heights(&self) -> Option<&Texture> {
        self.shadows.heights()
    }
}

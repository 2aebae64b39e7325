//! Drawing the ground and the sky into the frame.

use tyndall_gpu::wgpu;
use tyndall_gpu::{Buffer, Gpu, RenderPipelineDesc, Shader};
use tyndall_scattering::dome::Dome;
use tyndall_scene::SkyMode;

use super::tables::SkyTables;
use crate::clouds::CloudRenderer;
use crate::night_forms::NightForms;
use crate::target::DEPTH_FORMAT;
use crate::{RenderError, RendererConfig};

/// Pipelines of the ground, the sky per pixel and the sky on a dome.
#[derive(Debug)]
pub struct SkyRenderer {
    ground: NightForms,
    per_pixel: NightForms,
    dome: NightForms,
}

/// Bind groups of one frame.
#[derive(Debug)]
pub struct SkyDrawData {
    ground: (wgpu::RenderPipeline, [wgpu::BindGroup; 2]),
    /// What clouds leave of the ground's light.
    shade: wgpu::BindGroup,
    sky: (wgpu::RenderPipeline, [wgpu::BindGroup; 2]),
    /// The dome's mesh, or `None` for the sky per pixel.
    dome: Option<Dome>,
}

impl SkyRenderer {
    /// Makes the pipelines.
    ///
    /// # Errors
    /// When a shader is wrong.
    pub fn new(gpu: &Gpu, config: RendererConfig) -> Result<Self, RenderError> {
        let pipeline = |[label, vertex, fragment]: [&'static str; 3], writes_depth: bool| {
            let shader = Shader::load(gpu, &format!("sky/{label}.wgsl"))?;
            let depth = wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(writes_depth),
                // Reversed: nearer is greater, the sky lies at 0.
                depth_compare: Some(wgpu::CompareFunction::GreaterEqual),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            };
            let desc = RenderPipelineDesc {
                label,
                vertex,
                fragment,
                targets: &[],
                depth: Some(depth),
                primitive: wgpu::PrimitiveState::default(),
                constants: &[],
            };
            NightForms::new(gpu, shader, desc, config.frame_format())
        };
        Ok(Self {
            ground: pipeline(["ground", "ground_vertex", "ground_fragment"], true)?,
            per_pixel: pipeline(["sky", "sky_vertex", "sky_fragment"], false)?,
            dome: pipeline(["dome", "dome_vertex", "dome_fragment"], false)?,
        })
    }

    /// Binds the tables, and the shadow of the clouds that were prepared, for one frame.
    ///
    /// # Errors
    /// When a table does not fit the shaders.
    pub fn prepare(
        &mut self,
        gpu: &Gpu,
        (tables, clouds): (&SkyTables, &CloudRenderer),
        frame: &Buffer,
        (mode, dome): (SkyMode, Dome),
    ) -> Result<SkyDrawData, RenderError> {
        let common = tables.view_bindings();
        let is_night = tables.is_night_drawn();
        let ground = self.ground.form(gpu, is_night)?;
        let sky = match mode {
            SkyMode::PerPixel => &mut self.per_pixel,
            SkyMode::VertexDome => &mut self.dome,
        };
        let sky = sky.form(gpu, is_night)?;
        let with_night = [&common[..], &tables.night.sky_bindings()].concat();
        let mut with_irradiance = [&common[..], &tables.night.ground_bindings()].concat();
        with_irradiance.push(("irradiance_table", tables.irradiance.as_binding()));
        let frame = [("frame", frame.as_entire_binding())];
        Ok(SkyDrawData {
            ground: (ground.raw().clone(), [ground.bind(gpu, 0, &with_irradiance)?, ground.bind(gpu, 1, &frame)?]),
            shade: ground.bind(gpu, 3, &clouds.shadow_bindings())?,
            sky: (sky.raw().clone(), [sky.bind(gpu, 0, &with_night)?, sky.bind(gpu, 1, &frame)?]),
            dome: (mode == SkyMode::VertexDome).then_some(dome),
        })
    }

    /// Draws the ground, then the sky where nothing else is.
    pub fn draw(pass: &mut wgpu::RenderPass<'_>, data: &SkyDrawData) {
        pass.set_bind_group(3, &data.shade, &[]);
        let sky_vertices = data.dome.map_or(3, Dome::vertex_count);
        for ((pipeline, bindings), vertices) in [(&data.ground, 3), (&data.sky, sky_vertices)] {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &bindings[0], &[]);
            pass.set_bind_group(1, &bindings[1], &[]);
            pass.draw(0..vertices, 0..1);
        }
    }
}

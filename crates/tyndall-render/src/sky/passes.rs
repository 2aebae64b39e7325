//! Drawing the ground and the sky into the frame.

use tyndall_gpu::wgpu;
use tyndall_gpu::{Buffer, Gpu, RenderPipeline, RenderPipelineDesc, Shader};
use tyndall_scattering::dome::Dome;
use tyndall_scene::SkyMode;

use super::tables::SkyTables;
use crate::clouds::CloudRenderer;
use crate::target::DEPTH_FORMAT;
use crate::{RenderError, RendererConfig};

/// Pipelines of the ground, the sky per pixel and the sky on a dome.
#[derive(Debug)]
pub struct SkyRenderer {
    ground: RenderPipeline,
    per_pixel: RenderPipeline,
    dome: RenderPipeline,
}

/// Bind groups of one frame.
#[derive(Debug)]
pub struct SkyDrawData {
    ground: [wgpu::BindGroup; 2],
    /// What clouds leave of the ground's light.
    shade: wgpu::BindGroup,
    sky: [wgpu::BindGroup; 2],
    /// The dome's mesh, or `None` for the sky per pixel.
    dome: Option<Dome>,
}

impl SkyRenderer {
    /// Makes the pipelines.
    ///
    /// # Errors
    /// When a shader is wrong.
    pub fn new(gpu: &Gpu, config: RendererConfig) -> Result<Self, RenderError> {
        let pipeline = |name: &str, writes_depth: bool| {
            let shader = Shader::load(gpu, &format!("sky/{name}.wgsl"))?;
            let depth = wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(writes_depth),
                // Reversed: nearer is greater, the sky lies at 0.
                depth_compare: Some(wgpu::CompareFunction::GreaterEqual),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            };
            RenderPipeline::new(
                gpu,
                &shader,
                &RenderPipelineDesc {
                    label: name,
                    vertex: &format!("{name}_vertex"),
                    fragment: &format!("{name}_fragment"),
                    targets: &[config.frame_format().into()],
                    depth: Some(depth),
                    primitive: wgpu::PrimitiveState::default(),
                    constants: &[],
                },
            )
        };
        Ok(Self {
            ground: pipeline("ground", true)?,
            per_pixel: pipeline("sky", false)?,
            dome: pipeline("dome", false)?,
        })
    }

    /// Binds the tables, and the shadow of the clouds that were prepared, for one frame.
    ///
    /// # Errors
    /// When a table does not fit the shaders.
    pub fn prepare(
        &self,
        gpu: &Gpu,
        (tables, clouds): (&SkyTables, &CloudRenderer),
        frame: &Buffer,
        (mode, dome): (SkyMode, Dome),
    ) -> Result<SkyDrawData, RenderError> {
        let common = tables.view_bindings();
        let sky = match mode {
            SkyMode::PerPixel => &self.per_pixel,
            SkyMode::VertexDome => &self.dome,
        };
        let with_night = [&common[..], &tables.night.sky_bindings()].concat();
        let mut with_irradiance = [&common[..], &tables.night.ground_bindings()].concat();
        with_irradiance.push(("irradiance_table", tables.irradiance.as_binding()));
        let frame = [("frame", frame.as_entire_binding())];
        Ok(SkyDrawData {
            ground: [self.ground.bind(gpu, 0, &with_irradiance)?, self.ground.bind(gpu, 1, &frame)?],
            shade: self.ground.bind(gpu, 3, &clouds.shadow_bindings())?,
            sky: [sky.bind(gpu, 0, &with_night)?, sky.bind(gpu, 1, &frame)?],
            dome: (mode == SkyMode::VertexDome).then_some(dome),
        })
    }

    /// Draws the ground, then the sky where nothing else is.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, data: &SkyDrawData) {
        let draw = |pass: &mut wgpu::RenderPass<'_>,
                    pipeline: &RenderPipeline,
                    bindings: &[wgpu::BindGroup; 2],
                    vertices: u32| {
            pass.set_pipeline(pipeline.raw());
            pass.set_bind_group(0, &bindings[0], &[]);
            pass.set_bind_group(1, &bindings[1], &[]);
            pass.draw(0..vertices, 0..1);
        };
        pass.set_bind_group(3, &data.shade, &[]);
        draw(pass, &self.ground, &data.ground, 3);
        match data.dome {
            Some(dome) => draw(pass, &self.dome, &data.sky, dome.vertex_count()),
            None => draw(pass, &self.per_pixel, &data.sky, 3),
        }
    }
}

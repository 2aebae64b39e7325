//! The clouds of a frame as splats.

use tyndall_clouds::splats::{BallField, SplatOrders, SplatProjection, SplatView};
use tyndall_gpu::wgpu;
use tyndall_gpu::{Gpu, PassTimer, RenderPipeline, RenderPipelineDesc, Shader, Texture};
use tyndall_scene::{Orders, Scene};

use super::gpu_data::transport;
use crate::splats::{SplatDraw, SplatRenderer};
use crate::{FrameTarget, RenderError, RendererConfig, View};

/// What draws balls, and the pipeline that lays what is drawn of them over the frame.
#[derive(Debug)]
pub(super) struct CloudSplats {
    pipeline: RenderPipeline,
    renderer: SplatRenderer,
}

impl CloudSplats {
    pub(super) fn new(gpu: &Gpu, config: RendererConfig) -> Result<Self, RenderError> {
        let pipeline = RenderPipeline::new(
            gpu,
            &Shader::load(gpu, "splats/view.wgsl")?,
            &RenderPipelineDesc {
                label: "clouds of splats",
                vertex: "cloud_vertex",
                fragment: "splat_over",
                targets: &[config.frame_format().into()],
                depth: None,
                primitive: wgpu::PrimitiveState::default(),
                constants: &[],
            },
        )?;
        Ok(Self { pipeline, renderer: SplatRenderer::new(gpu)? })
    }

    /// Who draws the billboards, to be chosen.
    pub(super) fn renderer_mut(&mut self) -> &mut SplatRenderer {
        &mut self.renderer
    }

    /// The pipeline, and the textures of a target.
    pub(super) fn prepare(
        &mut self,
        gpu: &Gpu,
        target: &FrameTarget,
    ) -> Result<(&RenderPipeline, &[Texture; 2]), RenderError> {
        Ok((&self.pipeline, self.renderer.planes(gpu, target.size_px())?))
    }

    /// Draws those of the clouds' balls that a view shows, up to the depth of what was recorded for the target.
    pub(super) fn draw(
        &mut self,
        gpu: &Gpu,
        recording: (&mut wgpu::CommandEncoder, &mut PassTimer),
        (balls, scene, view): (&BallField, &Scene, View),
        target: &FrameTarget,
    ) -> Result<(), RenderError> {
        let view = splat_view(scene, view, target.size_px());
        let orders = match scene.clouds.orders {
            Orders::All => SplatOrders::All { transport: transport(&scene.clouds) },
            Orders::Single | Orders::Nishita1996 => SplatOrders::Single,
        };
        let balls = balls.seen(&view);
        self.renderer.draw(gpu, recording, SplatDraw { balls: &balls, view: &view, orders }, target)
    }
}

/// The camera of a view of a grounded scene.
fn splat_view(scene: &Scene, view: View, size_px: [u32; 2]) -> SplatView {
    let camera = view.frame(&scene.camera);
    let aspect = f64::from(size_px[0]) / f64::from(size_px[1]);
    let projection = match camera.orthographic_m {
        Some(width_m) => SplatProjection::Orthographic { half_m: [0.5 * width_m, 0.5 * width_m / aspect] },
        None => SplatProjection::Perspective { tan_half: [camera.tan_half_view * aspect, camera.tan_half_view] },
    };
    SplatView {
        position_m: camera.position.to_array(),
        axes: [camera.right, camera.up, camera.forward].map(|axis| axis.to_array()),
        projection,
        size_px: size_px.map(|side| side as usize),
        planet_radius_m: scene.model().planet_radius_m,
        reach_m: 1e3 * scene.clouds.reach_km,
    }
}

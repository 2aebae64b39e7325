//! The clouds of a frame as splats.

use std::sync::Arc;

use tyndall_clouds::splats::{BallField, SplatLighting, SplatOrders, SplatProjection, SplatView};
use tyndall_clouds::sunlight_scattered_often;
use tyndall_clouds::{CloudMatter, Edges};
use tyndall_gpu::wgpu;
use tyndall_gpu::{Gpu, PassTimer, RenderPipeline, RenderPipelineDesc, Shader, Texture};
use tyndall_scene::{Orders, Scene};

use super::gpu_data::transport;
use super::lamp::Lamp;
use crate::splats::{SplatDraw, SplatRenderer};
use crate::{FrameTarget, RenderError, RendererConfig, View};

/// The clouds' balls, and the pipeline that lays what is drawn of them over the frame.
#[derive(Debug)]
pub(super) struct CloudSplats {
    pipeline: RenderPipeline,
    renderer: SplatRenderer,
    /// The balls with their light, of the clouds and the lighting they follow from.
    field: Option<(Arc<CloudMatter>, SplatLighting, BallField)>,
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
        Ok(Self { pipeline, renderer: SplatRenderer::new(gpu)?, field: None })
    }

    /// The pipeline that lays splats over the frame.
    pub(super) fn pipeline(&self) -> &RenderPipeline {
        &self.pipeline
    }

    /// Who draws the billboards, to be chosen.
    pub(super) fn renderer_mut(&mut self) -> &mut SplatRenderer {
        &mut self.renderer
    }

    /// Lights the balls, unless they are lit, and makes the textures of a target.
    pub(super) fn prepare(
        &mut self,
        gpu: &Gpu,
        (scene, lamp): (&Scene, Lamp),
        matter: &Arc<CloudMatter>,
        target: &FrameTarget,
    ) -> Result<(&RenderPipeline, &[Texture; 2]), RenderError> {
        let all_orders = scene.clouds.orders == Orders::All;
        let lighting =
            SplatLighting { to_sun: lamp.direction, transport: all_orders.then(|| transport(&scene.clouds)) };
        let held = self.field.take().filter(|(of, by, _)| Arc::ptr_eq(of, matter) && *by == lighting);
        let field = match held {
            Some(field) => field,
            None => (Arc::clone(matter), lighting, field(matter, lighting)?),
        };
        self.field = Some(field);
        Ok((&self.pipeline, self.renderer.planes(gpu, target.size_px())?))
    }

    /// Draws the balls that a view shows, up to the depth of what was recorded for the target.
    pub(super) fn draw(
        &mut self,
        gpu: &Gpu,
        recording: (&mut wgpu::CommandEncoder, &mut PassTimer),
        (scene, view): (&Scene, View),
        target: &FrameTarget,
    ) -> Result<(), RenderError> {
        let Some((_, _, field)) = &self.field else { return Ok(()) };
        let view = splat_view(scene, view, target.size_px());
        let orders = match scene.clouds.orders {
            Orders::All => SplatOrders::All { transport: transport(&scene.clouds) },
            Orders::Single | Orders::Nishita1996 => SplatOrders::Single,
        };
        let balls = field.seen(&view);
        self.renderer.draw(gpu, recording, SplatDraw { balls: &balls, view: &view, orders }, target)
    }
}

/// The balls of clouds with their light.
fn field(matter: &CloudMatter, lighting: SplatLighting) -> Result<BallField, RenderError> {
    let [west, south, _] = matter.low_corner_m;
    let [east_m, north_m, _] = matter.extent_m();
    let period_m = (matter.edges == Edges::Wrap).then_some([east_m, north_m]);
    let field = BallField::new(&matter.balls(), ([west, south], period_m, matter.cell_m), lighting)?;
    let Some(transport) = lighting.transport else { return Ok(field) };
    let CloudMatter { extinction_per_m, cell_m, edges, low_corner_m, .. } = matter;
    let often = sunlight_scattered_often(extinction_per_m, *cell_m, lighting.to_sun, transport, *edges)?;
    Ok(field.with_diffuse(|place_m| often[cell_of(place_m, *low_corner_m, *cell_m, often.size())]))
}

/// The cell of a place, or the nearest one of the grid.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the grid")]
fn cell_of(place_m: [f64; 3], low_m: [f64; 3], cell_m: f64, size: [usize; 3]) -> [usize; 3] {
    [0, 1, 2].map(|axis| ((place_m[axis] - low_m[axis]) / cell_m).clamp(0.0, size[axis] as f64 - 1.0) as usize)
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

//! Clouds marched at half resolution: a quarter of the work, laid over the frame with regard to depth.

use tyndall_gpu::wgpu::{self, TextureUsages};
use tyndall_gpu::{Buffer, Gpu, PassTimer, RenderPipeline, RenderPipelineDesc, Shader, Texture, TextureDesc};

use crate::night_forms::NightForms;
use crate::{FrameTarget, RenderError, RendererConfig};

/// Pixels along a side of a marched one.
const SCALE: u32 = 2;

/// The two pipelines and the clouds between them.
#[derive(Debug)]
pub(super) struct HalfClouds {
    march: NightForms,
    over: RenderPipeline,
    part: Option<Texture>,
}

impl HalfClouds {
    pub(super) fn new(gpu: &Gpu, config: RendererConfig) -> Result<Self, RenderError> {
        let march = RenderPipelineDesc {
            label: "clouds at half resolution",
            vertex: "cloud_vertex",
            fragment: "cloud_part_fragment",
            targets: &[],
            depth: None,
            primitive: wgpu::PrimitiveState::default(),
            constants: &[("CLOUD_PIXEL", SCALE as f64)],
        };
        let over = RenderPipelineDesc {
            label: "clouds over the frame",
            vertex: "upsample_vertex",
            fragment: "upsample_fragment",
            targets: &[config.frame_format().into()],
            ..march.clone()
        };
        Ok(Self {
            march: NightForms::new(gpu, Shader::load(gpu, "clouds/view.wgsl")?, march, config.frame_format())?,
            over: RenderPipeline::new(gpu, &Shader::load(gpu, "clouds/upsample.wgsl")?, &over)?,
            part: None,
        })
    }

    /// The pipeline that marches.
    pub(super) fn march(&mut self) -> &mut NightForms {
        &mut self.march
    }

    /// Binds what is laid over the frame.
    pub(super) fn bind(
        &mut self,
        gpu: &Gpu,
        frame: &Buffer,
        behind: &Texture,
        target: &FrameTarget,
    ) -> Result<wgpu::BindGroup, RenderError> {
        let size_px = target.size_px().map(|side| side.div_ceil(SCALE));
        let last = self.part.take().filter(|part| part.size_px() == size_px);
        let part = if let Some(part) = last {
            part
        } else {
            let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::RENDER_ATTACHMENT;
            gpu.texture(&TextureDesc::new_2d("clouds at half resolution", size_px, target.frame.format(), usage))?
        };
        let resources = [
            ("frame", frame.as_entire_binding()),
            ("cloud_part", self.part.insert(part).as_binding()),
            ("cloud_behind", behind.as_binding()),
            ("cloud_depth", target.depth.as_binding()),
        ];
        Ok(self.over.bind(gpu, 1, &resources)?)
    }

    /// Records the march and lays it over the frame.
    pub(super) fn record(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timer: &mut PassTimer,
        (pipeline, march, over): (&wgpu::RenderPipeline, &[wgpu::BindGroup], &wgpu::BindGroup),
        target: &FrameTarget,
    ) {
        let Some(part) = &self.part else { return };
        // Where no cloud is, the march leaves what is there: nothing, and full transmittance.
        let clear = wgpu::LoadOp::Clear(wgpu::Color::BLACK);
        let passes = [
            ("clouds", pipeline, (part, clear), (0, march)),
            ("clouds over", self.over.raw(), (&target.frame, wgpu::LoadOp::Load), (1, std::slice::from_ref(over))),
        ];
        for (label, pipeline, (texture, load), (first, groups)) in passes {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some(label),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: texture.view(),
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
                })],
                timestamp_writes: timer.render_writes(label),
                ..Default::default()
            });
            pass.set_pipeline(pipeline);
            for (index, group) in (first..).zip(groups) {
                pass.set_bind_group(index, group, &[]);
            }
            pass.draw(0..3, 0..1);
        }
    }
}

//! Billboards drawn by the GPU: instanced rectangles, blended from back to front.

use tyndall_clouds::splats::SeenBall;
use tyndall_gpu::wgpu::{self, BlendComponent, BlendFactor, BlendOperation, BufferUsages, TextureFormat};
use tyndall_gpu::{Buffer, Gpu, PassTimer, RenderPipeline, RenderPipelineDesc, Shader, Texture};

use super::SplatDraw;
use super::gpu_data::{SplatBall, SplatCamera};
use crate::RenderError;

/// Most balls of a buffer: 64 MiB, which every device binds.
const BALLS_PER_BUFFER: usize = 1 << 20;

/// The pipeline and its buffers.
#[derive(Debug)]
pub(super) struct Billboards {
    pipeline: RenderPipeline,
    format: TextureFormat,
    camera: Buffer,
    balls: Vec<Buffer>,
}

impl Billboards {
    pub(super) fn new(gpu: &Gpu) -> Result<Self, RenderError> {
        // Half floats lose what is below 1/2000 of the sum; from back to front that is at most the last layers'.
        let blends = gpu.device.features().contains(wgpu::Features::FLOAT32_BLENDABLE);
        let format = if blends { TextureFormat::Rgba32Float } else { TextureFormat::Rgba16Float };
        let part = |src_factor| BlendComponent {
            src_factor,
            dst_factor: BlendFactor::OneMinusSrcAlpha,
            operation: BlendOperation::Add,
        };
        // Colours come premultiplied; alpha keeps what is left of the light from behind.
        let blend = wgpu::BlendState { color: part(BlendFactor::One), alpha: part(BlendFactor::Zero) };
        let target = wgpu::ColorTargetState { format, blend: Some(blend), write_mask: wgpu::ColorWrites::ALL };
        let pipeline = RenderPipeline::new(
            gpu,
            &Shader::load(gpu, "splats/billboard.wgsl")?,
            &RenderPipelineDesc {
                label: "splats",
                vertex: "splat_vertex",
                fragment: "splat_fragment",
                targets: &[target.clone(), target],
                depth: None,
                primitive: wgpu::PrimitiveState {
                    topology: wgpu::PrimitiveTopology::TriangleStrip,
                    ..Default::default()
                },
                constants: &[],
            },
        )?;
        let bytes = size_of::<SplatCamera>() as u64;
        let camera = gpu.buffer("camera of splats", bytes, BufferUsages::STORAGE | BufferUsages::COPY_DST)?;
        Ok(Self { pipeline, format, camera, balls: Vec::new() })
    }

    pub(super) fn format(&self) -> TextureFormat {
        self.format
    }

    pub(super) fn draw(
        &mut self,
        gpu: &Gpu,
        (encoder, timer): (&mut wgpu::CommandEncoder, &mut PassTimer),
        draw: SplatDraw<'_>,
        ([once, often], depth): (&[Texture; 2], &Texture),
    ) -> Result<(), RenderError> {
        let camera = SplatCamera::new(draw.view, draw.orders);
        gpu.queue.write_buffer(&self.camera, 0, bytemuck::bytes_of(&camera));
        let mut groups = Vec::new();
        for (index, balls) in draw.balls.chunks(BALLS_PER_BUFFER).enumerate() {
            self.fill(gpu, index, balls)?;
            let resources = [
                ("splat_balls", self.balls[index].as_entire_binding()),
                ("splat_camera", self.camera.as_entire_binding()),
                ("splat_depth", depth.as_binding()),
            ];
            groups.push((self.pipeline.bind(gpu, 0, &resources)?, u32::try_from(balls.len()).unwrap_or(0)));
        }
        // Nothing drawn yet: no light, and all of the light from behind.
        let ops = wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store };
        let attachments = [once, often].map(|texture| {
            Some(wgpu::RenderPassColorAttachment { view: texture.view(), depth_slice: None, resolve_target: None, ops })
        });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("splats"),
            color_attachments: &attachments,
            timestamp_writes: timer.render_writes("splats"),
            ..Default::default()
        });
        pass.set_pipeline(self.pipeline.raw());
        for (group, count) in &groups {
            pass.set_bind_group(0, group, &[]);
            pass.draw(0..4, 0..*count);
        }
        Ok(())
    }

    /// Writes balls into the buffer of that index, made anew when it is too small.
    fn fill(&mut self, gpu: &Gpu, index: usize, balls: &[SeenBall]) -> Result<(), RenderError> {
        let texels: Vec<_> = balls.iter().map(SplatBall::from).collect();
        let bytes = bytemuck::cast_slice::<_, u8>(&texels);
        let needed = bytes.len() as u64;
        if self.balls.get(index).is_none_or(|buffer| buffer.bytes() < needed) {
            let usage = BufferUsages::STORAGE | BufferUsages::COPY_DST;
            self.balls.truncate(index);
            self.balls.push(gpu.buffer("splats", needed.next_power_of_two(), usage)?);
        }
        gpu.queue.write_buffer(&self.balls[index], 0, bytes);
        Ok(())
    }
}

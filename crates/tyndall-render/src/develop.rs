//! From the HDR frame to the picture: metering, exposure, tone map, dither. WGSL: `shaders/frame/{meter,develop}.wgsl`.

use tyndall_gpu::wgpu::{self, BufferUsages};
use tyndall_gpu::{Buffer, ComputePipeline, Gpu, PassTimer, RenderPipeline, RenderPipelineDesc, Shader};

use crate::{FrameTarget, RenderError, RendererConfig};

/// Bytes of the gain that the meter writes: one number, padded.
const GAIN_BYTES: u64 = 16;

/// Pipelines of the meter and the development.
#[derive(Debug)]
pub struct DevelopRenderer {
    meter: ComputePipeline,
    develop: RenderPipeline,
    gain: Buffer,
}

/// Bind groups of one frame.
#[derive(Debug)]
pub struct DevelopDrawData {
    meter: wgpu::BindGroup,
    develop: wgpu::BindGroup,
}

impl DevelopRenderer {
    /// Makes the pipelines.
    ///
    /// # Errors
    /// When a shader is wrong.
    pub fn new(gpu: &Gpu, config: RendererConfig) -> Result<Self, RenderError> {
        let meter = ComputePipeline::new(gpu, &Shader::load(gpu, "frame/meter.wgsl")?, "meter", &[])?;
        let develop = RenderPipeline::new(
            gpu,
            &Shader::load(gpu, "frame/develop.wgsl")?,
            &RenderPipelineDesc {
                label: "develop",
                vertex: "develop_vertex",
                fragment: "develop_fragment",
                targets: &[config.picture_format().into()],
                depth: None,
                primitive: wgpu::PrimitiveState::default(),
                constants: &[],
            },
        )?;
        let gain = gpu.buffer("gain", GAIN_BYTES, BufferUsages::STORAGE | BufferUsages::COPY_SRC)?;
        Ok(Self { meter, develop, gain })
    }

    /// Binds the frame of a target.
    ///
    /// # Errors
    /// When the target does not fit the shaders.
    pub fn prepare(&self, gpu: &Gpu, frame: &Buffer, target: &FrameTarget) -> Result<DevelopDrawData, RenderError> {
        let meter = [
            ("frame", frame.as_entire_binding()),
            ("meter_frame", target.frame.as_binding()),
            ("meter_gain", self.gain.as_entire_binding()),
        ];
        let develop = [
            ("frame", frame.as_entire_binding()),
            ("develop_frame", target.frame.as_binding()),
            ("develop_gain", self.gain.as_entire_binding()),
        ];
        Ok(DevelopDrawData { meter: self.meter.bind(gpu, 1, &meter)?, develop: self.develop.bind(gpu, 1, &develop)? })
    }

    /// Records metering and development.
    pub fn record(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timer: &mut PassTimer,
        data: &DevelopDrawData,
        target: &FrameTarget,
    ) {
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some("meter"),
                timestamp_writes: timer.compute_writes("meter"),
            });
            pass.set_bind_group(1, &data.meter, &[]);
            self.meter.dispatch(&mut pass, [1, 1, 1]);
        }
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("develop"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: target.picture.view(),
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
            })],
            timestamp_writes: timer.render_writes("develop"),
            ..Default::default()
        });
        pass.set_pipeline(self.develop.raw());
        pass.set_bind_group(1, &data.develop, &[]);
        pass.draw(0..3, 0..1);
    }

    /// The gain that the last frame was developed with, from frame values to exposed values.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn read_gain(&self, gpu: &Gpu) -> Result<f32, RenderError> {
        let bytes = gpu.read_buffer(&self.gain)?;
        Ok(bytes.first_chunk::<4>().map_or(1.0, |first| f32::from_le_bytes(*first)))
    }
}

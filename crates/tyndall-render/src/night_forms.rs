//! A pipeline in two forms: with the light of the night, and without it for frames by day. Software adapters run both sides of
//! every branch, so that stars and moonlight would cost the same by day; a constant leaves them out of the program.

use tyndall_gpu::wgpu;
use tyndall_gpu::{Gpu, GpuError, RenderPipeline, RenderPipelineDesc, Shader};

/// Name of the constant in `shaders/sky/moon.wgsl`.
const NIGHT: &str = "NIGHT";

/// Both forms; each is made when a frame first needs it.
#[derive(Debug)]
pub(crate) struct NightForms {
    shader: Shader,
    desc: RenderPipelineDesc<'static>,
    target: wgpu::ColorTargetState,
    forms: [Option<RenderPipeline>; 2],
}

impl NightForms {
    /// Makes the form without the night; `desc` is that of both, with `target` in place of its targets.
    ///
    /// # Errors
    /// When the shader is wrong.
    pub(crate) fn new(
        gpu: &Gpu,
        shader: Shader,
        desc: RenderPipelineDesc<'static>,
        target: wgpu::TextureFormat,
    ) -> Result<Self, GpuError> {
        let mut pipeline = Self { shader, desc, target: target.into(), forms: [None, None] };
        pipeline.form(gpu, false)?;
        Ok(pipeline)
    }

    /// The form for a frame in which light of the night shows, or none.
    ///
    /// # Errors
    /// When the device refuses the pipeline.
    pub(crate) fn form(&mut self, gpu: &Gpu, is_night: bool) -> Result<&RenderPipeline, GpuError> {
        let form = &mut self.forms[usize::from(is_night)];
        let made = if let Some(made) = form.take() {
            made
        } else {
            let constants = [self.desc.constants, &[(NIGHT, f64::from(u8::from(is_night)))]].concat();
            let targets = [self.target.clone()];
            let desc = RenderPipelineDesc { targets: &targets, constants: &constants, ..self.desc.clone() };
            RenderPipeline::new(gpu, &self.shader, &desc)?
        };
        Ok(form.insert(made))
    }
}

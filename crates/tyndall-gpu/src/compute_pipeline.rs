//! Compute pipelines from reflection.

use naga::ShaderStage;

use crate::bindings::BindingTable;
use crate::{Gpu, GpuError, Shader, reflect};

/// A compute pipeline; workgroup size and bindings are the shader's.
#[derive(Debug)]
pub struct ComputePipeline {
    raw: wgpu::ComputePipeline,
    bindings: BindingTable,
    workgroup_size: [u32; 3],
}

impl ComputePipeline {
    /// Makes the pipeline of one entry point; `constants` are values of its `override` constants by name.
    ///
    /// # Errors
    /// When the shader has no such entry point or constant, or the device refuses the pipeline.
    pub fn new(gpu: &Gpu, shader: &Shader, entry: &str, constants: &[(&str, f64)]) -> Result<Self, GpuError> {
        let reflected = reflect::entry_point(shader, ShaderStage::Compute, entry, constants)?;
        let label = format!("`{entry}` in {}", shader.name());
        let bindings = BindingTable::new(gpu, &label, reflected.bindings)?;
        let layout = bindings.pipeline_layout(gpu)?;
        let raw = gpu.validated(&format!("compute pipeline {label}"), |device| {
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(&label),
                layout: Some(&layout),
                module: &shader.raw,
                entry_point: Some(entry),
                compilation_options: wgpu::PipelineCompilationOptions { constants, ..Default::default() },
                cache: None,
            })
        })?;
        Ok(Self { raw, bindings, workgroup_size: reflected.workgroup_size })
    }

    /// Binds resources to the variables of one group by their WGSL names. Only variables that the entry point uses are
    /// expected.
    ///
    /// # Errors
    /// When names are missing, unknown or given twice (the message lists the expected ones), or a resource does not fit
    /// its variable.
    pub fn bind(
        &self,
        gpu: &Gpu,
        group: u32,
        resources: &[(&str, wgpu::BindingResource<'_>)],
    ) -> Result<wgpu::BindGroup, GpuError> {
        self.bindings.bind(gpu, group, resources)
    }

    /// Sets the pipeline and starts at least `invocations` invocations along each axis, rounded up to whole workgroups.
    pub fn dispatch(&self, pass: &mut wgpu::ComputePass<'_>, invocations: [u32; 3]) {
        let groups = |axis: usize| invocations[axis].div_ceil(self.workgroup_size[axis].max(1));
        pass.set_pipeline(&self.raw);
        pass.dispatch_workgroups(groups(0), groups(1), groups(2));
    }

    /// Invocations of a workgroup along each axis, with the constants of this pipeline.
    #[must_use]
    pub fn workgroup_size(&self) -> [u32; 3] {
        self.workgroup_size
    }

    /// The pipeline itself.
    #[must_use]
    pub fn raw(&self) -> &wgpu::ComputePipeline {
        &self.raw
    }
}

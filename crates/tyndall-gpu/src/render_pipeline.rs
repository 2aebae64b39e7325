//! Render pipelines from reflection. Vertices are computed or pulled from storage buffers, so there are no vertex buffers.

use naga::ShaderStage;

use crate::bindings::BindingTable;
use crate::{Gpu, GpuError, Shader, reflect};

/// What a render pipeline is to be.
#[derive(Clone, Debug)]
pub struct RenderPipelineDesc<'a> {
    /// Name in error messages and graphics debuggers.
    pub label: &'a str,
    /// Vertex entry point.
    pub vertex: &'a str,
    /// Fragment entry point.
    pub fragment: &'a str,
    /// Formats, blending and write masks of the colour targets.
    pub targets: &'a [wgpu::ColorTargetState],
    /// Depth test, if any.
    pub depth: Option<wgpu::DepthStencilState>,
    /// Topology and culling.
    pub primitive: wgpu::PrimitiveState,
    /// Values of `override` constants by name, for both stages.
    pub constants: &'a [(&'a str, f64)],
}

/// A render pipeline; its bindings are the shader's.
#[derive(Debug)]
pub struct RenderPipeline {
    raw: wgpu::RenderPipeline,
    bindings: BindingTable,
}

impl RenderPipeline {
    /// Makes the pipeline of a vertex and a fragment entry point of one shader.
    ///
    /// # Errors
    /// When the shader has no such entry points or constants, or the device refuses the pipeline.
    pub fn new(gpu: &Gpu, shader: &Shader, desc: &RenderPipelineDesc<'_>) -> Result<Self, GpuError> {
        let mut used = reflect::entry_point(shader, ShaderStage::Vertex, desc.vertex, desc.constants)?.bindings;
        used.extend(reflect::entry_point(shader, ShaderStage::Fragment, desc.fragment, desc.constants)?.bindings);
        let label = format!("`{}` ({})", desc.label, shader.name());
        let bindings = BindingTable::new(gpu, &label, used)?;
        let layout = bindings.pipeline_layout(gpu)?;
        let raw = gpu.validated(&format!("render pipeline {label}"), |device| {
            device.create_render_pipeline(&raw_desc(shader, desc, &layout, &targets(desc)))
        })?;
        Ok(Self { raw, bindings })
    }

    /// Binds resources to the variables of one group by their WGSL names. Only variables that the entry points use are
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

    /// The pipeline itself.
    #[must_use]
    pub fn raw(&self) -> &wgpu::RenderPipeline {
        &self.raw
    }
}

fn targets(desc: &RenderPipelineDesc<'_>) -> Vec<Option<wgpu::ColorTargetState>> {
    desc.targets.iter().cloned().map(Some).collect()
}

fn raw_desc<'a>(
    shader: &'a Shader,
    desc: &RenderPipelineDesc<'a>,
    layout: &'a wgpu::PipelineLayout,
    targets: &'a [Option<wgpu::ColorTargetState>],
) -> wgpu::RenderPipelineDescriptor<'a> {
    let options = wgpu::PipelineCompilationOptions { constants: desc.constants, ..Default::default() };
    wgpu::RenderPipelineDescriptor {
        label: Some(desc.label),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module: &shader.raw,
            entry_point: Some(desc.vertex),
            compilation_options: options.clone(),
            buffers: &[],
        },
        primitive: desc.primitive,
        depth_stencil: desc.depth.clone(),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &shader.raw,
            entry_point: Some(desc.fragment),
            compilation_options: options,
            targets,
        }),
        multiview_mask: None,
        cache: None,
    }
}

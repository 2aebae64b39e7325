//! Bind group layouts of a pipeline, and bind groups made by the names of WGSL variables.

use crate::reflect::{Binding, list};
use crate::{Gpu, GpuError};

/// The bind groups of one pipeline.
#[derive(Debug)]
pub(crate) struct BindingTable {
    /// For messages: shader and entry points.
    pipeline: String,
    /// By index; groups without bindings are `None`.
    groups: Vec<Option<Group>>,
}

#[derive(Debug)]
struct Group {
    layout: wgpu::BindGroupLayout,
    bindings: Vec<Binding>,
}

impl BindingTable {
    /// Makes the layouts. The same variable may be listed by several stages.
    pub(crate) fn new(gpu: &Gpu, pipeline: &str, bindings: Vec<Binding>) -> Result<Self, GpuError> {
        let merged = merge(bindings);
        let count = merged.iter().map(|binding| binding.group + 1).max().unwrap_or(0);
        let groups = (0..count).map(|group| {
            let bindings: Vec<Binding> = merged.iter().filter(|b| b.group == group).cloned().collect();
            if bindings.is_empty() {
                return Ok(None);
            }
            let entries: Vec<_> = bindings.iter().map(layout_entry).collect();
            let desc = wgpu::BindGroupLayoutDescriptor { label: Some(pipeline), entries: &entries };
            let what = format!("layout of group {group} of {pipeline}");
            let layout = gpu.validated(&what, |device| device.create_bind_group_layout(&desc))?;
            Ok(Some(Group { layout, bindings }))
        });
        Ok(Self { pipeline: pipeline.to_owned(), groups: groups.collect::<Result<_, GpuError>>()? })
    }

    pub(crate) fn pipeline_layout(&self, gpu: &Gpu) -> Result<wgpu::PipelineLayout, GpuError> {
        let layouts: Vec<_> = self.groups.iter().map(|group| group.as_ref().map(|group| &group.layout)).collect();
        let desc = wgpu::PipelineLayoutDescriptor {
            label: Some(&self.pipeline),
            bind_group_layouts: &layouts,
            immediate_size: 0,
        };
        gpu.validated(&format!("layout of {}", self.pipeline), |device| device.create_pipeline_layout(&desc))
    }

    pub(crate) fn bind(
        &self,
        gpu: &Gpu,
        group: u32,
        resources: &[(&str, wgpu::BindingResource<'_>)],
    ) -> Result<wgpu::BindGroup, GpuError> {
        let found = self.groups.get(group as usize).and_then(Option::as_ref);
        let bindings = found.map_or(&[][..], |group| &group.bindings);
        let problem = mismatch(bindings, resources);
        let (Some(found), None) = (found, &problem) else {
            return Err(GpuError::Bindings {
                pipeline: self.pipeline.clone(),
                group,
                problem: problem.unwrap_or_else(|| "it has no bindings".to_owned()),
                expected: expected(bindings),
            });
        };
        let entries = bindings.iter().filter_map(|binding| {
            let (_, resource) = resources.iter().find(|(name, _)| *name == binding.name)?;
            Some(wgpu::BindGroupEntry { binding: binding.slot, resource: resource.clone() })
        });
        let entries: Vec<_> = entries.collect();
        let desc = wgpu::BindGroupDescriptor { label: Some(&self.pipeline), layout: &found.layout, entries: &entries };
        let what = format!("bind group {group} of {}", self.pipeline);
        gpu.validated(&what, |device| device.create_bind_group(&desc))
    }
}

/// Joins what several stages use: visibility is the union, and a texture that one stage filters must be filterable.
fn merge(bindings: Vec<Binding>) -> Vec<Binding> {
    let mut merged: Vec<Binding> = Vec::new();
    for binding in bindings {
        match merged.iter_mut().find(|known| (known.group, known.slot) == (binding.group, binding.slot)) {
            Some(known) => {
                known.visibility |= binding.visibility;
                if is_filtered(&binding.ty) {
                    known.ty = binding.ty;
                }
            }
            None => merged.push(binding),
        }
    }
    merged.sort_by_key(|binding| (binding.group, binding.slot));
    merged
}

fn is_filtered(ty: &wgpu::BindingType) -> bool {
    let sample_type = wgpu::TextureSampleType::Float { filterable: true };
    matches!(ty, wgpu::BindingType::Texture { sample_type: found, .. } if *found == sample_type)
}

fn layout_entry(binding: &Binding) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry { binding: binding.slot, visibility: binding.visibility, ty: binding.ty, count: None }
}

/// Which names are missing, unknown or given twice.
fn mismatch(bindings: &[Binding], resources: &[(&str, wgpu::BindingResource<'_>)]) -> Option<String> {
    let given = |name: &str| resources.iter().filter(|(other, _)| *other == name).count();
    let missing = bindings.iter().map(|binding| binding.name.as_str()).filter(|name| given(name) == 0);
    let unknown =
        resources.iter().map(|(name, _)| *name).filter(|name| bindings.iter().all(|binding| binding.name != *name));
    let mut problems = Vec::new();
    for (verdict, names) in [
        ("missing", missing.collect::<Vec<_>>()),
        ("unknown", unknown.collect()),
        ("given twice", bindings.iter().map(|b| b.name.as_str()).filter(|name| given(name) > 1).collect()),
    ] {
        if !names.is_empty() {
            problems.push(format!("{verdict}: {}", names.join(", ")));
        }
    }
    (!problems.is_empty()).then(|| problems.join("; "))
}

fn expected(bindings: &[Binding]) -> String {
    let texts: Vec<String> =
        bindings.iter().map(|binding| format!("{} ({})", binding.name, kind(&binding.ty))).collect();
    list(texts.iter().map(String::as_str))
}

fn kind(ty: &wgpu::BindingType) -> &'static str {
    match ty {
        wgpu::BindingType::Buffer { ty: wgpu::BufferBindingType::Uniform, .. } => "uniform buffer",
        wgpu::BindingType::Buffer { .. } => "storage buffer",
        wgpu::BindingType::Sampler(_) => "sampler",
        wgpu::BindingType::StorageTexture { .. } => "storage texture",
        _ => "texture",
    }
}

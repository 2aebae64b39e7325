//! What an entry point needs, read from the shader itself.

use std::borrow::Cow;

use naga::back::pipeline_constants::process_overrides;
use naga::{AddressSpace, ImageClass, ImageDimension, ScalarKind, ShaderStage, StorageAccess, TypeInner};

use crate::{GpuError, Shader};

/// A variable that an entry point uses.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Binding {
    pub(crate) name: String,
    pub(crate) group: u32,
    pub(crate) slot: u32,
    pub(crate) visibility: wgpu::ShaderStages,
    pub(crate) ty: wgpu::BindingType,
}

/// An entry point with its override constants put in.
#[derive(Debug)]
pub(crate) struct EntryPoint {
    pub(crate) workgroup_size: [u32; 3],
    pub(crate) bindings: Vec<Binding>,
}

/// Reflects an entry point as it is with these constants.
pub(crate) fn entry_point(
    shader: &Shader,
    stage: ShaderStage,
    entry: &str,
    constants: &[(&str, f64)],
) -> Result<EntryPoint, GpuError> {
    let known = |module: &naga::Module| module.entry_points.iter().position(|e| e.stage == stage && e.name == entry);
    if known(&shader.module).is_none() {
        return Err(unknown_entry(shader, stage, entry));
    }
    let values = constants.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
    let refuse = |message: String| GpuError::Constants {
        shader: shader.name().to_owned(),
        entry: entry.to_owned(),
        message: format!("{message}; it has: {}", override_names(&shader.module)),
    };
    let (module, info) = process_overrides(&shader.module, &shader.info, Some((stage, entry)), &values)
        .map_err(|error| refuse(error.to_string()))?;
    let (module, info): (Cow<'_, naga::Module>, Cow<'_, naga::valid::ModuleInfo>) = (module, info);
    let Some(index) = known(&module) else { return Err(unknown_entry(shader, stage, entry)) };
    Ok(EntryPoint {
        workgroup_size: module.entry_points[index].workgroup_size,
        bindings: bindings(&module, info.get_entry_point(index), visibility(stage)),
    })
}

fn unknown_entry(shader: &Shader, stage: ShaderStage, entry: &str) -> GpuError {
    let same_stage = shader.module.entry_points.iter().filter(|e| e.stage == stage);
    GpuError::UnknownEntry {
        shader: shader.name().to_owned(),
        stage: match stage {
            ShaderStage::Vertex => "vertex",
            ShaderStage::Fragment => "fragment",
            _ => "compute",
        },
        entry: entry.to_owned(),
        available: list(same_stage.map(|e| e.name.as_str())),
    }
}

fn override_names(module: &naga::Module) -> String {
    list(module.overrides.iter().filter_map(|(_, constant)| constant.name.as_deref()))
}

/// Names joined by commas, or `none`.
pub(crate) fn list<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<_> = names.collect();
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}

fn visibility(stage: ShaderStage) -> wgpu::ShaderStages {
    match stage {
        ShaderStage::Vertex => wgpu::ShaderStages::VERTEX,
        ShaderStage::Fragment => wgpu::ShaderStages::FRAGMENT,
        _ => wgpu::ShaderStages::COMPUTE,
    }
}

fn bindings(module: &naga::Module, used: &naga::valid::FunctionInfo, visibility: wgpu::ShaderStages) -> Vec<Binding> {
    let mut found: Vec<Binding> = module
        .global_variables
        .iter()
        .filter(|(handle, _)| !used[*handle].is_empty())
        .filter_map(|(handle, variable)| {
            let place = variable.binding?;
            Some(Binding {
                name: variable.name.clone().unwrap_or_default(),
                group: place.group,
                slot: place.binding,
                visibility,
                ty: binding_type(module, variable, is_filtered(module, used, handle))?,
            })
        })
        .collect();
    found.sort_by_key(|binding| (binding.group, binding.slot));
    found
}

/// Whether a texture is sampled with a filtering sampler.
fn is_filtered(
    module: &naga::Module,
    used: &naga::valid::FunctionInfo,
    texture: naga::Handle<naga::GlobalVariable>,
) -> bool {
    let mut samplers = used.sampling_set.iter().filter(|pair| pair.image == texture).map(|pair| pair.sampler);
    samplers.any(|sampler| !is_nearest(&module.global_variables[sampler]))
}

/// WGSL does not say whether a sampler filters; by our convention the name of one that does not ends in `nearest`.
fn is_nearest(sampler: &naga::GlobalVariable) -> bool {
    sampler.name.as_deref().is_some_and(|name| name.ends_with("nearest"))
}

/// `None` for kinds of resources that Tyndall's shaders do not have: ray tracing, external textures, binding arrays.
fn binding_type(
    module: &naga::Module,
    variable: &naga::GlobalVariable,
    is_filtered: bool,
) -> Option<wgpu::BindingType> {
    let inner = &module.types[variable.ty].inner;
    Some(match (variable.space, inner) {
        (AddressSpace::Uniform, _) => buffer_type(module, inner, wgpu::BufferBindingType::Uniform),
        (AddressSpace::Storage { access }, _) => {
            let read_only = !access.contains(StorageAccess::STORE);
            buffer_type(module, inner, wgpu::BufferBindingType::Storage { read_only })
        }
        (_, TypeInner::Sampler { comparison: true }) => {
            wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison)
        }
        (_, TypeInner::Sampler { .. }) if is_nearest(variable) => {
            wgpu::BindingType::Sampler(wgpu::SamplerBindingType::NonFiltering)
        }
        (_, TypeInner::Sampler { .. }) => wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
        (_, TypeInner::Image { dim, arrayed, class }) => {
            image_type(*class, view_dimension(*dim, *arrayed), is_filtered)?
        }
        _ => return None,
    })
}

fn buffer_type(module: &naga::Module, inner: &TypeInner, ty: wgpu::BufferBindingType) -> wgpu::BindingType {
    let min_bytes = u64::from(inner.size(module.to_ctx()));
    wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: wgpu::BufferSize::new(min_bytes) }
}

fn image_type(
    class: ImageClass,
    view_dimension: wgpu::TextureViewDimension,
    is_filtered: bool,
) -> Option<wgpu::BindingType> {
    Some(match class {
        ImageClass::Sampled { kind, multi } => wgpu::BindingType::Texture {
            sample_type: match kind {
                ScalarKind::Sint => wgpu::TextureSampleType::Sint,
                ScalarKind::Uint => wgpu::TextureSampleType::Uint,
                _ => wgpu::TextureSampleType::Float { filterable: is_filtered },
            },
            view_dimension,
            multisampled: multi,
        },
        ImageClass::Depth { multi } => wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Depth,
            view_dimension,
            multisampled: multi,
        },
        ImageClass::Storage { format, access } => wgpu::BindingType::StorageTexture {
            access: match (access.contains(StorageAccess::LOAD), access.contains(StorageAccess::STORE)) {
                (true, true) => wgpu::StorageTextureAccess::ReadWrite,
                (true, false) => wgpu::StorageTextureAccess::ReadOnly,
                _ => wgpu::StorageTextureAccess::WriteOnly,
            },
            format: wgpu_naga_bridge::map_storage_format_from_naga(format),
            view_dimension,
        },
        ImageClass::External => return None,
    })
}

fn view_dimension(dimension: ImageDimension, is_array: bool) -> wgpu::TextureViewDimension {
    match (dimension, is_array) {
        (ImageDimension::D1, _) => wgpu::TextureViewDimension::D1,
        (ImageDimension::D2, false) => wgpu::TextureViewDimension::D2,
        (ImageDimension::D2, true) => wgpu::TextureViewDimension::D2Array,
        (ImageDimension::D3, _) => wgpu::TextureViewDimension::D3,
        (ImageDimension::Cube, false) => wgpu::TextureViewDimension::Cube,
        (ImageDimension::Cube, true) => wgpu::TextureViewDimension::CubeArray,
    }
}

//! Every entry point in the languages of all platforms, on a machine that has one of them.

use naga::back::pipeline_constants::process_overrides;
use naga::{ImageClass, ShaderStage, StorageAccess, StorageFormat, TypeInner, back};

use crate::modules::{Module, assert_no_faults, faults_in};

/// Writes every entry point of a module in the four languages; faults name entry and language.
fn untranslatable(module: &Module) -> Vec<String> {
    let writers: [(&str, Writer); 4] =
        [("SPIR-V", spirv), ("Metal 2.1", metal), ("HLSL 5.1", hlsl), ("GLSL ES 3.1", glsl)];
    let mut faults = Vec::new();
    for entry in &module.ir.entry_points {
        // The writers want override constants resolved; with their defaults the structure is the same.
        let resolved = process_overrides(
            &module.ir,
            &module.info,
            Some((entry.stage, &entry.name)),
            &back::PipelineConstants::default(),
        );
        let place = format!("{}: `{}`", module.name, entry.name);
        match resolved {
            Err(error) => faults.push(format!("{place}: {error}")),
            Ok((ir, info)) => {
                let one = One { ir: &ir, info: &info, stage: entry.stage, name: &entry.name };
                let refused = |(language, write): &(&str, Writer)| {
                    write(&one).err().map(|error| format!("{place} in {language}: {error}"))
                };
                faults.extend(writers.iter().filter_map(refused));
            }
        }
    }
    faults
}

/// Writes one entry point in a language, or says why not.
type Writer = fn(&One<'_>) -> Result<(), String>;

/// A module with one entry point.
struct One<'a> {
    ir: &'a naga::Module,
    info: &'a naga::valid::ModuleInfo,
    stage: ShaderStage,
    name: &'a str,
}

fn spirv(one: &One<'_>) -> Result<(), String> {
    let words = back::spv::write_vec(one.ir, one.info, &back::spv::Options::default(), None);
    words.map(|_| ()).map_err(|error| error.to_string())
}

/// 2.1, because older versions have neither the instance index nor textures that are read and written.
fn metal(one: &One<'_>) -> Result<(), String> {
    let options = back::msl::Options { lang_version: (2, 1), fake_missing_bindings: true, ..Default::default() };
    let (_, written) = back::msl::write_string(one.ir, one.info, &options, &back::msl::PipelineOptions::default())
        .map_err(|error| error.to_string())?;
    written.entry_point_names.into_iter().try_for_each(|name| name.map(|_| ()).map_err(|error| error.to_string()))
}

fn hlsl(one: &One<'_>) -> Result<(), String> {
    let options = back::hlsl::Options {
        shader_model: back::hlsl::ShaderModel::V5_1,
        fake_missing_bindings: true,
        ..Default::default()
    };
    let pipeline = back::hlsl::PipelineOptions::default();
    let mut text = String::new();
    let written = back::hlsl::Writer::new(&mut text, &options, &pipeline)
        .write(one.ir, one.info, None)
        .map_err(|error| error.to_string())?;
    written.entry_point_names.into_iter().try_for_each(|name| name.map(|_| ()).map_err(|error| error.to_string()))
}

fn glsl(one: &One<'_>) -> Result<(), String> {
    let options = back::glsl::Options { version: back::glsl::Version::new_gles(310), ..Default::default() };
    let pipeline =
        back::glsl::PipelineOptions { shader_stage: one.stage, entry_point: one.name.to_owned(), multiview: None };
    let policies = naga::proc::BoundsCheckPolicies::default();
    let mut text = String::new();
    back::glsl::Writer::new(&mut text, one.ir, one.info, &options, &pipeline, policies)
        .and_then(|mut writer| writer.write())
        .map(|_| ())
        .map_err(|error| error.to_string())
}

/// Storage textures that some platform lacks: naga's writers do not look.
fn unportable_storage_textures(module: &Module) -> Vec<String> {
    let mut faults = Vec::new();
    for (handle, variable) in module.ir.global_variables.iter() {
        let TypeInner::Image { class: ImageClass::Storage { format, access }, .. } = module.ir.types[variable.ty].inner
        else {
            continue;
        };
        let place = module.place(module.ir.global_variables.get_span(handle));
        let name = variable.name.as_deref().unwrap_or("");
        if !is_everywhere(format) {
            faults.push(format!("{place}: GLSL ES 3.1 has no storage textures of {format:?} (`{name}`)"));
        }
        if access.contains(StorageAccess::LOAD | StorageAccess::STORE) && !is_read_write_everywhere(format) {
            faults.push(format!("{place}: only 32-bit single-channel formats are read and written (`{name}`)"));
        }
    }
    faults
}

/// Formats that both WebGPU and GLSL ES 3.1 have for storage.
fn is_everywhere(format: StorageFormat) -> bool {
    is_read_write_everywhere(format)
        || matches!(
            format,
            StorageFormat::Rgba8Unorm
                | StorageFormat::Rgba8Snorm
                | StorageFormat::Rgba8Uint
                | StorageFormat::Rgba8Sint
                | StorageFormat::Rgba16Float
                | StorageFormat::Rgba16Uint
                | StorageFormat::Rgba16Sint
                | StorageFormat::Rgba32Float
                | StorageFormat::Rgba32Uint
                | StorageFormat::Rgba32Sint
        )
}

fn is_read_write_everywhere(format: StorageFormat) -> bool {
    matches!(format, StorageFormat::R32Float | StorageFormat::R32Uint | StorageFormat::R32Sint)
}

#[test]
fn every_entry_point_translates_to_the_languages_of_all_platforms() {
    assert_no_faults(untranslatable, "these entry points cannot run everywhere");
}

#[test]
fn storage_textures_have_formats_and_access_that_all_platforms_have() {
    assert_no_faults(unportable_storage_textures, "these storage textures do not exist everywhere");
}

#[test]
fn a_planted_entry_that_one_language_lacks_is_found() {
    let text = "override COUNT: u32;
        @group(0) @binding(0) var<storage, read_write> out: array<u32>;
        @compute @workgroup_size(1) fn main() { out[0] = COUNT; }";
    let faults = faults_in(untranslatable, text);
    assert!(faults.len() == 1 && faults[0].starts_with("planted.wgsl: `main`: "), "no default: {faults:?}");
    let text = "@group(0) @binding(0) var t: texture_2d<f32>;
        @group(0) @binding(1) var<storage, read_write> out: array<u32>;
        @compute @workgroup_size(1) fn main() { out[0] = textureNumLevels(t); }";
    let faults = faults_in(untranslatable, text);
    assert!(faults.len() == 1 && faults[0].starts_with("planted.wgsl: `main` in GLSL ES 3.1: "), "{faults:?}");
}

#[test]
fn an_entry_with_overrides_textures_and_samplers_translates() {
    let text = "override STEPS: u32 = 8u;
        @group(0) @binding(0) var t: texture_3d<f32>;
        @group(0) @binding(1) var s: sampler;
        @group(0) @binding(2) var out: texture_storage_2d<rgba16float, write>;
        @compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
            textureStore(out, id.xy, textureSampleLevel(t, s, vec3<f32>(f32(STEPS)), 0.0));
        }
        @vertex fn vs(@builtin(vertex_index) v: u32, @builtin(instance_index) i: u32) -> @builtin(position) vec4<f32> {
            return vec4<f32>(f32(v), f32(i), 0.0, 1.0);
        }
        @fragment fn fs() -> @location(0) vec4<f32> { return vec4<f32>(1.0); }";
    assert_eq!(faults_in(untranslatable, text), Vec::<String>::new(), "all four languages");
    assert_eq!(faults_in(unportable_storage_textures, text), Vec::<String>::new(), "a format of every platform");
}

#[test]
fn planted_storage_textures_that_some_platform_lacks_are_found() {
    let text = |format: &str, access: &str| {
        format!(
            "@group(0) @binding(0) var t: texture_storage_2d<{format}, {access}>;
             @compute @workgroup_size(1) fn main() {{ textureStore(t, vec2<u32>(0u), vec4<f32>()); }}"
        )
    };
    let faults = faults_in(unportable_storage_textures, &text("rg32float", "write"));
    assert!(faults.len() == 1 && faults[0].starts_with("planted.wgsl:1: GLSL ES 3.1 has no"), "{faults:?}");
    let faults = faults_in(unportable_storage_textures, &text("rgba16float", "read_write"));
    assert!(faults.len() == 1 && faults[0].contains("only 32-bit single-channel"), "{faults:?}");
    let faults = faults_in(unportable_storage_textures, &text("r32float", "read_write"));
    assert_eq!(faults, Vec::<String>::new(), "this one is everywhere");
}

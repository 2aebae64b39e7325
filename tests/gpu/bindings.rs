//! Binding by the names of WGSL variables; layouts from reflection.

use tyndall_gpu::wgpu::{self, BufferUsages, TextureFormat, TextureUsages};
use tyndall_gpu::{
    ComputePipeline, Gpu, GpuError, RenderPipeline, RenderPipelineDesc, Shader, TextureDesc, rust_layout,
};

const SOURCE: &str = "
struct Params { size: vec2<u32>, gain: f32, _pad: f32 }
@group(0) @binding(0) var<uniform> params: Params;
@group(0) @binding(1) var source: texture_2d<f32>;
@group(0) @binding(2) var source_linear: sampler;
@group(2) @binding(0) var<storage, read_write> sums: array<f32>;
@group(0) @binding(3) var not_used_here: texture_2d<f32>;
@compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id.xy >= params.size)) { return; }
    sums[id.x] = params.gain * textureSampleLevel(source, source_linear, vec2<f32>(0.5), 0.0).x;
}
@compute @workgroup_size(8, 8) fn loads(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id.xy >= params.size)) { return; }
    sums[id.x] = textureLoad(source, id.xy, 0).x + textureLoad(not_used_here, id.xy, 0).x;
}
";

struct Fixture {
    gpu: Gpu,
    shader: Shader,
}

impl Fixture {
    fn new() -> Self {
        let gpu = Gpu::noop().expect("it needs no driver");
        let shader = Shader::from_source(&gpu, "test.wgsl", SOURCE).unwrap_or_else(|error| panic!("{error}"));
        Self { gpu, shader }
    }

    fn pipeline(&self, entry: &str) -> ComputePipeline {
        ComputePipeline::new(&self.gpu, &self.shader, entry, &[]).unwrap_or_else(|error| panic!("{error}"))
    }

    /// Binds group 0 of `main` with all resources but those named, and `also`.
    fn bind(&self, without: &[&str], also: &[&str]) -> Result<(), GpuError> {
        let params = self.gpu.uniform("params", &[0_u32; 4])?;
        let texture = self.gpu.texture(&texture(TextureFormat::Rgba16Float))?;
        let sampler = self.gpu.device.create_sampler(&wgpu::SamplerDescriptor::default());
        let mut resources = vec![
            ("params", params.as_entire_binding()),
            ("source", wgpu::BindingResource::TextureView(texture.view())),
            ("source_linear", wgpu::BindingResource::Sampler(&sampler)),
        ];
        resources.retain(|(name, _)| !without.contains(name));
        resources.extend(also.iter().map(|name| (*name, params.as_entire_binding())));
        self.pipeline("main").bind(&self.gpu, 0, &resources).map(|_| ())
    }
}

fn texture(format: TextureFormat) -> TextureDesc<'static> {
    TextureDesc::new_2d("source", [4, 4], format, TextureUsages::TEXTURE_BINDING)
}

#[test]
fn resources_are_bound_by_name_in_any_group() {
    let fixture = Fixture::new();
    fixture.bind(&[], &[]).expect("all variables of group 0");
    let sums = fixture.gpu.buffer("sums", 64, BufferUsages::STORAGE).expect("small");
    let resources = [("sums", sums.as_entire_binding())];
    fixture.pipeline("main").bind(&fixture.gpu, 2, &resources).expect("the variable of group 2");
}

#[test]
fn a_missing_resource_is_an_error_that_lists_the_expected_ones() {
    let error = Fixture::new().bind(&["source", "params"], &[]).expect_err("two are missing").to_string();
    assert_eq!(
        error,
        "group 0 of `main` in test.wgsl: missing: params, source; it takes: params (uniform buffer), source (texture), \
         source_linear (sampler)",
        "names and kinds"
    );
}

#[test]
fn unknown_and_doubled_names_are_errors() {
    let fixture = Fixture::new();
    for (also, verdict) in [
        ("sums", "unknown: sums"),
        ("not_used_here", "unknown: not_used_here"),
        ("parms", "unknown: parms"),
        ("params", "given twice: params"),
    ] {
        let error = fixture.bind(&[], &[also]).expect_err("one too many").to_string();
        assert!(error.contains(verdict), "{error}");
    }
}

#[test]
fn a_group_without_bindings_is_an_error() {
    let fixture = Fixture::new();
    for group in [1, 3] {
        let error = fixture.pipeline("main").bind(&fixture.gpu, group, &[]).expect_err("nothing there").to_string();
        assert!(error.contains(&format!("group {group} of")) && error.ends_with("it takes: none"), "{error}");
    }
}

#[test]
fn a_resource_of_the_wrong_kind_or_too_small_is_an_error() {
    let fixture = Fixture::new();
    let small = fixture.gpu.buffer("small", 8, BufferUsages::UNIFORM).expect("small");
    let error = fixture.bind(&["params"], &[]).expect_err("missing");
    assert!(matches!(error, GpuError::Bindings { .. }), "{error}");
    let texture = fixture.gpu.texture(&texture(TextureFormat::Rgba16Float)).expect("small");
    let sampler = fixture.gpu.device.create_sampler(&wgpu::SamplerDescriptor::default());
    let view = wgpu::BindingResource::TextureView(texture.view());
    for params in [small.as_entire_binding(), view.clone()] {
        let resources =
            [("params", params), ("source", view.clone()), ("source_linear", wgpu::BindingResource::Sampler(&sampler))];
        let error = fixture.pipeline("main").bind(&fixture.gpu, 0, &resources).expect_err("it does not fit");
        assert!(matches!(error, GpuError::Validation { .. }), "{error}");
    }
}

#[test]
fn textures_are_filterable_only_where_a_filtering_sampler_reads_them() {
    let fixture = Fixture::new();
    let floats = fixture.gpu.texture(&texture(TextureFormat::Rgba32Float)).expect("small");
    let view = wgpu::BindingResource::TextureView(floats.view());
    let params = fixture.gpu.uniform("params", &[0_u32; 4]).expect("small");
    let sampler = fixture.gpu.device.create_sampler(&wgpu::SamplerDescriptor::default());
    let loaded = [("params", params.as_entire_binding()), ("source", view.clone()), ("not_used_here", view.clone())];
    fixture.pipeline("loads").bind(&fixture.gpu, 0, &loaded).expect("32-bit floats can be loaded everywhere");
    let sampled = [
        ("params", params.as_entire_binding()),
        ("source", view),
        ("source_linear", wgpu::BindingResource::Sampler(&sampler)),
    ];
    let error = fixture.pipeline("main").bind(&fixture.gpu, 0, &sampled).expect_err("32-bit floats do not filter");
    assert!(error.to_string().contains("ilter"), "{error}");
}

#[test]
fn a_sampler_whose_name_ends_in_nearest_does_not_filter() {
    let gpu = Gpu::noop().expect("it needs no driver");
    let source = SOURCE.replace("source_linear", "source_nearest");
    let shader = Shader::from_source(&gpu, "test.wgsl", &source).unwrap_or_else(|error| panic!("{error}"));
    let pipeline = ComputePipeline::new(&gpu, &shader, "main", &[]).unwrap_or_else(|error| panic!("{error}"));
    let floats = gpu.texture(&texture(TextureFormat::Rgba32Float)).expect("small");
    let params = gpu.uniform("params", &[0_u32; 4]).expect("small");
    let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor::default());
    let resources = [
        ("params", params.as_entire_binding()),
        ("source", wgpu::BindingResource::TextureView(floats.view())),
        ("source_nearest", wgpu::BindingResource::Sampler(&sampler)),
    ];
    pipeline.bind(&gpu, 0, &resources).expect("unfiltered 32-bit floats can be sampled everywhere");
}

#[test]
fn both_stages_of_a_render_pipeline_share_their_variables() {
    let gpu = Gpu::noop().expect("it needs no driver");
    let source = "
        @group(0) @binding(0) var<uniform> shift: vec4<f32>;
        @group(0) @binding(1) var<uniform> colour: vec4<f32>;
        @vertex fn vs() -> @builtin(position) vec4<f32> { return shift; }
        @fragment fn fs() -> @location(0) vec4<f32> { return colour + shift; }";
    let shader = Shader::from_source(&gpu, "test.wgsl", source).unwrap_or_else(|error| panic!("{error}"));
    let desc = RenderPipelineDesc {
        label: "shifted",
        vertex: "vs",
        fragment: "fs",
        targets: &[TextureFormat::Rgba16Float.into()],
        depth: None,
        primitive: wgpu::PrimitiveState::default(),
        constants: &[],
    };
    let pipeline = RenderPipeline::new(&gpu, &shader, &desc).unwrap_or_else(|error| panic!("{error}"));
    let value = gpu.uniform("value", &[0.0_f32; 4]).expect("small");
    let resources = [("shift", value.as_entire_binding()), ("colour", value.as_entire_binding())];
    pipeline.bind(&gpu, 0, &resources).expect("each variable once");
}

#[repr(C)]
struct Params {
    size: [u32; 2],
    gain: f32,
    _pad: f32,
}

#[test]
fn layouts_of_both_sides_are_equal_and_a_renamed_or_moved_member_is_not() {
    let fixture = Fixture::new();
    let wgsl = |name| fixture.shader.struct_layout(name);
    assert_eq!(wgsl("Params"), Some(rust_layout!(Params { size, gain, _pad })), "the twin");
    assert_ne!(wgsl("Params"), Some(rust_layout!(Params { size, _pad, gain })), "another order");
    assert_ne!(wgsl("Params"), Some(rust_layout!(Params { size, gain })), "a member left out");
    assert_eq!(wgsl("Parms"), None, "no such struct");
}

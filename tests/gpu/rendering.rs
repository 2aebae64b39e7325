//! Drawing and computing through pipelines from reflection.

use tyndall_gpu::wgpu::{self, TextureFormat, TextureUsages};
use tyndall_gpu::{ComputePipeline, Gpu, PassTimer, RenderPipeline, RenderPipelineDesc, Shader, TextureDesc};
use tyndall_tests::gpu;

const GRADIENT: &str = include_str!("../fixtures/gradient.wgsl");
const INDICES: &str = include_str!("../fixtures/indices.wgsl");

/// Draws the gradient and reads it back.
pub(crate) fn draw(gpu: &Gpu, size_px: [u32; 2], timer: &mut PassTimer) -> Vec<u8> {
    let usage = TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC;
    let format = TextureFormat::Rgba32Float;
    let target = gpu.texture(&TextureDesc::new_2d("gradient", size_px, format, usage)).expect("small");
    let shader = Shader::from_source(gpu, "gradient.wgsl", GRADIENT).unwrap_or_else(|error| panic!("{error}"));
    let desc = RenderPipelineDesc {
        label: "gradient",
        vertex: "vs",
        fragment: "fs",
        targets: &[format.into()],
        depth: None,
        primitive: wgpu::PrimitiveState::default(),
        constants: &[],
    };
    let pipeline = RenderPipeline::new(gpu, &shader, &desc).unwrap_or_else(|error| panic!("{error}"));
    let colour = gpu.uniform("colour", &[0.25_f32, 0.5]).expect("small");
    let bindings = pipeline.bind(gpu, 0, &[("blue_alpha", colour.as_entire_binding())]).expect("the one variable");
    timer.begin_frame();
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: target.view(),
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations::default(),
        })],
        timestamp_writes: timer.render_writes("gradient"),
        ..Default::default()
    });
    pass.set_pipeline(pipeline.raw());
    pass.set_bind_group(0, &bindings, &[]);
    pass.draw(0..3, 0..1);
    drop(pass);
    timer.resolve(&mut encoder);
    gpu.queue.submit([encoder.finish()]);
    gpu.read_texture(&target).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn a_drawn_gradient_has_the_values_of_its_pixel_centres() {
    let [width, height] = [37_u32, 11];
    let mut timer = PassTimer::new(gpu(), 1).expect("small");
    let texels: Vec<f32> = bytemuck::pod_collect_to_vec(&draw(gpu(), [width, height], &mut timer));
    for (i, texel) in (0..).zip(texels.chunks_exact(4)) {
        let (x, y) = (i % width, i / width);
        let want = [(x as f32 + 0.5) / width as f32, (y as f32 + 0.5) / height as f32, 0.25, 0.5];
        for (value, want) in texel.iter().zip(want) {
            // Rasterisers interpolate in fixed point of at least 8 fractional bits of a pixel.
            assert!((value - want).abs() <= 1.0 / 256.0 / width.min(height) as f32, "({x}, {y}): {value} for {want}");
        }
    }
}

#[test]
fn the_same_draw_twice_gives_the_same_bytes() {
    let mut timer = PassTimer::new(gpu(), 1).expect("small");
    let first = draw(gpu(), [97, 33], &mut timer);
    assert!(first == draw(gpu(), [97, 33], &mut timer), "one adapter, one scene, one frame, the same bytes");
}

/// Runs `fill_indices` over `count` elements and returns them; further elements keep their zero.
fn indices(constants: &[(&str, f64)], count: u32) -> (ComputePipeline, Vec<u32>) {
    let gpu = gpu();
    let shader = Shader::from_source(gpu, "indices.wgsl", INDICES).unwrap_or_else(|error| panic!("{error}"));
    let pipeline =
        ComputePipeline::new(gpu, &shader, "fill_indices", constants).unwrap_or_else(|error| panic!("{error}"));
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
    let out = gpu.buffer("indices", 4 * 1000, usage).expect("small");
    let bindings = pipeline.bind(gpu, 0, &[("indices", out.as_entire_binding())]).expect("the one variable");
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
    pass.set_bind_group(0, &bindings, &[]);
    pipeline.dispatch(&mut pass, [count, 1, 1]);
    drop(pass);
    gpu.queue.submit([encoder.finish()]);
    (pipeline, bytemuck::pod_collect_to_vec(&gpu.read_buffer(&out).unwrap_or_else(|error| panic!("{error}"))))
}

#[test]
fn a_dispatch_covers_every_invocation_whatever_the_workgroup_size() {
    for group in [1_u32, 7, 64] {
        let (pipeline, values) = indices(&[("GROUP", group.into()), ("OFFSET", 5.0)], 1000);
        assert_eq!(pipeline.workgroup_size(), [group, 1, 1], "the override of the workgroup size is reflected");
        let want: Vec<u32> = (0..1000).map(|i| i + 5).collect();
        assert_eq!(values, want, "workgroups of {group}");
    }
}

#[test]
fn a_dispatch_rounds_up_to_whole_workgroups() {
    let (_, values) = indices(&[("GROUP", 64.0)], 65);
    assert_eq!(values.iter().filter(|value| **value > 0).count(), 128, "two workgroups of 64");
}

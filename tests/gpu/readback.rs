//! Bytes come back as they were written, without the padding that copies need.

use tyndall_gpu::wgpu::{self, BufferUsages, TextureFormat, TextureUsages};
use tyndall_gpu::{Gpu, Texture, TextureDesc};
use tyndall_tests::gpu;

const COPY: TextureUsages = TextureUsages::COPY_DST.union(TextureUsages::COPY_SRC);

/// Bytes that differ from their neighbours in every direction.
fn pattern(count: usize) -> Vec<u8> {
    (0..count).map(|i| (i * 7 + i / 251).to_le_bytes()[0]).collect()
}

fn upload(gpu: &Gpu, texture: &Texture, bytes: &[u8], bytes_per_row: u32) {
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(bytes_per_row),
        rows_per_image: Some(texture.height()),
    };
    gpu.queue.write_texture(texture.as_image_copy(), bytes, layout, texture.size());
}

#[test]
fn odd_widths_come_back_without_padding() {
    let gpu = gpu();
    for (format, texel_bytes) in
        [(TextureFormat::R8Unorm, 1), (TextureFormat::Rgba8Unorm, 4), (TextureFormat::Rgba16Float, 8)]
    {
        for [width, height] in [[1, 1], [3, 5], [63, 2], [64, 2], [65, 3], [333, 97]] {
            let texture = gpu.texture(&TextureDesc::new_2d("odd", [width, height], format, COPY)).expect("small");
            let bytes = pattern((width * height * texel_bytes) as usize);
            upload(gpu, &texture, &bytes, width * texel_bytes);
            let back = gpu.read_texture(&texture).unwrap_or_else(|error| panic!("{error}"));
            assert!(back == bytes, "{format:?} of {width} x {height} px");
        }
    }
}

#[test]
fn volumes_come_back_slice_after_slice() {
    let gpu = gpu();
    let desc = TextureDesc::new_3d("volume", [5, 3, 4], TextureFormat::R32Float, COPY);
    let texture = gpu.texture(&desc).expect("small");
    let bytes = pattern(5 * 3 * 4 * 4);
    upload(gpu, &texture, &bytes, 5 * 4);
    assert_eq!(gpu.read_texture(&texture).expect("it can be copied"), bytes, "x fastest, then y, then z");
}

#[test]
fn depth_comes_back_as_floats() {
    let gpu = gpu();
    let usage = TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC;
    let texture =
        gpu.texture(&TextureDesc::new_2d("depth", [7, 3], TextureFormat::Depth32Float, usage)).expect("small");
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    drop(encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: texture.view(),
            depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.25), store: wgpu::StoreOp::Store }),
            stencil_ops: None,
        }),
        ..Default::default()
    }));
    gpu.queue.submit([encoder.finish()]);
    let depths: Vec<f32> = bytemuck::pod_collect_to_vec(&gpu.read_texture(&texture).expect("it can be copied"));
    assert_eq!(depths, vec![0.25; 21], "the clear value in every texel");
}

#[test]
fn buffers_of_odd_length_come_back_whole() {
    let gpu = gpu();
    for length in [1_usize, 3, 4, 1001] {
        let buffer = gpu.buffer("odd", length as u64, BufferUsages::COPY_DST | BufferUsages::COPY_SRC).expect("small");
        let mut padded = pattern(length);
        padded.resize(length.next_multiple_of(4), 0);
        gpu.queue.write_buffer(&buffer, 0, &padded);
        let back = gpu.read_buffer(&buffer).expect("it can be copied");
        assert_eq!(back, &padded[..length], "{length} bytes");
    }
}

#[test]
fn uniforms_hold_their_value_and_are_padded_to_16_bytes() {
    let gpu = gpu();
    let uniform = gpu.uniform("three", &[1.0_f32, 2.0, 3.0]).expect("small");
    assert_eq!(uniform.size(), 16, "12 bytes padded");
    assert!(uniform.usage().contains(BufferUsages::UNIFORM | BufferUsages::COPY_DST), "it can be written again");
}

#[test]
fn a_texture_without_the_usage_for_copies_is_an_error() {
    let desc = TextureDesc::new_2d("t", [4, 4], TextureFormat::Rgba8Unorm, TextureUsages::TEXTURE_BINDING);
    let texture = gpu().texture(&desc).expect("small");
    let error = gpu().read_texture(&texture).expect_err("COPY_SRC is missing").to_string();
    assert!(error.starts_with("copying texture `t`: ") && error.contains("COPY_SRC"), "{error}");
}

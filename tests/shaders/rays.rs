//! What shaders of sand answer to a list of rays.

use tyndall_gpu::{ComputePipeline, Gpu, GpuError, Shader, wgpu};

/// The answers of an entry point of a text to `inputs`, four numbers each; `own` are the resources of group 2.
pub(crate) fn answers(
    gpu: &Gpu,
    (text, entry): (&str, &str),
    inputs: &[[f32; 4]],
    own: &[(&str, wgpu::BindingResource<'_>)],
) -> Result<Vec<[f32; 4]>, GpuError> {
    let pipeline = ComputePipeline::new(gpu, &Shader::from_source(gpu, "test.wgsl", text)?, entry, &[])?;
    let storage = wgpu::BufferUsages::STORAGE;
    let bytes = size_of_val(inputs) as u64;
    let xs = gpu.buffer("inputs", bytes, storage | wgpu::BufferUsages::COPY_DST)?;
    let ys = gpu.buffer("outputs", bytes, storage | wgpu::BufferUsages::COPY_SRC)?;
    gpu.queue.write_buffer(&xs, 0, bytemuck::cast_slice(inputs));
    let rays = [("inputs", xs.as_entire_binding()), ("outputs", ys.as_entire_binding())];
    let groups = [(0, pipeline.bind(gpu, 0, &rays)?), (2, pipeline.bind(gpu, 2, own)?)];
    let count = u32::try_from(inputs.len()).unwrap_or(u32::MAX);
    gpu.validated("answering rays", |device| {
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        for (index, group) in &groups {
            pass.set_bind_group(*index, group, &[]);
        }
        pipeline.dispatch(&mut pass, [count, 1, 1]);
        drop(pass);
        gpu.queue.submit([encoder.finish()])
    })?;
    Ok(bytemuck::pod_collect_to_vec(&gpu.read_buffer(&ys)?))
}

/// A square texture of half floats.
pub(crate) fn texture(gpu: &Gpu, format: wgpu::TextureFormat, side: u32, halves: &[u16]) -> wgpu::TextureView {
    let size = wgpu::Extent3d { width: side, height: side, depth_or_array_layers: 1 };
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("test"),
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    let rows = halves.len() / side as usize * size_of::<u16>();
    let layout =
        wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: u32::try_from(rows).ok(), rows_per_image: Some(side) };
    gpu.queue.write_texture(texture.as_image_copy(), bytemuck::cast_slice(halves), layout, size);
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

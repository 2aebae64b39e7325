//! The maps of a bed on the GPU.

use half::f16;
use half::slice::{HalfBitsSliceExt as _, HalfFloatSliceExt as _};
use tyndall_dunes::Edges;
use tyndall_gpu::wgpu::{self, TextureFormat, TextureUsages};
use tyndall_gpu::{Buffer, Gpu, Texture, TextureDesc};

use super::bed::{Bed, mip_levels};
use super::ripple_tile::RippleTile;
use super::streaks::STREAK_TEXELS;
use crate::RenderError;

/// Maps of a field that follow from its sand alone.
#[derive(Debug)]
pub(super) struct BedTextures {
    pub(super) heights: Buffer,
    pub(super) winds: Texture,
    pub(super) sampler: wgpu::Sampler,
}

impl BedTextures {
    /// Of a bed.
    pub(super) fn new(gpu: &Gpu, bed: &Bed) -> Result<Self, RenderError> {
        let size = bed.heights.size();
        let address =
            if bed.edges == Edges::Periodic { wgpu::AddressMode::Repeat } else { wgpu::AddressMode::ClampToEdge };
        let texels = bed.height_levels().concat();
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
        let heights = gpu.buffer("heights of the desert", size_of_val(&texels[..]) as u64, usage)?;
        gpu.queue.write_buffer(&heights, 0, bytemuck::cast_slice(&texels));
        Ok(Self {
            heights,
            winds: of_halves(gpu, "ripples of the desert", size, &bed.ripples)?,
            sampler: sampler(gpu, address),
        })
    }
}

/// The map of a sun's light, of any size over the field.
pub(super) fn light_texture(gpu: &Gpu, size: [usize; 2], light: &[[f32; 4]]) -> Result<Texture, RenderError> {
    of_halves(gpu, "light on the desert", size, light)
}

/// The tile of ripples: slopes with squares of them, the mixed product, and heights.
pub(super) fn tile_textures(gpu: &Gpu, tile: &RippleTile) -> Result<[Texture; 3], RenderError> {
    let size = [tile.scale.texels; 2];
    let half = |value: f32| f16::from_f32(value).to_bits();
    let slopes: Vec<Vec<[u16; 4]>> =
        tile.levels.iter().map(|level| level.iter().map(|m| [m[0], m[1], m[2], m[3]].map(half)).collect()).collect();
    let cross: Vec<Vec<u16>> = tile.levels.iter().map(|level| level.iter().map(|m| half(m[4])).collect()).collect();
    let heights: Vec<Vec<u16>> = tile.heights.iter().map(|level| level.iter().copied().map(half).collect()).collect();
    Ok([
        levels(gpu, "slopes of ripples", size, TextureFormat::Rgba16Float, &slopes)?,
        levels(gpu, "moments of ripples", size, TextureFormat::R16Float, &cross)?,
        levels(gpu, "heights of ripples", size, TextureFormat::R16Float, &heights)?,
    ])
}

/// The tile of streaks.
pub(super) fn streak_texture(gpu: &Gpu, tile: &[f32]) -> Result<Texture, RenderError> {
    let size = [STREAK_TEXELS; 2];
    let half = |value: &f32| f16::from_f32(*value).to_bits();
    let floats = mip_levels(tile.to_vec(), size, |value, weight| value * weight, |a, b| a + b);
    let halves: Vec<Vec<u16>> = floats.iter().map(|level| level.iter().map(half).collect()).collect();
    levels(gpu, "streaks of blowing sand", size, TextureFormat::R16Float, &halves)
}

/// Repeats in all directions, smooth between texels and levels.
pub(super) fn sampler(gpu: &Gpu, address: wgpu::AddressMode) -> wgpu::Sampler {
    gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("desert"),
        address_mode_u: address,
        address_mode_v: address,
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        mipmap_filter: wgpu::MipmapFilterMode::Linear,
        ..Default::default()
    })
}

fn of_halves(gpu: &Gpu, label: &str, size: [usize; 2], map: &[[f32; 4]]) -> Result<Texture, RenderError> {
    let scale = |texel: [f32; 4], factor: f32| texel.map(|part| part * factor);
    let add = |a: [f32; 4], b: [f32; 4]| [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]];
    half_levels(gpu, label, size, &mip_levels(map.to_vec(), size, scale, add))
}

/// A texture of four half floats a texel, from all its mip levels.
pub(super) fn half_levels(
    gpu: &Gpu,
    label: &str,
    size: [usize; 2],
    floats: &[Vec<[f32; 4]>],
) -> Result<Texture, RenderError> {
    let halves = |level: &Vec<[f32; 4]>| {
        let mut halves = vec![[0_u16; 4]; level.len()];
        halves.as_flattened_mut().reinterpret_cast_mut::<f16>().convert_from_f32_slice(level.as_flattened());
        halves
    };
    levels(gpu, label, size, TextureFormat::Rgba16Float, &floats.iter().map(halves).collect::<Vec<_>>())
}

/// A texture with all its mip levels.
fn levels<T: bytemuck::Pod>(
    gpu: &Gpu,
    label: &str,
    size: [usize; 2],
    format: TextureFormat,
    levels: &[Vec<T>],
) -> Result<Texture, RenderError> {
    let side = |cells: usize| u32::try_from(cells).unwrap_or(u32::MAX);
    let [width, height] = size.map(side);
    let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST;
    let desc = TextureDesc::new_2d(label, [width, height], format, usage);
    let texture = gpu.texture(&TextureDesc { mip_levels: side(levels.len()), ..desc })?;
    for (level, texels) in (0..).zip(levels) {
        let place = wgpu::TexelCopyTextureInfo { mip_level: level, ..texture.as_image_copy() };
        let [width, height] = [width, height].map(|side| (side >> level).max(1));
        let bytes_per_row = width * u32::try_from(size_of::<T>()).unwrap_or(u32::MAX);
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(bytes_per_row), rows_per_image: Some(height) };
        let extent = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
        gpu.queue.write_texture(place, bytemuck::cast_slice(texels), layout, extent);
    }
    Ok(texture)
}

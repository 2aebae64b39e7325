//! Turbulence finer than a cell as a texture, and how it moves with the wind.

use tyndall_clouds::{BILLOWS_LEVELS, BILLOWS_SIDE, Billows};
use tyndall_gpu::wgpu::{self, TextureFormat, TextureUsages};
use tyndall_gpu::{Gpu, Texture, TextureDesc};

use super::source::CloudSourceRequest;
use crate::RenderError;

/// Seed of the lobes: where they lie does not belong to the scene.
const SEED: u64 = 1996;

/// The tile and its mip levels.
pub(super) fn billow_texture(gpu: &Gpu) -> Result<Texture, RenderError> {
    let side = u32::try_from(BILLOWS_SIDE).unwrap_or(u32::MAX);
    let mip_levels = u32::try_from(BILLOWS_LEVELS).unwrap_or(1);
    let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST;
    let desc = TextureDesc::new_3d("turbulence of clouds", [side; 3], TextureFormat::R8Unorm, usage);
    let texture = gpu.texture(&TextureDesc { mip_levels, ..desc })?;
    for (level, texels) in (0..mip_levels).zip(&Billows::new(SEED).levels) {
        let side = side >> level;
        let place = wgpu::TexelCopyTextureInfo { mip_level: level, ..texture.as_image_copy() };
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(side), rows_per_image: Some(side) };
        let size = wgpu::Extent3d { width: side, height: side, depth_or_array_layers: side };
        gpu.queue.write_texture(place, texels, layout, size);
    }
    Ok(texture)
}

/// How far the wind half-way up has moved clouds since the warm-up's end, in cells east and north; those of files stand still.
pub(super) fn drift_cells(source: &CloudSourceRequest, time_s: f64) -> [f64; 2] {
    let CloudSourceRequest::Automaton { params, .. } = source else { return [0.0; 2] };
    let (wind, cell_m) = (&params.wind, params.grid.cell_m);
    let cells = |speed_m_s: f64, from_deg: f64| {
        let (sine, cosine) = from_deg.to_radians().sin_cos();
        [-sine, -cosine].map(|part| 0.5 * part * speed_m_s * time_s / cell_m)
    };
    let floor = cells(wind.floor_speed_m_s, wind.floor_from_deg);
    let ceiling = cells(wind.ceiling_speed_m_s, wind.ceiling_from_deg);
    [floor[0] + ceiling[0], floor[1] + ceiling[1]]
}

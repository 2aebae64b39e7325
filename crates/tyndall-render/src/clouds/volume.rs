//! The clouds' matter and light as 3-D textures, made by the CPU and kept while what they follow from stays the same.

use std::sync::Arc;

use tyndall_clouds::{CloudLight, CloudMatter, cloud_light};
use tyndall_core::grid::Grid3;
use tyndall_gpu::wgpu::{self, TextureFormat, TextureUsages};
use tyndall_gpu::{Gpu, Texture, TextureDesc};

use super::skip::skip_cells;
use crate::RenderError;

/// Largest optical depth that is stored: a half float holds it, and no light is left beyond.
const MOST_DEPTH: f32 = 6e4;

/// What the textures follow from.
#[derive(Clone, Debug)]
pub(super) struct VolumeRequest {
    /// The clouds.
    pub(super) matter: Arc<CloudMatter>,
    /// Direction to the sun.
    pub(super) to_sun: [f64; 3],
    /// One less the mean cosine of scattering.
    pub(super) transport: f64,
}

impl VolumeRequest {
    /// Whether the clouds are the same object as those of another request; their light may differ.
    fn has_matter_of(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.matter, &other.matter)
    }

    fn is(&self, other: &Self) -> bool {
        let light = |request: &Self| (request.to_sun, request.transport);
        self.has_matter_of(other) && light(self) == light(other)
    }
}

/// Textures of the clouds.
#[derive(Debug)]
pub(super) struct CloudTextures {
    /// Extinction (1/m), optical depth to the sun, diffuse sunlight (1/sr) and the sky's share, at the cells' centres.
    pub(super) cells: Texture,
    /// How far rays may jump, for each block.
    pub(super) skips: Texture,
}

/// The textures of the last request.
#[derive(Debug, Default)]
pub(super) struct CloudVolume {
    textures: Option<(VolumeRequest, CloudTextures)>,
}

impl CloudVolume {
    /// The textures for a request; nothing is computed that was computed for the last one.
    pub(super) fn update(&mut self, gpu: &Gpu, request: &VolumeRequest) -> Result<&CloudTextures, RenderError> {
        let held = self.textures.take();
        let textures = match held {
            Some((last, textures)) if last.is(request) => textures,
            last => {
                let skips = last.filter(|(last, _)| last.has_matter_of(request)).map(|(_, textures)| textures.skips);
                upload(gpu, request, skips)?
            }
        };
        Ok(&self.textures.insert((request.clone(), textures)).1)
    }
}

fn upload(gpu: &Gpu, request: &VolumeRequest, skips: Option<Texture>) -> Result<CloudTextures, RenderError> {
    let CloudMatter { extinction_per_m, cell_m, edges, .. } = &*request.matter;
    let light = cloud_light(extinction_per_m, *cell_m, request.to_sun, request.transport, *edges)?;
    let texels = texels(extinction_per_m, &light);
    let bytes = bytemuck::cast_slice::<_, u8>(&texels);
    let cells = filled(gpu, "clouds", (extinction_per_m.size(), TextureFormat::Rgba16Float, 8), bytes)?;
    let skips = if let Some(skips) = skips {
        skips
    } else {
        let blocks = skip_cells(extinction_per_m, *edges);
        filled(gpu, "clouds' gaps", (blocks.size(), TextureFormat::R8Uint, 1), blocks.cells())?
    };
    Ok(CloudTextures { cells, skips })
}

/// Matter and light of the cells as the bits of half floats.
fn texels(extinction: &Grid3<f32>, light: &CloudLight) -> Vec<[u16; 4]> {
    let depths = light.sun_depth.cells().iter().zip(light.sun_diffuse.cells()).zip(light.sky_share.cells());
    let texel = |(extinction, ((depth, diffuse), sky)): (&f32, ((&f32, &f32), &f32))| {
        [*extinction, depth.min(MOST_DEPTH), *diffuse, *sky].map(|value| half::f16::from_f32(value).to_bits())
    };
    extinction.cells().iter().zip(depths).map(texel).collect()
}

/// A 3-D texture that holds `bytes`.
fn filled(
    gpu: &Gpu,
    label: &str,
    (size, format, texel_bytes): ([usize; 3], TextureFormat, u32),
    bytes: &[u8],
) -> Result<Texture, RenderError> {
    let size = size.map(|count| u32::try_from(count).unwrap_or(u32::MAX));
    let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST;
    let texture = gpu.texture(&TextureDesc::new_3d(label, size, format, usage))?;
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(texel_bytes * size[0]),
        rows_per_image: Some(size[1]),
    };
    gpu.queue.write_texture(texture.as_image_copy(), bytes, layout, texture.size());
    Ok(texture)
}

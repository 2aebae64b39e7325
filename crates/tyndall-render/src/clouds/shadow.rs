//! What clouds leave of the light of sun and sky, as data on the GPU. WGSL: `shaders/clouds/shadow.wgsl`.
//!
//! The ground, the landscape and the air in front of it read [`CloudShadow::bindings`]; shafts of light are to.

use tyndall_clouds::floor_shadow::{FloorLight, FloorShadow, LOWEST_SUN, OPEN_SKY, sun_slope};
use tyndall_clouds::{CloudMatter, Edges};
use tyndall_gpu::wgpu::{self, BufferUsages, TextureFormat, TextureUsages};
use tyndall_gpu::{Buffer, Gpu, Texture, TextureDesc};

use super::gpu_data;
use super::lamp::Lamp;
use super::request::LightRequest;
use crate::RenderError;

/// Map, uniform and samplers, of clouds or of an open sky.
#[derive(Debug)]
pub(super) struct CloudShadow {
    uniform: Buffer,
    /// A map and cells without clouds.
    open: [Texture; 2],
    /// Samplers of grids that repeat, and of others.
    samplers: [wgpu::Sampler; 2],
    /// Of the clouds that the uniform is of, whether they repeat.
    clouds_wrap: Option<bool>,
}

impl CloudShadow {
    /// The light of an open sky.
    ///
    /// # Errors
    /// When memory does not suffice.
    pub(super) fn new(gpu: &Gpu) -> Result<Self, RenderError> {
        let bytes = size_of::<gpu_data::CloudShadow>() as u64;
        let open = FloorShadow { size: [1, 1], corner_cells: [0, 0], light: vec![OPEN_SKY] };
        let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST;
        let cells = gpu.texture(&TextureDesc::new_3d("no clouds", [1, 1, 1], TextureFormat::Rgba16Float, usage))?;
        let sampler = |address| {
            gpu.device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("cloud shadow"),
                address_mode_u: address,
                address_mode_v: address,
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                mipmap_filter: wgpu::MipmapFilterMode::Linear,
                ..Default::default()
            })
        };
        let new = Self {
            uniform: gpu.buffer("cloud shadow", bytes, BufferUsages::STORAGE | BufferUsages::COPY_DST)?,
            open: [shadow_map(gpu, &[open])?, cells],
            samplers: [sampler(wgpu::AddressMode::Repeat), sampler(wgpu::AddressMode::ClampToEdge)],
            clouds_wrap: None,
        };
        gpu.queue.write_buffer(&new.uniform, 0, bytemuck::bytes_of(&gpu_data::CloudShadow::open_sky()));
        Ok(new)
    }

    /// Uploads where the clouds of a frame are; without clouds the sky is open.
    pub(super) fn update(&mut self, gpu: &Gpu, uniform: Option<&gpu_data::CloudShadow>) {
        let open_sky = gpu_data::CloudShadow::open_sky();
        self.clouds_wrap = uniform.map(|uniform| uniform.wraps == 1);
        let uniform = uniform.unwrap_or(&open_sky);
        gpu.queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(uniform));
    }

    /// Whether there are clouds.
    pub(super) fn is_of_clouds(&self) -> bool {
        self.clouds_wrap.is_some()
    }

    /// What `clouds/shadow.wgsl` needs, by the names of its variables, for the map and cells of clouds, if there are any.
    pub(super) fn bindings<'a>(
        &'a self,
        clouds: Option<[&'a Texture; 2]>,
    ) -> [(&'static str, wgpu::BindingResource<'a>); 4] {
        let [map, cells] = clouds.unwrap_or(self.open.each_ref());
        [
            ("cloud_shade", self.uniform.as_entire_binding()),
            ("cloud_shade_map", map.as_binding()),
            ("cloud_shade_cells", cells.as_binding()),
            (
                "cloud_shade_sampler",
                wgpu::BindingResource::Sampler(&self.samplers[usize::from(self.clouds_wrap == Some(false))]),
            ),
        ]
    }
}

impl gpu_data::CloudShadow {
    /// Full light everywhere.
    #[must_use]
    pub fn open_sky() -> Self {
        Self {
            map_size_m: [1.0; 2],
            cells_size_m: [1.0; 2],
            // Every altitude is above.
            floor_m: -2e6,
            ceiling_m: -1e6,
            texel_m: 1.0,
            layers: 1.0,
            wraps: 1,
            mean: [1.0, 0.0, 1.0],
            ..bytemuck::Zeroable::zeroed()
        }
    }

    /// Of clouds in some light, from their map and its coarser levels.
    #[expect(clippy::cast_possible_truncation, reason = "the GPU computes in f32")]
    pub(super) fn new(matter: &CloudMatter, light: &LightRequest, levels: &[FloorShadow]) -> Self {
        let Some(map) = levels.first() else { return Self::open_sky() };
        let Lamp { direction: to_sun, radius_rad, is_moon } = light.lamp;
        let [west, south, floor_m] = matter.low_corner_m;
        let [width, depth, height] = matter.extent_m();
        let cell_m = matter.cell_m;
        let [beyond_west, beyond_south] = map.corner_cells.map(|cells| cells as f64 * cell_m);
        let length = to_sun.iter().map(|part| part * part).sum::<f64>().sqrt();
        let wraps = matter.edges == Edges::Wrap;
        Self {
            map_corner_m: [west + beyond_west, south + beyond_south].map(|at| at as f32),
            map_size_m: map.size.map(|texels| (texels as f64 * cell_m) as f32),
            cells_corner_m: [west, south].map(|at| at as f32),
            cells_size_m: [width, depth].map(|side| side as f32),
            slope: sun_slope(to_sun).map(|slope| slope as f32),
            floor_m: floor_m as f32,
            ceiling_m: (floor_m + height) as f32,
            texel_m: cell_m as f32,
            spread: (2.0 * radius_rad.tan() / (to_sun[2] / length).max(LOWEST_SUN)) as f32,
            layers: matter.extinction_per_m.size()[2] as f32,
            wraps: u32::from(wraps),
            mean: if wraps { mean(map) } else { parts(OPEN_SKY) },
            moonlit: u32::from(is_moon),
            lamp: to_sun.map(|part| (part / length) as f32),
            padding: 0,
        }
    }
}

/// The mean of a map.
fn mean(map: &FloorShadow) -> [f32; 3] {
    let mut sums = [0.0_f64; 3];
    for light in &map.light {
        sums.iter_mut().zip(parts(*light)).for_each(|(sum, part)| *sum += f64::from(part));
    }
    #[expect(clippy::cast_possible_truncation, reason = "the GPU computes in f32")]
    sums.map(|sum| (sum / map.light.len().max(1) as f64) as f32)
}

fn parts(light: FloorLight) -> [f32; 3] {
    [light.direct, light.diffuse, light.sky]
}

/// The map and its coarser levels as a texture.
pub(super) fn shadow_map(gpu: &Gpu, levels: &[FloorShadow]) -> Result<Texture, RenderError> {
    let size = levels.first().map_or([1, 1], |map| map.size).map(|count| u32::try_from(count).unwrap_or(u32::MAX));
    let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST;
    let flat = TextureDesc::new_2d("cloud shadow", size, TextureFormat::Rgba16Float, usage);
    let mip_levels = u32::try_from(levels.len()).unwrap_or(u32::MAX);
    let texture = gpu.texture(&TextureDesc { mip_levels, ..flat })?;
    for (level, map) in (0..).zip(levels) {
        write_level(gpu, &texture, map, level);
    }
    Ok(texture)
}

fn write_level(gpu: &Gpu, texture: &Texture, map: &FloorShadow, level: u32) {
    let texel = |light: &FloorLight| {
        [light.direct, light.diffuse, light.sky, 1.0].map(|share| half::f16::from_f32(share).to_bits())
    };
    let texels: Vec<[u16; 4]> = map.light.iter().map(texel).collect();
    let [width, height] = map.size.map(|count| u32::try_from(count).unwrap_or(u32::MAX));
    let layout =
        wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(8 * width), rows_per_image: Some(height) };
    let place = wgpu::TexelCopyTextureInfo { mip_level: level, ..texture.as_image_copy() };
    let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
    gpu.queue.write_texture(place, bytemuck::cast_slice(&texels), layout, size);
}

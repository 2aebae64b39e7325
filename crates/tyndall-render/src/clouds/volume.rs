//! The clouds' matter and light as 3-D textures, made by the CPU and kept while what they follow from stays the same.

use tyndall_clouds::{CloudLight, CloudParams, CloudSimulation, cloud_light};
use tyndall_core::grid::Grid3;
use tyndall_gpu::wgpu::{self, TextureFormat, TextureUsages};
use tyndall_gpu::{Gpu, Texture, TextureDesc};

use super::skip::skip_cells;
use crate::RenderError;

/// Largest optical depth that is stored: a half float holds it, and no light is left beyond.
const MOST_DEPTH: f32 = 6e4;

/// What the cells follow from.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct VolumeRequest {
    /// The simulation.
    pub(super) params: CloudParams,
    /// Time (s) since the end of the warm-up.
    pub(super) time_s: f64,
    /// Direction to the sun.
    pub(super) to_sun: [f64; 3],
    /// One less the mean cosine of scattering.
    pub(super) transport: f64,
}

/// Textures of the clouds.
#[derive(Debug)]
pub(super) struct CloudTextures {
    /// Extinction (1/m), optical depth to the sun, diffuse sunlight (1/sr) and the sky's share, at the cells' centres.
    pub(super) cells: Texture,
    /// How far rays may jump, for each block.
    pub(super) skips: Texture,
}

/// The simulation, its matter at a moment, and the textures.
#[derive(Debug, Default)]
pub(super) struct CloudVolume {
    simulation: Option<CloudSimulation>,
    matter: Option<(CloudParams, u64, Grid3<f32>)>,
    textures: Option<(VolumeRequest, CloudTextures)>,
}

impl CloudVolume {
    /// The textures for a request; nothing is computed that was computed for the last one.
    pub(super) fn update(&mut self, gpu: &Gpu, request: &VolumeRequest) -> Result<&CloudTextures, RenderError> {
        let held = self.textures.take();
        let textures = match held {
            Some((last, textures)) if last == *request => textures,
            last => {
                let before = self.matter.as_ref().map(|(params, time, _)| (params.clone(), *time));
                self.update_matter(request)?;
                let same_matter = before == self.matter.as_ref().map(|(params, time, _)| (params.clone(), *time));
                let skips = last.filter(|_| same_matter).map(|(_, textures)| textures.skips);
                self.upload(gpu, request, skips)?
            }
        };
        Ok(&self.textures.insert((request.clone(), textures)).1)
    }

    /// The extinction at the moment that was asked for.
    fn update_matter(&mut self, request: &VolumeRequest) -> Result<(), RenderError> {
        let VolumeRequest { params, time_s, .. } = request;
        let key = (params, time_s.to_bits());
        if self.matter.as_ref().is_some_and(|(params, time, _)| (params, *time) == key) {
            return Ok(());
        }
        let earlier = self.simulation.take().filter(|known| known.params() == params);
        let (steps, fraction) = moment(time_s / params.grid.step_s);
        let wanted = params.grid.warm_up_steps + steps;
        let mut simulation = match earlier.filter(|known| known.automaton().step_count() <= wanted) {
            Some(known) => known,
            None => CloudSimulation::new(params)?,
        };
        simulation.advance(wanted - simulation.automaton().step_count());
        let extinction = simulation.extinction_per_m(fraction)?;
        self.matter = Some((params.clone(), time_s.to_bits(), extinction));
        self.simulation = Some(simulation);
        Ok(())
    }

    fn upload(&self, gpu: &Gpu, request: &VolumeRequest, skips: Option<Texture>) -> Result<CloudTextures, RenderError> {
        let empty = Grid3::filled([1, 1, 1], 0.0);
        let extinction = self.matter.as_ref().map_or(&empty, |(_, _, extinction)| extinction);
        let grid = &request.params.grid;
        let light = cloud_light(extinction, grid.cell_m, request.to_sun, request.transport, grid.edges)?;
        let texels = texels(extinction, &light);
        let bytes = bytemuck::cast_slice::<_, u8>(&texels);
        let cells = filled(gpu, "clouds", (extinction.size(), TextureFormat::Rgba16Float, 8), bytes)?;
        let skips = if let Some(skips) = skips {
            skips
        } else {
            let blocks = skip_cells(extinction, grid.edges);
            filled(gpu, "clouds' gaps", (blocks.size(), TextureFormat::R8Uint, 1), blocks.cells())?
        };
        Ok(CloudTextures { cells, skips })
    }
}

/// Whole steps and the share of the next, of which the simulation shows the time between its last two: the share 1 is the
/// last step itself.
#[expect(clippy::cast_possible_truncation, reason = "times and steps have small ranges")]
fn moment(steps: f64) -> (u32, f32) {
    let last = steps.ceil();
    (last as u32, (1.0 - (last - steps)) as f32)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_are_shares_of_the_step_that_ends_next() {
        assert_eq!(moment(0.0), (0, 1.0), "the end of the warm-up");
        assert_eq!(moment(3.0), (3, 1.0), "a whole step");
        assert_eq!(moment(2.25), (3, 0.25), "a quarter of the third");
    }
}

//! The clouds' matter and light as 3-D textures, made by the CPU and kept while what they follow from stays the same.

use std::sync::Arc;
use std::time::Instant;

use rayon::prelude::*;
use tyndall_clouds::{
    CloudLight, CloudMatter, FloorShadow, cloud_light, deep_extinction_per_m, floor_shadow, steepened,
};
use tyndall_core::array::NamedArrays;
use tyndall_core::grid::Grid3;
use tyndall_gpu::wgpu::{self, TextureFormat, TextureUsages};
use tyndall_gpu::{Gpu, Texture, TextureDesc};

use super::building::{CloudProgress, Making};
use super::gpu_data;
use super::lamp::Lamp;
use super::report::CloudReport;
use super::shadow::shadow_map;
use super::skip::skip_cells;
use super::source::{CloudSource, CloudSourceRequest};
use crate::RenderError;
use crate::sky::TableBuilding;

/// Largest optical depth that is stored: a half float holds it, and no light is left beyond.
const MOST_DEPTH: f32 = 6e4;

/// How much steeper edges are, per unit of detail: turbulence then breaks off few puffs.
const STEEPENING: f64 = 0.6;

/// What the textures follow from.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct VolumeRequest {
    /// The clouds.
    pub(super) source: CloudSourceRequest,
    /// Their light.
    pub(super) light: LightRequest,
}

/// What the light in the clouds follows from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LightRequest {
    /// Sun or moon.
    pub(super) lamp: Lamp,
    /// One less the mean cosine of scattering.
    pub(super) transport: f64,
    /// How deep turbulence cuts into edges, 0 to 1.
    pub(super) detail: f64,
}

/// Matter and light at the cells' centres, ready to be uploaded.
#[derive(Debug)]
pub(super) struct Volume {
    pub(super) matter: Arc<CloudMatter>,
    full_per_m: f64,
    shares: Vec<u16>,
    texels: Vec<[u16; 4]>,
    /// Light below them, from fine to coarse.
    shadow: Vec<FloorShadow>,
    /// How far rays may jump.
    skips: Arc<Grid3<u8>>,
    report: Option<Arc<CloudReport>>,
}

/// Makes volumes, with as much as possible of what was made for the last one; uses no GPU.
#[derive(Debug, Default)]
pub(super) struct VolumeMaker {
    source: CloudSource,
    skips: Option<(Arc<CloudMatter>, Arc<Grid3<u8>>)>,
}

impl VolumeMaker {
    /// Chooses the state from which simulations start.
    pub(super) fn start_from(&mut self, state: Option<NamedArrays>) {
        self.source.start_from(state);
    }

    /// The volume of a request; `None` when `is_stale`, which is asked now and then, says that nobody waits for it.
    pub(super) fn make(
        &mut self,
        request: &VolumeRequest,
        is_stale: &dyn Fn() -> bool,
    ) -> Result<Option<Volume>, RenderError> {
        let Some(matter) = self.source.matter_unless(&request.source, is_stale)? else { return Ok(None) };
        let started = Instant::now();
        let LightRequest { lamp, transport, detail } = request.light;
        let to_sun = lamp.direction;
        let full_per_m = deep_extinction_per_m(&matter.extinction_per_m);
        let steep = if detail > 0.0 {
            let steepness = 1.0 + STEEPENING * detail;
            Some(steepened(&matter.extinction_per_m, full_per_m, steepness)?)
        } else {
            None
        };
        let extinction = steep.as_ref().unwrap_or(&matter.extinction_per_m);
        let light = cloud_light(extinction, matter.cell_m, to_sun, transport, matter.edges)?;
        let texels = texels(extinction, &light);
        let shares = shares(extinction, full_per_m);
        let shadow = floor_shadow(&matter.extinction_per_m, matter.cell_m, to_sun, transport, matter.edges)?.levels();
        let report = CloudReport::new(&self.source, started.elapsed()).map(Arc::new);
        Ok(Some(Volume { full_per_m, shares, texels, shadow, skips: self.skips(&matter), report, matter }))
    }

    fn skips(&mut self, matter: &Arc<CloudMatter>) -> Arc<Grid3<u8>> {
        let known = self.skips.take().filter(|(of, _)| Arc::ptr_eq(of, matter));
        let make = || (Arc::clone(matter), Arc::new(skip_cells(&matter.extinction_per_m, matter.edges)));
        Arc::clone(&self.skips.insert(known.unwrap_or_else(make)).1)
    }
}

/// Textures of the clouds.
#[derive(Debug)]
pub(super) struct CloudTextures {
    /// Extinction (1/m), optical depth to the sun, diffuse sunlight (1/sr) and the sky's share, at the cells' centres.
    pub(super) cells: Texture,
    /// Extinction as a share of that deep in the clouds, at the cells' centres.
    pub(super) shares: Texture,
    /// How far rays may jump, for each block.
    pub(super) skips: Texture,
    /// Light on the floor below the cells, and where it is.
    pub(super) shadow: (Texture, gpu_data::CloudShadow),
}

/// The textures that are shown.
#[derive(Debug)]
pub(super) struct ShownClouds {
    /// What they were asked for.
    pub(super) request: VolumeRequest,
    /// The clouds in them.
    pub(super) matter: Arc<CloudMatter>,
    /// Extinction deep in them (1/m).
    pub(super) full_per_m: f64,
    /// Matter and light.
    pub(super) textures: CloudTextures,
    report: Option<Arc<CloudReport>>,
}

/// The textures and who makes what is in them.
#[derive(Debug, Default)]
pub(super) struct CloudVolume {
    making: Making,
    shown: Option<ShownClouds>,
    /// What could not be made, and why.
    refused: Option<(VolumeRequest, Arc<RenderError>)>,
    /// Counts what has been shown.
    revision: u64,
    progress: CloudProgress,
}

impl CloudVolume {
    /// Chooses who makes the volumes; what is shown stays.
    pub(super) fn set_building(&mut self, building: TableBuilding) {
        self.making = Making::new(building);
    }

    /// Chooses the state from which simulations start; what was made from another is forgotten.
    pub(super) fn start_from(&mut self, state: Option<NamedArrays>) {
        self.making.start_from(state);
        (self.shown, self.refused) = (None, None);
    }

    /// What is shown, and its number.
    pub(super) fn shown(&self) -> Option<(&ShownClouds, u64)> {
        self.shown.as_ref().map(|shown| (shown, self.revision))
    }

    /// How it stands since the last update.
    pub(super) fn progress(&self) -> &CloudProgress {
        &self.progress
    }

    /// A frame without clouds: nothing is made any longer.
    pub(super) fn rest(&mut self) {
        self.making.cancel();
        self.progress = CloudProgress::default();
    }

    /// The clouds to show for a request: those before, where a thread is still at these; `None` where there are none yet.
    pub(super) fn update(&mut self, gpu: &Gpu, request: &VolumeRequest) -> Result<Option<&ShownClouds>, RenderError> {
        let is_shown = self.shown.as_ref().is_some_and(|shown| shown.request == *request);
        let is_refused = self.refused.as_ref().is_some_and(|(refused, _)| refused == request);
        if let Some((request, made)) = self.making.next((!is_shown && !is_refused).then_some(request)) {
            match made {
                Ok(volume) => self.show(gpu, request, volume)?,
                Err(error) => self.refused = Some((request, Arc::new(error))),
            }
        }
        let shown = self.shown.as_ref();
        self.progress.building = shown.is_none_or(|shown| shown.request != *request);
        self.progress.report = shown.and_then(|shown| shown.report.clone());
        if let Some((_, error)) = self.refused.as_ref().filter(|(refused, _)| refused == request) {
            self.progress.building = false;
            return Err(RenderError::Refused(Arc::clone(error)));
        }
        Ok(shown)
    }

    fn show(&mut self, gpu: &Gpu, request: VolumeRequest, volume: Volume) -> Result<(), RenderError> {
        self.revision += 1;
        // The old ones give their memory back first.
        self.shown = None;
        let Volume { matter, full_per_m, shares, texels, shadow, skips, report } = volume;
        let size = matter.extinction_per_m.size();
        let shares = filled(gpu, "clouds", (size, TextureFormat::R16Float, 2), bytemuck::cast_slice(&shares))?;
        let bytes = bytemuck::cast_slice::<_, u8>(&texels);
        let cells = filled(gpu, "light in clouds", (size, TextureFormat::Rgba16Float, 8), bytes)?;
        let skips = filled(gpu, "clouds' gaps", (skips.size(), TextureFormat::R8Uint, 1), skips.cells())?;
        let shadow = (shadow_map(gpu, &shadow)?, gpu_data::CloudShadow::new(&matter, &request.light, &shadow));
        let textures = CloudTextures { cells, shares, skips, shadow };
        self.shown = Some(ShownClouds { request, matter, full_per_m, textures, report });
        Ok(())
    }
}

/// Matter as shares of `full_per_m`, as the bits of half floats.
fn shares(extinction: &Grid3<f32>, full_per_m: f64) -> Vec<u16> {
    let scale = 1.0 / full_per_m;
    extinction.cells().par_iter().map(|value| half::f16::from_f64(f64::from(*value) * scale).to_bits()).collect()
}

/// Matter and light of the cells as the bits of half floats.
fn texels(extinction: &Grid3<f32>, light: &CloudLight) -> Vec<[u16; 4]> {
    let cells = extinction.cells().par_iter().zip(light.sun_depth.cells());
    let texel = |(((extinction, depth), diffuse), sky): (((&f32, &f32), &f32), &f32)| {
        [*extinction, depth.min(MOST_DEPTH), *diffuse, *sky].map(|value| half::f16::from_f32(value).to_bits())
    };
    cells.zip(light.sun_diffuse.cells()).zip(light.sky_share.cells()).map(texel).collect()
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

//! The clouds' matter and light as 3-D textures, kept while what they follow from stays the same.

use std::sync::Arc;

use tyndall_clouds::CloudMatter;
use tyndall_clouds::splats::BallField;
use tyndall_core::array::NamedArrays;
use tyndall_gpu::wgpu::{self, TextureFormat, TextureUsages};
use tyndall_gpu::{Gpu, Texture, TextureDesc};

use super::building::{CloudProgress, Making};
use super::gpu_data;
use super::maker::Volume;
use super::report::CloudReport;
use super::request::VolumeRequest;
use super::shadow::shadow_map;
use crate::RenderError;
use crate::sky::TableBuilding;

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
    /// Their balls with their light, for clouds of splats.
    pub(super) balls: Option<BallField>,
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
        let Volume { matter, full_per_m, shares, texels, shadow, skips, balls, report } = volume;
        let size = matter.extinction_per_m.size();
        let shares = filled(gpu, "clouds", (size, TextureFormat::R16Float, 2), bytemuck::cast_slice(&shares))?;
        let bytes = bytemuck::cast_slice::<_, u8>(&texels);
        let cells = filled(gpu, "light in clouds", (size, TextureFormat::Rgba16Float, 8), bytes)?;
        let skips = filled(gpu, "clouds' gaps", (skips.size(), TextureFormat::R8Uint, 1), skips.cells())?;
        let shadow = (shadow_map(gpu, &shadow)?, gpu_data::CloudShadow::new(&matter, &request.light, &shadow));
        let textures = CloudTextures { cells, shares, skips, shadow };
        self.shown = Some(ShownClouds { request, matter, full_per_m, textures, balls, report });
        Ok(())
    }
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

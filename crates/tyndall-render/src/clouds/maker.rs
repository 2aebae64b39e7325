//! Makes what clouds are drawn from, on the CPU: matter and light of the cells, their shadow, and their balls.

use std::sync::Arc;
use std::time::Instant;

use rayon::prelude::*;
use tyndall_clouds::splats::{BallField, SplatLighting};
use tyndall_clouds::{
    CloudLight, CloudMatter, Edges, FloorShadow, cloud_light, deep_extinction_per_m, floor_shadow, steepened,
    sunlight_scattered_often,
};
use tyndall_core::array::NamedArrays;
use tyndall_core::grid::Grid3;

use super::report::CloudReport;
use super::request::{LightRequest, VolumeRequest};
use super::skip::skip_cells;
use super::source::CloudSource;
use crate::RenderError;

/// Largest optical depth that is stored: a half float holds it, and no light is left beyond.
const MOST_DEPTH: f32 = 6e4;

/// How much steeper edges are, per unit of detail: turbulence then breaks off few puffs.
const STEEPENING: f64 = 0.6;

/// Matter and light at the cells' centres, ready to be uploaded.
#[derive(Debug)]
pub(super) struct Volume {
    pub(super) matter: Arc<CloudMatter>,
    /// Extinction deep in them (1/m).
    pub(super) full_per_m: f64,
    pub(super) shares: Vec<u16>,
    pub(super) texels: Vec<[u16; 4]>,
    /// Light below them, from fine to coarse.
    pub(super) shadow: Vec<FloorShadow>,
    /// How far rays may jump.
    pub(super) skips: Arc<Grid3<u8>>,
    /// The balls with their light, for clouds of splats.
    pub(super) balls: Option<BallField>,
    pub(super) report: Option<Arc<CloudReport>>,
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
        let balls = request.splats.map(|lighting| lit_balls(&matter, lighting)).transpose()?;
        Ok(Some(Volume { full_per_m, shares, texels, shadow, skips: self.skips(&matter), balls, report, matter }))
    }

    fn skips(&mut self, matter: &Arc<CloudMatter>) -> Arc<Grid3<u8>> {
        let known = self.skips.take().filter(|(of, _)| Arc::ptr_eq(of, matter));
        let make = || (Arc::clone(matter), Arc::new(skip_cells(&matter.extinction_per_m, matter.edges)));
        Arc::clone(&self.skips.insert(known.unwrap_or_else(make)).1)
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

/// The balls of clouds with their light.
fn lit_balls(matter: &CloudMatter, lighting: SplatLighting) -> Result<BallField, RenderError> {
    let [west, south, _] = matter.low_corner_m;
    let [east_m, north_m, _] = matter.extent_m();
    let period_m = (matter.edges == Edges::Wrap).then_some([east_m, north_m]);
    let field = BallField::new(&matter.balls(), ([west, south], period_m, matter.cell_m), lighting)?;
    let Some(transport) = lighting.transport else { return Ok(field) };
    let CloudMatter { extinction_per_m, cell_m, edges, low_corner_m, .. } = matter;
    let often = sunlight_scattered_often(extinction_per_m, *cell_m, lighting.to_sun, transport, *edges)?;
    Ok(field.with_diffuse(|place_m| often[cell_of(place_m, *low_corner_m, *cell_m, often.size())]))
}

/// The cell of a place, or the nearest one of the grid.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the grid")]
fn cell_of(place_m: [f64; 3], low_m: [f64; 3], cell_m: f64, size: [usize; 3]) -> [usize; 3] {
    [0, 1, 2].map(|axis| ((place_m[axis] - low_m[axis]) / cell_m).clamp(0.0, size[axis] as f64 - 1.0) as usize)
}

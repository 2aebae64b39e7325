//! The maps that lie beside the heights.

use tyndall_dunes::DesertSimulation;
use tyndall_dunes::export::DuneMaps;
use tyndall_dunes::horizon::HorizonMap;
use tyndall_dunes::measure::HeightGrid;
use tyndall_dunes::slab::DUNE_QUANTA_PER_CELL;
use tyndall_scene::{Scene, SceneError};

use crate::Failure;

/// Azimuths of the horizons that shadows come from.
const AZIMUTHS: usize = 64;

/// A map to write.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum MapName {
    /// All of them
    All,
    /// Normals: east, north, up in red, green, blue
    Normal,
    /// Direction in which ripples travel: east and north in red and green, their height in blue
    Ripples,
    /// Depth of the sand in metres
    Sand,
    /// Steps since the bed moved last
    Age,
    /// Slip faces
    SlipFace,
    /// Where the wind does not reach
    Lee,
    /// Share of the sun's disc that is seen, 0 in shadow
    Sun,
    /// Share of the sky's light that arrives
    Sky,
    /// Cover by plants
    Plants,
}

impl MapName {
    /// The names without repetition, in the order of the list.
    pub(super) fn wanted(given: &[Self]) -> Vec<Self> {
        let every = <Self as clap::ValueEnum>::value_variants().iter().copied().filter(|name| *name != Self::All);
        every.filter(|name| given.contains(name) || given.contains(&Self::All)).collect()
    }
}

/// The numbers of a layer, x runs fastest from the south-west.
#[derive(Clone, Debug)]
pub(super) enum Samples {
    /// Amounts in the unit of the layer.
    Amounts(Vec<f32>),
    /// Vectors of length 1 or less.
    Vectors(Vec<[f32; 3]>),
    /// Shares, 255 is all.
    Shares(Vec<u8>),
}

/// A map by its name.
#[derive(Clone, Debug)]
pub(super) struct Layer {
    /// Part of the file's name; nothing for the heights.
    pub(super) suffix: &'static str,
    pub(super) unit: &'static str,
    pub(super) doc: &'static str,
    pub(super) samples: Samples,
}

/// The heights and the wanted maps.
pub(super) fn make(scene: &Scene, desert: &DesertSimulation, names: &[MapName]) -> Result<Vec<Layer>, Failure> {
    let maps = desert.maps().map_err(SceneError::Sand)?;
    let heights = layer("", "m", "height over the level of the ground", Samples::Amounts(maps.height_m.clone()));
    let horizon = names.iter().any(|name| matches!(name, MapName::Sun | MapName::Sky)).then(|| horizon(desert));
    let horizon = horizon.transpose()?;
    let mut layers = vec![heights];
    for name in names {
        layers.extend(one(scene, desert, &maps, horizon.as_ref(), *name)?);
    }
    Ok(layers)
}

fn layer(suffix: &'static str, unit: &'static str, doc: &'static str, samples: Samples) -> Layer {
    Layer { suffix, unit, doc, samples }
}

/// One map; `None` for plants where none grow.
fn one(
    scene: &Scene,
    desert: &DesertSimulation,
    maps: &DuneMaps,
    horizon: Option<&HorizonMap>,
    name: MapName,
) -> Result<Option<Layer>, Failure> {
    let mask = |cells: &[u8]| Samples::Shares(cells.iter().map(|cell| 255 * cell.min(&1)).collect());
    let cells = 0..maps.height_m.len();
    Ok(Some(match name {
        MapName::All => return Ok(None),
        MapName::Normal => {
            layer("normal", "1", "normal: east, north, up, each from -1 to 1", Samples::Vectors(maps.normals.clone()))
        }
        MapName::Ripples => {
            let ripple = |[east, north]: &[f32; 2]| [*east, *north, east.hypot(*north)];
            let doc = "direction in which ripples travel: east, north, and their height, each from -1 to 1";
            layer("ripples", "1", doc, Samples::Vectors(maps.ripples.iter().map(ripple).collect()))
        }
        MapName::Sand => layer("sand", "m", "depth of the sand", Samples::Amounts(maps.sand_m.clone())),
        MapName::Age => {
            let ages = desert.age_steps().unwrap_or_default();
            #[expect(clippy::cast_precision_loss, reason = "ages beyond 2^24 steps lose their last digits")]
            let ages = ages.into_iter().map(|age| age as f32).collect();
            layer("age", "steps", "steps since the bed moved last", Samples::Amounts(ages))
        }
        MapName::SlipFace => layer("slip-face", "1", "255 on slip faces", mask(&maps.slip_face)),
        MapName::Lee => layer("lee", "1", "255 where the wind does not reach", mask(&maps.lee)),
        MapName::Sun => {
            let sun = scene.sun_direction()?.unit();
            let (azimuth, elevation) = (sun.y.atan2(sun.x), sun.z.clamp(-1.0, 1.0).asin());
            let seen = |cell| horizon.map_or(1.0, |horizon| horizon.sun_visibility(cell, azimuth, elevation));
            let doc = "share of the sun's disc that is seen, 255 is all";
            layer("sun", "1", doc, Samples::Shares(cells.map(|cell| to_u8(seen(cell))).collect()))
        }
        MapName::Sky => {
            let open = |cell| horizon.map_or(1.0, |horizon| horizon.sky_openness(cell));
            let doc = "share of an even sky's light that falls on level ground, 255 is all";
            layer("sky", "1", doc, Samples::Shares(cells.map(|cell| to_u8(open(cell))).collect()))
        }
        MapName::Plants => match desert.field().plant_cover() {
            Some(cover) => layer("plants", "1", "cover by plants, 255 is full", Samples::Shares(cover.to_vec())),
            None => return Ok(None),
        },
    }))
}

fn horizon(desert: &DesertSimulation) -> Result<HorizonMap, Failure> {
    let field = desert.field();
    let bed = HeightGrid::from_quanta(desert.size(), field.heights(), DUNE_QUANTA_PER_CELL);
    let bed = bed.ok_or_else(|| Failure::Usage("the bed has no cells".to_owned()))?;
    Ok(HorizonMap::new(&bed, AZIMUTHS, field.edges()).map_err(SceneError::Sand)?)
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 255 by the clamp")]
fn to_u8(share: f64) -> u8 {
    (share.clamp(0.0, 1.0) * 255.0).round() as u8
}

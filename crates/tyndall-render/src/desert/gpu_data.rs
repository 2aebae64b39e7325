//! The desert's uniform and how it follows from a scene.

use tyndall_dunes::blowing::GRAIN_SPEED;
use tyndall_scene::{RippleLook, SandParams, Scene};

use super::mesh::DesertMesh;

/// Twin of `Desert` in `shaders/desert/desert.wgsl`; units and meanings there.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[expect(missing_docs, reason = "documented at the WGSL twin")]
pub struct Desert {
    pub albedo: [f32; 3],
    pub facets: f32,
    pub ground: [f32; 3],
    pub cell_m: f32,
    pub size: [f32; 2],
    pub tile_m: f32,
    pub ripple_gain: f32,
    pub columns: u32,
    pub rings: u32,
    pub wraps: u32,
    pub ripples: u32,
    pub centre_radius_m: f32,
    pub far_radius_m: f32,
    pub first_azimuth: f32,
    pub azimuth_step: f32,
    pub sun_half_width: f32,
    pub shine: f32,
    pub glints: f32,
    pub bounce: f32,
    pub tile_texels: f32,
    pub hexagon_m: f32,
    pub moonlit: u32,
    pub relief: f32,
}

/// Half the width (rad) over which a shadow's edge fades: the sun's radius, and what the air's glow around it adds.
const SUN_EDGE: f64 = 0.006;

/// Index of ripples that the tile has.
pub(super) const TILE_INDEX: f64 = 16.0;

/// Ripples from one corner of the lattice of patches to the next.
const RIPPLES_A_PATCH: f64 = 14.0;

impl Desert {
    /// From a scene with a field of so many cells, its tile of ripples, the mesh of a view, and the light that casts its
    /// shadows.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "the GPU computes in f32")]
    pub fn new(scene: &Scene, size: [usize; 2], tile: TileScale, mesh: &DesertMesh, is_moonlit: bool) -> Self {
        let sand = &scene.sand;
        Self {
            albedo: [sand.red, sand.green, sand.blue].map(|albedo| albedo as f32),
            facets: sand.roughness_deg.to_radians().powi(2) as f32,
            ground: [scene.ground.red, scene.ground.green, scene.ground.blue].map(|albedo| albedo as f32),
            cell_m: scene.dunes.cell_m as f32,
            size: size.map(|cells| cells as f32),
            tile_m: (tile.ripples * sand.ripple_length_m) as f32,
            ripple_gain: (TILE_INDEX / sand.ripple_index) as f32,
            columns: mesh.columns,
            rings: mesh.rings,
            wraps: u32::from(scene.dunes.edges == tyndall_scene::Edges::Periodic),
            ripples: match sand.ripples {
                RippleLook::None => 0,
                RippleLook::Paper => 1,
                RippleLook::Best => 2,
            },
            centre_radius_m: mesh.centre_radius_m as f32,
            far_radius_m: mesh.far_radius_m as f32,
            first_azimuth: mesh.first_azimuth_rad as f32,
            azimuth_step: mesh.azimuth_step_rad as f32,
            sun_half_width: SUN_EDGE as f32,
            shine: sand.shine as f32,
            glints: sand.glints as f32,
            bounce: sand.bounce as f32,
            tile_texels: tile.texels as f32,
            hexagon_m: (RIPPLES_A_PATCH * sand.ripple_length_m) as f32,
            moonlit: u32::from(is_moonlit),
            relief: relief(sand, tile),
        }
    }
}

/// Height of the tile's highest crest as a share of its side; 0 when ripples are normals alone.
#[expect(clippy::cast_possible_truncation, reason = "the GPU computes in f32")]
fn relief(sand: &SandParams, tile: TileScale) -> f32 {
    let has_relief = sand.relief && sand.ripples == RippleLook::Best && tile.texels > 0;
    if has_relief { (tile.height / tile.texels as f64 * TILE_INDEX / sand.ripple_index) as f32 } else { 0.0 }
}

/// Twin of `Blowing` in `shaders/desert/blowing.wgsl`; units and meanings there.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[expect(missing_docs, reason = "documented at the WGSL twin")]
pub struct Blowing {
    pub albedo: [f32; 3],
    pub base_m: f32,
    pub along: [f32; 2],
    pub travelled_m: f32,
    pub top_m: f32,
    pub floor_m: f32,
    pub streaks_a_metre: f32,
    pub padding: [f32; 2],
}

/// Side (m) of the tile of streaks across the wind.
const STREAKS_M: f64 = 40.0;

impl Blowing {
    /// From a scene whose wind blows to `toward_deg`, with the level (m) that heights of columns count from, the highest sand in
    /// the air and the lowest place of the bed.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "the GPU computes in f32")]
    pub fn new(scene: &Scene, toward_deg: f64, [base_m, top_m, floor_m]: [f32; 3]) -> Self {
        let sand = &scene.sand;
        let (sin, cos) = toward_deg.to_radians().sin_cos();
        let way_m = GRAIN_SPEED * sand.wind_m_s * sand.wind_time_s;
        Self {
            albedo: [sand.red, sand.green, sand.blue].map(|albedo| grain_albedo(albedo) as f32),
            base_m,
            along: [cos, sin].map(|part| part as f32),
            travelled_m: way_m as f32,
            top_m,
            floor_m,
            streaks_a_metre: (1.0 / STREAKS_M) as f32,
            padding: [0.0; 2],
        }
    }
}

/// Share of light that single grains scatter, whose heap reflects a share of it: Hapke 1981, in which a heap of grains that
/// scatter w reflects (1 - r) / (1 + r), r the square root of 1 - w.
#[must_use]
pub fn grain_albedo(heap: f64) -> f64 {
    let root = (1.0 - heap) / (1.0 + heap);
    1.0 - root * root
}

/// How large a tile of ripples is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TileScale {
    /// Texels of a side.
    pub texels: usize,
    /// Ripples along a side.
    pub ripples: f64,
    /// Height (texels) over the mean of its highest crest, or depth of its deepest trough.
    pub height: f64,
}

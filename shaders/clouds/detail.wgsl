// Turbulence finer than a cell, which keeps the mean density: tyndall_clouds::turbulence.
// @import clouds/clouds.wgsl
// @import common/erosion.wgsl

@group(2) @binding(5) var cloud_billows: texture_3d<f32>;
@group(2) @binding(6) var cloud_billow_sampler: sampler;

/// Side of the tile (cells), and of its texels.
const CLOUD_TILE_CELLS: f32 = 20.0;
const CLOUD_TILE_TEXELS: f32 = 128.0;
/// Mip levels from which on lobes are no longer seen, and that over which they fade.
const CLOUD_LAST_LEVEL: f32 = 4.0;
/// Sharpest edge, in shares.
const CLOUD_SHARPEST: f32 = 0.05;

/// Turned, so that the tile's repetition lies along no axis of the grid.
const CLOUD_TURN = mat3x3<f32>(vec3<f32>(0.36, 0.48, -0.8), vec3<f32>(-0.8, 0.6, 0.0), vec3<f32>(0.48, 0.64, 0.6));

/// Mip level of the billows for a footprint in cells.
fn cloud_billow_level(footprint: f32) -> f32 {
    return log2(max(footprint * CLOUD_TILE_TEXELS / CLOUD_TILE_CELLS, 1.0));
}

/// Share of cloud with turbulence, the same without any (detail 0) and deep in a cloud (share 1), of what the cells have at a place in cells.
fn cloud_detailed(share: f32, place: vec3<f32>, level: f32) -> f32 {
    let at = CLOUD_TURN * (place - vec3<f32>(clouds.drift_cells, 0.0)) / CLOUD_TILE_CELLS;
    let noise = textureSampleLevel(cloud_billows, cloud_billow_sampler, at, min(level, CLOUD_LAST_LEVEL)).x;
    let softness = max(1.0 - clouds.detail * clamp(CLOUD_LAST_LEVEL + 1.0 - level, 0.0, 1.0), CLOUD_SHARPEST);
    return eroded_share(share, noise, softness);
}

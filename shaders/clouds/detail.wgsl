// Turbulence finer than a cell: billows that cut into the edges of clouds and leave their middles as they are.
// @import clouds/clouds.wgsl
// @import common/noise.wgsl

/// Wavelength of the coarsest billows over the side of a cell.
const CLOUD_BILLOW_CELLS: f32 = 7.0;
const CLOUD_BILLOW_OCTAVES: u32 = 4u;
/// Share of a cloud's extinction that the deepest billows cut away, and over which an edge rises.
const CLOUD_BILLOW_DEPTH: f32 = 0.7;
const CLOUD_EDGE: f32 = 0.12;

/// Billows of 0..1 at a place in cells, for a footprint in cells, below which none are seen.
fn cloud_billows(place: vec3<f32>, footprint: f32) -> f32 {
    var at = place / CLOUD_BILLOW_CELLS;
    var wavelength = CLOUD_BILLOW_CELLS;
    var sum = 0.0;
    var weight = 0.5;
    for (var octave = 0u; octave < CLOUD_BILLOW_OCTAVES; octave++) { // loops: CLOUD_BILLOW_OCTAVES
        let seen = clamp(0.5 * wavelength / max(footprint, 1e-3) - 1.0, 0.0, 1.0);
        // Unseen octaves count with their mean, so that clouds keep their size with distance.
        let value = select(0.5, 1.0 - abs(2.0 * noise_value(at) - 1.0), seen > 0.0);
        sum += weight * mix(0.5, value, seen);
        at = 2.03 * at.yzx + vec3<f32>(17.3, 5.1, 9.7);
        wavelength /= 2.03;
        weight *= 0.5;
    }
    return sum / (1.0 - weight * 2.0);
}

/// Extinction (1/m) with turbulence of what the cells have at a place in cells, `t` metres away.
fn cloud_detailed(extinction: f32, place: vec3<f32>, t: f32) -> f32 {
    if ((extinction <= 0.0) | (clouds.detail <= 0.0)) {
        return extinction;
    }
    let share = extinction / clouds.full_per_m;
    let deepest = CLOUD_BILLOW_DEPTH * clouds.detail;
    if (share > deepest + CLOUD_EDGE) {
        return extinction;
    }
    let footprint = t * frame_pixel_angle(vec2<f32>(0.0)) / clouds.cell_m;
    // The threshold rises where billows are hollow; edges become steep, and middles are above any threshold.
    let threshold = deepest * (1.0 - cloud_billows(place, footprint));
    return extinction * smoothstep(threshold, threshold + CLOUD_EDGE, share);
}

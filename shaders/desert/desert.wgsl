// The desert of a frame. The field of dunes is centred on the origin; x points east, y north.
// A storage buffer, and decisions without branches, as in clouds/clouds.wgsl.
// Uniform twin: tyndall_render::desert::gpu_data::Desert.

struct Desert {
    albedo: vec3<f32>,       // 1, of the sand
    facets: f32,             // rad^2, variance of the slopes of what is too small for any map
    ground: vec3<f32>,       // 1, albedo of bare ground
    cell_m: f32,             // side of a cell of the field
    size: vec2<f32>,         // cells of the field to the east and the north
    tile_m: f32,             // side of the tile of ripples
    ripple_gain: f32,        // 1, factor on the slopes of the tile
    columns: u32,            // vertices of a ring of the mesh
    rings: u32,              // of the mesh
    wraps: u32,              // 1 when the field repeats without end
    ripples: u32,            // 0 none, 1 as in the paper, 2 best
    centre_radius_m: f32,    // of the first ring outside the centre
    far_radius_m: f32,       // of the last ring
    first_azimuth: f32,      // rad from east to north, of the first column
    azimuth_step: f32,       // rad
    sun_half_width: f32,     // rad, half the width of the edge of a shadow
    shine: f32,              // 1, strength of the mirror-like part
    glints: f32,             // 1, strength of single grains
    bounce: f32,             // 1, factor on the light that sand throws on sand
    tile_texels: f32,        // of a side of the tile
    hexagon_m: f32,          // side of the triangles between which patches of ripples are blended
    moonlit: u32,            // 1 when the moon casts the shadows, not the sun
    relief: f32,             // 1, height of the tile's highest crest over its mean as a share of its side; 0 for flat normals
}
@group(2) @binding(0) var<storage, read> desert: Desert;

/// Place on the maps of the field, 0 to 1 within it, of a place (m) east and north of the origin.
fn desert_map_place(place: vec2<f32>) -> vec2<f32> {
    return place / (desert.cell_m * desert.size) + 0.5;
}

/// 1 within the field and wherever it repeats; falls to 0 within 8 cells of an open edge.
fn desert_inside(place: vec2<f32>) -> f32 {
    let away = (0.5 * desert.size - abs(place / desert.cell_m)) / 8.0;
    let share = clamp(min(away.x, away.y), 0.0, 1.0);
    return select(share * share * (3.0 - 2.0 * share), 1.0, desert.wraps == 1u);
}

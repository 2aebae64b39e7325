// The clouds of a frame: a grid of cells. Uniform twin: tyndall_render::clouds::gpu_data::Clouds.
// A storage buffer, and decisions without branches: lavapipe 22.3 fails in shaders that branch on several uniform buffers.
// @import frame/frame.wgsl

struct Clouds {
    size: vec3<f32>,       // cells east, north and up
    cell_m: f32,           // side of a cell
    asymmetry: vec2<f32>,  // 1, mean cosines of the two lobes of scattering
    forward_weight: f32,   // 1, share of the first lobe
    transport: f32,        // 1, one less the mean cosine of both
    floor_m: f32,          // altitudes between which there are cells
    ceiling_m: f32,
    reach_m: f32,          // distance from the camera beyond which no clouds are drawn
    full_per_m: f32,       // 1/m, extinction deep in a cloud, of which cloud_matter holds shares
    wraps: u32,            // 1 when the grid repeats to the east and the north
    all_orders: u32,       // 1 when light counts that was scattered more than once
    detail: f32,           // 1, how deep turbulence cuts into edges
    block_cells: f32,      // side of a block of cloud_skips
    low_corner_m: vec2<f32>, // the grid's west and south sides, from the scene's origin
    drift_cells: vec2<f32>,  // how far the wind has moved turbulence
}
@group(2) @binding(0) var<storage, read> clouds: Clouds;
@group(2) @binding(1) var cloud_matter: texture_3d<f32>; // extinction over full_per_m
@group(2) @binding(2) var cloud_sampler: sampler;
@group(2) @binding(3) var cloud_skips: texture_3d<u32>;  // cells that a ray may jump from anywhere in a block
@group(2) @binding(4) var cloud_cells: texture_3d<f32>;  // extinction (1/m), optical depth to the sun, diffuse sunlight (1/sr), share of the sky

/// Place in cells from the grid's low corner of a point: metres east and north of the origin, and its altitude.
fn cloud_place(point: vec2<f32>, altitude: f32) -> vec3<f32> {
    return vec3<f32>((point - clouds.low_corner_m) / clouds.cell_m, (altitude - clouds.floor_m) / clouds.cell_m);
}

/// Place in the textures of one in cells.
fn cloud_texture_place(place: vec3<f32>) -> vec3<f32> {
    // The sampler repeats; without it the outer half cells are those of the edge.
    let inner = select(place, clamp(place, vec3<f32>(0.5), clouds.size - 0.5), clouds.wraps == 0u);
    return inner / clouds.size;
}

/// Extinction over full_per_m at a place in cells; nothing outside a grid that does not repeat.
fn cloud_share(place: vec3<f32>) -> f32 {
    let inside = all(place.xy == clamp(place.xy, vec2<f32>(0.0), clouds.size.xy)) | (clouds.wraps == 1u);
    let share = textureSampleLevel(cloud_matter, cloud_sampler, cloud_texture_place(place), 0.0).x;
    return select(0.0, share, inside & (place.z > 0.0) & (place.z < clouds.size.z));
}

/// Optical depth to the sun, diffuse sunlight (1/sr) and the sky's share at a place in cells.
fn cloud_light_at(place: vec3<f32>) -> vec3<f32> {
    return textureSampleLevel(cloud_cells, cloud_sampler, cloud_texture_place(place), 0.0).yzw;
}

/// Cells along each axis that a ray may go on from a place without meeting cloud; 0 where there may be some.
fn cloud_skip(place: vec3<f32>) -> f32 {
    let wrapped = place.xy - clouds.size.xy * floor(place.xy / clouds.size.xy);
    let inner = select(place.xy, wrapped, clouds.wraps == 1u);
    let last = vec3<f32>(textureDimensions(cloud_skips) - 1u);
    let block = clamp(floor(vec3<f32>(inner, place.z) / clouds.block_cells), vec3<f32>(0.0), last);
    return f32(textureLoad(cloud_skips, vec3<u32>(block), 0).x);
}

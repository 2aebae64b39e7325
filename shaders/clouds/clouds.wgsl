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
    full_per_m: f32,       // 1/m, extinction deep in a cloud
    wraps: u32,            // 1 when the grid repeats to the east and the north
    all_orders: u32,       // 1 when light counts that was scattered more than once
    detail: f32,           // 1, how deep turbulence cuts into edges
    block_cells: f32,      // side of a block of cloud_skips
    low_corner_m: vec2<f32>, // the grid's west and south sides, from the scene's origin
    padding: vec2<f32>,
}
@group(2) @binding(0) var<storage, read> clouds: Clouds;
@group(2) @binding(1) var cloud_cells: texture_3d<f32>; // extinction (1/m), optical depth to the sun, diffuse sunlight (1/sr), share of the sky
@group(2) @binding(2) var cloud_sampler: sampler;
@group(2) @binding(3) var cloud_skips: texture_3d<u32>; // cells that a ray may jump from anywhere in a block

/// Place in cells from the grid's low corner of a point: metres east and north of the origin, and its altitude.
fn cloud_place(point: vec2<f32>, altitude: f32) -> vec3<f32> {
    return vec3<f32>((point - clouds.low_corner_m) / clouds.cell_m, (altitude - clouds.floor_m) / clouds.cell_m);
}

/// Matter and light at a place in cells; nothing outside a grid that does not repeat.
fn cloud_at(place: vec3<f32>) -> vec4<f32> {
    let outside = any(place.xy != clamp(place.xy, vec2<f32>(0.0), clouds.size.xy));
    if ((clouds.wraps == 0u) & outside) {
        return vec4<f32>(0.0);
    }
    // The sampler repeats; without it the outer half cells are those of the edge.
    let inner = select(place, clamp(place, vec3<f32>(0.5), clouds.size - 0.5), clouds.wraps == 0u);
    return textureSampleLevel(cloud_cells, cloud_sampler, inner / clouds.size, 0.0);
}

/// Cells along each axis that a ray may go on from a place without meeting cloud; 0 where there may be some.
fn cloud_skip(place: vec3<f32>) -> f32 {
    let wrapped = place.xy - clouds.size.xy * floor(place.xy / clouds.size.xy);
    let inner = select(place.xy, wrapped, clouds.wraps == 1u);
    let last = vec3<f32>(textureDimensions(cloud_skips) - 1u);
    let block = clamp(floor(vec3<f32>(inner, place.z) / clouds.block_cells), vec3<f32>(0.0), last);
    return f32(textureLoad(cloud_skips, vec3<u32>(block), 0).x);
}

// What clouds leave of the light of sun and sky below them: a map on the plane of their floor, seen along the sun's rays.
// Without clouds the map holds full light, and every factor here is exactly 1. At any altitude: clouds/shadow.wgsl.
// Twin: tyndall_clouds::floor_shadow. Uniform twin: tyndall_render::clouds::gpu_data::CloudShadow.
// A storage buffer, and decisions without branches, as in clouds/clouds.wgsl.

struct CloudShadow {
    map_corner_m: vec2<f32>,   // low corner of the map, east and north of the origin
    map_size_m: vec2<f32>,
    cells_corner_m: vec2<f32>, // of the grid of cells
    cells_size_m: vec2<f32>,
    slope: vec2<f32>,          // 1, way east and north for each metre up, towards the sun
    floor_m: f32,              // altitudes between which there are cells
    ceiling_m: f32,
    texel_m: f32,              // side of the map's finest texel
    spread: f32,               // 1, width of a half shadow for each metre below the clouds
    layers: f32,               // cells from floor to ceiling
    wraps: u32,                // 1 when map and cells repeat
    mean: vec3<f32>,           // 1, of the map
    moonlit: u32,              // 1 when the moon casts the shadows, not the sun
    lamp: vec3<f32>,           // 1, towards the light that casts them
    padding: u32,
}
@group(3) @binding(0) var<storage, read> cloud_shade: CloudShadow;
@group(3) @binding(1) var cloud_shade_map: texture_2d<f32>;   // sunlight straight, sunlight scattered, skylight
@group(3) @binding(3) var cloud_shade_sampler: sampler;

/// The map at a place (m), blurred over a width (m).
fn cloud_shade_floor(place: vec2<f32>, width_m: f32) -> vec3<f32> {
    let local = place - cloud_shade.map_corner_m;
    let level = log2(max(width_m / cloud_shade.texel_m, 1.0));
    let light = textureSampleLevel(cloud_shade_map, cloud_shade_sampler, local / cloud_shade.map_size_m, level).xyz;
    // Coarse texels at the edge of a map that does not repeat hold some of what lies within.
    let away = max(max(-local, local - cloud_shade.map_size_m), vec2<f32>(0.0));
    let gone = clamp(max(away.x, away.y) / max(width_m, cloud_shade.texel_m), 0.0, 1.0);
    return mix(light, vec3<f32>(1.0, 0.0, 1.0), select(gone, 0.0, cloud_shade.wraps == 1u));
}

/// Cosine between a direction and the light that casts the shadows.
fn cloud_shade_cosine(direction: vec3<f32>) -> f32 {
    return clamp(dot(direction, cloud_shade.lamp), -1.0, 1.0);
}

/// Share of its light that clouds leave to the ground around a place as far as a cloud at an altitude looks down on it.
fn cloud_shade_of_ground(place: vec2<f32>, altitude: f32) -> f32 {
    let share = cloud_shade_floor(place, 2.0 * altitude);
    return share.x + share.y;
}

/// Share of its light that the air between an observer and the ground or clouds far away has: what lies below clouds has
/// their mean shade, up to the observer's altitude (m), for a scale height (m) of the air.
fn cloud_shade_of_air(altitude: f32, scale_height: f32) -> f32 {
    let whole = 1.0 - exp(-max(altitude, 1.0) / scale_height);
    let below = 1.0 - exp(-clamp(altitude, 1.0, max(cloud_shade.floor_m, 1.0)) / scale_height);
    return 1.0 + below / whole * (cloud_shade_mean(0.0) - 1.0);
}

/// Mean share of daylight in the air at an altitude.
fn cloud_shade_mean(altitude: f32) -> f32 {
    let share = clamp((cloud_shade.ceiling_m - altitude) / (cloud_shade.ceiling_m - cloud_shade.floor_m), 0.0, 1.0);
    return 1.0 + share * (cloud_shade.mean.x + cloud_shade.mean.y - 1.0);
}

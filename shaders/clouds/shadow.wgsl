// What clouds leave of the light of sun and sky, for whatever stands or floats in the scene: ground, landscape, air, shafts.
// Below the clouds from the map on their floor; among them from the light volume; above them nothing is missing.
// Twins: tyndall_clouds::floor_shadow.
// @import clouds/shade.wgsl

@group(3) @binding(2) var cloud_shade_cells: texture_3d<f32>; // y: optical depth to the sun

/// Shares of light that reach a place.
struct CloudShade {
    direct: f32,  // of the sunlight, straight
    diffuse: f32, // of the sunlight, scattered by clouds on its way
    sky: f32,     // of the sky's light
}

/// Share of the sunlight at a place among the cells.
fn cloud_shade_within(place: vec2<f32>, altitude: f32) -> f32 {
    let layer = (altitude - cloud_shade.floor_m) / (cloud_shade.ceiling_m - cloud_shade.floor_m) * cloud_shade.layers;
    let up = clamp(layer, 0.5, cloud_shade.layers - 0.5) / cloud_shade.layers;
    let at = vec3<f32>((place - cloud_shade.cells_corner_m) / cloud_shade.cells_size_m, up);
    return exp(-textureSampleLevel(cloud_shade_cells, cloud_shade_sampler, at, 0.0).y);
}

/// Whether the way to the sun leads through an open grid from a place beside it: what the floor says there counts.
fn cloud_shade_beside(place: vec2<f32>, altitude: f32) -> bool {
    let rise = max(cloud_shade.ceiling_m - altitude, 0.0);
    let a = place - cloud_shade.cells_corner_m;
    let b = a + rise * cloud_shade.slope;
    return all(max(a, b) > vec2<f32>(0.0)) & all(min(a, b) < cloud_shade.cells_size_m);
}

/// Share of the sun's light that is left at a place: metres east and north of the origin, and altitude.
fn cloud_shadow(place: vec2<f32>, altitude: f32) -> f32 {
    let below_m = cloud_shade.floor_m - altitude;
    let on_floor = place + below_m * cloud_shade.slope;
    let from_floor = cloud_shade_floor(on_floor, cloud_shade.spread * max(below_m, 0.0)).x;
    let local = place - cloud_shade.cells_corner_m;
    let outside = (cloud_shade.wraps == 0u) & any(local != clamp(local, vec2<f32>(0.0), cloud_shade.cells_size_m));
    let beside = select(1.0, from_floor, cloud_shade_beside(place, altitude));
    let among = select(cloud_shade_within(place, altitude), beside, outside);
    let share = select(among, from_floor, below_m >= 0.0);
    return select(share, 1.0, altitude >= cloud_shade.ceiling_m);
}

/// Shares of all kinds of light at a place. What clouds scatter down comes from as far around as they are high.
fn cloud_shade_at(place: vec2<f32>, altitude: f32) -> CloudShade {
    let below_m = cloud_shade.floor_m - altitude;
    let around = cloud_shade_floor(place, max(2.0 * below_m, cloud_shade.texel_m)).yz;
    // Higher up less and less of the clouds is above.
    let share = clamp((cloud_shade.ceiling_m - altitude) / (cloud_shade.ceiling_m - cloud_shade.floor_m), 0.0, 1.0);
    return CloudShade(cloud_shadow(place, altitude), share * around.x, 1.0 + share * (around.y - 1.0));
}

/// Factor on light of the ground for what clouds send back to it, which it reflects again.
fn cloud_shade_between(shade: CloudShade, albedo: vec4<f32>) -> vec4<f32> {
    return 1.0 / (1.0 - albedo * (1.0 - shade.sky));
}

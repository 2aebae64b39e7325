// Radiance of the sky that the moon lights, from its table.
// @import sky/moon.wgsl
// @import sky/sky_view_lookup.wgsl

@group(0) @binding(22) var moon_sky: texture_2d<f32>;

/// Radiance (cd/m^2) of moonlit air in a direction.
fn moon_sky_radiance(direction: vec3<f32>) -> vec3<f32> {
    var radiance = vec3<f32>(0.0);
    if (NIGHT) {
        // A loop, as lavapipe 22.3 fails in shaders that branch on several uniform buffers.
        for (var nights = moon.skylight; nights > 0u; nights--) { // loops: 1
            radiance += moon_sky_lookup(direction);
        }
    }
    return radiance;
}

/// The table's radiance (cd/m^2) in a direction.
fn moon_sky_lookup(direction: vec3<f32>) -> vec3<f32> {
    let across = abs(direction.x * moon.direction.y - direction.y * moon.direction.x);
    // atan2(0, 0) has no value: at the zenith any azimuth will do, the floors pick one.
    let azimuth = atan2(across, dot(direction.xy, moon.direction.xy) + 1e-20);
    let elevation = atan2(direction.z, max(length(direction.xy), 1e-20));
    let cell = sky_view_cell(SkyViewGrid(textureDimensions(moon_sky), textureDimensions(moon_sky).y / 4u), vec2<f32>(elevation, azimuth));
    let a = cell.first;
    let b = a + vec2<u32>(1u, 0u);
    let c = a + vec2<u32>(0u, 1u);
    let d = a + vec2<u32>(1u, 1u);
    return mat4x3<f32>(textureLoad(moon_sky, a, 0).xyz, textureLoad(moon_sky, b, 0).xyz, textureLoad(moon_sky, c, 0).xyz, textureLoad(moon_sky, d, 0).xyz) * cell.weights;
}

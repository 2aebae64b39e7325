// Radiance of the sky in a direction from the sky-view table. Twin: tyndall_scattering::sky_view_table.
// @import sky/sky_view_map.wgsl

@group(0) @binding(6) var sky_view_air: texture_2d<f32>;
@group(0) @binding(7) var sky_view_aerosol: texture_2d<f32>;

/// Elevation and azimuth from the sun, 0..pi [rad], of a direction.
fn sky_view_angles(direction: vec3<f32>) -> vec2<f32> {
    let sun = sky_view.sun_direction.xy;
    let across = abs(direction.x * sun.y - direction.y * sun.x);
    let horizontal = length(direction.xy);
    // atan2(0, 0) has no value: at the zenith any azimuth will do, the floor picks one.
    let azimuth = atan2(across, dot(direction.xy, sun) + 1e-20);
    return vec2<f32>(atan2(direction.z, max(horizontal, 1e-20)), azimuth);
}

/// Radiance [cd/m^2] for angles and the cosine between direction and sun.
fn sky_view_radiance(angles: vec2<f32>, nu: f32) -> vec3<f32> {
    let position = sky_view_map(angles.x, angles.y);
    let above = position.y >= f32(sky_view.rows_below);
    let low_row = select(0u, sky_view.rows_below, above);
    let high_row = select(sky_view.rows_below, sky_view.table_size.y, above) - 2u;
    let first = clamp(vec2<u32>(max(position, vec2<f32>(0.0))), vec2<u32>(0u, low_row), vec2<u32>(sky_view.table_size.x - 2u, high_row));
    let fraction = clamp(position - vec2<f32>(first), vec2<f32>(0.0), vec2<f32>(1.0));
    let weights = vec4<f32>((1.0 - fraction.x) * (1.0 - fraction.y), fraction.x * (1.0 - fraction.y), (1.0 - fraction.x) * fraction.y, fraction.x * fraction.y);
    let b = first + vec2<u32>(1u, 0u);
    let c = first + vec2<u32>(0u, 1u);
    let d = first + vec2<u32>(1u, 1u);
    let air = mat4x3<f32>(textureLoad(sky_view_air, first, 0).xyz, textureLoad(sky_view_air, b, 0).xyz, textureLoad(sky_view_air, c, 0).xyz, textureLoad(sky_view_air, d, 0).xyz) * weights;
    let aerosol = mat4x3<f32>(textureLoad(sky_view_aerosol, first, 0).xyz, textureLoad(sky_view_aerosol, b, 0).xyz, textureLoad(sky_view_aerosol, c, 0).xyz, textureLoad(sky_view_aerosol, d, 0).xyz) * weights;
    let phases = atmosphere_phases(nu);
    return air * phases.x + aerosol * phases.y;
}

// Radiance of the sky in a direction from the sky-view table. Twin: tyndall_scattering::sky_view_table.
// @import sky/sky_view_map.wgsl

@group(0) @binding(6) var sky_view_air: texture_2d<f32>;
@group(0) @binding(7) var sky_view_aerosol: texture_2d<f32>;
@group(0) @binding(9) var sky_view_diffuse: texture_2d<f32>;
@group(0) @binding(15) var sky_view_haze: texture_2d<f32>; // small and dark without haze

/// Elevation and azimuth from the sun, 0..pi [rad], of a direction.
fn sky_view_angles(direction: vec3<f32>) -> vec2<f32> {
    let sun = sky_view.sun_direction.xy;
    let across = abs(direction.x * sun.y - direction.y * sun.x);
    let horizontal = length(direction.xy);
    // atan2(0, 0) has no value: at the zenith any azimuth will do, the floor picks one.
    let azimuth = atan2(across, dot(direction.xy, sun) + 1e-20);
    return vec2<f32>(atan2(direction.z, max(horizontal, 1e-20)), azimuth);
}

/// Four texels around a direction: the first, and the weights of it, its right, its upper and its upper right neighbour.
struct SkyViewCell {
    first: vec2<u32>,
    weights: vec4<f32>,
}

/// The cell of a direction; no cell crosses the horizon.
fn sky_view_cell(grid: SkyViewGrid, angles: vec2<f32>) -> SkyViewCell {
    let position = sky_view_grid_place(grid, angles.x, angles.y);
    let above = position.y >= f32(grid.rows_below);
    let low_row = select(0u, grid.rows_below, above);
    let high_row = select(grid.rows_below, grid.size.y, above) - 2u;
    let first = clamp(vec2<u32>(max(position, vec2<f32>(0.0))), vec2<u32>(0u, low_row), vec2<u32>(grid.size.x - 2u, high_row));
    let fraction = clamp(position - vec2<f32>(first), vec2<f32>(0.0), vec2<f32>(1.0));
    let weights = vec4<f32>((1.0 - fraction.x) * (1.0 - fraction.y), fraction.x * (1.0 - fraction.y), (1.0 - fraction.x) * fraction.y, fraction.x * fraction.y);
    return SkyViewCell(first, weights);
}

/// Radiance (cd/m^2) of light scattered more than once, for elevation and azimuth (rad).
fn sky_view_diffuse_radiance(angles: vec2<f32>) -> vec3<f32> {
    let cell = sky_view_cell(sky_view_diffuse_grid(textureDimensions(sky_view_diffuse)), angles);
    let a = cell.first;
    let b = a + vec2<u32>(1u, 0u);
    let c = a + vec2<u32>(0u, 1u);
    let d = a + vec2<u32>(1u, 1u);
    return mat4x3<f32>(textureLoad(sky_view_diffuse, a, 0).xyz, textureLoad(sky_view_diffuse, b, 0).xyz, textureLoad(sky_view_diffuse, c, 0).xyz, textureLoad(sky_view_diffuse, d, 0).xyz) * cell.weights;
}

/// Radiance (cd/m^2) for elevation and azimuth (rad) and the cosine between direction and sun.
fn sky_view_radiance(angles: vec2<f32>, nu: f32) -> vec3<f32> {
    let cell = sky_view_cell(sky_view_grid(), angles);
    let a = cell.first;
    let b = a + vec2<u32>(1u, 0u);
    let c = a + vec2<u32>(0u, 1u);
    let d = a + vec2<u32>(1u, 1u);
    let air = mat4x3<f32>(textureLoad(sky_view_air, a, 0).xyz, textureLoad(sky_view_air, b, 0).xyz, textureLoad(sky_view_air, c, 0).xyz, textureLoad(sky_view_air, d, 0).xyz) * cell.weights;
    let aerosol = mat4x3<f32>(textureLoad(sky_view_aerosol, a, 0).xyz, textureLoad(sky_view_aerosol, b, 0).xyz, textureLoad(sky_view_aerosol, c, 0).xyz, textureLoad(sky_view_aerosol, d, 0).xyz) * cell.weights;
    let phases = atmosphere_phases(nu);
    var light = air * phases.x + aerosol * phases.y + sky_view_diffuse_radiance(angles);
    if (atmosphere_hazy()) {
        light += phases.z * (mat4x3<f32>(textureLoad(sky_view_haze, a, 0).xyz, textureLoad(sky_view_haze, b, 0).xyz, textureLoad(sky_view_haze, c, 0).xyz, textureLoad(sky_view_haze, d, 0).xyz) * cell.weights);
    }
    return light;
}

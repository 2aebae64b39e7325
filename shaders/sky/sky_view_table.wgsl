// Fills the sky-view table: light scattered once, by air and by aerosol, before their phase functions, as linear Rec.709
// [cd/m^2 sr]. One direction per invocation, about 32 nodes of the march each. Twin: tyndall_scattering::sky_view_table.
// @import sky/march.wgsl
// @import sky/sky_view_map.wgsl

@group(0) @binding(4) var sky_view_air_texels: texture_storage_2d<rgba32float, write>;
@group(0) @binding(5) var sky_view_aerosol_texels: texture_storage_2d<rgba32float, write>;

/// The ray of a texel from where it enters the atmosphere; mu above 1 marks a ray that misses it.
fn sky_view_ray(texel: vec2<u32>) -> Ray {
    let angles = sky_view_map_inverse(texel);
    let mu = sin(angles.x);
    let mu_sun = sky_view.sun_direction.z;
    let sines = cos(angles.x) * sqrt(max((1.0 - mu_sun) * (1.0 + mu_sun), 0.0));
    let nu = clamp(mu * mu_sun + sines * cos(angles.y), -1.0, 1.0);
    let h = sky_view.observer_altitude_m;
    let entry = sky_entry_distance(mu);
    if (entry < 0.0) {
        return Ray(0.0, 2.0, 0.0, 0.0);
    }
    if (entry == 0.0) {
        return Ray(h, mu, mu_sun, nu);
    }
    let radius = atmosphere.planet_radius_m;
    let top = atmosphere.top_altitude_m;
    return Ray(top, mu_along(radius, h, mu, 1.0, entry, top), mu_along(radius, h, mu_sun, nu, entry, top), nu);
}

/// Length of a ray. The row decides on which side of the horizon it ends; at the horizon itself rounding must not.
fn sky_view_length(ray: Ray, above: bool) -> f32 {
    let radius = atmosphere.planet_radius_m;
    if (above) {
        return distance_to_top(radius, atmosphere.top_altitude_m, ray.h, ray.mu);
    }
    let to_ground = distance_to_ground(radius, ray.h, ray.mu);
    return select(to_ground, max(-(radius + ray.h) * ray.mu, 0.0), to_ground < 0.0);
}

@compute @workgroup_size(8, 8, 1)
fn sky_view_table(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id.xy >= sky_view.table_size)) { return; }
    let ray = sky_view_ray(id.xy);
    var air = vec3<f32>(0.0);
    var aerosol = vec3<f32>(0.0);
    if (ray.mu <= 1.0) {
        let length = sky_view_length(ray, id.y >= sky_view.rows_below);
        let light = march_scattered(ray, length, sky_view.panels);
        air = atmosphere_rec709(light.air);
        aerosol = atmosphere_rec709(light.aerosol);
    }
    textureStore(sky_view_air_texels, id.xy, vec4<f32>(air, 0.0));
    textureStore(sky_view_aerosol_texels, id.xy, vec4<f32>(aerosol, 0.0));
}

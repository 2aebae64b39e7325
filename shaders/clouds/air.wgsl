// The air between the camera and a cloud, from the sky's tables. Light scattered into the line of sight is the share of the
// whole sky's in that direction that the air's opacity has up to there: exact where the air along the ray is lit evenly.
// @import clouds/shade.wgsl
// @import sky/column_lookup.wgsl
// @import sky/moon_sky.wgsl
// @import sky/sky_view_lookup.wgsl
// @import sky/view.wgsl

struct CloudAir {
    transmittance: vec3<f32>, // of sunlight, in linear Rec.709
    veil: vec3<f32>,          // cd/m^2
}

/// Columns (m) from the observer to a point at distance t, in an atmosphere that the observer may stand outside of.
fn cloud_air_columns(mu: f32, t: f32) -> vec4<f32> {
    let radius = atmosphere.planet_radius_m;
    let top = atmosphere.top_altitude_m;
    let h = sky_view.observer_altitude_m;
    let h_end = min(altitude_along(radius, h, mu, t), top);
    let mu_end = mu_along(radius, h, mu, 1.0, t, h_end);
    if (h >= top) {
        return columns_to_top(h_end, -mu_end);
    }
    if (mu_end >= 0.0) {
        return max(columns_to_top(h, mu) - columns_to_top(h_end, mu_end), vec4<f32>(0.0));
    }
    return max(columns_to_top(h_end, -mu_end) - columns_to_top(h, -mu), vec4<f32>(0.0));
}

/// Columns (m) of the whole line of sight, to the ground or to the top.
fn cloud_sight_columns(mu: f32) -> vec4<f32> {
    let ground = distance_to_ground(atmosphere.planet_radius_m, sky_view.observer_altitude_m, mu);
    if (ground >= 0.0) {
        return cloud_air_columns(mu, ground);
    }
    return columns_to_top(min(sky_view.observer_altitude_m, atmosphere.top_altitude_m), mu);
}

/// Light (linear Rec.709) of a part of the sun's spectrum.
fn cloud_air_rec709(part: Spectrum) -> vec3<f32> {
    return atmosphere_rec709(spectrum_mul(atmosphere.solar_irradiance, part));
}

/// The air up to a cloud `t` metres away.
fn cloud_air(direction: vec3<f32>, t: f32) -> CloudAir {
    let white = max(cloud_air_rec709(Spectrum(vec4<f32>(1.0), vec4<f32>(1.0))), vec3<f32>(1e-20));
    let near = cloud_air_rec709(atmosphere_transmittance(cloud_air_columns(direction.z, t))) / white;
    let whole = cloud_air_rec709(atmosphere_transmittance(cloud_sight_columns(direction.z))) / white;
    let share = clamp((1.0 - near) / max(1.0 - whole, vec3<f32>(1e-5)), vec3<f32>(0.0), vec3<f32>(1.0));
    let sky = sky_view_radiance(sky_view_angles(direction), sky_sun_cosine(direction)) + moon_sky_radiance(direction);
    let lit = cloud_shade_of_air(sky_view.observer_altitude_m, atmosphere.air_scale_height_m);
    return CloudAir(near, lit * share * sky);
}

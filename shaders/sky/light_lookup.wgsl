// Sunlight and skylight on a surface near the camera, from the table. Terrain, buildings, dunes and clouds read it.
// Twin: tyndall_scattering::sky_light::SkyLight::irradiance.
// @import sky/light.wgsl
// @import sky/orders_basis.wgsl

@group(0) @binding(30) var sky_light_table: texture_2d<f32>;
@group(0) @binding(31) var sky_light_sampler: sampler;

/// A layer of the table at an altitude (m) and the sun's zenith cosine there (lx).
fn sky_light_layer(h: f32, mu_sun: f32, layer: u32) -> vec3<f32> {
    let span = max(sky_light.highest_mu_sun - sky_light.lowest_mu_sun, 1e-9);
    let column = clamp((mu_sun - sky_light.lowest_mu_sun) / span, 0.0, 1.0) * f32(SKY_LIGHT_SUNS - 1u);
    let row = clamp(h / sky_light.top_altitude_m, 0.0, 1.0) * f32(SKY_LIGHT_ALTITUDES - 1u);
    let size = vec2<f32>(f32(SKY_LIGHT_SUNS), f32(SKY_LIGHT_ALTITUDES * SKY_LIGHT_LAYERS));
    let at = (vec2<f32>(column, row + f32(layer * SKY_LIGHT_ALTITUDES)) + 0.5) / size;
    return sky_light.lux * textureSampleLevel(sky_light_table, sky_light_sampler, at, 0.0).rgb;
}

/// Sunlight on a surface that faces the sun (lx, linear Rec.709).
fn sky_light_sun(h: f32, mu_sun: f32) -> vec3<f32> {
    return sky_light_layer(h, mu_sun, 0u);
}

/// Light (lx, linear Rec.709) on level surfaces.
struct SkyLightLevel {
    up: vec3<f32>,   // on one that faces up
    down: vec3<f32>,
}

/// Light of sky and ground on level surfaces: [`sky_light_irradiance`], most terms of which are 0 there.
fn sky_light_level(h: f32, mu_sun: f32) -> SkyLightLevel {
    let x = mu_sun * mu_sun;
    var even = sky_light_layer(h, mu_sun, 1u) * ORDERS_NORMS[0] + sky_light_layer(h, mu_sun, 4u) * ORDERS_NORMS[3];
    even += sky_light_layer(h, mu_sun, 7u) * ORDERS_NORMS[10];
    even += sky_light_layer(h, mu_sun, 12u) * ((((231.0 * x - 315.0) * x + 105.0) * x - 5.0) / 16.0);
    let odd = sky_light_layer(h, mu_sun, 2u) * ORDERS_NORMS[1];
    return SkyLightLevel(max(even + odd, vec3<f32>(0.0)), max(even - odd, vec3<f32>(0.0)));
}

/// Light of sky and ground on a surface (lx, linear Rec.709): zenith cosine of its normal, cosine of the normal's azimuth
/// from the sun, and cosine between normal and sun.
fn sky_light_irradiance(h: f32, mu_sun: f32, mu: f32, cos_phi: f32, nu: f32) -> vec3<f32> {
    let sine = sqrt(max((1.0 - mu) * (1.0 + mu), 0.0));
    let square = mu * mu;
    let cos_2 = 2.0 * cos_phi * cos_phi - 1.0;
    let cos_3 = 2.0 * cos_phi * cos_2 - cos_phi;
    let cos_4 = 2.0 * cos_2 * cos_2 - 1.0;
    var sum = sky_light_layer(h, mu_sun, 1u) * ORDERS_NORMS[0];
    sum += sky_light_layer(h, mu_sun, 2u) * (ORDERS_NORMS[1] * mu);
    sum += sky_light_layer(h, mu_sun, 3u) * (ORDERS_NORMS[2] * sine * cos_phi);
    sum += sky_light_layer(h, mu_sun, 4u) * (ORDERS_NORMS[3] * 0.5 * (3.0 * square - 1.0));
    sum += sky_light_layer(h, mu_sun, 5u) * (ORDERS_NORMS[4] * 3.0 * mu * sine * cos_phi);
    sum += sky_light_layer(h, mu_sun, 6u) * (ORDERS_NORMS[5] * 3.0 * sine * sine * cos_2);
    sum += sky_light_layer(h, mu_sun, 7u) * (ORDERS_NORMS[10] * 0.125 * ((35.0 * square - 30.0) * square + 3.0));
    sum += sky_light_layer(h, mu_sun, 8u) * (ORDERS_NORMS[11] * 2.5 * (7.0 * square - 3.0) * mu * sine * cos_phi);
    sum += sky_light_layer(h, mu_sun, 9u) * (ORDERS_NORMS[12] * 7.5 * (7.0 * square - 1.0) * sine * sine * cos_2);
    sum += sky_light_layer(h, mu_sun, 10u) * (ORDERS_NORMS[13] * 105.0 * mu * sine * sine * sine * cos_3);
    sum += sky_light_layer(h, mu_sun, 11u) * (ORDERS_NORMS[14] * 105.0 * sine * sine * sine * sine * cos_4);
    let x = nu * nu;
    sum += sky_light_layer(h, mu_sun, 12u) * ((((231.0 * x - 315.0) * x + 105.0) * x - 5.0) / 16.0);
    return max(sum, vec3<f32>(0.0));
}

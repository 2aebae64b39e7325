// Columns of the haze in closed form: fog is thinner than the texels of any table. Twin: tyndall_scattering::layer_column.
// @import common/sphere.wgsl
// @import sky/atmosphere.wgsl

const LAYER_ROOT_PI: f32 = 1.7724538509;

/// e^(x^2) erfc(x) for x >= 0.
fn layer_scaled_erfc(x: f32) -> f32 {
    let t = 1.0 / (1.0 + 0.5 * x);
    let low = vec4<f32>(-1.2655093, 0.999604579, 0.384089844, 0.00403571361);
    let high = vec4<f32>(0.248290639, -0.872904148, 0.668515161, -0.166122112);
    let powers = vec4<f32>(1.0, t, t * t, t * t * t);
    return t * exp(dot(low, powers) + t * t * t * t * dot(high, powers));
}

/// Column [m] above altitude h over the density there, where the haze thins out; mu >= 0.
fn layer_thinning(h: f32, mu: f32) -> f32 {
    let bend = max((1.0 - mu) * (1.0 + mu), 1e-6) / (2.0 * (atmosphere.planet_radius_m + h));
    let root = sqrt(bend * atmosphere.haze_scale_height_m);
    return atmosphere.haze_scale_height_m / root * 0.5 * LAYER_ROOT_PI * layer_scaled_erfc(0.5 * mu / root);
}

/// Column [m] of a ray with mu >= 0.
fn layer_rising(h: f32, mu: f32) -> f32 {
    let top = atmosphere.haze_top_m;
    if (h >= top) {
        return exp(-(h - top) / atmosphere.haze_scale_height_m) * layer_thinning(h, mu);
    }
    let radius = atmosphere.planet_radius_m;
    let even = distance_to_top(radius, top, h, mu);
    return even + layer_thinning(top, mu_along(radius, h, mu, 1.0, even, top));
}

/// Column [m] of haze from altitude h in a direction above the horizon to the end of the layer; 0 without haze.
fn layer_column(h: f32, mu: f32) -> f32 {
    if (!atmosphere_hazy()) {
        return 0.0;
    }
    let radius = atmosphere.planet_radius_m;
    let behind = layer_rising(h, abs(mu));
    if (mu >= 0.0) {
        return behind;
    }
    let lowest = altitude_along(radius, h, mu, -(radius + h) * mu);
    return max(2.0 * layer_rising(lowest, 0.0) - behind, 0.0);
}

// What all passes of the orders of scattering read, and the layout of their table: two vectors a harmonic; sun, altitude,
// harmonic (fastest); then two vectors a sun for the irradiance at the ground.
// Uniform twin: tyndall_render::sky::gpu_data::Orders.
// @import common/spectrum.wgsl

struct Orders {
    air_scattering: Spectrum,      // 1/m at density 1
    aerosol_scattering: Spectrum,  // 1/m at density 1
    haze_scattering: Spectrum,     // 1/m at density 1
    moments: array<vec4<f32>, 5>,  // 1, Legendre moments of the phase functions: x air, y aerosol, z haze
    zeniths: array<vec4<f32>, 8>,  // 1, Gauss nodes (x) and weights (y) on 0..1
    altitudes: u32,
    suns_above: u32,               // from the horizon to the zenith
    suns_below: u32,
    zenith_count: u32,             // on each side of the horizon, up to 8
    azimuths: u32,                 // in half a turn, up to 8
    panels: u32,                   // of the march, 2..16
    degree: u32,                   // of the harmonics, 0..4
    brightness: f32,               // 1, factor on the table's light; 0 switches it off
    lowest_mu_sun: f32,            // zenith cosine of the lowest sun
    haze_even: u32,                // intervals of altitude in the even part of the haze
    haze_thinning: u32,            // intervals where it thins out; 0 without haze
    lights_surfaces: u32,          // 1 if surfaces too are lit by the table, 0 if by light scattered once
}
@group(0) @binding(10) var<uniform> orders: Orders;

/// Harmonics of a node.
fn orders_harmonics() -> u32 {
    return (orders.degree + 1u) * (orders.degree + 2u) / 2u;
}

/// Suns of the table.
fn orders_suns() -> u32 {
    return orders.suns_above + orders.suns_below;
}

/// First vector of the irradiances in a table, behind the harmonics: two vectors a sun.
fn orders_irradiance_start() -> u32 {
    return 2u * orders_suns() * orders.altitudes * orders_harmonics();
}

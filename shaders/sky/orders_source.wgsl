// The table of diffuse light that a pass reads, and the irradiance in it. Twin: tyndall_scattering::orders::field.
// @import sky/orders_suns.wgsl

@group(0) @binding(11) var<storage, read> orders_source: array<vec4<f32>>;

/// The spectrum that begins at a vector of the table.
fn orders_load(index: u32) -> Spectrum {
    return Spectrum(orders_source[index], orders_source[index + 1u]);
}

/// Irradiance of the sky on the ground (W/m^2/nm).
fn orders_irradiance(mu_sun: f32) -> Spectrum {
    let sun = orders_sun_place(mu_sun);
    let index = orders_irradiance_start() + 2u * sun.index;
    return spectrum_add(spectrum_scale(orders_load(index), 1.0 - sun.fraction), spectrum_scale(orders_load(index + 2u), sun.fraction));
}

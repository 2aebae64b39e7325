// Light of sun and sky on level ground at sea level, from the irradiance table. Twins: tyndall_scattering::irradiance_table.
// @import sky/column_lookup.wgsl
// @import sky/irradiance_map.wgsl
// @import sky/view.wgsl

@group(0) @binding(8) var irradiance_table: texture_2d<f32>;

/// A spectrum between two columns of two rows of the irradiance table.
fn ground_irradiance_rows(first: u32, fraction: f32, row: u32) -> Spectrum {
    let lo = mix(textureLoad(irradiance_table, vec2<u32>(first, row), 0), textureLoad(irradiance_table, vec2<u32>(first + 1u, row), 0), fraction);
    let hi = mix(textureLoad(irradiance_table, vec2<u32>(first, row + 1u), 0), textureLoad(irradiance_table, vec2<u32>(first + 1u, row + 1u), 0), fraction);
    return Spectrum(lo, hi);
}

/// Irradiance of the sky (W/m^2/nm) for a sun of zenith cosine mu_sun: light scattered once, and more often.
fn ground_sky_irradiance(mu_sun: f32) -> Spectrum {
    let position = irradiance_map(mu_sun) * f32(IRRADIANCE_TABLE_SIZE - 1u);
    let first = min(u32(position), IRRADIANCE_TABLE_SIZE - 2u);
    let fraction = position - f32(first);
    return spectrum_add(ground_irradiance_rows(first, fraction, 0u), ground_irradiance_rows(first, fraction, 2u));
}

/// Irradiance of the sun [W/m^2/nm] on the ground; fades while the disc sinks below the horizon.
fn ground_sun_irradiance(mu_sun: f32) -> Spectrum {
    let radius = sky_view.sun_angular_radius;
    let visible = clamp(0.5 + 0.5 * mu_sun / sin(radius), 0.0, 1.0);
    let light = spectrum_mul(atmosphere.solar_irradiance, atmosphere_transmittance(columns_to_top(0.0, max(mu_sun, 0.0))));
    // Half the sunken disc's light still grazes: the mean cosine of the visible part is near its half width.
    return spectrum_scale(light, visible * max(mu_sun, 0.5 * sin(radius) * visible));
}

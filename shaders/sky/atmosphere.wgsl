// The atmosphere that all sky shaders read, and its density and extinction.
// Uniform twin: tyndall_render::sky::gpu_data::Atmosphere. Formulas: tyndall_scattering::{medium, atmosphere}.
// @import common/phase.wgsl
// @import common/spectrum.wgsl

struct Atmosphere {
    planet_radius_m: f32,
    top_altitude_m: f32,
    air_scale_height_m: f32,
    aerosol_scale_height_m: f32,
    ozone_altitude_m: f32,
    ozone_half_width_m: f32,
    aerosol_g: f32,          // 1, shape of the aerosol's phase function
    aerosol_phase: u32,      // 0 Cornette-Shanks, 1 Henyey-Greenstein
    air_extinction: Spectrum,     // 1/m at density 1
    aerosol_extinction: Spectrum, // 1/m at density 1
    ozone_extinction: Spectrum,   // 1/m at density 1
    air_source: Spectrum,         // W/m^3/nm, sunlight times scattering coefficient
    aerosol_source: Spectrum,     // W/m^3/nm
    solar_irradiance: Spectrum,   // W/m^2/nm at the top
    ground_albedo: Spectrum,      // 1
    red: Spectrum,                // cd/m^2 per W/m^2/sr/nm, linear Rec.709
    green: Spectrum,
    blue: Spectrum,
}
@group(0) @binding(0) var<uniform> atmosphere: Atmosphere;

/// Relative densities of air, aerosol and ozone at an altitude [m].
fn atmosphere_density(h: f32) -> vec3<f32> {
    let ozone = 1.0 - abs(h - atmosphere.ozone_altitude_m) / atmosphere.ozone_half_width_m;
    return vec3<f32>(exp(-h / atmosphere.air_scale_height_m), exp(-h / atmosphere.aerosol_scale_height_m), max(ozone, 0.0));
}

/// Transmittance of a path with these columns [m] of air, aerosol and ozone.
fn atmosphere_transmittance(columns: vec3<f32>) -> Spectrum {
    let air = spectrum_scale(atmosphere.air_extinction, columns.x);
    let aerosol = spectrum_scale(atmosphere.aerosol_extinction, columns.y);
    let ozone = spectrum_scale(atmosphere.ozone_extinction, columns.z);
    return spectrum_transmittance(spectrum_add(spectrum_add(air, aerosol), ozone));
}

/// Phase functions of air and aerosol for the cosine between ray and sun [1/sr].
fn atmosphere_phases(nu: f32) -> vec2<f32> {
    let lobe = phase_cornette_shanks(nu, atmosphere.aerosol_g);
    let mean_cosine = phase_henyey_greenstein(nu, atmosphere.aerosol_g);
    return vec2<f32>(phase_rayleigh(nu), select(mean_cosine, lobe, atmosphere.aerosol_phase == 0u));
}

/// Linear Rec.709 [cd/m^2] of a spectral radiance [W/m^2/sr/nm].
fn atmosphere_rec709(radiance: Spectrum) -> vec3<f32> {
    return vec3<f32>(
        spectrum_dot(radiance, atmosphere.red),
        spectrum_dot(radiance, atmosphere.green),
        spectrum_dot(radiance, atmosphere.blue),
    );
}

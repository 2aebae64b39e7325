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
    haze_top_m: f32,
    haze_scale_height_m: f32,
    haze_g: vec2<f32>,       // 1, mean cosines of the forward and of the backward lobe
    haze_forward_weight: f32, // 1, share of the forward lobe
    haze_strongest: f32,     // 1/m, largest extinction at density 1; 0 without haze, which then costs nothing
    haze_zone_m: f32,        // altitude above which the haze is too thin to be seen
    padding: u32,
    air_extinction: Spectrum,     // 1/m at density 1
    aerosol_extinction: Spectrum, // 1/m at density 1
    ozone_extinction: Spectrum,   // 1/m at density 1
    air_source: Spectrum,         // W/m^3/nm, sunlight times scattering coefficient
    aerosol_source: Spectrum,     // W/m^3/nm
    haze_extinction: Spectrum,    // 1/m at density 1
    haze_source: Spectrum,        // W/m^3/nm
    solar_irradiance: Spectrum,   // W/m^2/nm at the top
    ground_albedo: Spectrum,      // 1
    red: Spectrum,                // cd/m^2 per W/m^2/sr/nm, linear Rec.709
    green: Spectrum,
    blue: Spectrum,
}
@group(0) @binding(0) var<uniform> atmosphere: Atmosphere;

/// Whether there is haze or fog.
fn atmosphere_hazy() -> bool {
    return atmosphere.haze_strongest > 0.0;
}

/// Relative densities of air, aerosol, ozone and haze at an altitude [m].
fn atmosphere_density(h: f32) -> vec4<f32> {
    let ozone = 1.0 - abs(h - atmosphere.ozone_altitude_m) / atmosphere.ozone_half_width_m;
    var haze = 0.0;
    if (atmosphere_hazy()) {
        haze = exp(-max(h - atmosphere.haze_top_m, 0.0) / atmosphere.haze_scale_height_m);
    }
    return vec4<f32>(exp(-h / atmosphere.air_scale_height_m), exp(-h / atmosphere.aerosol_scale_height_m), max(ozone, 0.0), haze);
}

/// Transmittance of a path with these columns [m] of air, aerosol, ozone and haze.
fn atmosphere_transmittance(columns: vec4<f32>) -> Spectrum {
    let air = spectrum_scale(atmosphere.air_extinction, columns.x);
    let aerosol = spectrum_scale(atmosphere.aerosol_extinction, columns.y);
    let ozone = spectrum_scale(atmosphere.ozone_extinction, columns.z);
    let clear = spectrum_add(spectrum_add(air, aerosol), ozone);
    return spectrum_transmittance(spectrum_add(clear, spectrum_scale(atmosphere.haze_extinction, columns.w)));
}

/// Phase functions of air, aerosol and haze for the cosine between ray and sun [1/sr].
fn atmosphere_phases(nu: f32) -> vec3<f32> {
    let lobe = phase_cornette_shanks(nu, atmosphere.aerosol_g);
    let mean_cosine = phase_henyey_greenstein(nu, atmosphere.aerosol_g);
    let haze = phase_double_henyey_greenstein(nu, atmosphere.haze_g, atmosphere.haze_forward_weight);
    return vec3<f32>(phase_rayleigh(nu), select(mean_cosine, lobe, atmosphere.aerosol_phase == 0u), haze);
}

/// Linear Rec.709 [cd/m^2] of a spectral radiance [W/m^2/sr/nm].
fn atmosphere_rec709(radiance: Spectrum) -> vec3<f32> {
    return vec3<f32>(
        spectrum_dot(radiance, atmosphere.red),
        spectrum_dot(radiance, atmosphere.green),
        spectrum_dot(radiance, atmosphere.blue),
    );
}

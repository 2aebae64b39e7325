// The light of the night on the ground, and of the air in front of it.
// @import sky/airglow.wgsl
// @import sky/moon_sky.wgsl

/// Irradiance (W/m^2/nm) of the airglow on horizontal ground: a sky that shines evenly.
fn ground_airglow_irradiance() -> Spectrum {
    if (!NIGHT) {
        return Spectrum(vec4<f32>(0.0), vec4<f32>(0.0));
    }
    return spectrum_scale(airglow.zenith, SKY_PI);
}

/// Light (cd/m^2) that the air in front of the ground adds by night; `transmittance` is that of this air.
fn ground_night_veil(direction: vec3<f32>, transmittance: Spectrum) -> vec3<f32> {
    if (!NIGHT) {
        return vec3<f32>(0.0);
    }
    let scattered = Spectrum(0.5 - 0.5 * transmittance.lo, 0.5 - 0.5 * transmittance.hi);
    return moon_sky_radiance(direction) + atmosphere_rec709(spectrum_mul(airglow.zenith, scattered));
}

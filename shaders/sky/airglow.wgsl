// The airglow, the light that is left when twilight ends: a shell at 85 to 95 km that shines evenly, brighter where the line
// of sight is slant, dimmed by the air below. What the air scatters of it is taken as half of what it takes away, the
// share of a sky that shines above dark ground.
// Uniform twin: tyndall_render::sky::night::gpu_data::Airglow.
// @import sky/sun_columns.wgsl

struct Airglow {
    zenith: Spectrum,   // W/m^2/sr/nm, of the shell seen straight through
    bottom_m: f32,      // of the shell
    top_m: f32,
    padding0: u32,
    padding1: u32,
}
@group(0) @binding(23) var<uniform> airglow: Airglow;

/// Half the length (m) that a line cuts out of the sphere at an altitude, squared; negative when it misses.
fn airglow_half_chord_squared(h: f32, mu: f32, altitude: f32) -> f32 {
    let radius = atmosphere.planet_radius_m;
    let b = (radius + h) * mu;
    return b * b - (h - altitude) * (2.0 * radius + h + altitude);
}

/// Lengths (m) of a ray that misses the ground in the shell: x before its lowest point, which no air dims, y behind it.
fn airglow_lengths(mu: f32) -> vec2<f32> {
    let radius = atmosphere.planet_radius_m;
    let h = sky_view.observer_altitude_m;
    if (h < airglow.bottom_m) {
        return vec2<f32>(0.0, distance_to_top(radius, airglow.top_m, h, mu) - distance_to_top(radius, airglow.bottom_m, h, mu));
    }
    if (h > airglow.top_m && mu >= 0.0) {
        return vec2<f32>(0.0);
    }
    let outer = sqrt(max(airglow_half_chord_squared(h, mu, airglow.top_m), 0.0));
    let inner = sqrt(max(airglow_half_chord_squared(h, mu, airglow.bottom_m), 0.0));
    // From inside the shell the part before the observer is missing.
    let before = select(min(outer, max(-(radius + h) * mu, 0.0)), outer, h > airglow.top_m) - select(0.0, inner, mu < 0.0);
    let behind = select(outer - max((radius + h) * mu, 0.0), outer - inner, mu < 0.0);
    return max(vec2<f32>(before, behind), vec2<f32>(0.0));
}

/// Radiance (cd/m^2) of the airglow in a direction that misses the ground.
fn airglow_radiance(direction: vec3<f32>) -> vec3<f32> {
    let lengths = airglow_lengths(direction.z) / (airglow.top_m - airglow.bottom_m);
    let transmittance = atmosphere_transmittance(sun_columns(direction.z));
    let scattered = Spectrum(0.5 - 0.5 * transmittance.lo, 0.5 - 0.5 * transmittance.hi);
    let seen = spectrum_add(spectrum_scale(transmittance, lengths.y), scattered);
    let clear = Spectrum(seen.lo + lengths.x, seen.hi + lengths.x);
    return atmosphere_rec709(spectrum_mul(airglow.zenith, clear));
}

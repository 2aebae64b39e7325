// What the sky knows of the observer and the sun of one frame, and rays from there.
// Uniform twin: tyndall_render::sky::gpu_data::SkyView.
// @import common/sphere.wgsl
// @import sky/atmosphere.wgsl

struct SkyView {
    sun_direction: vec3<f32>,     // 1, towards the sun; x east, y north, z up
    observer_altitude_m: f32,
    limb_exponents: Spectrum,     // 1, 0 for a uniform disc
    horizon_elevation: f32,       // rad, 0 or below
    sun_angular_radius: f32,      // rad
    sun_visible: u32,             // 1 when the disc is drawn
    panels: u32,                  // of the march, 2..16
    table_size: vec2<u32>,        // azimuths, rows
    rows_below: u32,              // rows below the horizon
    dome_rings: u32,              // from the horizon to the zenith
    dome_segments: u32,
    ground_pattern: u32,          // 0 plain, 1 checker
    ground_tile_m: f32,
    padding: u32,
}
@group(0) @binding(3) var<uniform> sky_view: SkyView;

const SKY_PI: f32 = 3.1415926535;

/// Where a ray from the observer enters the atmosphere [m]: 0 from inside, -1 when it misses.
fn sky_entry_distance(mu: f32) -> f32 {
    let h = sky_view.observer_altitude_m;
    if (h <= atmosphere.top_altitude_m) {
        return 0.0;
    }
    return distance_to_entry(atmosphere.planet_radius_m, atmosphere.top_altitude_m, h, mu);
}

/// Cosine between a direction and the sun.
fn sky_sun_cosine(direction: vec3<f32>) -> f32 {
    return clamp(dot(direction, sky_view.sun_direction), -1.0, 1.0);
}

// What the shaders know of the moon.
// Uniform twin: tyndall_render::sky::night::gpu_data::Moon. State: tyndall_scene::astronomy.
// @import common/spectrum.wgsl

struct Moon {
    direction: vec3<f32>,      // 1, towards the moon; x east, y north, z up
    angular_radius: f32,       // rad
    sunlight: vec3<f32>,       // 1, from the moon towards the sun
    disc_per_sr: f32,          // 1/sr, radiance of the lit disc per irradiance and share of lit and seen
    north: vec3<f32>,          // 1, towards the pole
    earthshine_per_sr: f32,    // 1/sr, radiance of the unlit disc per irradiance
    light: Spectrum,           // 1, irradiance at the top of the atmosphere over that of the sun
    disc: u32,                 // 1 when it is drawn
    maria: u32,                // 1 with dark plains
    skylight: u32,             // 1 when it lights air and ground
    padding: u32,
}
@group(0) @binding(21) var<uniform> moon: Moon;

/// Whether light of the night (moon, stars, airglow) is drawn at all: false in pipelines for frames that the day outshines.
override NIGHT: bool = true;

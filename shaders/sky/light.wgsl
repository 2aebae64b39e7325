// Sunlight and skylight on surfaces near the camera, for one sun: a table over altitude and the sun's height there, linear
// in between. Read it through the functions of sky/light_lookup.wgsl. Twin: tyndall_scattering::sky_light.
// Uniform twin: tyndall_render::sky::gpu_data::SkyLight.

struct SkyLight {
    lowest_mu_sun: f32,   // zenith cosine of the sun in the first column
    highest_mu_sun: f32,  // in the last
    top_altitude_m: f32,  // of the last row; the first is at sea level
    lux: f32,             // lx per stored value
}
@group(0) @binding(29) var<uniform> sky_light: SkyLight;

const SKY_LIGHT_SUNS: u32 = 8u;
const SKY_LIGHT_ALTITUDES: u32 = 24u;
// Sunlight, eleven harmonics of degrees 0, 1, 2 and 4 (the cosine has none of degree 3), and the lobe of degree 6.
const SKY_LIGHT_LAYERS: u32 = 13u;

// Fills the upper two rows of the irradiance table: the light of the sky, scattered once, on horizontal ground at sea level
// (W/m^2/nm). A workgroup per sun; its 64 threads march four directions each (16 zenith angles x 16 azimuths) and add up
// in shared memory in a fixed order.
// Twin: tyndall_scattering::irradiance_table.
// @import sky/irradiance_map.wgsl
// @import sky/march.wgsl

@group(0) @binding(4) var irradiance_texels: texture_storage_2d<rgba32float, write>;

const IRRADIANCE_PI: f32 = 3.1415926535;
const IRRADIANCE_ZENITHS: u32 = 16u;
const IRRADIANCE_AZIMUTHS: u32 = 16u;
const IRRADIANCE_DIRECTIONS_PER_THREAD: u32 = 4u;
const IRRADIANCE_PANELS: u32 = 8u;

var<workgroup> irradiance_lo: array<vec4<f32>, 64>;
var<workgroup> irradiance_hi: array<vec4<f32>, 64>;

/// Share of one direction in the irradiance.
fn irradiance_direction(index: u32, mu_sun: f32) -> Spectrum {
    let low = pow(f32(index / IRRADIANCE_AZIMUTHS) / f32(IRRADIANCE_ZENITHS), 2.0);
    let high = pow(f32(index / IRRADIANCE_AZIMUTHS + 1u) / f32(IRRADIANCE_ZENITHS), 2.0);
    let mu = sqrt(0.5 * (low + high));
    let azimuth = IRRADIANCE_PI * (f32(index % IRRADIANCE_AZIMUTHS) + 0.5) / f32(IRRADIANCE_AZIMUTHS);
    let nu = clamp(mu * mu_sun + sqrt((1.0 - mu * mu) * (1.0 - mu_sun * mu_sun)) * cos(azimuth), -1.0, 1.0);
    let length = distance_to_top(atmosphere.planet_radius_m, atmosphere.top_altitude_m, 0.0, mu);
    let light = march_scattered(Ray(0.0, mu, mu_sun, nu), length, IRRADIANCE_PANELS);
    return spectrum_scale(march_radiance(light, atmosphere_phases(nu)), IRRADIANCE_PI * (high - low) / f32(IRRADIANCE_AZIMUTHS));
}

@compute @workgroup_size(64, 1, 1)
fn irradiance_table(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) thread: u32) {
    if (group.x >= IRRADIANCE_TABLE_SIZE) { return; }
    let mu_sun = irradiance_map_inverse(f32(group.x) / f32(IRRADIANCE_TABLE_SIZE - 1u));
    var sum = Spectrum(vec4<f32>(0.0), vec4<f32>(0.0));
    for (var i = 0u; i < IRRADIANCE_DIRECTIONS_PER_THREAD; i++) { // loops: IRRADIANCE_DIRECTIONS_PER_THREAD
        sum = spectrum_add(sum, irradiance_direction(thread * IRRADIANCE_DIRECTIONS_PER_THREAD + i, mu_sun));
    }
    irradiance_lo[thread] = sum.lo;
    irradiance_hi[thread] = sum.hi;
    workgroupBarrier();
    if (thread != 0u) { return; }
    for (var i = 1u; i < 64u; i++) { // loops: 64
        sum = spectrum_add(sum, Spectrum(irradiance_lo[i], irradiance_hi[i]));
    }
    textureStore(irradiance_texels, vec2<u32>(group.x, 0u), sum.lo);
    textureStore(irradiance_texels, vec2<u32>(group.x, 1u), sum.hi);
}

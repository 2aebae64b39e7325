// What the air between the camera and a point takes away and adds, from the volume. Whatever stands in the air reads it:
// seen = radiance * transmittance + light. Twin: tyndall_scattering::aerial::AerialSlices::seen.
// @import aerial/aerial.wgsl
// @import sky/atmosphere.wgsl

@group(0) @binding(14) var aerial_light_volume: texture_3d<f32>;
@group(0) @binding(15) var aerial_aerosol_volume: texture_3d<f32>;
@group(0) @binding(16) var aerial_haze_volume: texture_3d<f32>;
@group(0) @binding(17) var aerial_depth_volume: texture_3d<f32>;
@group(0) @binding(18) var aerial_sampler: sampler;

/// Air in front of a point.
struct AerialSeen {
    transmittance: vec3<f32>, // 1, of red, green and blue
    light: vec3<f32>,         // cd/m^2, linear Rec.709
}

/// Values at the end of a slice; none before the first.
fn aerial_at(place: vec3<f32>, slice: i32, phases: vec3<f32>) -> AerialSeen {
    if (slice < 0) {
        return AerialSeen(vec3<f32>(0.0), vec3<f32>(0.0));
    }
    let at = vec3<f32>(place.xy, (f32(slice) + 0.5) / f32(AERIAL_SLICES));
    var light = textureSampleLevel(aerial_light_volume, aerial_sampler, at, 0.0).rgb;
    light += phases.y * textureSampleLevel(aerial_aerosol_volume, aerial_sampler, at, 0.0).rgb;
    if (atmosphere_hazy()) {
        light += phases.z * textureSampleLevel(aerial_haze_volume, aerial_sampler, at, 0.0).rgb;
    }
    return AerialSeen(textureSampleLevel(aerial_depth_volume, aerial_sampler, at, 0.0).rgb, light);
}

/// Air between the camera and a point `distance_m` away, at a point of the image plane, with cosine nu to the sun. Points
/// beyond the volume are seen as at its end.
fn aerial_seen(plane: vec2<f32>, distance_m: f32, nu: f32) -> AerialSeen {
    let size = vec2<f32>(f32(aerial.columns), f32(aerial.rows));
    let place = vec3<f32>(((0.5 * plane + 0.5) * (size - 1.0) + 0.5) / size, 0.0);
    let share = sqrt(clamp(distance_m / aerial.far_m, 0.0, 1.0)) * f32(AERIAL_SLICES);
    let slice = min(i32(share), i32(AERIAL_SLICES) - 1);
    let t0 = aerial_distance(f32(slice));
    let t1 = aerial_distance(f32(slice + 1));
    let within = clamp((distance_m - t0) / (t1 - t0), 0.0, 1.0);
    let phases = atmosphere_phases(nu);
    // aerial_at gives optical depths in the place of transmittances.
    let before = aerial_at(place, slice - 1, phases);
    let behind = aerial_at(place, slice, phases);
    let depth = max(behind.transmittance - before.transmittance, vec3<f32>(0.0));
    // Evenly lit, evenly dense air within the slice.
    let even = (1.0 - exp(-within * depth)) / max(1.0 - exp(-depth), vec3<f32>(1e-12));
    let reached = select(even, vec3<f32>(within), depth < vec3<f32>(1e-3));
    let light = mix(before.light, behind.light, reached);
    return AerialSeen(exp(-before.transmittance - within * depth), aerial.unit * light);
}

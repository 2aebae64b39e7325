// How the air lifts what stands outside it: from the direction in which it is seen to the one in which it stands.
// Uniform twin: tyndall_render::sky::night::gpu_data::Refraction. Table: tyndall_scattering::refraction.

struct Refraction {
    lift: array<vec4<f32>, 64>,  // rad, from the horizon to the zenith, quadratically dense at the horizon
    horizon_elevation: f32,      // rad, 0 or below
    padding0: u32,
    padding1: u32,
    padding2: u32,
}
@group(0) @binding(20) var<uniform> refraction: Refraction;

const REFRACTION_NODES: u32 = 256u;
const REFRACTION_HALF_PI: f32 = 1.5707963268;

/// Lift of a node (rad).
fn refraction_node(index: u32) -> f32 {
    return refraction.lift[index / 4u][index % 4u];
}

/// By how much (rad) something seen at this elevation (rad) appears too high; below the horizon as at the horizon.
fn refraction_lift(elevation: f32) -> f32 {
    let share = (elevation - refraction.horizon_elevation) / (REFRACTION_HALF_PI - refraction.horizon_elevation);
    let position = sqrt(clamp(share, 0.0, 1.0)) * f32(REFRACTION_NODES - 1u);
    let first = min(u32(position), REFRACTION_NODES - 2u);
    return mix(refraction_node(first), refraction_node(first + 1u), position - f32(first));
}

/// The unit vector towards what is seen in a direction.
fn refraction_true(direction: vec3<f32>) -> vec3<f32> {
    let horizontal = length(direction.xy);
    let lift = refraction_lift(atan2(direction.z, max(horizontal, 1e-20)));
    // In the zenith nothing is lifted, and there is no way down.
    let lower = horizontal * cos(lift) + direction.z * sin(lift);
    return vec3<f32>(direction.xy * (lower / max(horizontal, 1e-6)), direction.z * cos(lift) - horizontal * sin(lift));
}

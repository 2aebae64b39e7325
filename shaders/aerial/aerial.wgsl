// The volume of air in front of the camera: what the air between the camera and a point takes away and adds. Columns and
// rows stand in the image plane, from edge to edge; slice k ends at far_m ((k + 1) / AERIAL_SLICES)^2.
// Uniform twin: tyndall_render::aerial::gpu_data::Aerial. Twin of the slices: tyndall_scattering::aerial.

struct Aerial {
    columns: u32,
    rows: u32,
    far_m: f32,
    unit: f32, // cd/m^2 per stored value
}
// Where a step that fills the volume branches on nothing but `orders`, lavapipe 22.3 crashes.
@group(0) @binding(1) var<uniform> aerial: Aerial;

const AERIAL_SLICES: u32 = 64u;

/// Distance (m) at which a slice begins; at AERIAL_SLICES the last one ends.
fn aerial_distance(slice: f32) -> f32 {
    let share = slice / f32(AERIAL_SLICES);
    return aerial.far_m * share * share;
}

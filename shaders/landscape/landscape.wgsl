// The landscape of a frame. Uniform twin: tyndall_render::landscape::gpu_data::Landscape.

struct Landscape {
    base: vec2<f32>,          // 1, height without noise over height_m: valley floor, and what crests add
    amplitude: vec2<f32>,     // 1, amplitude of the noise, in the same way
    half_size_m: f32,         // half the side of the square
    height_m: f32,            // height of high peaks
    wavelength_m: f32,        // of the coarsest octave
    gain: f32,                // 1, amplitude of an octave over the one before
    damping: f32,             // 1, how much steep slopes damp finer octaves
    ridge: f32,               // 1, 0 rounded, 1 folded into crests
    valley_m: f32,            // half the width of the valley, 0 without one
    snow_line_m: f32,
    ground_albedo: vec3<f32>, // 1, of the planet around the landscape
    key: u32,                 // of the random numbers
    columns: u32,             // vertices of a ring of the mesh
    rings: u32,               // of the mesh
    far_rings: u32,           // of them those beyond split_radius_m
    centre_radius_m: f32,     // of the first ring outside the centre
    split_radius_m: f32,      // where the far rings begin
    far_radius_m: f32,        // of the last ring
    first_azimuth: f32,       // rad from east to north, of the first column
    azimuth_step: f32,        // rad
    sun_tan_low: f32,         // 1, tangent of the elevation of the sun's lower edge
    sun_tan_high: f32,        // of its upper edge
    valley_phase: f32,        // 1, share of a bend at which the valley's axis begins
    padding0: f32,
    sun_heading: vec2<f32>,   // 1, horizontal direction to the sun
    padding1: f32,
    padding2: f32,
}
@group(2) @binding(0) var<uniform> landscape: Landscape;

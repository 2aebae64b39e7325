// Balls as a camera sees them, from back to front, and the camera. Storage buffers: lavapipe 22.3 fails on branches on uniforms.
// Twins: tyndall_render::splats::gpu_data.

struct SplatBall {
    centre_m: vec3<f32>,    // in the camera's axes: right, up, forward
    radius_m: f32,
    extent: vec4<f32>,      // box in the picture, -1..1: left, bottom, right, top
    peak: f32,              // 1, extinction in the centre times the radius
    distance_m: f32,        // of the centre from the camera
    sun_depth: f32,         // 1, optical depth towards the sun at the centre
    forward: f32,           // 1, share of sunlight scattered forward alone
    diffuse: f32,           // 1/sr, of sunlight scattered often
    sky: f32,               // 1, the sky's share
    slope: vec2<f32>,       // 1, change of sun_depth per unit of the picture's plane
}

struct SplatCamera {
    half: vec2<f32>,        // half the picture's plane: tangents, or metres
    perspective: f32,       // 1 from one point, 0 along parallel lines
    transport: f32,         // 1, of light that may be scattered on its way; 0 for light scattered once alone
    near_m: f32,            // reversed depth = near / planar distance
    padding: f32,
}
@group(0) @binding(0) var<storage, read> splat_balls: array<SplatBall>;
@group(0) @binding(1) var<storage, read> splat_camera: SplatCamera;
@group(0) @binding(2) var splat_depth: texture_2d<f32>; // reversed, 0 where the sky is

// Lays clouds that were marched at half resolution over the frame. What lies at another depth than a pixel counts little, so
// that clouds do not bleed over the outlines of hills. Costs four texels a pixel.
// @import frame/frame.wgsl

@group(1) @binding(1) var cloud_part: texture_2d<f32>;   // frame value of the clouds, and their transmittance
@group(1) @binding(2) var cloud_behind: texture_2d<f32>; // the frame without clouds
@group(1) @binding(3) var cloud_depth: texture_2d<f32>;  // reversed, 0 where the sky is

/// Pixels along a side of a marched one.
override CLOUD_PIXEL: u32 = 2u; // 1..=4
/// Share of a depth by which another may differ and still count much.
const CLOUD_ALIKE: f32 = 0.02;

@vertex
fn upsample_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return frame_triangle(index);
}

/// Reversed depth that a marched pixel was marched up to.
fn upsample_depth(marched: vec2<u32>) -> f32 {
    return textureLoad(cloud_depth, min(CLOUD_PIXEL * marched + CLOUD_PIXEL / 2u, frame.size_px - 1u), 0).x;
}

@fragment
fn upsample_fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = vec2<u32>(position.xy);
    let depth = textureLoad(cloud_depth, pixel, 0).x;
    let place = position.xy / f32(CLOUD_PIXEL) - 0.5;
    let fraction = place - floor(place);
    let last = vec2<i32>(textureDimensions(cloud_part)) - 1;
    var sum = vec4<f32>(0.0);
    var weights = 0.0;
    for (var i = 0; i < 4; i++) { // loops: 4
        let corner = vec2<i32>(i & 1, i >> 1);
        let marched = vec2<u32>(clamp(vec2<i32>(floor(place)) + corner, vec2<i32>(0), last));
        let other = upsample_depth(marched);
        let apart = abs(other - depth) / max(max(other, depth), 1e-12);
        let near = mix(1.0 - fraction, fraction, vec2<f32>(corner));
        let weight = near.x * near.y * CLOUD_ALIKE / (CLOUD_ALIKE + apart) + 1e-6;
        sum += weight * textureLoad(cloud_part, marched, 0);
        weights += weight;
    }
    let clouds = sum / weights;
    let behind = textureLoad(cloud_behind, pixel, 0).xyz;
    return vec4<f32>(min(behind * clouds.w + clouds.xyz, vec3<f32>(frame.largest)), 1.0);
}

// From the frame to the picture: exposure, tone map, display encoding, dither.
// @import common/noise.wgsl
// @import common/tone.wgsl
// @import frame/frame.wgsl

@group(1) @binding(1) var develop_frame: texture_2d<f32>;
@group(1) @binding(2) var<storage, read> develop_gain: array<f32, 4>;

/// Display value of an exposed colour by the chosen tone map.
fn develop_tone(exposed: vec3<f32>) -> vec3<f32> {
    if (frame.tone_map == 0u) {
        return tone_agx(exposed);
    }
    var linear = exposed;
    if (frame.tone_map == 1u) {
        linear = tone_aces(exposed);
    }
    return vec3<f32>(tone_srgb_encode(linear.x), tone_srgb_encode(linear.y), tone_srgb_encode(linear.z));
}

@vertex
fn develop_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return frame_triangle(index);
}

@fragment
fn develop_fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = vec2<u32>(position.xy);
    let exposed = textureLoad(develop_frame, pixel, 0).rgb * develop_gain[0];
    var shown = develop_tone(exposed);
    // The neutral look costs nothing.
    if (frame.contrast != 1.0 || frame.saturation != 1.0) {
        shown = tone_look(shown, frame.contrast, frame.saturation);
    }
    if (frame.dither == 1u) {
        let noise = vec3<f32>(noise_triangular(pixel, 0u), noise_triangular(pixel, 1u), noise_triangular(pixel, 2u));
        shown += noise / frame.levels;
    }
    return vec4<f32>(clamp(shown, vec3<f32>(0.0), vec3<f32>(1.0)), 1.0);
}

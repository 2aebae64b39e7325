// Sunlight that terrain lets pass, from the shadow map.
// @import landscape/landscape.wgsl

@group(2) @binding(6) var shadow_map: texture_2d<f32>;

/// Share of the sun's disc that is seen from a place (m) at an altitude (m).
fn shadow_of_terrain(place: vec2<f32>, altitude: f32) -> f32 {
    let size = vec2<f32>(textureDimensions(shadow_map));
    let texel_m = 2.0 * landscape.half_size_m / size.x;
    let texel = clamp((place + landscape.half_size_m) / texel_m - 0.5, vec2<f32>(0.0), size - 1.001);
    let first = vec2<u32>(texel);
    let fraction = texel - vec2<f32>(first);
    let a = textureLoad(shadow_map, first, 0).xy;
    let b = textureLoad(shadow_map, first + vec2<u32>(1u, 0u), 0).xy;
    let c = textureLoad(shadow_map, first + vec2<u32>(0u, 1u), 0).xy;
    let d = textureLoad(shadow_map, first + vec2<u32>(1u, 1u), 0).xy;
    let edge = mix(mix(a, b, fraction.x), mix(c, d, fraction.x), fraction.y);
    // The map is smoother than the ground by about a fifth of its texel; it must not shade slopes that face the sun.
    let soft = 0.15 * texel_m;
    return smoothstep(-1.0, 1.0, (altitude + soft - edge.y) / max(edge.x - edge.y, soft));
}

// One pass of the shadow map: x and y hold the altitude (m) below which a place lies in the shadow of terrain at most so many
// texels towards the sun, for the lower and the upper edge of its disc. Each pass doubles the distance, so that ten passes
// cover a thousand texels.
// @import landscape/landscape.wgsl

@group(2) @binding(2) var shadow_texels: texture_storage_2d<rgba32float, write>;
@group(2) @binding(3) var shadow_before: texture_2d<f32>;
@group(2) @binding(4) var<uniform> shadow_reach: vec4<f32>; // x: texels of this pass

/// The map of the pass before between its texels; far below any ground outside.
fn shadow_at(texel: vec2<f32>) -> vec2<f32> {
    let last = vec2<f32>(textureDimensions(shadow_before)) - 1.0;
    if (any(texel < vec2<f32>(0.0)) || any(texel > last)) {
        return vec2<f32>(-1e6);
    }
    let first = min(vec2<u32>(texel), vec2<u32>(last) - 1u);
    let fraction = texel - vec2<f32>(first);
    let a = textureLoad(shadow_before, first, 0).xy;
    let b = textureLoad(shadow_before, first + vec2<u32>(1u, 0u), 0).xy;
    let c = textureLoad(shadow_before, first + vec2<u32>(0u, 1u), 0).xy;
    let d = textureLoad(shadow_before, first + vec2<u32>(1u, 1u), 0).xy;
    return mix(mix(a, b, fraction.x), mix(c, d, fraction.x), fraction.y);
}

@compute @workgroup_size(8, 8, 1)
fn landscape_shadow(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(shadow_texels);
    if (any(id.xy >= size)) { return; }
    let reach_m = shadow_reach.x * 2.0 * landscape.half_size_m / f32(size.x);
    let towards_sun = shadow_at(vec2<f32>(id.xy) + shadow_reach.x * landscape.sun_heading);
    let risen = towards_sun - reach_m * vec2<f32>(landscape.sun_tan_low, landscape.sun_tan_high);
    let here = textureLoad(shadow_before, id.xy, 0).xy;
    textureStore(shadow_texels, id.xy, vec4<f32>(max(here, risen), 0.0, 0.0));
}

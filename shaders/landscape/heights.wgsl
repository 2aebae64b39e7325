// Fills the map from which shadows are made: altitude of the terrain (m) in its first two channels.
// @import landscape/relief.wgsl

@group(2) @binding(2) var shadow_texels: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8, 1)
fn landscape_heights(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(shadow_texels);
    if (any(id.xy >= size)) { return; }
    let texel_m = 2.0 * landscape.half_size_m / f32(size.x);
    let place = (vec2<f32>(id.xy) + 0.5) * texel_m - landscape.half_size_m;
    let altitude = relief_at(place, 0.5 * texel_m).x;
    textureStore(shadow_texels, id.xy, vec4<f32>(altitude, altitude, 0.0, 0.0));
}

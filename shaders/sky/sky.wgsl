// The sky per pixel: the table with exact phase functions, and the sun's disc. Drawn at infinite depth, behind everything.
// @import frame/frame.wgsl
// @import sky/night.wgsl
// @import sky/sky_view_lookup.wgsl
// @import sky/sun_disc.wgsl

@vertex
fn sky_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return frame_triangle(index);
}

@fragment
fn sky_fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let plane = frame_plane(position);
    let direction = frame_direction(plane);
    let radiance = sky_view_radiance(sky_view_angles(direction), sky_sun_cosine(direction));
    let discs = sun_disc_radiance(plane) + night_radiance(plane, direction);
    return vec4<f32>(min((radiance + discs) * frame.pre_exposure, vec3<f32>(frame.largest)), 1.0);
}

// The paper's sky (section 2): a dome of quadrilaterals, the colour of the table at each vertex, linear in between; rings
// dense at the horizon. The sun's disc is added per pixel. Twin of the mesh: tyndall_scattering::dome.
// @import frame/frame.wgsl
// @import sky/night.wgsl
// @import sky/sky_view_lookup.wgsl
// @import sky/sun_disc.wgsl

struct DomeVertex {
    @builtin(position) clip: vec4<f32>,
    @location(0) radiance: vec3<f32>, // cd/m^2 times pre-exposure
}

/// Elevation and azimuth from the sun, 0..2 pi [rad], of a vertex of the triangle list.
fn dome_vertex_angles(index: u32) -> vec2<f32> {
    let corners = array<u32, 6>(0u, 1u, 2u, 2u, 1u, 3u);
    let corner = corners[index % 6u];
    let quad = index / 6u;
    let ring = quad / sky_view.dome_segments;
    let above = ring < sky_view.dome_rings;
    let share = f32(select(ring - min(ring, sky_view.dome_rings), ring, above) + corner / 2u) / f32(sky_view.dome_rings);
    let pole = select(-0.5 * SKY_PI, 0.5 * SKY_PI, above) - sky_view.horizon_elevation;
    let segment = f32(quad % sky_view.dome_segments + corner % 2u);
    return vec2<f32>(sky_view.horizon_elevation + pole * share * share, 2.0 * SKY_PI * segment / f32(sky_view.dome_segments));
}

@vertex
fn dome_vertex(@builtin(vertex_index) index: u32) -> DomeVertex {
    let angles = dome_vertex_angles(index);
    let sun = sky_view.sun_direction;
    // With the sun in the zenith its azimuth is anything.
    let heading = select(vec2<f32>(0.0, 1.0), normalize(sun.xy), length(sun.xy) > 1e-6);
    let across = vec2<f32>(heading.y, -heading.x);
    let horizontal = cos(angles.y) * heading + sin(angles.y) * across;
    let direction = vec3<f32>(horizontal * cos(angles.x), sin(angles.x));
    let folded = min(angles.y, 2.0 * SKY_PI - angles.y);
    let radiance = sky_view_radiance(vec2<f32>(angles.x, folded), sky_sun_cosine(direction));
    // At infinity: reversed depth 0.
    let view = vec3<f32>(dot(direction, frame.right), dot(direction, frame.up), dot(direction, frame.forward));
    let clip = vec4<f32>(view.x / frame.tan_half_width, view.y / frame.tan_half_height, 0.0, view.z);
    return DomeVertex(clip, radiance * frame.pre_exposure);
}

@fragment
fn dome_fragment(vertex: DomeVertex) -> @location(0) vec4<f32> {
    let plane = frame_plane(vertex.clip);
    let discs = sun_disc_radiance(plane) + night_radiance(plane, frame_direction(plane));
    return vec4<f32>(min(vertex.radiance + discs * frame.pre_exposure, vec3<f32>(frame.largest)), 1.0);
}

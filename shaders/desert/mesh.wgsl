// The desert's mesh: rings around the camera over the azimuths in view, each wider than the last by the same factor, so that
// quadrilaterals look equally large at any distance. A vertex is (east and north of the camera, altitude, spacing), in metres.
// @import desert/bed.wgsl
// @import frame/frame.wgsl

@group(2) @binding(1) var<storage, read_write> desert_vertices: array<vec4<f32>>;

@compute @workgroup_size(64, 1, 1)
fn desert_mesh(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id.xy >= vec2<u32>(desert.columns, desert.rings))) { return; }
    let share = (f32(id.y) - 1.0) / f32(desert.rings - 2u);
    let outside = desert.centre_radius_m * pow(desert.far_radius_m / desert.centre_radius_m, share);
    let radius = select(outside, frame_centre_radius() * desert.centre_radius_m, id.y == 0u);
    let azimuth = desert.first_azimuth + f32(id.x) * desert.azimuth_step;
    let from_camera = radius * vec2<f32>(cos(azimuth), sin(azimuth));
    let spacing = max(radius * desert.azimuth_step, 0.02);
    let bed = bed_at(frame.position_m.xy + from_camera, 0.5 * spacing);
    desert_vertices[id.y * desert.columns + id.x] = vec4<f32>(from_camera, bed.x, spacing);
}

// The ground's mesh: rings around the camera, dense near it, over the azimuths in view. A vertex is (east and north of
// the camera, altitude, spacing of its ring), in metres.
// @import frame/frame.wgsl
// @import landscape/relief.wgsl

@group(2) @binding(1) var<storage, read_write> landscape_vertices: array<vec4<f32>>;

/// Radius (m) of a ring; ring 0 is the centre.
fn mesh_radius(ring: f32) -> f32 {
    if (ring < 0.5) {
        return frame_centre_radius() * landscape.centre_radius_m;
    }
    let near_rings = f32(landscape.rings - landscape.far_rings);
    let near = landscape.centre_radius_m * pow(landscape.split_radius_m / landscape.centre_radius_m, (ring - 1.0) / (near_rings - 1.0));
    let far = landscape.split_radius_m * pow(landscape.far_radius_m / landscape.split_radius_m, (ring - near_rings) / f32(landscape.far_rings - 1u));
    return select(far, near, ring < near_rings);
}

@compute @workgroup_size(64, 1, 1)
fn landscape_mesh(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id.xy >= vec2<u32>(landscape.columns, landscape.rings))) { return; }
    let radius = mesh_radius(f32(id.y));
    let azimuth = landscape.first_azimuth + f32(id.x) * landscape.azimuth_step;
    let from_camera = radius * vec2<f32>(cos(azimuth), sin(azimuth));
    let spacing = max(radius * landscape.azimuth_step, 0.02);
    var altitude = -RELIEF_SINK_M;
    let place = frame.position_m.xy + from_camera;
    if (all(abs(place) < vec2<f32>(landscape.half_size_m))) {
        altitude = relief_at(place, 0.5 * spacing).x;
    }
    landscape_vertices[id.y * landscape.columns + id.x] = vec4<f32>(from_camera, altitude, spacing);
}

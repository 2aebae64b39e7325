// The desert's mesh: rings around the camera over the azimuths in view, each wider than the last by the same factor, so that
// quadrilaterals look equally large at any distance. A vertex is (east and north of the camera, altitude, spacing), in metres.
// @import desert/bed.wgsl
// @import frame/frame.wgsl

@group(2) @binding(1) var<storage, read_write> desert_vertices: array<vec4<f32>>;

/// Parts of the way from a ring to the next that are searched for crests.
const MESH_PARTS: i32 = 4;

/// Radius (m) of a ring, or between two.
fn mesh_radius(ring: f32) -> f32 {
    let share = (ring - 1.0) / f32(desert.rings - 2u);
    return desert.centre_radius_m * pow(desert.far_radius_m / desert.centre_radius_m, share);
}

/// Width (m) of a column at a radius.
fn mesh_spacing(radius: f32) -> f32 {
    return max(radius * desert.azimuth_step, 0.02);
}

/// Tangent of the elevation in which the camera sees the sand in a direction, and its rise by a factor e of the radius.
fn mesh_elevation(toward: vec2<f32>, radius: f32) -> vec2<f32> {
    let bed = bed_at(frame.position_m.xy + radius * toward, 0.5 * mesh_spacing(radius));
    let elevation = (bed.x - frame.position_m.z) / radius;
    return vec2<f32>(elevation, dot(bed.yz, toward) - elevation);
}

/// Radius (m) of the highest crest against what is behind it within half a ring of a ring; the ring's without one.
fn mesh_crest(toward: vec2<f32>, ring: f32) -> f32 {
    var place = ring;
    var highest = -1e30;
    var before = mesh_elevation(toward, mesh_radius(ring - 0.5));
    for (var part = 0; part < MESH_PARTS; part++) { // loops: 4
        let near = ring - 0.5 + f32(part) / f32(MESH_PARTS);
        let after = mesh_elevation(toward, mesh_radius(near + 1.0 / f32(MESH_PARTS)));
        let height = max(before.x, after.x);
        let is_crest = before.y > 0.0 && after.y <= 0.0 && height > highest;
        place = select(place, near + before.y / (before.y - after.y) / f32(MESH_PARTS), is_crest);
        highest = select(highest, height, is_crest);
        before = after;
    }
    return mesh_radius(place);
}

@compute @workgroup_size(64, 1, 1)
fn desert_mesh(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id.xy >= vec2<u32>(desert.columns, desert.rings))) { return; }
    let azimuth = desert.first_azimuth + f32(id.x) * desert.azimuth_step;
    let toward = vec2<f32>(cos(azimuth), sin(azimuth));
    let radius = select(mesh_crest(toward, f32(id.y)), frame_centre_radius() * desert.centre_radius_m, id.y == 0u);
    let spacing = mesh_spacing(radius);
    let bed = bed_at(frame.position_m.xy + radius * toward, 0.5 * spacing);
    desert_vertices[id.y * desert.columns + id.x] = vec4<f32>(radius * toward, bed.x, spacing);
}

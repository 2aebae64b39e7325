// From the map to the camera: places on the curved planet, and the sun there.
// @import common/sphere.wgsl
// @import frame/frame.wgsl
// @import sky/view.wgsl

/// Position (m) relative to the camera of a place `from_camera` (m east and north along the ground) at an altitude (m).
fn place_position(from_camera: vec2<f32>, altitude: f32) -> vec3<f32> {
    let radius = atmosphere.planet_radius_m;
    let distance = length(from_camera);
    let half_angle = 0.5 * distance / radius;
    let drop = 2.0 * (radius + altitude) * sin(half_angle) * sin(half_angle);
    let spread = (radius + altitude) * sin(2.0 * half_angle) / max(distance, 1e-3);
    return vec3<f32>(from_camera * spread, altitude - frame.position_m.z - drop);
}

/// Clip position of a point relative to the camera.
fn place_clip(position: vec3<f32>) -> vec4<f32> {
    let view = vec3<f32>(dot(position, frame.right), dot(position, frame.up), dot(position, frame.forward));
    if (frame.projection == FRAME_EQUIRECTANGULAR) {
        let distance = max(length(position), frame.near_m);
        let turn = atan2(view.x, view.z + 1e-20) / FRAME_PI;
        let elevation = atan2(view.y, length(view.xz) + 1e-20) / (0.5 * FRAME_PI);
        return vec4<f32>(turn, elevation, frame.near_m / distance, 1.0);
    }
    return vec4<f32>(view.x / frame.tan_half_width, view.y / frame.tan_half_height, frame.near_m, view.z);
}

/// Direction to the sun in the axes of a distant place, whose zenith is not the camera's.
fn place_sun(from_camera: vec2<f32>) -> vec3<f32> {
    let tilt = from_camera / atmosphere.planet_radius_m;
    let sun = sky_view.sun_direction;
    return normalize(vec3<f32>(sun.xy - tilt * sun.z, sun.z + dot(tilt, sun.xy)));
}

// The camera of a frame. Image-plane coordinates: (0, 0) in the centre, x right, y up, +-1 at the edges. A panorama is
// equirectangular: x is the angle from forward towards right in half turns, y the elevation above them in right angles. An
// orthographic picture has parallel lines of sight that begin on a plane through the camera.
// Uniform twin: tyndall_render::frame::gpu_data::Frame.

struct Frame {
    right: vec3<f32>,          // 1, east-north-up
    tan_half_width: f32,       // 1, tangent of half the horizontal field of view; orthographic: m, half the width
    up: vec3<f32>,             // 1
    tan_half_height: f32,      // the same of the height
    forward: vec3<f32>,        // 1
    near_m: f32,               // reversed depth = near / planar distance
    position_m: vec3<f32>,     // east, north, altitude
    pre_exposure: f32,         // 1/(cd/m^2), frame value per radiance
    size_px: vec2<u32>,
    tone_map: u32,             // 0 AgX, 1 ACES, 2 none
    dither: u32,               // 1 on
    auto_exposure: u32,        // 1 when the meter decides
    manual_gain: f32,          // 1, exposed value per frame value when it does not
    compensation: f32,         // 1, factor on the metered exposure
    levels: f32,               // steps of the output per unit: 255, or 65535
    contrast: f32,             // 1, exponent on the display value
    saturation: f32,           // 1, factor on the distance from grey
    projection: u32,           // 0 perspective, 1 equirectangular, 2 orthographic
    largest: f32,              // frame value that the frame's format holds
}
@group(1) @binding(0) var<uniform> frame: Frame;

const FRAME_EQUIRECTANGULAR: u32 = 1u;
const FRAME_ORTHOGRAPHIC: u32 = 2u;
const FRAME_PI: f32 = 3.1415926535;

/// A triangle that covers the screen.
fn frame_triangle(index: u32) -> vec4<f32> {
    return vec4<f32>(f32((index << 1u) & 2u) * 2.0 - 1.0, f32(index & 2u) * 2.0 - 1.0, 0.0, 1.0);
}

/// Image-plane coordinates of a fragment position.
fn frame_plane(position: vec4<f32>) -> vec2<f32> {
    let unit = position.xy / vec2<f32>(frame.size_px) * 2.0 - 1.0;
    return vec2<f32>(unit.x, -unit.y);
}

/// Radius of the centre of a mesh around the camera, relative to its first ring. The nadir of a panorama is a whole row, over
/// which each azimuth needs a vertex of its own.
fn frame_centre_radius() -> f32 {
    return select(0.0, 1e-3, frame.projection == FRAME_EQUIRECTANGULAR);
}

/// Width and height of a pixel in image-plane coordinates.
fn frame_pixel_size() -> vec2<f32> {
    return 2.0 / vec2<f32>(frame.size_px);
}

/// World direction of a point of the image plane.
fn frame_direction(plane: vec2<f32>) -> vec3<f32> {
    if (frame.projection == FRAME_EQUIRECTANGULAR) {
        let turn = FRAME_PI * plane.x;
        let elevation = 0.5 * FRAME_PI * plane.y;
        return cos(elevation) * (cos(turn) * frame.forward + sin(turn) * frame.right) + sin(elevation) * frame.up;
    }
    let across = select(frame_across(plane), vec3<f32>(0.0), frame.projection == FRAME_ORTHOGRAPHIC);
    return normalize(frame.forward + across);
}

/// Way from the centre to a point of the image plane, at distance 1 in a perspective, in metres in an orthographic picture.
fn frame_across(plane: vec2<f32>) -> vec3<f32> {
    return plane.x * frame.tan_half_width * frame.right + plane.y * frame.tan_half_height * frame.up;
}

/// Where the line of sight of a point of the image plane begins [m], from the camera.
fn frame_eye(plane: vec2<f32>) -> vec3<f32> {
    return select(vec3<f32>(0.0), frame_across(plane), frame.projection == FRAME_ORTHOGRAPHIC);
}

/// Largest width and height (rad) of the pixel at a point of the image plane; of a perspective those at the centre, where
/// pixels are widest.
fn frame_pixel_extent(plane: vec2<f32>) -> vec2<f32> {
    let size = frame_pixel_size();
    if (frame.projection == FRAME_EQUIRECTANGULAR) {
        // The pixel is widest at its edge towards the horizon.
        let edge = max(abs(plane.y) - 0.5 * size.y, 0.0);
        return FRAME_PI * size * vec2<f32>(cos(0.5 * FRAME_PI * edge), 0.5);
    }
    let extent = size * vec2<f32>(frame.tan_half_width, frame.tan_half_height);
    // Parallel lines of sight have no angle between them.
    return select(extent, vec2<f32>(1e-6), frame.projection == FRAME_ORTHOGRAPHIC);
}

/// Largest angle [rad] that the pixel at a point of the image plane covers: its diagonal.
fn frame_pixel_angle(plane: vec2<f32>) -> f32 {
    return length(frame_pixel_extent(plane));
}

/// Solid angle of a small piece of the image plane, relative to one at the centre.
fn frame_solid_angle(plane: vec2<f32>) -> f32 {
    if (frame.projection == FRAME_EQUIRECTANGULAR) {
        return cos(0.5 * FRAME_PI * plane.y);
    }
    let extent = vec2<f32>(frame.tan_half_width, frame.tan_half_height);
    let slopes = select(plane * extent, vec2<f32>(0.0), frame.projection == FRAME_ORTHOGRAPHIC);
    return pow(1.0 + dot(slopes, slopes), -1.5);
}

/// Distance that the depth buffer counts [m], of a point `t` metres away: planar, in a panorama along the ray.
fn frame_depth_m(direction: vec3<f32>, t: f32) -> f32 {
    let planar = select(t * dot(direction, frame.forward), t, frame.projection == FRAME_EQUIRECTANGULAR);
    return max(planar, frame.near_m);
}

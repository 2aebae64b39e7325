// A ray through the clouds: how much light of each kind it gathers. Light that was scattered often is met in a medium thinner
// by `transport`, and gathered with that medium's transmittance; see tyndall_clouds::cloud_light.
// @import clouds/clouds.wgsl
// @import clouds/detail.wgsl
// @import clouds/forward.wgsl
// @import clouds/shade.wgsl
// @import common/phase.wgsl
// @import sky/view.wgsl

/// Most places with matter on a ray, and most without in between.
const CLOUD_STEPS: u32 = 320u;
const CLOUD_LEAPS: u32 = 200u;
/// Step over the side of a cell near the camera, and over the distance far away.
const CLOUD_STEP_CELLS: f32 = 0.5;
const CLOUD_STEP_GROWTH: f32 = 0.01;
/// Way towards the sun (cells) along which turbulence throws shadows.
const CLOUD_NEAR_CELLS: f32 = 1.5;
/// Transmittance from which on a ray misses the shadows of turbulence, and how much longer its steps are then.
const CLOUD_DIM: f32 = 0.03;
const CLOUD_DIM_STEPS: f32 = 2.0;
/// Transmittances at which a ray has seen enough.
const CLOUD_DARK: f32 = 0.002;
const CLOUD_DARK_DIFFUSE: f32 = 0.04;
/// Share of the reach over which clouds fade out.
const CLOUD_FADE: f32 = 0.25;

/// Where the line of sight begins: metres east and north of the origin, and the altitude.
var<private> cloud_eye_m: vec3<f32>;

struct CloudLight {
    sun: f32,           // 1/sr, of a sun of irradiance 1
    sky: f32,           // 1, of what a surface that faces up receives, over pi
    ground: f32,        // 1, the same that faces down
    transmittance: f32, // of the whole ray
    distance_m: f32,    // mean, of what is seen
    forward: f32,       // 1, of what lies behind, scattered forward only
}

/// Distances (m) between which a ray is among the cells and within reach; start >= end when it never is.
fn cloud_span(mu: f32, limit_m: f32) -> vec2<f32> {
    let radius = atmosphere.planet_radius_m;
    let h = cloud_eye_m.z;
    let ceiling = altitude_crossings(radius, h, mu, clouds.ceiling_m);
    let floor = altitude_crossings(radius, h, mu, clouds.floor_m);
    let is_below = h < clouds.floor_m;
    let is_above = h > clouds.ceiling_m;
    let start = select(select(0.0, ceiling.x, is_above), floor.y, is_below);
    // Downwards a ray leaves through the floor; where it rises again it is too far away.
    let through_floor = select(ceiling.y, floor.x, floor.x > 0.0);
    let end = select(through_floor, ceiling.y, is_below);
    let misses = is_above & (ceiling.x <= 0.0);
    return vec2<f32>(max(start, 0.0), select(min(end, min(limit_m, clouds.reach_m)), 0.0, misses));
}

/// Optical depth towards the sun: what is near with its turbulence, the rest from the cells.
fn cloud_sun_depth(place: vec3<f32>, level: f32) -> f32 {
    let middle = place + 0.5 * CLOUD_NEAR_CELLS * cloud_shade.lamp;
    var near = cloud_share(middle);
    if (near > 0.0) {
        near = cloud_detailed(near, middle, level);
    }
    let beyond = place + CLOUD_NEAR_CELLS * cloud_shade.lamp;
    let is_inside = (beyond.z > 0.0) & (beyond.z < clouds.size.z);
    let far = select(0.0, cloud_light_at(beyond).x, is_inside);
    return near * CLOUD_NEAR_CELLS * clouds.cell_m * clouds.full_per_m + far;
}

/// A piece of a ray with matter in it, or none with a share of 0.
struct CloudPiece {
    place: vec3<f32>, // cells
    distance_m: f32,  // of the place
    length_m: f32,
    share: f32,       // of full extinction
    level: f32,       // whole mip level of turbulence, the finer and the coarser one in turns
    next_m: f32,      // where to go on
}

/// The next piece with matter from `start_m` on, in steps `stretch` times as long as the finest. A loop of its own, so that a
/// group of rays pays for light only where one of them has matter.
fn cloud_next(direction: vec3<f32>, start_m: f32, end_m: f32, stretch: f32, jitter: f32) -> CloudPiece {
    let radius = atmosphere.planet_radius_m;
    let h0 = cloud_eye_m.z;
    let texel_angle = frame_pixel_angle(vec2<f32>(0.0)) / clouds.cell_m;
    var piece = CloudPiece(vec3<f32>(0.0), 0.0, 0.0, 0.0, 0.0, start_m);
    for (var i = 0u; i < CLOUD_LEAPS; i++) { // loops: CLOUD_LEAPS
        if ((piece.next_m >= end_m) | (piece.share > 0.0)) { break; }
        let t = piece.next_m;
        let fine_m = max(CLOUD_STEP_CELLS * clouds.cell_m, CLOUD_STEP_GROWTH * t);
        piece.length_m = min(fine_m * stretch, end_m - t);
        piece.distance_m = t + jitter * piece.length_m;
        let h = altitude_along(radius, h0, direction.z, piece.distance_m);
        piece.place = cloud_place(cloud_eye_m.xy + piece.distance_m * direction.xy, h);
        let rise = (direction.z * (radius + h0) + piece.distance_m) / (radius + h);
        let steepest = max(max(abs(direction.x), abs(direction.y)), abs(rise));
        let skip_m = cloud_skip(piece.place) * clouds.cell_m / steepest;
        piece.next_m = t + max(skip_m, piece.length_m);
        if (skip_m <= piece.length_m) {
            piece.level = floor(cloud_billow_level(piece.distance_m * texel_angle) + jitter);
            piece.share = cloud_share(piece.place);
            if (piece.share > 0.0) {
                piece.share = cloud_detailed(piece.share, piece.place, piece.level);
            }
        }
    }
    return piece;
}

/// Gathers light along a ray up to `limit_m`; `jitter` 0..1 moves the samples within their steps.
fn cloud_march(direction: vec3<f32>, limit_m: f32, jitter: f32) -> CloudLight {
    let span = cloud_span(direction.z, limit_m);
    let nu = cloud_shade_cosine(direction);
    let once = phase_double_henyey_greenstein(nu, clouds.asymmetry, clouds.forward_weight);
    var light = CloudLight(0.0, 0.0, 0.0, 1.0, 0.0, 0.0);
    let often = f32(clouds.all_orders);
    var thin = 1.0; // transmittance for light that was scattered often
    var t = span.x;
    for (var i = 0u; i < CLOUD_STEPS; i++) { // loops: CLOUD_STEPS
        let is_dim = light.transmittance < CLOUD_DIM;
        let piece = cloud_next(direction, t, span.y, select(1.0, CLOUD_DIM_STEPS, is_dim), jitter);
        t = piece.next_m;
        if (piece.share <= 0.0 && t >= span.y) { break; }
        let fade = 1.0 - smoothstep((1.0 - CLOUD_FADE) * clouds.reach_m, clouds.reach_m, piece.distance_m);
        let depth = piece.share * clouds.full_per_m * fade * piece.length_m;
        let cell = cloud_light_at(piece.place);
        var sun_depth = cell.x;
        if (!is_dim) {
            sun_depth = cloud_sun_depth(piece.place, piece.level);
        }
        let left = exp(-depth);
        let seen = light.transmittance * (1.0 - left);
        light.sun += seen * once * exp(-sun_depth);
        light.distance_m += seen * piece.distance_m;
        let eye_depth = 0.5 * depth - log(max(light.transmittance, 1e-30));
        light.transmittance *= left;
        let left_thin = exp(-clouds.transport * depth);
        let seen_thin = often * thin * (1.0 - left_thin);
        // Light spread a little does not see single eddies.
        let turn = CloudTurn(cell.x, eye_depth, seen, seen_thin);
        light.sun += seen_thin * cell.y + often * cloud_forward(nu, turn);
        light.sky += seen_thin * cell.z;
        light.ground += seen_thin * (1.0 - cell.z);
        thin *= left_thin;
        if (light.transmittance < CLOUD_DARK && often * thin < CLOUD_DARK_DIFFUSE) { break; }
    }
    light.forward = often * (thin - light.transmittance);
    light.distance_m /= max(1.0 - light.transmittance, 1e-6);
    return light;
}

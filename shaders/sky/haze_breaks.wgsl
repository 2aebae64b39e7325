// Where the integral along a ray breaks in haze: from the eye, on both sides of the layer's top, and where the haze thins
// out. Twin: tyndall_scattering::haze_breaks.
// @import common/sphere.wgsl
// @import sky/atmosphere.wgsl

/// Optical depths from the eye and from the layer's top at which it breaks.
const HAZE_DEPTHS = vec3<f32>(2.5, 7.0, 18.0);
/// Scale heights above the layer's top from break to break.
const HAZE_SPACING: f32 = 1.25;
/// Zenith cosine of the lowest sun of which breaks take notice.
const HAZE_LOWEST_MU_SUN: f32 = 0.02;
/// Breaks closer than this are one [m, and share of the distance].
const HAZE_CLOSEST_M: f32 = 1e-3;
const HAZE_CLOSEST_SHARE: f32 = 1e-6;
/// Behind every ray.
const HAZE_FAR: f32 = 1e30;

/// The breaks of one ray.
struct HazeBreaks {
    lowest: f32,      // m, distance of the lowest point
    at_eye: f32,      // 1/m, extinction at the eye
    top: vec2<f32>,   // m, where the ray passes the top of the layer, down and up
    fading: vec2<f32>, // 1/m, how fast light fades below the top along the ray, down and up
    zone: vec2<f32>,  // m, where the ray passes the end of what can be seen
}

/// How fast sunlight fades below the layer's top at distance t along a ray [1/m].
fn haze_fading(h: f32, mu: f32, mu_sun: f32, nu: f32, t: f32) -> f32 {
    let radius = atmosphere.planet_radius_m;
    let steepness = abs(mu_along(radius, h, mu, 1.0, t, atmosphere.haze_top_m));
    let sun = max(mu_along(radius, h, mu_sun, nu, t, atmosphere.haze_top_m), HAZE_LOWEST_MU_SUN);
    return atmosphere.haze_strongest * steepness / sun;
}

/// The breaks of a ray whose lowest point lies at a distance; only in haze.
fn haze_breaks(h: f32, mu: f32, mu_sun: f32, nu: f32, lowest: f32) -> HazeBreaks {
    let radius = atmosphere.planet_radius_m;
    let top = altitude_crossings(radius, h, mu, select(SPHERE_NEVER, atmosphere.haze_top_m, atmosphere.haze_top_m > 0.0));
    let fading = vec2<f32>(haze_fading(h, mu, mu_sun, nu, top.x) + atmosphere.haze_strongest, haze_fading(h, mu, mu_sun, nu, top.y));
    let at_eye = atmosphere.haze_strongest * atmosphere_density(h).w;
    return HazeBreaks(lowest, at_eye, top, max(fading, vec2<f32>(1e-12)), altitude_crossings(radius, h, mu, atmosphere.haze_zone_m));
}

/// The nearer of `next` and a place, if that lies behind `behind`.
fn haze_nearer(next: f32, place: f32, behind: f32) -> f32 {
    return select(next, min(next, place), place > behind);
}

/// The next level where the haze thins out: multiples of the spacing above the layer's top.
fn haze_next_level(breaks: HazeBreaks, h: f32, mu: f32, t: f32) -> f32 {
    let radius = atmosphere.planet_radius_m;
    let step = HAZE_SPACING * atmosphere.haze_scale_height_m;
    let level = (altitude_along(radius, h, mu, t) - atmosphere.haze_top_m) / step;
    let rises = t >= breaks.lowest;
    let next = select(ceil(level - 1e-3) - 1.0, max(floor(level + 1e-3), -1.0) + 1.0, rises);
    let altitude = atmosphere.haze_top_m + next * step;
    if (next < 0.0 || altitude >= atmosphere.haze_zone_m) {
        return HAZE_FAR;
    }
    let crossings = altitude_crossings(radius, h, mu, altitude);
    return select(crossings.x, crossings.y, rises);
}

/// The nearest break behind distance t [m], HAZE_FAR when there is none.
fn haze_next_break(breaks: HazeBreaks, h: f32, mu: f32, t: f32) -> f32 {
    let behind = t + HAZE_CLOSEST_M + HAZE_CLOSEST_SHARE * t;
    var next = haze_nearer(HAZE_FAR, haze_next_level(breaks, h, mu, t), behind);
    next = haze_nearer(next, breaks.zone.x, behind);
    next = haze_nearer(next, breaks.zone.y, behind);
    next = haze_nearer(next, breaks.top.x, behind);
    next = haze_nearer(next, breaks.top.y, behind);
    for (var i = 0u; i < 3u; i++) { // loops: 3
        next = haze_nearer(next, HAZE_DEPTHS[i] / max(breaks.at_eye, 1e-30), behind);
        if (breaks.top.y > SPHERE_NEVER) {
            let down = breaks.top.x + HAZE_DEPTHS[i] / breaks.fading.x;
            let up = breaks.top.y - HAZE_DEPTHS[i] / breaks.fading.y;
            next = haze_nearer(next, min(down, max(breaks.lowest, breaks.top.x)), behind);
            next = haze_nearer(next, max(up, min(breaks.lowest, breaks.top.y)), behind);
        }
    }
    return next;
}

// Rays in a spherical shell, in forms that do not cancel in f32: r^2 - R^2 is written h (2R + h).
// Lengths in metres; h = altitude, mu = cosine of the zenith angle. Twins: tyndall_scattering::geometry.

/// A distance that no ray has.
const SPHERE_NEVER: f32 = -1e30;

/// Altitude at distance t along a ray from altitude h; never below the ground.
fn altitude_along(radius: f32, h: f32, mu: f32, t: f32) -> f32 {
    let q = h * (2.0 * radius + h) + t * (2.0 * (radius + h) * mu + t);
    return max(q / (radius + sqrt(max(radius * radius + q, 0.0))), 0.0);
}

/// Distance from inside to the sphere at altitude top; 0 <= h <= top.
fn distance_to_top(radius: f32, top: f32, h: f32, mu: f32) -> f32 {
    let b = (radius + h) * mu;
    let q = max((top - h) * (2.0 * radius + top + h), 0.0);
    let root = sqrt(b * b + q);
    return select(root - b, q / max(root + b, 1e-6), b > 0.0);
}

/// Distance from outside, h >= top, to where the ray enters the sphere at altitude top; -1 when it misses.
fn distance_to_entry(radius: f32, top: f32, h: f32, mu: f32) -> f32 {
    let b = (radius + h) * mu;
    let q = max((h - top) * (2.0 * radius + top + h), 0.0);
    let discriminant = b * b - q;
    if (mu >= 0.0 || discriminant < 0.0) {
        return -1.0;
    }
    return q / (sqrt(discriminant) - b);
}

/// Distance to the ground; -1 when the ray misses it.
fn distance_to_ground(radius: f32, h: f32, mu: f32) -> f32 {
    let b = (radius + h) * mu;
    let q = h * (2.0 * radius + h);
    let discriminant = b * b - q;
    if (mu >= 0.0 || discriminant < 0.0) {
        return -1.0;
    }
    return q / (sqrt(discriminant) - b);
}

/// Distances at which the line of a ray passes an altitude, on the way down and on the way up; both SPHERE_NEVER where its
/// lowest point lies higher. Negative distances lie behind the start.
fn altitude_crossings(radius: f32, h: f32, mu: f32, altitude: f32) -> vec2<f32> {
    let b = (radius + h) * mu;
    let q = (h - altitude) * (2.0 * radius + h + altitude);
    let discriminant = b * b - q;
    if (discriminant < 0.0) {
        return vec2<f32>(SPHERE_NEVER);
    }
    let root = sqrt(discriminant);
    let down = select(-b - root, q / max(root - b, 1e-6), b < 0.0);
    let up = select(root - b, -q / max(root + b, 1e-6), b > 0.0);
    return vec2<f32>(down, up);
}

/// Zenith cosine of the geometric horizon.
fn horizon_mu(radius: f32, h: f32) -> f32 {
    return -sqrt(h * (2.0 * radius + h)) / (radius + h);
}

/// Zenith cosine, at distance t along a ray where the altitude is h_t, of a direction with zenith cosine mu_other at the
/// start and cosine nu with the ray.
fn mu_along(radius: f32, h: f32, mu_other: f32, nu: f32, t: f32, h_t: f32) -> f32 {
    return clamp(((radius + h) * mu_other + t * nu) / (radius + h_t), -1.0, 1.0);
}

/// The stretch (start, end) of a ray of the given length in the planet's shadow; start >= end when there is none.
fn shadow_interval(radius: f32, h: f32, mu: f32, mu_sun: f32, nu: f32, length: f32) -> vec2<f32> {
    let none = vec2<f32>(length, length);
    let r = radius + h;
    let along = r * mu_sun;
    // 1 - nu^2 of a ray along the sunlight rounds to 0; the floor keeps its far root finite and out of reach.
    let a = max((1.0 - nu) * (1.0 + nu), 1e-12);
    let b = r * mu - along * nu;
    let c = h * (2.0 * radius + h) - along * along;
    let discriminant = b * b - a * c;
    if (discriminant <= 0.0) {
        return none;
    }
    let root = sqrt(discriminant);
    let q = select(root - b, -b - root, b > 0.0);
    let roots = select(vec2<f32>(c / q, q / a), vec2<f32>(q / a, c / q), b > 0.0);
    let start = max(roots.x, 0.0);
    let end = min(roots.y, length);
    if (end <= start || along + nu * 0.5 * (start + end) >= 0.0) {
        return none;
    }
    return vec2<f32>(start, end);
}

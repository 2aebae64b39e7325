//! Rays in a spherical shell, without the cancellation of r^2 - R^2.
//!
//! Positions are an altitude h above the sphere of radius R; differences of squares are written h (2R + h). The same
//! expressions hold in f32 in `shaders/common/sphere.wgsl`.

/// An observer's ray, by its altitude and cosines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Altitude of the observer (m), 0 to the top.
    pub h_m: f64,
    /// Cosine of the ray's zenith angle.
    pub mu: f64,
    /// Cosine of the sun's zenith angle.
    pub mu_sun: f64,
    /// Cosine of the angle between ray and sun.
    pub nu: f64,
}

impl Ray {
    /// From zenith angles and the azimuth between ray and sun (rad).
    #[must_use]
    pub fn from_angles(h_m: f64, view_zenith: f64, sun_zenith: f64, azimuth: f64) -> Self {
        let (mu, mu_sun) = (view_zenith.cos(), sun_zenith.cos());
        let nu = (mu * mu_sun + view_zenith.sin() * sun_zenith.sin() * azimuth.cos()).clamp(-1.0, 1.0);
        Self { h_m, mu, mu_sun, nu }
    }
}

/// Altitude (m) at distance `t_m` along a ray that starts at altitude `h_m` with zenith cosine `mu`.
#[must_use]
pub fn altitude_along(radius_m: f64, h_m: f64, mu: f64, t_m: f64) -> f64 {
    let q = h_m * (2.0 * radius_m + h_m) + t_m * (2.0 * (radius_m + h_m) * mu + t_m);
    q / (radius_m + (radius_m * radius_m + q).sqrt())
}

/// Distance (m) from inside to the sphere at altitude `top_m`, for 0 <= `h_m` <= `top_m`.
#[must_use]
pub fn distance_to_top(radius_m: f64, top_m: f64, h_m: f64, mu: f64) -> f64 {
    let b = (radius_m + h_m) * mu;
    let q = ((top_m - h_m) * (2.0 * radius_m + top_m + h_m)).max(0.0);
    let root = (b * b + q).sqrt();
    if b > 0.0 { q / (root + b) } else { root - b }
}

/// The two distances (m) at which the line of a ray passes an altitude, on the way down and on the way up, or `None` where
/// its lowest point lies higher. Negative distances lie behind the start.
#[must_use]
pub fn altitude_crossings(radius_m: f64, h_m: f64, mu: f64, altitude_m: f64) -> Option<[f64; 2]> {
    let b = (radius_m + h_m) * mu;
    let q = (h_m - altitude_m) * (2.0 * radius_m + h_m + altitude_m);
    let discriminant = b * b - q;
    if discriminant < 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    // Both without cancellation.
    let down = if b < 0.0 { q / (root - b) } else { -b - root };
    let up = if b > 0.0 { -q / (root + b) } else { root - b };
    Some([down, up])
}

/// Distance (m) to the ground, or `None` when the ray misses it.
#[must_use]
pub fn distance_to_ground(radius_m: f64, h_m: f64, mu: f64) -> Option<f64> {
    let b = (radius_m + h_m) * mu;
    let q = h_m * (2.0 * radius_m + h_m);
    let discriminant = b * b - q;
    (mu < 0.0 && discriminant >= 0.0).then(|| q / (discriminant.sqrt() - b))
}

/// The ray from where it enters the atmosphere, and the distance (m) to that point; a ray that starts inside is returned as
/// it is, and one that misses the atmosphere is `None`.
#[must_use]
pub fn enter_atmosphere(radius_m: f64, top_m: f64, ray: &Ray) -> Option<(Ray, f64)> {
    if ray.h_m <= top_m {
        return Some((*ray, 0.0));
    }
    let b = (radius_m + ray.h_m) * ray.mu;
    let q = (ray.h_m - top_m) * (2.0 * radius_m + top_m + ray.h_m);
    let discriminant = b * b - q;
    if ray.mu >= 0.0 || discriminant <= 0.0 {
        return None;
    }
    // The nearer of the two points, without cancellation.
    let t_m = q / (discriminant.sqrt() - b);
    let [mu, mu_sun] = [(ray.mu, 1.0), (ray.mu_sun, ray.nu)]
        .map(|(mu_other, nu)| mu_along(radius_m, ray.h_m, mu_other, nu, t_m, top_m));
    Some((Ray { h_m: top_m, mu, mu_sun, nu: ray.nu }, t_m))
}

/// Zenith cosine of the geometric horizon seen from altitude `h_m`.
#[must_use]
pub fn horizon_mu(radius_m: f64, h_m: f64) -> f64 {
    -(h_m * (2.0 * radius_m + h_m)).sqrt() / (radius_m + h_m)
}

/// Zenith cosine, at distance `t_m` along a ray, of a direction whose zenith cosine at the start is `mu_other` and whose
/// cosine with the ray is `nu`. `h_t_m` is the altitude there.
#[must_use]
pub fn mu_along(radius_m: f64, h_m: f64, mu_other: f64, nu: f64, t_m: f64, h_t_m: f64) -> f64 {
    (((radius_m + h_m) * mu_other + t_m * nu) / (radius_m + h_t_m)).clamp(-1.0, 1.0)
}

/// The stretch [m, m] of a ray of `length_m` outside the planet that lies in the planet's shadow, a half cylinder behind
/// the planet along the sunlight, or `None` when the ray stays in the light.
///
/// Equation (1) of the paper does not mention it: the term is zero where the path to the sun meets the planet. The plane
/// through the centre at right angles to the sunlight cuts the cylinder inside the planet, so a ray outside the planet
/// lies in the shadow on one stretch or on none.
#[must_use]
pub fn shadow_interval(radius_m: f64, ray: &Ray, length_m: f64) -> Option<(f64, f64)> {
    let r = radius_m + ray.h_m;
    let along = r * ray.mu_sun;
    // Distance from the cylinder's axis: a t^2 + 2 b t + c < 0 inside.
    let a = 1.0 - ray.nu * ray.nu;
    let b = r * ray.mu - along * ray.nu;
    let c = ray.h_m * (2.0 * radius_m + ray.h_m) - along * along;
    let discriminant = b * b - a * c;
    if discriminant <= 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    // The two roots without cancellation; a ray along the sunlight has a = 0 and one root at infinity.
    let q = if b > 0.0 { -b - root } else { -b + root };
    let (first, second) = if b > 0.0 { (q / a, c / q) } else { (c / q, q / a) };
    let (start, end) = (first.max(0.0), second.min(length_m));
    let behind = along + ray.nu * 0.5 * (start + end) < 0.0;
    (end > start && behind).then_some((start, end))
}

#[cfg(test)]
mod tests {
    use super::*;

    // Not the Earth on purpose: a hard-wired radius would show.
    const RADIUS_M: f64 = 1_000_000.0;
    const TOP_M: f64 = 500_000.0;

    #[test]
    fn altitude_along_equals_pythagoras() {
        for (h, mu, t) in [(0.0, 0.3, 5e4), (2e5, -0.4, 1e5), (10.0, 1.0, 3e5)] {
            let r: f64 = RADIUS_M + h;
            let want = (r * r + 2.0 * r * mu * t + t * t).sqrt() - RADIUS_M;
            assert!((altitude_along(RADIUS_M, h, mu, t) - want).abs() < 1e-6, "{h} {mu} {t}");
        }
    }

    #[test]
    fn the_end_of_a_ray_to_the_top_lies_at_the_top() {
        for (h, mu) in [(0.0, 1.0), (0.0, 0.0), (1e5, -0.2), (4.9e5, 0.7)] {
            let t = distance_to_top(RADIUS_M, TOP_M, h, mu);
            assert!((altitude_along(RADIUS_M, h, mu, t) - TOP_M).abs() < 1e-6, "{h} {mu}: {t}");
        }
        let horizontal = ((RADIUS_M + TOP_M).powi(2) - RADIUS_M * RADIUS_M).sqrt();
        assert!((distance_to_top(RADIUS_M, TOP_M, 0.0, 0.0) - horizontal).abs() < 1e-6, "horizontal ray");
    }

    #[test]
    fn a_line_passes_an_altitude_where_it_has_that_altitude() {
        for (h, mu, altitude) in [(2e3, -0.3, 500.0), (2e3, 0.2, 500.0), (2e3, -0.02, 4e3), (0.0, 1.0, 10.0)] {
            let crossings = altitude_crossings(RADIUS_M, h, mu, altitude).expect("low enough");
            for t in crossings {
                assert!((altitude_along(RADIUS_M, h, mu, t) - altitude).abs() < 1e-6, "{h} {mu}: {t}");
            }
            assert!(crossings[0] < crossings[1], "down before up: {crossings:?}");
        }
        assert!(altitude_crossings(RADIUS_M, 2e3, 0.0, 1e3).is_none(), "a level ray is at its lowest point");
    }

    #[test]
    fn rays_below_the_horizon_meet_the_ground_and_rays_above_do_not() {
        for h in [2.0, 1e3, 1e5] {
            let horizon = horizon_mu(RADIUS_M, h);
            let t = distance_to_ground(RADIUS_M, h, horizon - 1e-6).expect("below the horizon");
            assert!(altitude_along(RADIUS_M, h, horizon - 1e-6, t).abs() < 1e-6, "{h}");
            assert!(distance_to_ground(RADIUS_M, h, horizon + 1e-6).is_none(), "{h}");
        }
        assert!((distance_to_ground(RADIUS_M, 2.0, -1.0).unwrap() - 2.0).abs() < 1e-9, "straight down");
    }

    #[test]
    fn rays_from_space_enter_at_the_top_or_miss() {
        let ray = Ray { h_m: 2e6, mu: -0.95, mu_sun: 0.3, nu: 0.1 };
        let (entered, t_m) = enter_atmosphere(RADIUS_M, TOP_M, &ray).expect("it meets the atmosphere");
        assert!((altitude_along(RADIUS_M, ray.h_m, ray.mu, t_m) - TOP_M).abs() < 1e-3, "{t_m}");
        // The closest approach to the centre is the same on the way.
        let impact = |ray: &Ray| (RADIUS_M + ray.h_m) * (1.0 - ray.mu * ray.mu).sqrt();
        assert!((impact(&entered) - impact(&ray)).abs() < 1e-3 && entered.mu < 0.0, "{entered:?}");
        assert!(enter_atmosphere(RADIUS_M, TOP_M, &Ray { mu: -0.8, ..ray }).is_none(), "it passes by");
        assert!(enter_atmosphere(RADIUS_M, TOP_M, &Ray { mu: 0.5, ..ray }).is_none(), "it looks away");
        let inside = Ray { h_m: 10.0, ..ray };
        assert_eq!(enter_atmosphere(RADIUS_M, TOP_M, &inside), Some((inside, 0.0)), "already inside");
    }

    #[test]
    fn the_shadow_interval_agrees_with_a_test_of_each_point() {
        let in_shadow = |h: f64, mu: f64, mu_sun: f64, nu: f64, t: f64| {
            let r: f64 = RADIUS_M + h;
            let along = r * mu_sun + t * nu;
            along < 0.0 && r * r + 2.0 * r * mu * t + t * t - along * along < RADIUS_M * RADIUS_M
        };
        let mut shadowed = 0;
        for i in 0..4000_u32 {
            let u = |k: u32| f64::from(tyndall_core::rng::CellRng::new(3).uniform(k, u64::from(i), 0));
            let (h, mu_sun, azimuth) = (u(0).powi(2) * 1e5, -0.5 + 0.7 * u(1), 6.3 * u(2));
            let mu = 2.0 * u(3) - 1.0;
            let nu = mu * mu_sun + ((1.0 - mu * mu) * (1.0 - mu_sun * mu_sun)).sqrt() * azimuth.cos();
            let to_top = distance_to_top(RADIUS_M, TOP_M, h, mu);
            let length = distance_to_ground(RADIUS_M, h, mu).unwrap_or(to_top);
            let t = u(4) * length;
            let interval = shadow_interval(RADIUS_M, &Ray { h_m: h, mu, mu_sun, nu }, length);
            let inside = interval.is_some_and(|(start, end)| start < t && t < end);
            assert_eq!(inside, in_shadow(h, mu, mu_sun, nu, t), "{h} {mu} {mu_sun} {nu} {t} {interval:?}");
            shadowed += u32::from(inside);
        }
        assert!(shadowed > 400, "only {shadowed} points in shadow: the test would not notice a missing one");
    }
}

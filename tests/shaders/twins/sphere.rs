//! Twins of `shaders/common/sphere.wgsl`, around a planet of the Earth's size.
//!
//! Rounding in f32 is 6e-8 of the largest term. Where a ray touches a sphere, a root of almost nothing is drawn; the ranges
//! stay away from there, for hit or miss is then decided by rounding on both sides.

use tyndall_scattering::geometry::{self, Ray};
use tyndall_tests::Tolerance;

use super::NONE;

/// Written in the expressions too.
const RADIUS_M: f64 = 6_360_000.0;
const TOP_M: f64 = 100_000.0;

/// Entry into a sphere from outside, -1 for a miss; solved here, for no crate needs it in f64.
fn distance_to_entry(h_m: f64, mu: f64) -> f64 {
    let b = (RADIUS_M + h_m) * mu;
    let q = (h_m - TOP_M) * (2.0 * RADIUS_M + TOP_M + h_m);
    let discriminant = b * b - q;
    if mu >= 0.0 || discriminant < 0.0 { -1.0 } else { -b - discriminant.sqrt() }
}

fn crossings(h_m: f64, mu: f64, altitude_m: f64) -> [f64; 2] {
    // As `SPHERE_NEVER` in the shader.
    geometry::altitude_crossings(RADIUS_M, h_m, mu, altitude_m).unwrap_or([-1e30; 2])
}

fn shadow(h_m: f64, [mu, mu_sun, nu]: [f64; 3], length_m: f64) -> (f64, f64) {
    let ray = Ray { h_m, mu, mu_sun, nu };
    geometry::shadow_interval(RADIUS_M, &ray, length_m).unwrap_or((length_m, length_m))
}

/// A ray that enters the shadow from the light, from an input of the ranges below.
fn into_the_shadow(x: [f64; 4]) -> (f64, f64) {
    shadow(80_000.0 + 0.2 * x[0], [-0.1 + 0.01 * x[1], 0.1 * x[2], -0.9 + 0.05 * x[3]], 1e6)
}

twins! { "common/sphere.wgsl";
    // Terms of 2 R t = 1.3e13 m^2 rounded twice, over 2 R.
    altitude_along in [0.0..=1e5, -1.0..=1.0, 0.0..=1e6, NONE], within Tolerance { absolute: 0.3, relative: 1e-6 }, {
        "altitude_along(6360000.0, x.x, x.y, x.z)"
            => |x| geometry::altitude_along(RADIUS_M, x[0], x[1], x[2]).max(0.0),
    }
    distance_to_top in [0.0..=99_000.0, -1.0..=1.0, NONE, NONE], within Tolerance::relative(2e-6), {
        "distance_to_top(6360000.0, 100000.0, x.x, x.y)"
            => |x| geometry::distance_to_top(RADIUS_M, TOP_M, x[0], x[1]),
    }
    // The discriminant keeps a twentieth of its terms.
    distance_to_entry in [2e5..=1e6, -1.0..=-0.55, -0.15..=1.0, NONE], within Tolerance::relative(2e-6), {
        "distance_to_entry(6360000.0, 100000.0, x.x, x.y)" => |x| distance_to_entry(x[0], x[1]),
        "distance_to_entry(6360000.0, 100000.0, x.x, x.z)" => |x| distance_to_entry(x[0], x[2]),
    }
    distance_to_ground in [0.0..=1e5, -1.0..=-0.2, 0.0..=1.0, NONE], within Tolerance::relative(2e-6), {
        "distance_to_ground(6360000.0, x.x, x.y)"
            => |x| geometry::distance_to_ground(RADIUS_M, x[0], x[1]).unwrap_or(-1.0),
        "distance_to_ground(6360000.0, x.x, x.z)"
            => |x| geometry::distance_to_ground(RADIUS_M, x[0], x[2]).unwrap_or(-1.0),
    }
    // Altitudes above and below the start; level rays, whose crossings are roots of almost nothing, are left out.
    altitude_crossings in [0.0..=1e4, 0.2..=1.0, 0.0..=1e5, NONE],
        within Tolerance { absolute: 0.01, relative: 3e-6 }, {
        "altitude_crossings(6360000.0, x.x, x.y, x.z).y" => |x| crossings(x[0], x[1], x[2])[1],
        "altitude_crossings(6360000.0, x.x, -x.y, x.z).x" => |x| crossings(x[0], -x[1], x[2])[0],
        "altitude_crossings(6360000.0, x.x, x.y * 0.0, x.x - 1.0 - x.z).x" => |x| crossings(x[0], 0.0, x[0] - 1.0 - x[2])[0],
    }
    horizon_mu in [0.0..=1e5, NONE, NONE, NONE], within Tolerance::relative(1e-6), {
        "horizon_mu(6360000.0, x.x)" => |x| geometry::horizon_mu(RADIUS_M, x[0]),
    }
    mu_along in [-1.0..=1.0, -1.0..=1.0, 0.0..=1e6, 0.0..=1e5], within Tolerance::absolute(5e-7), {
        "mu_along(6360000.0, 1000.0, x.x, x.y, x.z, x.w)"
            => |x| geometry::mu_along(RADIUS_M, 1000.0, x[0], x[1], x[2], x[3]),
    }
    // In the shadow from the start; with the sun in front, and so in no shadow; and from the light into the shadow.
    shadow_interval in [1e3..=5e4, -1.0..=1.0, -0.5..=-0.3, -0.6..=0.6],
        within Tolerance { absolute: 0.5, relative: 1e-6 }, {
        "shadow_interval(6360000.0, x.x, x.y, x.z, x.w, 300000.0).x" => |x| shadow(x[0], [x[1], x[2], x[3]], 3e5).0,
        "shadow_interval(6360000.0, x.x, x.y, x.z, x.w, 300000.0).y" => |x| shadow(x[0], [x[1], x[2], x[3]], 3e5).1,
        "shadow_interval(6360000.0, x.x, x.y, -x.z, x.w, 300000.0).x" => |x| shadow(x[0], [x[1], -x[2], x[3]], 3e5).0,
        "shadow_interval(6360000.0, 80000.0 + 0.2 * x.x, -0.1 + 0.01 * x.y, 0.1 * x.z, -0.9 + 0.05 * x.w, 1e6).x"
            => |x| into_the_shadow(x).0,
        "shadow_interval(6360000.0, 80000.0 + 0.2 * x.x, -0.1 + 0.01 * x.y, 0.1 * x.z, -0.9 + 0.05 * x.w, 1e6).y"
            => |x| into_the_shadow(x).1,
    }
}

//! The field of a metaball: Wyvill, `McPheeters` and Wyvill, "Data structure for soft objects", 1986, reference 10 of the paper.
//!
//! Equation (3) builds a cloud's density from balls: `rho(P) = sum of q_j f(|P - C_j| / R_j)`, with an equals sign where
//! the print has an approximate one. Everything that is ever needed of f is a polynomial, times a square root for whole
//! columns, so there is no table: the light that a ball takes, which the paper keeps in a billboard texture, is
//! exp(-extinction * R * [`ball_column`]) at any distance from the axis.
//!
//! `a` is the distance from the centre over the radius R, `b` the distance of a line from the centre over R; both from 0,
//! everything is zero from 1 on.

use std::f64::consts::PI;

/// Integral of the field over a ball of radius 1: 736 pi / 2835. A ball holds q R^3 times this.
pub const BALL_MASS: f64 = 736.0 * PI / 2835.0;

/// Field at distance `a`: 1 - 22/9 a^2 + 17/9 a^4 - 4/9 a^6, from 1 in the centre to 0 with slope 0 at the rim.
#[must_use]
pub fn ball_field(a: f64) -> f64 {
    let w = (1.0 - a * a).max(0.0);
    w * w * (5.0 + 4.0 * w) / 9.0
}

/// Derivative of [`ball_field`] with respect to `a`.
#[must_use]
pub fn ball_field_slope(a: f64) -> f64 {
    let w = (1.0 - a * a).max(0.0);
    -2.0 * a * w * (10.0 + 12.0 * w) / 9.0
}

/// Integral of the field along a whole line at distance `b` from the centre, over R:
/// u^(5/2) (16/27 + 128/315 u) with u = 1 - b^2.
#[must_use]
pub fn ball_column(b: f64) -> f64 {
    let u = (1.0 - b * b).max(0.0);
    u * u * u.sqrt() * (16.0 / 27.0 + 128.0 / 315.0 * u)
}

/// Integral of the field along a line at distance `b`, from where it enters the ball to `s` radii past the point nearest to
/// the centre (negative: before it), over R.
#[must_use]
pub fn ball_column_to(b: f64, s: f64) -> f64 {
    let u = (1.0 - b * b).max(0.0);
    let end = u.sqrt();
    half_column(u, s.clamp(-end, end)) + half_column(u, end)
}

/// Integral from the point nearest to the centre to `s`, which is odd in s.
fn half_column(u: f64, s: f64) -> f64 {
    let s2 = s * s;
    let square = s * (u * u - s2 * (2.0 / 3.0 * u - s2 / 5.0));
    let cube = s * (u * u * u - s2 * (u * u - s2 * (3.0 / 5.0 * u - s2 / 7.0)));
    (5.0 * square + 4.0 * cube) / 9.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn integrate(low: f64, high: f64, f: impl Fn(f64) -> f64) -> f64 {
        let count = 20_000;
        let step = (high - low) / f64::from(count);
        (0..count).map(|i| f(low + (f64::from(i) + 0.5) * step)).sum::<f64>() * step
    }

    #[test]
    fn the_field_is_the_published_polynomial_and_half_at_half_the_radius() {
        for a in [0.0_f64, 0.2, 0.5, 0.8, 1.0] {
            let want = 1.0 - 22.0 / 9.0 * a.powi(2) + 17.0 / 9.0 * a.powi(4) - 4.0 / 9.0 * a.powi(6);
            assert!((ball_field(a) - want).abs() < 1e-14, "a = {a}");
        }
        assert!((ball_field(0.5) - 0.5).abs() < 1e-15, "half at half the radius");
        assert!(ball_field(1.5).abs() < 1e-15 && ball_field_slope(1.5).abs() < 1e-15, "nothing outside");
    }

    #[test]
    fn the_slope_is_the_fields_difference_quotient() {
        for a in [0.05, 0.3, 0.6, 0.95] {
            let quotient = (ball_field(a + 1e-5) - ball_field(a - 1e-5)) / 2e-5;
            assert!((ball_field_slope(a) - quotient).abs() < 1e-8, "a = {a}: {quotient}");
        }
    }

    #[test]
    fn the_column_is_the_integral_of_the_field_along_the_line() {
        for b in [0.0_f64, 0.3, 0.7, 0.95] {
            let end = (1.0 - b * b).sqrt();
            let want = integrate(-end, end, |s| ball_field(b.hypot(s)));
            assert!((ball_column(b) - want).abs() < 1e-8, "b = {b}: {want}");
        }
        assert!((ball_column(0.0) - 0.998_941_798_941_799).abs() < 1e-14, "through the centre");
    }

    #[test]
    fn a_part_of_the_column_is_the_integral_up_to_there_and_the_whole_beyond() {
        for (b, s) in [(0.0, -0.4), (0.3, 0.2), (0.6, 0.7), (0.9, -0.1)] {
            let end = f64::sqrt(1.0 - b * b);
            let want = integrate(-end, s, |s| ball_field(b.hypot(s)));
            assert!((ball_column_to(b, s) - want).abs() < 1e-8, "b = {b}, s = {s}: {want}");
        }
        assert!((ball_column_to(0.4, 5.0) - ball_column(0.4)).abs() < 1e-14, "behind the ball");
        assert!(ball_column_to(0.4, -5.0).abs() < 1e-14, "before the ball");
    }

    #[test]
    fn the_columns_of_all_lines_add_up_to_the_mass() {
        let mass = integrate(0.0, 1.0, |b| 2.0 * PI * b * ball_column(b));
        assert!((mass - BALL_MASS).abs() < 1e-8, "{mass}");
        assert!((BALL_MASS - 0.815_595_129_820_842).abs() < 1e-14, "published value");
    }
}

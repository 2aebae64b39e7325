//! Directions in fixed point, from angles, by arithmetic that IEEE 754 fixes to the bit.
//!
//! The sine of a system's mathematics library may differ in the last bit from another system's. Here only sums, products
//! and quotients are used, so an angle gives the same integers everywhere; shaders receive the integers.

/// Fractional bits of a direction's components: a product with a length of 16 bits stays within i32.
pub const DIRECTION_BITS: u32 = 14;
/// The fixed-point number 1 of a direction's components.
pub const DIRECTION_ONE: i32 = 1 << DIRECTION_BITS;

/// A unit vector on the ground in units of 2^-14; x points east, y north.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Direction {
    /// Eastward part.
    pub x: i32,
    /// Northward part.
    pub y: i32,
}

impl Direction {
    /// Along +x.
    pub const EAST: Self = Self { x: DIRECTION_ONE, y: 0 };

    /// The direction at `angle_deg`, anticlockwise from +x.
    #[must_use]
    pub fn from_degrees(angle_deg: f64) -> Self {
        let (sin, cos) = sin_cos_deg(angle_deg);
        Self { x: to_fixed(cos), y: to_fixed(sin) }
    }

    /// The cell at distance `cells` from the origin, rounded to the nearest, the same for opposite directions.
    #[inline(always)]
    #[must_use]
    pub fn offset(self, cells: i32) -> [i32; 2] {
        let round = |part: i32| part.signum() * ((part.abs() * cells + DIRECTION_ONE / 2) >> DIRECTION_BITS);
        [round(self.x), round(self.y)]
    }

    /// The displacement of a hop of `length_256` (1/256 cell), each part rounded down after adding its `dither`
    /// (0..256), away from the origin in the same way for opposite directions.
    #[inline(always)]
    #[must_use]
    pub fn hop(self, length_256: i32, dither: [i32; 2]) -> [i32; 2] {
        self.stride(length_256).dithered(dither)
    }

    /// The part of [`Direction::hop`] that does not depend on the dither.
    #[inline(always)]
    #[must_use]
    pub fn stride(self, length_256: i32) -> Stride {
        let part = |part: i32| (part.abs() * length_256) >> DIRECTION_BITS;
        Stride { parts_256: [part(self.x), part(self.y)], signs: [self.x.signum(), self.y.signum()] }
    }
}

/// A hop before dithering.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stride {
    parts_256: [i32; 2],
    signs: [i32; 2],
}

impl Stride {
    /// The displacement with this dither (0..256 each).
    #[inline(always)]
    #[must_use]
    pub fn dithered(self, dither: [i32; 2]) -> [i32; 2] {
        let part = |axis: usize| self.signs[axis] * ((self.parts_256[axis] + dither[axis]) >> 8);
        [part(0), part(1)]
    }
}

fn to_fixed(value: f64) -> i32 {
    (value * f64::from(DIRECTION_ONE)).round() as i32
}

/// Sine and cosine of an angle in degrees, to 1e-15, from basic arithmetic only.
#[must_use]
pub fn sin_cos_deg(angle_deg: f64) -> (f64, f64) {
    let turned = angle_deg.rem_euclid(360.0);
    let quarter = (turned / 90.0 + 0.5).floor();
    let x = (turned - 90.0 * quarter) * (std::f64::consts::PI / 180.0);
    let (sin, cos) = (taylor(x, x, 2.0), taylor(1.0, x, 1.0));
    match quarter.rem_euclid(4.0) {
        q if q < 0.5 => (sin, cos),
        q if q < 1.5 => (cos, -sin),
        q if q < 2.5 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

/// The alternating series that starts with `term` and whose terms grow by -x^2 / (n (n + 1)), n = `from`, `from` + 2...
fn taylor(mut term: f64, x: f64, from: f64) -> f64 {
    let (mut sum, mut n) = (term, from);
    // Eleven terms reach 1e-17 for the largest argument, pi / 4.
    for _ in 0..11 {
        term *= -x * x / (n * (n + 1.0));
        sum += term;
        n += 2.0;
    }
    sum
}

/// Tangent of a slope in degrees, below 90.
#[must_use]
pub fn tan_deg(slope_deg: f64) -> f64 {
    let (sin, cos) = sin_cos_deg(slope_deg);
    sin / cos
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sine_and_cosine_agree_with_the_library() {
        for tenth in -7200..7200 {
            let angle_deg = f64::from(tenth) * 0.1;
            let (sin, cos) = sin_cos_deg(angle_deg);
            let (expected_sin, expected_cos) = angle_deg.to_radians().sin_cos();
            // The library's argument of up to 4 pi has been rounded, by up to 9e-16.
            assert!((sin - expected_sin).abs() < 4e-15 && (cos - expected_cos).abs() < 4e-15, "{angle_deg} deg");
        }
    }

    #[test]
    fn quarter_turns_are_exact() {
        let expected = [(DIRECTION_ONE, 0), (0, DIRECTION_ONE), (-DIRECTION_ONE, 0), (0, -DIRECTION_ONE)];
        for (quarter, (x, y)) in (0..).zip(expected) {
            let angle_deg = 90.0 * f64::from(quarter);
            assert_eq!(Direction::from_degrees(angle_deg), Direction { x, y }, "{angle_deg} deg");
            assert_eq!(Direction::from_degrees(angle_deg - 720.0), Direction { x, y }, "{angle_deg} - 720 deg");
        }
    }

    #[test]
    fn opposite_directions_have_opposite_offsets_and_hops() {
        for degree in 0..360 {
            let there = Direction::from_degrees(f64::from(degree));
            let back = Direction { x: -there.x, y: -there.y };
            for cells in [1, 2, 5, 17, 64] {
                assert_eq!(there.offset(cells), back.offset(cells).map(|part| -part), "{degree} deg, {cells} cells");
                let dither = [17, 200];
                let hop = back.hop(256 * cells, dither).map(|part| -part);
                assert_eq!(there.hop(256 * cells, dither), hop, "{degree} deg, hop of {cells} cells");
            }
        }
    }

    #[test]
    fn dithered_hops_have_the_right_mean() {
        let wind = Direction::from_degrees(37.0);
        let length_256 = 1357;
        let sum: i64 = (0..256).map(|dither| i64::from(wind.hop(length_256, [dither, 255 - dither])[0])).sum();
        let expected = f64::from(length_256) / 256.0 * 37f64.to_radians().cos();
        // A length is resolved to 1/256 cell, the direction to 2^-14.
        assert!(
            (sum as f64 / 256.0 - expected).abs() < 1.0 / 256.0 + 4e-4,
            "mean {} of {expected}",
            sum as f64 / 256.0
        );
    }
}

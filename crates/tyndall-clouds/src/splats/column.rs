//! The column of a ball in single precision, as the splats need it; [`tyndall_core::metaball`] has the same in double.
#![expect(clippy::inline_always, reason = "only what is inlined is compiled for the processor's wider instructions")]

/// Factors of the column u^(5/2) (A + B u).
pub(super) const COLUMN: [f32; 2] = [16.0 / 27.0, 128.0 / 315.0];

/// Integral of the field along a whole line, over the radius; `u` is 1 less the square of the line's distance in radii.
#[inline(always)]
pub(super) fn column(u: f32) -> f32 {
    let u = u.max(0.0);
    u * u * u.sqrt() * (COLUMN[0] + COLUMN[1] * u)
}

/// Integral along the line up to `s` radii past the point that is nearest to the centre.
#[inline(always)]
pub(super) fn column_to(u: f32, s: f32) -> f32 {
    let u = u.max(0.0);
    let end = u.sqrt();
    half_column(u, s.clamp(-end, end)) + 0.5 * column(u)
}

/// Integral from the point nearest to the centre to `s`, which is odd in s.
#[inline(always)]
fn half_column(u: f32, s: f32) -> f32 {
    let s2 = s * s;
    let square = s * (u * u - s2 * (2.0 / 3.0 * u - 0.2 * s2));
    let cube = s * (u * u * u - s2 * (u * u - s2 * (0.6 * u - 1.0 / 7.0 * s2)));
    5.0 / 9.0 * square + 4.0 / 9.0 * cube
}

/// Derivative of [`column_to`] by `u`.
#[inline(always)]
pub(super) fn column_to_by_u(u: f32, s: f32) -> f32 {
    let u = u.max(0.0);
    let end = u.sqrt();
    let (s, s2) = (s.clamp(-end, end), s.clamp(-end, end).powi(2));
    let parts = 5.0 * (2.0 * u - 2.0 / 3.0 * s2) + 4.0 * (3.0 * u * u - s2 * (2.0 * u - 0.6 * s2));
    let half = 1.0 / 9.0 * s * parts;
    half + 0.5 * u * end * (2.5 * COLUMN[0] + 3.5 * COLUMN[1] * u)
}

/// Field at `s` radii past the point nearest to the centre.
#[inline(always)]
pub(super) fn field(u: f32, s: f32) -> f32 {
    let w = (u - s * s).max(0.0);
    w * w * (5.0 / 9.0 + 4.0 / 9.0 * w)
}

/// exp(-x) for x >= 0, within 3e-7 of itself; of additions, multiplications and bits alone, so that it becomes vector
/// instructions and has the same bits on every processor.
#[inline(always)]
pub(super) fn exp_minus(x: f32) -> f32 {
    /// Adding it rounds to whole numbers, which are then the lowest bits.
    const ROUND: f32 = 12_582_912.0;
    let y = (x * -std::f32::consts::LOG2_E).max(-126.0);
    let rounded = y + ROUND;
    let f = y - (rounded - ROUND);
    let high = 0.055_504_11 + f * (0.009_618_129 + f * (0.001_333_356 + f * 0.000_154_035));
    let series = f * (std::f32::consts::LN_2 + f * (0.240_226_5 + f * high));
    f32::from_bits((1.0 + series).to_bits().wrapping_add(rounded.to_bits() << 23))
}

#[cfg(test)]
mod tests {
    use tyndall_core::metaball::{ball_column, ball_column_to};

    use super::*;

    #[test]
    fn columns_are_those_of_double_precision() {
        for i in 0..=100_u8 {
            let b = f64::from(i) / 100.0;
            let u = crate::narrow::narrow(1.0 - b * b);
            assert!((f64::from(column(u)) - ball_column(b)).abs() < 1e-6, "b = {b}");
            for s in [-2.0_f32, -0.7, -0.1, 0.0, 0.3, 0.9, 3.0] {
                let wanted = ball_column_to(b, f64::from(s));
                assert!((f64::from(column_to(u, s)) - wanted).abs() < 1e-6, "b = {b}, s = {s}");
            }
        }
    }

    #[test]
    fn derivatives_are_difference_quotients() {
        for (u, s) in [(0.9_f32, 0.3_f32), (0.5, -0.4), (0.3, 2.0), (0.7, -2.0)] {
            let by_u = (column_to(u + 1e-2, s) - column_to(u - 1e-2, s)) / 2e-2;
            assert!((column_to_by_u(u, s) - by_u).abs() < 2e-3, "u = {u}, s = {s}: {by_u}");
            let by_s = (column_to(u, s + 1e-2) - column_to(u, s - 1e-2)) / 2e-2;
            assert!((field(u, s) - by_s).abs() < 2e-3, "u = {u}, s = {s}: {by_s}");
        }
    }

    #[test]
    fn the_exponential_is_right_to_seven_digits_and_never_negative() {
        for i in 0..4000_u16 {
            let x = f32::from(i) * 0.02;
            let (found, wanted) = (f64::from(exp_minus(x)), (-f64::from(x)).exp());
            // The product with log2(e) is rounded, which costs x times half a unit in the last place.
            assert!((found - wanted).abs() < (4e-7 + 1e-7 * f64::from(x)) * wanted, "x = {x}: {found} {wanted}");
        }
        assert!(exp_minus(1e9) >= 0.0 && exp_minus(1e9) < 1e-37, "nothing is left of a dense cloud");
        assert!((exp_minus(0.0) - 1.0).abs() < 1e-12, "nothing is taken by none");
    }
}

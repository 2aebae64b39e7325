//! How far a value may be from its reference.

/// A value `y` of reference `r` passes if `|y - r| <= absolute + relative |r|`. Where a tolerance stands, a comment says
/// where its figures come from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Allowed difference where the reference is zero, in the unit of the value.
    pub absolute: f64,
    /// Allowed share of the reference.
    pub relative: f64,
}

impl Tolerance {
    /// A share of the reference alone.
    #[must_use]
    pub const fn relative(relative: f64) -> Self {
        Self { absolute: 0.0, relative }
    }

    /// A difference alone.
    #[must_use]
    pub const fn absolute(absolute: f64) -> Self {
        Self { absolute, relative: 0.0 }
    }

    /// The difference over the allowed one; above 1 it is too large. Infinite when one of the two is not finite and they
    /// are not the same.
    #[must_use]
    pub fn excess(self, value: f64, reference: f64) -> f64 {
        if value.to_bits() == reference.to_bits() || (value.is_nan() && reference.is_nan()) {
            return 0.0;
        }
        if !value.is_finite() || !reference.is_finite() {
            return f64::INFINITY;
        }
        (value - reference).abs() / (self.absolute + self.relative * reference.abs())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn absolute_and_relative_parts_add_up() {
        let tolerance = Tolerance { absolute: 0.5, relative: 0.125 };
        assert!((tolerance.excess(9.5, 8.0) - 1.0).abs() < 1e-12, "0.5 + 0.125 * 8 is exactly used up");
        assert!(Tolerance::relative(1e-5).excess(1e-9, 0.0) > 1.0, "a share of zero allows nothing");
    }

    #[test]
    fn values_that_are_not_finite_never_pass_as_finite_ones() {
        let tolerance = Tolerance::absolute(1e30);
        for (value, reference) in [(f64::NAN, 1.0), (1.0, f64::NAN), (f64::INFINITY, 1.0), (f64::INFINITY, f64::NAN)] {
            assert!(tolerance.excess(value, reference) > 1.0, "{value} for {reference}");
        }
        assert!(tolerance.excess(f64::INFINITY, f64::INFINITY) <= 1.0, "the same infinity is the same value");
    }
}

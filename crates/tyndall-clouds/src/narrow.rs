//! From double to single precision.

/// The nearest f32.
#[expect(clippy::cast_possible_truncation, reason = "grids are stored in single precision; the one place that narrows")]
pub(crate) fn narrow(value: f64) -> f32 {
    value as f32
}

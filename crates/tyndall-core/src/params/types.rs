//! The Rust types that a parameter may have.

use super::{ParamKind, Scale};

/// A type whose values travel as `f64` without loss.
pub trait ParamType: Copy {
    /// Real, integer, toggle or choice.
    const KIND: ParamKind;

    /// Range of a parameter that declares none.
    const FULL_RANGE: (f64, f64);

    /// The value as `f64`.
    fn to_value(self) -> f64;

    /// The value back from `f64`; the caller has checked kind and range.
    fn from_value(value: f64) -> Self;
}

impl ParamType for f64 {
    const KIND: ParamKind = ParamKind::Real;
    const FULL_RANGE: (Self, Self) = (Self::MIN, Self::MAX);

    fn to_value(self) -> f64 {
        self
    }

    fn from_value(value: f64) -> Self {
        value
    }
}

impl ParamType for u32 {
    const KIND: ParamKind = ParamKind::Integer;
    const FULL_RANGE: (f64, f64) = (0.0, Self::MAX as f64);

    fn to_value(self) -> f64 {
        f64::from(self)
    }

    #[expect(clippy::cast_possible_truncation, reason = "the caller has checked that the value is whole and in range")]
    fn from_value(value: f64) -> Self {
        value as Self
    }
}

impl ParamType for bool {
    const KIND: ParamKind = ParamKind::Toggle;
    const FULL_RANGE: (f64, f64) = (0.0, 1.0);

    fn to_value(self) -> f64 {
        f64::from(u8::from(self))
    }

    fn from_value(value: f64) -> Self {
        value != 0.0
    }
}

/// Position of a choice among its names.
#[doc(hidden)]
#[must_use]
#[expect(clippy::cast_possible_truncation, reason = "choices travel as the index of their name")]
pub fn choice_index(value: f64) -> usize {
    value as usize
}

/// Unit, range and slider scale of a parameter: as declared, or the type's own when the declaration has none.
#[doc(hidden)]
#[must_use]
pub fn limits<T: ParamType>(declared: Option<Limits>) -> Limits {
    let (low, high) = T::FULL_RANGE;
    declared.unwrap_or(Limits { unit: "1", low, high, scale: Scale::Linear })
}

/// The bracketed part of a declaration.
#[doc(hidden)]
#[derive(Debug)]
pub struct Limits {
    pub unit: &'static str,
    pub low: f64,
    pub high: f64,
    pub scale: Scale,
}

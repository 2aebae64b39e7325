//! A texel of several numbers that tables interpolate together.

/// Sums and multiples of `N` numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Texel<const N: usize>(pub(crate) [f64; N]);

impl<const N: usize> std::ops::Add for Texel<N> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] + other.0[i]))
    }
}

impl<const N: usize> std::ops::Mul<f64> for Texel<N> {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self(self.0.map(|value| value * factor))
    }
}

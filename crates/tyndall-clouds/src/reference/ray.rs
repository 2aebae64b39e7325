//! Lines of sight.

/// A line of sight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it begins.
    pub origin: [f64; 3],
    /// Where it goes; its length does not matter.
    pub direction: [f64; 3],
}

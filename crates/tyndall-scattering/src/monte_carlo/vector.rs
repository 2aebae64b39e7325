//! The few operations on directions that a random walk needs.

use std::f64::consts::TAU;

/// A direction or a displacement.
pub(super) type Vector = [f64; 3];

/// Scalar product.
pub(super) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a x + b y.
pub(super) fn combine(a: f64, x: Vector, b: f64, y: Vector) -> Vector {
    std::array::from_fn(|i| a * x[i] + b * y[i])
}

/// The direction at an angle of cosine `cosine` from the unit vector `axis`, `turn` (0 to 1) of a full turn around it.
pub(super) fn around(axis: Vector, cosine: f64, turn: f64) -> Vector {
    let (first, second) = basis(axis);
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    let (sin_turn, cos_turn) = (TAU * turn).sin_cos();
    let sideways = combine(sine * cos_turn, first, sine * sin_turn, second);
    normalized(combine(cosine, axis, 1.0, sideways))
}

/// Two unit vectors at right angles to a unit vector and to each other; Duff et al. 2017, "Building an Orthonormal Basis,
/// Revisited".
fn basis([x, y, z]: Vector) -> (Vector, Vector) {
    let sign = 1.0_f64.copysign(z);
    let a = -1.0 / (sign + z);
    let b = x * y * a;
    ([1.0 + sign * x * x * a, sign * b, -sign * x], [b, sign + y * y * a, -y])
}

/// The same direction with length 1.
pub(super) fn normalized(vector: Vector) -> Vector {
    let scale = 1.0 / dot(vector, vector).sqrt();
    vector.map(|component| component * scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_direction_around_an_axis_keeps_its_angle() {
        for axis in [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [0.6, 0.0, -0.8], [0.48, 0.6, 0.64]] {
            for (cosine, turn) in [(1.0, 0.3), (-1.0, 0.1), (0.2, 0.0), (-0.7, 0.9)] {
                let direction = around(axis, cosine, turn);
                assert!((dot(direction, axis) - cosine).abs() < 1e-12, "{axis:?} {cosine}");
                assert!((dot(direction, direction) - 1.0).abs() < 1e-12, "{direction:?}");
            }
        }
    }

    #[test]
    fn a_half_turn_is_the_mirror_image() {
        let axis = [0.48, 0.6, 0.64];
        let sum = combine(1.0, around(axis, 0.3, 0.1), 1.0, around(axis, 0.3, 0.6));
        assert!((dot(sum, sum).sqrt() - 0.6).abs() < 1e-12, "{sum:?}");
    }
}

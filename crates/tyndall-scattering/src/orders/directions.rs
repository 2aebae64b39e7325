//! Directions at a node: zenith cosines split at the horizon and dense there, azimuths of half a turn.

use std::f64::consts::PI;

/// A zenith cosine of the quadrature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Zenith {
    /// Cosine of the zenith angle.
    pub mu: f64,
    /// Solid angle (sr) of one azimuth of the half turn and its mirror image.
    pub solid_angle: f64,
}

/// `count` zenith cosines below the horizon at `horizon_mu`, then `count` above, for `azimuths` azimuths in half a turn.
///
/// mu = edge +- span t^2 with Gauss nodes t: the radiance changes fastest at the horizon, where it has a step.
#[must_use]
pub fn zeniths(horizon_mu: f64, count: usize, azimuths: usize) -> Vec<Zenith> {
    let nodes = gauss_legendre(count);
    let side = |pole: f64| {
        let span = pole - horizon_mu;
        nodes.iter().map(move |(t, weight)| Zenith {
            mu: horizon_mu + span * t * t,
            solid_angle: span.abs() * 2.0 * t * weight * 2.0 * PI / azimuths as f64,
        })
    };
    side(-1.0).chain(side(1.0)).collect()
}

/// Cosine of azimuth `index` of `count` in half a turn, midpoints.
#[must_use]
pub fn azimuth_cosine(index: usize, count: usize) -> f64 {
    (PI * (index as f64 + 0.5) / count as f64).cos()
}

/// Nodes and weights of Gauss-Legendre quadrature on 0 to 1, by Newton's iteration.
#[must_use]
pub fn gauss_legendre(count: usize) -> Vec<(f64, f64)> {
    let node = |index: usize| {
        let mut z = (PI * (index as f64 + 0.75) / (count as f64 + 0.5)).cos();
        let mut slope = 1.0;
        // From this start the iteration doubles its digits each time; eight rounds are more than f64 can use.
        for _round in 0..8 {
            let (mut before, mut here) = (0.0, 1.0);
            for k in 0..count {
                (before, here) = (here, ((2 * k + 1) as f64 * z * here - k as f64 * before) / (k + 1) as f64);
            }
            slope = count as f64 * (z * here - before) / (z * z - 1.0);
            z -= here / slope;
        }
        (0.5 * (1.0 + z), 1.0 / ((1.0 - z * z) * slope * slope))
    };
    (0..count).rev().map(node).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_solid_angles_add_up_to_the_sphere() {
        for horizon in [0.0, -0.1, -0.8] {
            let sum: f64 = zeniths(horizon, 6, 5).iter().map(|zenith| zenith.solid_angle * 5.0).sum();
            assert!((sum / (4.0 * PI) - 1.0).abs() < 1e-12, "horizon {horizon}: {sum}");
        }
    }

    #[test]
    fn no_direction_crosses_the_horizon() {
        let zeniths = zeniths(-0.2, 4, 4);
        assert!(zeniths[..4].iter().all(|zenith| -1.0 < zenith.mu && zenith.mu < -0.2), "below");
        assert!(zeniths[4..].iter().all(|zenith| -0.2 < zenith.mu && zenith.mu < 1.0), "above");
    }

    #[test]
    fn gauss_nodes_are_exact_for_polynomials_of_twice_their_number() {
        for count in [2_usize, 5, 8] {
            for degree in 0..2 * count {
                let exponent = i32::try_from(degree).expect("small");
                let sum: f64 = gauss_legendre(count).iter().map(|(x, weight)| weight * x.powi(exponent)).sum();
                assert!((sum * (degree + 1) as f64 - 1.0).abs() < 1e-13, "{count} nodes, degree {degree}: {sum}");
            }
        }
    }
}

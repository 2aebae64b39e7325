//! Real spherical harmonics that are symmetric about the sun's meridian.
//!
//! `Y_lm` = `N_lm` `P_lm`(mu) cos(m phi), 0 <= m <= l, with mu the cosine of the zenith angle and phi the azimuth from the
//! sun; orthonormal over the sphere. The sky is its own mirror image about the plane through zenith and sun, so that the
//! harmonics with sin(m phi) are not needed. WGSL: `shaders/sky/orders_basis.wgsl`.

use std::f64::consts::PI;

/// Largest degree l.
pub const MAX_DEGREE: usize = 4;

/// Harmonics of [`MAX_DEGREE`].
pub const MAX_HARMONICS: usize = harmonic_count(MAX_DEGREE);

/// Number of harmonics up to a degree.
#[must_use]
pub const fn harmonic_count(degree: usize) -> usize {
    (degree + 1) * (degree + 2) / 2
}

/// Place of `Y_lm` in lists of harmonics.
#[must_use]
pub const fn harmonic_index(l: usize, m: usize) -> usize {
    l * (l + 1) / 2 + m
}

/// The parts `N_lm` `P_lm`(mu) of the harmonics up to `degree`, the rest zero; without the sign (-1)^m of some texts.
#[must_use]
pub fn zenith_parts(mu: f64, degree: usize) -> [f64; MAX_HARMONICS] {
    let sine = (1.0 - mu * mu).max(0.0).sqrt();
    let mut parts = [0.0; MAX_HARMONICS];
    let mut diagonal = 1.0;
    for m in 0..=degree {
        // P_mm = (2m - 1)!! sin^m, then upwards in l.
        let (mut before, mut here) = (0.0, diagonal);
        for l in m..=degree {
            parts[harmonic_index(l, m)] = NORMS[harmonic_index(l, m)] * here;
            let next = ((2 * l + 1) as f64 * mu * here - (l + m) as f64 * before) / (l + 1 - m) as f64;
            (before, here) = (here, next);
        }
        diagonal *= (2 * m + 1) as f64 * sine;
    }
    parts
}

/// The parts cos(m phi), m from 0 to [`MAX_DEGREE`], by Chebyshev's recurrence.
#[must_use]
pub fn azimuth_parts(cos_phi: f64) -> [f64; MAX_DEGREE + 1] {
    let mut parts = [1.0, cos_phi, 0.0, 0.0, 0.0];
    for m in 2..=MAX_DEGREE {
        parts[m] = 2.0 * cos_phi * parts[m - 1] - parts[m - 2];
    }
    parts
}

/// `N_lm` = sqrt((2l + 1) / (4 pi) (l - m)! / (l + m)!), times sqrt 2 for m > 0.
static NORMS: std::sync::LazyLock<[f64; MAX_HARMONICS]> = std::sync::LazyLock::new(|| {
    let mut norms = [0.0; MAX_HARMONICS];
    for l in 0..=MAX_DEGREE {
        for m in 0..=l {
            let factorials: f64 = (l - m + 1..=l + m).map(|k| k as f64).product();
            let doubled = if m == 0 { 1.0 } else { 2.0 };
            norms[harmonic_index(l, m)] = (doubled * (2 * l + 1) as f64 / (4.0 * PI * factorials)).sqrt();
        }
    }
    norms
});

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::integrate;

    /// All harmonics at once, by the definition.
    fn harmonics(mu: f64, phi: f64) -> [f64; MAX_HARMONICS] {
        let (zenith, azimuth) = (zenith_parts(mu, MAX_DEGREE), azimuth_parts(phi.cos()));
        let mut values = [0.0; MAX_HARMONICS];
        for l in 0..=MAX_DEGREE {
            for m in 0..=l {
                values[harmonic_index(l, m)] = zenith[harmonic_index(l, m)] * azimuth[m];
            }
        }
        values
    }

    #[test]
    fn harmonics_are_orthonormal_over_the_sphere() {
        for a in 0..MAX_HARMONICS {
            for b in 0..=a {
                // Sixteen even azimuths are exact for products up to cos(8 phi).
                let product = integrate(-1.0, 1.0, 16, |mu| {
                    let around = (0..16).map(|k| harmonics(mu, 2.0 * PI * f64::from(k) / 16.0));
                    around.map(|y| y[a] * y[b]).sum::<f64>() * 2.0 * PI / 16.0
                });
                let want = if a == b { 1.0 } else { 0.0 };
                // Odd powers of the sine have an infinite slope at the poles.
                assert!((product - want).abs() < 1e-5, "{a} {b}: {product}");
            }
        }
    }

    #[test]
    fn the_addition_theorem_gives_legendre_polynomials() {
        // The mirror-symmetric harmonics suffice when one of the two directions lies in the plane of symmetry.
        let (mu, phi, mu_sun) = (0.3_f64, 1.1_f64, 0.6_f64);
        let nu = mu * mu_sun + ((1.0 - mu * mu) * (1.0 - mu_sun * mu_sun)).sqrt() * phi.cos();
        let (a, b) = (harmonics(mu, phi), harmonics(mu_sun, 0.0));
        let legendre = [1.0, nu, 0.5 * (3.0 * nu * nu - 1.0), 0.5 * nu * (5.0 * nu * nu - 3.0)];
        for (l, want) in legendre.into_iter().enumerate() {
            let sum: f64 = (0..=l).map(|m| a[harmonic_index(l, m)] * b[harmonic_index(l, m)]).sum();
            let got = sum * 4.0 * PI / (2 * l + 1) as f64;
            assert!((got - want).abs() < 1e-12, "l = {l}: {got} {want}");
        }
    }

    #[test]
    fn a_lower_degree_leaves_the_higher_harmonics_out() {
        let (low, high) = (zenith_parts(-0.4, 2), zenith_parts(-0.4, MAX_DEGREE));
        assert_eq!(low[..harmonic_count(2)], high[..harmonic_count(2)], "the same low harmonics");
        assert!(low[harmonic_count(2)..].iter().all(|value| *value == 0.0), "nothing above");
    }
}

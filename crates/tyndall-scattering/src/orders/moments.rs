//! Legendre moments of phase functions.
//!
//! p(cos theta) = 1/(4 pi) sum of (2l + 1) `chi_l` `P_l`(cos theta); `chi_0` = 1, `chi_1` is the mean cosine. Scattering
//! multiplies the harmonics of degree l of the incoming radiance by `chi_l`.

use std::f64::consts::PI;

use super::basis::MAX_DEGREE;
use crate::phase::Phase;
use crate::quadrature::integrate;

/// Panels of the integral over each half of the cosines.
const PANELS: usize = 400;

/// Moments `chi_0` to `chi_4` of a phase function.
#[must_use]
pub fn phase_moments(phase: Phase) -> [f64; MAX_DEGREE + 1] {
    match phase {
        // 3/4 (1 + mu^2) = 1 + 1/2 P_2.
        Phase::Rayleigh => [1.0, 0.0, 0.1, 0.0, 0.0],
        Phase::CornetteShanks { .. } | Phase::HenyeyGreenstein { .. } | Phase::DoubleHenyeyGreenstein { .. } => {
            std::array::from_fn(|l| 2.0 * PI * (half(phase, l, 1.0) + half(phase, l, -1.0)))
        }
    }
}

/// Integral of p `P_l` over the cosines from 0 to `pole`, 1 or -1, with nodes dense at the pole, where lobes are narrow.
fn half(phase: Phase, l: usize, pole: f64) -> f64 {
    integrate(0.0, 1.0, PANELS, |u| {
        let mu = pole * (1.0 - u * u);
        phase.value(mu) * legendre(l, mu) * 2.0 * u
    })
}

/// Legendre polynomial of degree `l`.
fn legendre(l: usize, mu: f64) -> f64 {
    let (mut before, mut here) = (0.0, 1.0);
    for k in 0..l {
        (before, here) = (here, ((2 * k + 1) as f64 * mu * here - k as f64 * before) / (k + 1) as f64);
    }
    here
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn henyey_and_greensteins_moments_are_the_powers_of_g() {
        for g in [-0.7, 0.0, 0.3, 0.76, 0.95] {
            for (l, chi) in phase_moments(Phase::HenyeyGreenstein { g }).into_iter().enumerate() {
                let want = g.powi(i32::try_from(l).expect("small"));
                assert!((chi - want).abs() < 1e-9, "g = {g}, l = {l}: {chi} {want}");
            }
        }
    }

    #[test]
    fn cornette_and_shanks_mean_cosine_is_the_published_one() {
        for g in [-0.5_f64, 0.2, 0.76, 0.9] {
            let chi = phase_moments(Phase::CornetteShanks { g });
            let mean = 3.0 * g * (4.0 + g * g) / (5.0 * (2.0 + g * g));
            assert!((chi[0] - 1.0).abs() < 1e-9 && (chi[1] - mean).abs() < 1e-9, "g = {g}: {chi:?} {mean}");
        }
    }

    #[test]
    fn rayleighs_moments_are_those_of_its_integral() {
        for (l, want) in phase_moments(Phase::Rayleigh).into_iter().enumerate() {
            let got = 2.0 * PI * (half(Phase::Rayleigh, l, 1.0) + half(Phase::Rayleigh, l, -1.0));
            assert!((got - want).abs() < 1e-9, "l = {l}: {got} {want}");
        }
    }
}

//! Random scattering angles.

use crate::phase::{Phase, phase_double_henyey_greenstein, phase_henyey_greenstein, phase_rayleigh};

/// Lobes narrower than this are sampled as if they were isotropic, where the inversion divides by g.
const ISOTROPIC_G: f64 = 1e-4;

/// The cosine of a scattering angle, for a random number in 0..1, distributed by [`scattering_pdf`].
pub(super) fn sample_cosine(phase: Phase, unit: f64) -> f64 {
    match phase {
        Phase::Rayleigh => {
            // 8 u = 4 + 3 c + c^3; Cardano's formula for its one real root.
            let z = 2.0 * (2.0 * unit - 1.0);
            let root = (z + z.hypot(1.0)).cbrt();
            (root - 1.0 / root).clamp(-1.0, 1.0)
        }
        Phase::CornetteShanks { g } | Phase::HenyeyGreenstein { g } => sample_henyey_greenstein(g, unit),
        // The random number first chooses the lobe; what is left of it is random again.
        Phase::DoubleHenyeyGreenstein { g: [forward, _], forward_weight } if unit < forward_weight => {
            sample_henyey_greenstein(forward, unit / forward_weight)
        }
        Phase::DoubleHenyeyGreenstein { g: [_, backward], forward_weight } => {
            sample_henyey_greenstein(backward, (unit - forward_weight) / (1.0 - forward_weight).max(f64::MIN_POSITIVE))
        }
    }
}

/// Density (1/sr) with which [`sample_cosine`] chooses. It is the phase function itself, except that Cornette and Shanks'
/// is sampled by Henyey and Greenstein's, from which it differs by less than a factor 2.
pub(super) fn scattering_pdf(phase: Phase, cosine: f64) -> f64 {
    match phase {
        Phase::Rayleigh => phase_rayleigh(cosine),
        Phase::CornetteShanks { g } | Phase::HenyeyGreenstein { g } => phase_henyey_greenstein(cosine, g),
        Phase::DoubleHenyeyGreenstein { g, forward_weight } => {
            phase_double_henyey_greenstein(cosine, g, forward_weight)
        }
    }
}

fn sample_henyey_greenstein(g: f64, unit: f64) -> f64 {
    if g.abs() < ISOTROPIC_G {
        return 2.0 * unit - 1.0;
    }
    let ratio = (1.0 - g * g) / (1.0 - g + 2.0 * g * unit);
    ((1.0 + g * g - ratio * ratio) / (2.0 * g)).clamp(-1.0, 1.0)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::quadrature::integrate;

    #[test]
    fn sampled_cosines_have_the_distribution_of_their_density() {
        let lobes = [-0.6, 0.0, 0.5, 0.9];
        let phases = lobes.map(|g| [Phase::HenyeyGreenstein { g }, Phase::CornetteShanks { g }]);
        for phase in phases.into_iter().flatten().chain([Phase::Rayleigh]) {
            for unit in [0.01, 0.2, 0.5, 0.77, 0.999] {
                let cosine = sample_cosine(phase, unit);
                let below = 2.0 * PI * integrate(-1.0, cosine, 2000, |mu| scattering_pdf(phase, mu));
                assert!((below - unit).abs() < 1e-6, "{phase:?} {unit}: {below}");
            }
        }
    }

    #[test]
    fn two_lobes_are_sampled_in_their_shares() {
        let (g, forward_weight, count) = ([0.8, -0.3], 0.9, 20_000);
        let phase = Phase::DoubleHenyeyGreenstein { g, forward_weight };
        let cosines = (0..count).map(|i| sample_cosine(phase, (f64::from(i) + 0.5) / f64::from(count)));
        let mean = cosines.sum::<f64>() / f64::from(count);
        let want = forward_weight * g[0] + (1.0 - forward_weight) * g[1];
        assert!((mean - want).abs() < 1e-4, "{mean} {want}");
        assert!((scattering_pdf(phase, 0.2) - phase.value(0.2)).abs() < 1e-15, "the density is the phase function");
    }
}

//! Random scattering angles.

use crate::phase::{Phase, phase_henyey_greenstein, phase_rayleigh};

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
    }
}

/// Density (1/sr) with which [`sample_cosine`] chooses. It is the phase function itself, except that Cornette and Shanks'
/// is sampled by Henyey and Greenstein's, from which it differs by less than a factor 2.
pub(super) fn scattering_pdf(phase: Phase, cosine: f64) -> f64 {
    match phase {
        Phase::Rayleigh => phase_rayleigh(cosine),
        Phase::CornetteShanks { g } | Phase::HenyeyGreenstein { g } => phase_henyey_greenstein(cosine, g),
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
}

//! Phase functions, normalised so that their integral over the sphere is one (1/sr).
//!
//! `cos_theta` is the cosine between the directions in which light travels before and after. The paper's F(alpha) of
//! equation (1) has mean 1 over the sphere instead; F = 4 pi p. WGSL twins: `shaders/common/phase.wgsl`.

use std::f64::consts::PI;

/// Rayleigh, 3/(16 pi) (1 + cos^2 theta); equation (1), F divided by 4 pi.
#[must_use]
pub fn phase_rayleigh(cos_theta: f64) -> f64 {
    3.0 / (16.0 * PI) * (1.0 + cos_theta * cos_theta)
}

/// Cornette and Shanks 1992; `g` in -1..1 shapes the lobe, its mean cosine is 3g(4 + g^2) / (5(2 + g^2)).
#[must_use]
pub fn phase_cornette_shanks(cos_theta: f64, g: f64) -> f64 {
    let d = 1.0 + g * g - 2.0 * g * cos_theta;
    3.0 / (8.0 * PI) * (1.0 - g * g) / (2.0 + g * g) * (1.0 + cos_theta * cos_theta) / (d * d.sqrt())
}

/// Henyey and Greenstein 1941; `g` in -1..1 is the mean cosine.
#[must_use]
pub fn phase_henyey_greenstein(cos_theta: f64, g: f64) -> f64 {
    let d = 1.0 + g * g - 2.0 * g * cos_theta;
    (1.0 - g * g) / (4.0 * PI * d * d.sqrt())
}

/// Two lobes of Henyey and Greenstein, `g` = [forward, backward], the forward one with the share `forward_weight`.
#[must_use]
pub fn phase_double_henyey_greenstein(cos_theta: f64, [forward, backward]: [f64; 2], forward_weight: f64) -> f64 {
    forward_weight * phase_henyey_greenstein(cos_theta, forward)
        + (1.0 - forward_weight) * phase_henyey_greenstein(cos_theta, backward)
}

/// [`phase_double_henyey_greenstein`] after a number of scatterings, 1 or more: the moments of a lobe multiply (Goudsmit and
/// Saunderson 1940), which for Henyey and Greenstein's makes a lobe of its kind. Light that was never turned back keeps to
/// the forward lobe; the rest counts as turned back once.
#[must_use]
pub fn phase_of_orders(cos_theta: f64, orders: f64, g: [f64; 2], forward_weight: f64) -> f64 {
    let narrow = g[0].powf(orders - 1.0);
    phase_double_henyey_greenstein(cos_theta, g.map(|g| narrow * g), forward_weight.powf(orders))
}

/// Which phase function a medium has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Phase {
    /// [`phase_rayleigh`].
    Rayleigh,
    /// [`phase_cornette_shanks`].
    CornetteShanks {
        /// Shape of the lobe, -1 to 1.
        g: f64,
    },
    /// [`phase_henyey_greenstein`].
    HenyeyGreenstein {
        /// Mean cosine, -1 to 1.
        g: f64,
    },
    /// [`phase_double_henyey_greenstein`].
    DoubleHenyeyGreenstein {
        /// Mean cosines of the forward and of the backward lobe, -1 to 1.
        g: [f64; 2],
        /// Share of the forward lobe, 0 to 1.
        forward_weight: f64,
    },
}

impl Phase {
    /// Value at the cosine of the scattering angle (1/sr).
    #[must_use]
    pub fn value(self, cos_theta: f64) -> f64 {
        match self {
            Self::Rayleigh => phase_rayleigh(cos_theta),
            Self::CornetteShanks { g } => phase_cornette_shanks(cos_theta, g),
            Self::HenyeyGreenstein { g } => phase_henyey_greenstein(cos_theta, g),
            Self::DoubleHenyeyGreenstein { g, forward_weight } => {
                phase_double_henyey_greenstein(cos_theta, g, forward_weight)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::integrate;

    fn moment(phase: Phase, power: i32) -> f64 {
        2.0 * PI * integrate(-1.0, 1.0, 4000, |mu| phase.value(mu) * mu.powi(power))
    }

    fn all() -> Vec<Phase> {
        let lobes = [-0.8, -0.3, 0.0, 0.5, 0.76, 0.9];
        let pairs = lobes.map(|g| [Phase::CornetteShanks { g }, Phase::HenyeyGreenstein { g }]);
        let double = Phase::DoubleHenyeyGreenstein { g: [0.85, -0.3], forward_weight: 0.9 };
        [Phase::Rayleigh, double].into_iter().chain(pairs.into_iter().flatten()).collect()
    }

    #[test]
    fn every_phase_function_integrates_to_one() {
        for phase in all() {
            assert!((moment(phase, 0) - 1.0).abs() < 1e-9, "{phase:?}: {}", moment(phase, 0));
        }
    }

    #[test]
    fn henyey_greenstein_has_mean_cosine_g_and_rayleigh_none() {
        assert!(moment(Phase::Rayleigh, 1).abs() < 1e-12, "Rayleigh is symmetric");
        for g in [-0.6, 0.2, 0.85] {
            let mean = moment(Phase::HenyeyGreenstein { g }, 1);
            assert!((mean - g).abs() < 1e-9, "g = {g}: {mean}");
        }
    }

    #[test]
    fn lobes_of_many_orders_are_those_of_one_convolved_with_themselves() {
        let (g, weight) = ([0.89, -0.5], 0.94);
        for cosine in [-1.0, -0.2, 0.4, 1.0] {
            let (one, want) =
                (phase_of_orders(cosine, 1.0, g, weight), phase_double_henyey_greenstein(cosine, g, weight));
            assert!((one - want).abs() < 1e-15, "one order at {cosine}: {one}, {want}");
        }
        for orders in [2.0, 3.0, 7.5] {
            let moment = |power: i32| {
                2.0 * PI * integrate(-1.0, 1.0, 4000, |mu| phase_of_orders(mu, orders, g, weight) * mu.powi(power))
            };
            assert!((moment(0) - 1.0).abs() < 1e-9, "{orders} orders keep the light: {}", moment(0));
            // One lobe alone is exact: its moments are powers of its mean cosine.
            let alone = 2.0 * PI * integrate(-1.0, 1.0, 4000, |mu| phase_of_orders(mu, orders, [0.89, 0.0], 1.0) * mu);
            assert!((alone - 0.89_f64.powf(orders)).abs() < 1e-9, "{orders} orders of one lobe: {alone}");
        }
        // Twice: 0.94^2 of 0.89^2, twice 0.94 x 0.06 of 0.89 x -0.5; the 0.06^2 that turned back twice count as once.
        let found = 2.0 * PI * integrate(-1.0, 1.0, 4000, |mu| phase_of_orders(mu, 2.0, g, weight) * mu);
        let want = (0.94 * 0.89 - 0.06 * 0.5_f64).powi(2);
        assert!((found - want).abs() < 0.0036 * (0.89 * 0.5 + 0.25) + 1e-9, "mean cosine after two: {found}, {want}");
    }

    #[test]
    fn cornette_shanks_has_its_published_mean_cosine() {
        for g in [-0.6_f64, 0.3, 0.76] {
            let mean = moment(Phase::CornetteShanks { g }, 1);
            let want = 3.0 * g * (4.0 + g * g) / (5.0 * (2.0 + g * g));
            assert!((mean - want).abs() < 1e-9, "g = {g}: {mean} {want}");
        }
    }

    #[test]
    fn cornette_shanks_without_lobe_is_rayleigh() {
        for mu in [-1.0, -0.4, 0.0, 0.7, 1.0] {
            assert!((phase_cornette_shanks(mu, 0.0) - phase_rayleigh(mu)).abs() < 1e-15, "{mu}");
        }
    }
}

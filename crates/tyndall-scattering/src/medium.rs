//! A medium: how dense it is at each altitude, how it scatters, absorbs and in which directions.

use std::f64::consts::PI;

use crate::phase::Phase;
use crate::quadrature::integrate;

/// Breaks of a layer above its top in scale heights; beyond the last nothing is left.
const LAYER_BREAKS: [f64; 5] = [0.0, 2.0, 5.0, 10.0, 20.0];

/// Density over altitude, relative to the density that the coefficients belong to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Profile {
    /// exp(-h / H), equation (2).
    Exponential {
        /// Scale height H (m).
        scale_height_m: f64,
    },
    /// exp(-h / H) + b: some of the medium at every altitude.
    Background {
        /// Scale height H (m).
        scale_height_m: f64,
        /// Relative density b that is everywhere.
        background: f64,
    },
    /// exp(-(h / s)^p), a fit to measured air that falls faster than an exponential.
    Stretched {
        /// Altitude s at which the density is 1/e (m).
        scale_m: f64,
        /// Power p.
        power: f64,
    },
    /// m / h exp(-ln^2(h / m) / (2 w^2)), a layer with a long tail upwards; ozone.
    LogNormal {
        /// Altitude m, at which the density is 1 (m).
        median_m: f64,
        /// Width w of the logarithm.
        width: f64,
    },
    /// 1 at the centre, falling linearly to 0 at `half_width_m` above and below; ozone.
    Tent {
        /// Altitude of the largest density (m).
        centre_m: f64,
        /// Distance at which the density reaches zero (m).
        half_width_m: f64,
    },
    /// 1 from the ground to the top of a layer, then exp(-(h - top) / H); haze and fog.
    Layer {
        /// Altitude up to which the density is 1 (m); 0 for fog that thins out from the ground.
        top_m: f64,
        /// Scale height H above (m).
        scale_height_m: f64,
    },
}

impl Profile {
    /// Relative density at an altitude (m).
    #[must_use]
    pub fn density(&self, altitude_m: f64) -> f64 {
        match *self {
            Self::Exponential { scale_height_m } => (-altitude_m / scale_height_m).exp(),
            Self::Background { scale_height_m, background } => (-altitude_m / scale_height_m).exp() + background,
            Self::Stretched { scale_m, power } => (-(altitude_m.max(0.0) / scale_m).powf(power)).exp(),
            Self::LogNormal { median_m, width } => {
                let ratio = altitude_m / median_m;
                // At the ground the exponential wins over the pole of 1 / h.
                if ratio > 0.0 { (-0.5 * (ratio.ln() / width).powi(2)).exp() / ratio } else { 0.0 }
            }
            Self::Tent { centre_m, half_width_m } => (1.0 - (altitude_m - centre_m).abs() / half_width_m).max(0.0),
            Self::Layer { top_m, scale_height_m } => (-(altitude_m - top_m).max(0.0) / scale_height_m).exp(),
        }
    }

    /// Logarithm of the density, where that itself may be too small for a number.
    #[must_use]
    pub fn ln_density(&self, altitude_m: f64) -> f64 {
        match *self {
            Self::Exponential { scale_height_m } => -altitude_m / scale_height_m,
            Self::Stretched { scale_m, power } => -(altitude_m.max(0.0) / scale_m).powf(power),
            Self::Layer { top_m, scale_height_m } => -(altitude_m - top_m).max(0.0) / scale_height_m,
            _ => self.density(altitude_m).max(f64::MIN_POSITIVE).ln(),
        }
    }

    /// Altitudes (m) at which the density has a kink or a scale of its own, where a quadrature must break.
    #[must_use]
    pub fn breaks_m(&self) -> Vec<f64> {
        match *self {
            Self::Exponential { .. } | Self::Background { .. } | Self::Stretched { .. } | Self::LogNormal { .. } => {
                vec![]
            }
            Self::Tent { centre_m, half_width_m } => vec![centre_m - half_width_m, centre_m, centre_m + half_width_m],
            Self::Layer { top_m, scale_height_m } => {
                LAYER_BREAKS.iter().map(|scale_heights| top_m + scale_heights * scale_height_m).collect()
            }
        }
    }

    /// Vertical column from sea level to infinity (m): the thickness of the medium if all had density 1.
    #[must_use]
    pub fn vertical_column_m(&self) -> f64 {
        match *self {
            Self::Exponential { scale_height_m } => scale_height_m,
            Self::Background { scale_height_m, background } => {
                if background > 0.0 {
                    f64::INFINITY
                } else {
                    scale_height_m
                }
            }
            Self::Stretched { scale_m, power } => {
                // With x = (h / s)^p no slope is infinite for p >= 1; e^-40 ends f64.
                let end: f64 = 40.0_f64.powf(1.0 / power);
                scale_m * integrate(0.0, end, 200, |x| (-x.powf(power)).exp())
            }
            Self::LogNormal { median_m, width } => median_m * width * (2.0 * PI).sqrt(),
            Self::Layer { top_m, scale_height_m } => top_m + scale_height_m,
            Self::Tent { centre_m, half_width_m } => {
                let below = (half_width_m - centre_m).max(0.0);
                half_width_m - 0.5 * below * below / half_width_m
            }
        }
    }
}

/// One constituent of the atmosphere. Coefficients hold for relative density 1, one value per wavelength.
#[derive(Clone, Debug, PartialEq)]
pub struct Medium {
    /// Density over altitude.
    pub profile: Profile,
    /// Scattering coefficient (1/m).
    pub scattering_per_m: Vec<f64>,
    /// Absorption coefficient (1/m).
    pub absorption_per_m: Vec<f64>,
    /// Directions of the scattered light.
    pub phase: Phase,
}

impl Medium {
    /// Whether it neither scatters nor absorbs, so that nothing changes when it is left out.
    #[must_use]
    pub fn is_absent(&self) -> bool {
        let nothing = |values: &[f64]| values.iter().all(|value| *value <= 0.0);
        nothing(&self.scattering_per_m) && nothing(&self.absorption_per_m)
    }

    /// Scattering plus absorption (1/m) at wavelength `index`.
    #[must_use]
    pub fn extinction_per_m(&self, index: usize) -> f64 {
        self.scattering_per_m[index] + self.absorption_per_m[index]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_logarithm_of_the_density_is_that_of_the_density() {
        let profiles = [
            Profile::Exponential { scale_height_m: 8e3 },
            Profile::Background { scale_height_m: 1e3, background: 1e-3 },
            Profile::Stretched { scale_m: 9e3, power: 1.16 },
            Profile::LogNormal { median_m: 25e3, width: 0.3 },
            Profile::Layer { top_m: 4e3, scale_height_m: 1e3 },
        ];
        for profile in profiles {
            for altitude_m in [100.0, 3e3, 20e3] {
                let (ln, density) = (profile.ln_density(altitude_m), profile.density(altitude_m));
                assert!((ln - density.ln()).abs() < 1e-9, "{profile:?} at {altitude_m}: {ln} {density}");
            }
        }
    }

    #[test]
    fn vertical_columns_equal_the_integral_of_the_density() {
        let profiles = [
            Profile::Exponential { scale_height_m: 8e3 },
            Profile::Tent { centre_m: 25e3, half_width_m: 15e3 },
            Profile::Tent { centre_m: 5e3, half_width_m: 15e3 },
            Profile::Layer { top_m: 4e3, scale_height_m: 1e3 },
            Profile::Background { scale_height_m: 1e3, background: 0.0 },
            Profile::Stretched { scale_m: 9e3, power: 1.16 },
            Profile::LogNormal { median_m: 25e3, width: 0.3 },
        ];
        for profile in profiles {
            let integral = integrate(0.0, 400e3, 4000, |altitude_m| profile.density(altitude_m));
            assert!((integral / profile.vertical_column_m() - 1.0).abs() < 1e-6, "{profile:?}: {integral}");
        }
    }
}

//! A medium: how dense it is at each altitude, how it scatters, absorbs and in which directions.

use crate::phase::Phase;

/// Density over altitude, relative to the density that the coefficients belong to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Profile {
    /// exp(-h / H), equation (2).
    Exponential {
        /// Scale height H (m).
        scale_height_m: f64,
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
            Self::Tent { centre_m, half_width_m } => (1.0 - (altitude_m - centre_m).abs() / half_width_m).max(0.0),
            Self::Layer { top_m, scale_height_m } => (-(altitude_m - top_m).max(0.0) / scale_height_m).exp(),
        }
    }

    /// Vertical column from sea level to infinity (m): the thickness of the medium if all had density 1.
    #[must_use]
    pub fn vertical_column_m(&self) -> f64 {
        match *self {
            Self::Exponential { scale_height_m } => scale_height_m,
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
    use crate::quadrature::integrate;

    #[test]
    fn vertical_columns_equal_the_integral_of_the_density() {
        let profiles = [
            Profile::Exponential { scale_height_m: 8e3 },
            Profile::Tent { centre_m: 25e3, half_width_m: 15e3 },
            Profile::Tent { centre_m: 5e3, half_width_m: 15e3 },
            Profile::Layer { top_m: 4e3, scale_height_m: 1e3 },
        ];
        for profile in profiles {
            let integral = integrate(0.0, 400e3, 4000, |altitude_m| profile.density(altitude_m));
            assert!((integral / profile.vertical_column_m() - 1.0).abs() < 1e-6, "{profile:?}: {integral}");
        }
    }
}

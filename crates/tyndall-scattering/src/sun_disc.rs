//! The sun's disc: radiance, limb darkening, share above the horizon.

use std::f64::consts::PI;

use tyndall_core::spectrum::{Spectrum, WAVELENGTHS_NM};

/// Mean angular radius of the sun (rad), 0.2667 degrees.
pub const SUN_ANGULAR_RADIUS: f64 = 0.004_654_8;

/// Limb-darkening exponents a of I = mu^a at their wavelengths (nm), Hestroffer and Magnan 1998.
const LIMB_EXPONENTS: [(f64, f64); 3] = [(440.0, 0.652), (550.0, 0.503), (680.0, 0.397)];

/// Limb-darkening exponent at a wavelength (nm): linear between the published ones and beyond them.
#[must_use]
pub fn limb_exponent(wavelength_nm: f64) -> f64 {
    let [blue, green, red] = LIMB_EXPONENTS;
    let (a, b) = if wavelength_nm < green.0 { (blue, green) } else { (green, red) };
    a.1 + (b.1 - a.1) * (wavelength_nm - a.0) / (b.0 - a.0)
}

/// Limb-darkening exponents of the eight wavelengths; all zero when the disc is uniform.
#[must_use]
pub fn limb_exponents(limb_darkening: bool) -> Spectrum {
    WAVELENGTHS_NM.map(|nm| if limb_darkening { limb_exponent(nm) } else { 0.0 })
}

/// Radiance of the disc's centre (W/m^2/sr/nm) for a sunlight of `irradiance` (W/m^2/nm) on a plane facing it.
///
/// With I = `I_0` mu^a over a disc of angular radius r: E = pi sin^2(r) `I_0` 2 / (a + 2).
#[must_use]
pub fn sun_centre_radiance(irradiance: f64, exponent: f64, angular_radius: f64) -> f64 {
    irradiance * (exponent + 2.0) / (2.0 * PI * angular_radius.sin().powi(2))
}

/// Radiance of the disc relative to its centre at `share` of the angular radius from it (0 centre, 1 limb).
#[must_use]
pub fn limb_darkening(share: f64, exponent: f64) -> f64 {
    (1.0 - share * share).max(0.0).powf(0.5 * exponent)
}

/// Share of the disc above a straight horizon, for the elevation of its centre above it and its radius (rad).
#[must_use]
pub fn visible_share(elevation: f64, angular_radius: f64) -> f64 {
    let x = (elevation / angular_radius).clamp(-1.0, 1.0);
    0.5 + (x * (1.0 - x * x).sqrt() + x.asin()) / PI
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature::integrate;

    #[test]
    fn the_disc_radiates_the_suns_irradiance() {
        for exponent in [0.0, 0.4, 0.652] {
            let radius = SUN_ANGULAR_RADIUS;
            let centre = sun_centre_radiance(1.9, exponent, radius);
            // dE = L 2 pi share radius^2 d(share); substitution share = 1 - y^2 removes the root at the limb.
            let flux = integrate(0.0, 1.0, 200, |y| {
                let share = 1.0 - y * y;
                limb_darkening(share, exponent) * share * 2.0 * y
            });
            let irradiance = centre * 2.0 * PI * radius.sin().powi(2) * flux;
            assert!((irradiance / 1.9 - 1.0).abs() < 1e-6, "a = {exponent}: {irradiance}");
        }
    }

    #[test]
    fn limb_exponents_are_the_published_ones() {
        for (nm, exponent) in LIMB_EXPONENTS {
            assert!((limb_exponent(nm) - exponent).abs() < 1e-12, "{nm} nm");
        }
        assert!(limb_exponent(395.0) > 0.652 && limb_exponent(701.0) < 0.397, "blue darkens more than red");
    }

    #[test]
    fn half_the_disc_is_visible_when_its_centre_touches_the_horizon() {
        let r = SUN_ANGULAR_RADIUS;
        assert!((visible_share(0.0, r) - 0.5).abs() < 1e-12, "half");
        assert!((visible_share(r, r) - 1.0).abs() < 1e-12, "whole");
        assert!(visible_share(-r, r).abs() < 1e-12, "none");
        let sum = visible_share(0.3 * r, r) + visible_share(-0.3 * r, r);
        assert!((sum - 1.0).abs() < 1e-12, "the two parts of a cut disc: {sum}");
    }
}

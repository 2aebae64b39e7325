//! Scattering coefficients of air.
//!
//! Two models: the fit of Bodhaine et al. 1999 to measured refractive indices and depolarisation (default), and the
//! paper's constant k of equations (1) and (2), which leaves out the depolarisation (King factor 1.048) and the change
//! of the refractive index with wavelength.

use std::f64::consts::PI;

use tyndall_core::units::M_PER_NM;

/// Refractive index of air at sea level in the visible, as the paper's constant k needs it.
pub const REFRACTIVE_INDEX: f64 = 1.000_278;

/// Molecules of air at sea level (1/m^3), `N_s` of the paper's k.
pub const MOLECULES_PER_M3: f64 = 2.547e25;

/// Optical depth of the standard atmosphere above sea level, Bodhaine et al. 1999, eq. 30; `wavelength_nm` in 250..850.
#[must_use]
pub fn bodhaine_optical_depth(wavelength_nm: f64) -> f64 {
    let um = wavelength_nm * 1e-3;
    let l2 = um * um;
    0.002152 * (1.0455996 - 341.29061 / l2 - 0.9023085 * l2) / (1.0 + 0.0027059889 / l2 - 85.968563 * l2)
}

/// The constant k of equation (1) (m^3): 2 pi^2 (n^2 - 1)^2 / (3 `N_s`).
#[must_use]
pub fn paper_k_m3() -> f64 {
    let n2 = REFRACTIVE_INDEX * REFRACTIVE_INDEX;
    2.0 * PI * PI * (n2 - 1.0) * (n2 - 1.0) / (3.0 * MOLECULES_PER_M3)
}

/// Scattering coefficient at sea level of equation (2), 4 pi k / lambda^4 (1/m).
#[must_use]
pub fn paper_scattering_per_m(wavelength_nm: f64) -> f64 {
    let wavelength_m = wavelength_nm * M_PER_NM;
    4.0 * PI * paper_k_m3() / wavelength_m.powi(4)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bodhaine_gives_the_textbook_optical_depths() {
        let wavelengths = [400.0, 450.0, 500.0, 550.0, 600.0, 650.0, 700.0];
        let published = [0.3602, 0.2211, 0.1434, 0.0971, 0.0681, 0.0492, 0.0364];
        for (wavelength, want) in wavelengths.into_iter().zip(published) {
            let got = bodhaine_optical_depth(wavelength);
            // The published values have four decimals.
            assert!((got - want).abs() < 0.6e-4, "{wavelength} nm: {got} {want}");
        }
    }

    #[test]
    fn the_papers_air_scatters_about_five_per_cent_too_little() {
        // 0.01097/km against 0.01150/km, the accepted value at 550 nm and 15 C.
        let paper_per_km = paper_scattering_per_m(550.0) * 1e3;
        assert!((paper_per_km - 0.01097).abs() < 0.5e-5, "{paper_per_km}");
        assert!((paper_per_km / 0.01150 - 0.954).abs() < 0.001, "{}", paper_per_km / 0.01150);
    }

    #[test]
    fn equation_two_falls_with_the_fourth_power_of_wavelength() {
        let ratio = paper_scattering_per_m(400.0) / paper_scattering_per_m(800.0);
        assert!((ratio - 16.0).abs() < 1e-12, "{ratio}");
    }
}

//! Spectra of a few kinds of light.

use glam::{DMat3, DVec3};
use tyndall_core::spectrum::{Spectrum, WAVELENGTHS_NM, rec709_from_spectrum, xyz_from_spectrum};

/// Second radiation constant (nm K).
const SECOND_RADIATION_NM_K: f64 = 1.438_776_877e7;

/// A spectrum times the factor that gives it this luminance (cd/m^2), or, for an irradiance, illuminance (lux).
pub(super) fn with_luminance(shape: &Spectrum, luminance: f64) -> Spectrum {
    let factor = luminance / xyz_from_spectrum(shape)[1];
    shape.map(|value| value * factor)
}

/// The spectrum of luminance 1 that is white, (1, 1, 1), in linear Rec.709: a smooth one, of three bells.
pub(super) fn white() -> Spectrum {
    let bell = |centre_nm: f64| WAVELENGTHS_NM.map(|nm| (-((nm - centre_nm) / 60.0).powi(2)).exp());
    let bells = [450.0, 540.0, 610.0].map(bell);
    let columns = bells.map(|bell| DVec3::from_array(rec709_from_spectrum(&bell)));
    let shares = DMat3::from_cols(columns[0], columns[1], columns[2]).inverse() * DVec3::ONE;
    std::array::from_fn(|k| shares.x * bells[0][k] + shares.y * bells[1][k] + shares.z * bells[2][k])
}

/// Linear Rec.709 of luminance 1 of a star of this colour index: Ballesteros 2012 for its temperature, then a black body.
pub(super) fn star_rec709(colour_index: f64) -> [f64; 3] {
    let index = 0.92 * colour_index;
    let temperature_k = 4600.0 * (1.0 / (index + 1.7) + 1.0 / (index + 0.62));
    let planck =
        WAVELENGTHS_NM.map(|nm| (500.0 / nm).powi(5) / (SECOND_RADIATION_NM_K / (nm * temperature_k)).exp_m1());
    rec709_from_spectrum(&with_luminance(&planck, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_is_white_and_positive() {
        let white = white();
        assert!(white.iter().all(|value| *value > 0.0), "{white:?}");
        for channel in rec709_from_spectrum(&white) {
            assert!((channel - 1.0).abs() < 1e-9, "{channel}");
        }
    }

    #[test]
    fn rigel_is_blue_and_betelgeuse_red_and_both_have_luminance_one() {
        for colour_index in [-0.3, 0.0, 0.65, 1.85] {
            let rgb = star_rec709(colour_index);
            let luminance = tyndall_core::spectrum::luminance_from_rec709(rgb);
            assert!((luminance - 1.0).abs() < 1e-3, "{colour_index}: {luminance}");
        }
        let [rigel, betelgeuse] = [-0.03, 1.85].map(star_rec709);
        assert!(rigel[2] > rigel[0] && betelgeuse[0] > 2.0 * betelgeuse[2], "{rigel:?} {betelgeuse:?}");
    }
}

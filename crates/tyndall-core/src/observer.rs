//! The CIE 1931 2-degree standard observer, and colour from spectra of any wavelengths.
//!
//! The product's own eight wavelengths have better weights ([`crate::spectrum`]); these serve spectra from elsewhere.

use crate::spectrum::{WAVELENGTHS_NM, XYZ_FROM_SPECTRUM};

/// Luminous efficacy (lm/W) at the peak of the observer's sensitivity.
pub const LUMINOUS_EFFICACY_LM_W: f64 = 683.0;

/// First wavelength of the table (nm).
const FIRST_NM: f64 = 360.0;

/// Step of the table (nm).
const STEP_NM: f64 = 5.0;

/// Fewest even wavelengths whose plain sum is a colour.
const FEWEST_EVEN: usize = 24;

/// How a spectrum becomes a colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColourRule {
    /// The fitted weights of the product's eight wavelengths.
    Fitted,
    /// Sum over even steps.
    EvenSum,
    /// The spectrum is taken to be linear between its wavelengths; a per cent or more off when they are few.
    Linear,
}

/// Weights from a spectral radiance (W/m^2/sr/nm) at some wavelengths to CIE XYZ with Y in cd/m^2.
#[derive(Clone, Debug, PartialEq)]
pub struct ColourWeights {
    /// How the weights were found.
    pub rule: ColourRule,
    /// Weights of X, Y and Z for each wavelength.
    pub xyz: Vec<[f64; 3]>,
}

impl ColourWeights {
    /// Weights for ascending wavelengths (nm).
    #[must_use]
    pub fn new(wavelengths_nm: &[f64]) -> Self {
        if same(wavelengths_nm, &WAVELENGTHS_NM) {
            let xyz = (0..WAVELENGTHS_NM.len()).map(|k| XYZ_FROM_SPECTRUM.map(|row| row[k])).collect();
            return Self { rule: ColourRule::Fitted, xyz };
        }
        if let Some(step_nm) = even_step_nm(wavelengths_nm) {
            let weight = |nm: &f64| observer(*nm).map(|value| LUMINOUS_EFFICACY_LM_W * step_nm * value);
            return Self { rule: ColourRule::EvenSum, xyz: wavelengths_nm.iter().map(weight).collect() };
        }
        Self { rule: ColourRule::Linear, xyz: linear_weights(wavelengths_nm) }
    }

    /// CIE XYZ of a spectrum.
    #[must_use]
    pub fn xyz(&self, spectrum: &[f64]) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (weights, value) in self.xyz.iter().zip(spectrum) {
            sum.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += weight * value);
        }
        sum
    }
}

fn same(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6)
}

/// The step (nm) of a long, even list.
fn even_step_nm(wavelengths_nm: &[f64]) -> Option<f64> {
    let (first, last) = (wavelengths_nm.first()?, wavelengths_nm.last()?);
    let step_nm = (last - first) / (wavelengths_nm.len() - 1).max(1) as f64;
    let even = wavelengths_nm.windows(2).all(|pair| (pair[1] - pair[0] - step_nm).abs() < 1e-3 * step_nm);
    (wavelengths_nm.len() >= FEWEST_EVEN && even).then_some(step_nm)
}

/// Integrals of the observer times the hat functions of the wavelengths; the outermost ones hold beyond the ends.
fn linear_weights(wavelengths_nm: &[f64]) -> Vec<[f64; 3]> {
    let mut weights = vec![[0.0; 3]; wavelengths_nm.len()];
    for index in 0..=10 * (OBSERVER.len() - 1) {
        let step_nm = STEP_NM / 10.0;
        let nm = FIRST_NM + index as f64 * step_nm;
        let above = wavelengths_nm.partition_point(|wavelength| *wavelength < nm);
        let (low, high) = (above.saturating_sub(1), above.min(wavelengths_nm.len().saturating_sub(1)));
        let span_nm = wavelengths_nm.get(high).zip(wavelengths_nm.get(low)).map_or(0.0, |(high, low)| high - low);
        let fraction = if span_nm > 0.0 { (nm - wavelengths_nm[low]) / span_nm } else { 0.0 };
        for (node, share) in [(low, 1.0 - fraction), (high, fraction)] {
            if let Some(weight) = weights.get_mut(node) {
                let value = observer(nm);
                for (weight, value) in weight.iter_mut().zip(value) {
                    *weight += LUMINOUS_EFFICACY_LM_W * step_nm * share * value;
                }
            }
        }
    }
    weights
}

/// Colour-matching functions x, y, z at a wavelength (nm), cubic between the table's; zero outside 360 to 830 nm.
#[must_use]
#[expect(clippy::cast_possible_truncation, reason = "the index of a small table")]
pub fn observer(wavelength_nm: f64) -> [f64; 3] {
    let place = (wavelength_nm - FIRST_NM) / STEP_NM;
    let last = OBSERVER.len() - 1;
    if place.is_nan() || place < 0.0 || place > last as f64 {
        return [0.0; 3];
    }
    let below = (place as usize).min(last - 1);
    let f = place - below as f64;
    let row = |offset: usize| OBSERVER[(below + offset).saturating_sub(1).min(last)];
    let (a, b, c, d) = (row(0), row(1), row(2), row(3));
    std::array::from_fn(|i| {
        // Catmull and Rom 1974.
        let cubic = 2.0 * a[i] - 5.0 * b[i] + 4.0 * c[i] - d[i] + f * (3.0 * (b[i] - c[i]) + d[i] - a[i]);
        (b[i] + 0.5 * f * (c[i] - a[i] + f * cubic)).max(0.0)
    })
}

/// CIE 15, table T.4 (1931 2-degree observer), 360 to 830 nm in steps of 5 nm.
const OBSERVER: [[f64; 3]; 95] = [
    [0.0001299, 3.917e-06, 0.0006061],
    [0.0002321, 6.965e-06, 0.001086],
    [0.0004149, 1.239e-05, 0.001946],
    [0.0007416, 2.202e-05, 0.003486],
    [0.001368, 3.9e-05, 0.006450001],
    [0.002236, 6.4e-05, 0.01054999],
    [0.004243, 0.00012, 0.02005001],
    [0.00765, 0.000217, 0.03621],
    [0.01431, 0.000396, 0.06785001],
    [0.02319, 0.00064, 0.1102],
    [0.04351, 0.00121, 0.2074],
    [0.07763, 0.00218, 0.3713],
    [0.13438, 0.004, 0.6456],
    [0.21477, 0.0073, 1.0390501],
    [0.2839, 0.0116, 1.3856],
    [0.3285, 0.01684, 1.62296],
    [0.34828, 0.023, 1.74706],
    [0.34806, 0.0298, 1.7826],
    [0.3362, 0.038, 1.77211],
    [0.3187, 0.048, 1.7441],
    [0.2908, 0.06, 1.6692],
    [0.2511, 0.0739, 1.5281],
    [0.19536, 0.09098, 1.28764],
    [0.1421, 0.1126, 1.0419],
    [0.09564, 0.13902, 0.8129501],
    [0.05795001, 0.1693, 0.6162],
    [0.03201, 0.20802, 0.46518],
    [0.0147, 0.2586, 0.3533],
    [0.0049, 0.323, 0.272],
    [0.0024, 0.4073, 0.2123],
    [0.0093, 0.503, 0.1582],
    [0.0291, 0.6082, 0.1117],
    [0.06327, 0.71, 0.07824999],
    [0.1096, 0.7932, 0.05725001],
    [0.1655, 0.862, 0.04216],
    [0.2257499, 0.9148501, 0.02984],
    [0.2904, 0.954, 0.0203],
    [0.3597, 0.9803, 0.0134],
    [0.4334499, 0.9949501, 0.008749999],
    [0.5120501, 1.0, 0.005749999],
    [0.5945, 0.995, 0.0039],
    [0.6784, 0.9786, 0.002749999],
    [0.7621, 0.952, 0.0021],
    [0.8425, 0.9154, 0.0018],
    [0.9163, 0.87, 0.001650001],
    [0.9786, 0.8163, 0.0014],
    [1.0263, 0.757, 0.0011],
    [1.0567, 0.6949, 0.001],
    [1.0622, 0.631, 0.0008],
    [1.0456, 0.5668, 0.0006],
    [1.0026, 0.503, 0.00034],
    [0.9384, 0.4412, 0.00024],
    [0.8544499, 0.381, 0.00019],
    [0.7514, 0.321, 0.0001],
    [0.6424, 0.265, 4.999999e-05],
    [0.5419, 0.217, 3e-05],
    [0.4479, 0.175, 2e-05],
    [0.3608, 0.1382, 1e-05],
    [0.2835, 0.107, -1.905824131e-21],
    [0.2187, 0.0816, 0.0],
    [0.1649, 0.061, 0.0],
    [0.1212, 0.04458, 0.0],
    [0.0874, 0.032, 0.0],
    [0.0636, 0.0232, 0.0],
    [0.04677, 0.017, 0.0],
    [0.0329, 0.01192, 0.0],
    [0.0227, 0.00821, 0.0],
    [0.01584, 0.005723, 0.0],
    [0.01135916, 0.004102, 0.0],
    [0.008110916, 0.002929, 0.0],
    [0.005790346, 0.002091, 0.0],
    [0.004109457, 0.001484, 0.0],
    [0.002899327, 0.001047, 0.0],
    [0.00204919, 0.00074, 0.0],
    [0.001439971, 0.00052, 0.0],
    [0.0009999493, 0.0003611, 0.0],
    [0.0006900786, 0.0002492, 0.0],
    [0.0004760213, 0.0001719, 0.0],
    [0.0003323011, 0.00012, 0.0],
    [0.0002348261, 8.48e-05, 0.0],
    [0.0001661505, 6e-05, 0.0],
    [0.000117413, 4.24e-05, 0.0],
    [8.307527e-05, 3e-05, 0.0],
    [5.870652e-05, 2.12e-05, 0.0],
    [4.150994e-05, 1.499e-05, 0.0],
    [2.935326e-05, 1.06e-05, 0.0],
    [2.067383e-05, 7.4657e-06, 0.0],
    [1.455977e-05, 5.2578e-06, 0.0],
    [1.025398e-05, 3.7029e-06, 0.0],
    [7.221456e-06, 2.6078e-06, 0.0],
    [5.085868e-06, 1.8366e-06, 0.0],
    [3.581652e-06, 1.2934e-06, 0.0],
    [2.522525e-06, 9.1093e-07, 0.0],
    [1.776509e-06, 6.4153e-07, 0.0],
    [1.251141e-06, 4.5181e-07, 0.0],
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::chromaticity;

    fn even(count: usize) -> Vec<f64> {
        (0..count).map(|k| 360.0 + 470.0 * k as f64 / (count - 1) as f64).collect()
    }

    #[test]
    fn an_equal_energy_spectrum_is_white_with_the_published_integral() {
        for (count, rule) in [(95, ColourRule::EvenSum), (40, ColourRule::EvenSum), (12, ColourRule::Linear)] {
            let weights = ColourWeights::new(&even(count));
            assert_eq!(weights.rule, rule, "{count} wavelengths");
            let xyz = weights.xyz(&vec![1.0; count]);
            // The integral of each function is 106.857 nm.
            assert!((xyz[1] / (683.0 * 106.857) - 1.0).abs() < 2e-3, "{count}: {xyz:?}");
            let [x, y] = chromaticity(xyz);
            assert!((x - 1.0 / 3.0).abs() < 5e-4 && (y - 1.0 / 3.0).abs() < 5e-4, "{count}: {x} {y}");
        }
    }

    #[test]
    fn the_observer_is_most_sensitive_near_555_nm_and_blind_outside_the_table() {
        assert!((observer(555.0)[1] - 1.0).abs() < 1e-9, "{:?}", observer(555.0));
        assert!(observer(550.0)[1] < 1.0 && observer(560.0)[1] < 1.0, "the peak");
        for nm in [359.0, 831.0, f64::NAN] {
            assert!(observer(nm).iter().all(|value| *value == 0.0), "{nm}");
        }
    }

    #[test]
    fn the_products_wavelengths_keep_their_fitted_weights() {
        let weights = ColourWeights::new(&WAVELENGTHS_NM);
        assert_eq!(weights.rule, ColourRule::Fitted, "by name");
        let spectrum = [0.3, 0.4, 0.5, 0.4, 0.3, 0.2, 0.2, 0.1];
        let want = crate::spectrum::xyz_from_spectrum(&spectrum);
        assert!(weights.xyz(&spectrum).iter().zip(want).all(|(a, b)| (a - b).abs() < 1e-9 * b), "{want:?}");
    }
}

//! Absorption of ozone in the Chappuis band.

/// Cross-sections at 233 K (1e-27 m^2), Serdyuchenko et al. 2014, means over bins of 10 nm from 360 nm.
const CROSS_SECTION_1E_27_M2: [f64; 48] = [
    1.18, 0.2182, 0.2818, 0.6636, 1.527, 2.763, 5.52, 8.451, 15.82, 23.16, 36.69, 49.24, 77.52, 90.16, 148.0, 160.2,
    213.9, 275.5, 309.1, 350.0, 426.6, 467.2, 439.8, 470.1, 501.9, 430.5, 374.0, 321.5, 266.2, 223.8, 185.2, 147.3,
    120.9, 94.23, 74.55, 65.66, 51.05, 41.5, 42.28, 32.37, 24.51, 28.01, 25.34, 16.24, 14.65, 20.78, 13.83, 7.105,
];
const FIRST_BIN_CENTRE_NM: f64 = 365.0;
const BIN_NM: f64 = 10.0;

/// Absorption cross-section of one ozone molecule at 233 K (m^2); linear between bin centres, constant outside 365..835 nm.
#[must_use]
#[expect(clippy::cast_possible_truncation, reason = "clamped to the table before the cast")]
pub fn ozone_cross_section_m2(wavelength_nm: f64) -> f64 {
    let last = (CROSS_SECTION_1E_27_M2.len() - 1) as f64;
    let position = ((wavelength_nm - FIRST_BIN_CENTRE_NM) / BIN_NM).clamp(0.0, last);
    let index = (position as usize).min(CROSS_SECTION_1E_27_M2.len() - 2);
    let fraction = position - index as f64;
    1e-27 * (CROSS_SECTION_1E_27_M2[index] * (1.0 - fraction) + CROSS_SECTION_1E_27_M2[index + 1] * fraction)
}

#[cfg(test)]
mod tests {
    use super::*;
    use tyndall_core::units::MOLECULES_PER_M2_PER_DOBSON_UNIT;

    #[test]
    fn three_hundred_dobson_units_have_the_published_optical_depth() {
        // About 0.041 in the Chappuis band's peak near 600 nm.
        let optical_depth = ozone_cross_section_m2(605.0) * 300.0 * MOLECULES_PER_M2_PER_DOBSON_UNIT;
        assert!((optical_depth - 0.0405).abs() < 0.0005, "{optical_depth}");
    }

    #[test]
    fn the_cross_section_is_continuous_and_constant_outside_its_table() {
        assert!((ozone_cross_section_m2(200.0) - 1.18e-27).abs() < 1e-35, "below");
        assert!((ozone_cross_section_m2(900.0) - 7.105e-27).abs() < 1e-35, "above");
        let (below, above) = (ozone_cross_section_m2(604.999), ozone_cross_section_m2(605.001));
        assert!((below / above - 1.0).abs() < 1e-4, "{below} {above}");
    }
}

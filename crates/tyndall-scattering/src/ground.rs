//! Reflectance of the ground.

use crate::params::{GroundMaterial, GroundParams};

/// First wavelength (nm) and step of the tables below.
const FIRST_NM: f64 = 380.0;
const STEP_NM: f64 = 40.0;

/// Grass, Feister and Grewe 1995, as binned for the comparison of clear-sky models by Bruneton 2016.
const GRASS: [f64; 9] = [0.0192, 0.0269, 0.0317, 0.0353, 0.0825, 0.0699, 0.0525, 0.0387, 0.089];

/// Fresh snow of 0.1 mm grains, Wiscombe and Warren 1980, figure 8: flat in the visible, falling in the far red.
const SNOW: [f64; 9] = [0.98, 0.985, 0.985, 0.985, 0.985, 0.98, 0.975, 0.97, 0.96];

/// Diffuse reflection of a flat sea, n = 1.34, under an even sky: Preisendorfer and Mobley 1986.
const WATER: [f64; 9] = [0.066; 9];

/// Share of light that the ground reflects at a wavelength (nm).
pub(crate) fn ground_albedo(ground: &GroundParams, wavelength_nm: f64) -> f64 {
    match ground.material {
        GroundMaterial::Colour => albedo_from_rgb([ground.red, ground.green, ground.blue], wavelength_nm),
        GroundMaterial::Grass => interpolate(&GRASS, wavelength_nm),
        GroundMaterial::Snow => interpolate(&SNOW, wavelength_nm),
        GroundMaterial::Water => interpolate(&WATER, wavelength_nm),
    }
}

/// A table between its wavelengths; its ends beyond them.
#[expect(clippy::cast_possible_truncation, reason = "clamped to the table before the cast")]
fn interpolate(table: &[f64], wavelength_nm: f64) -> f64 {
    let position = ((wavelength_nm - FIRST_NM) / STEP_NM).clamp(0.0, (table.len() - 1) as f64);
    let index = (position as usize).min(table.len() - 2);
    let fraction = position - index as f64;
    table[index] * (1.0 - fraction) + table[index + 1] * fraction
}

/// A smooth reflectance spectrum for an RGB albedo: blue below 480 nm, red above 600 nm, linear blends through green at
/// 540 nm. The three parts add up to one, so that grey stays grey.
pub(crate) fn albedo_from_rgb([red, green, blue]: [f64; 3], wavelength_nm: f64) -> f64 {
    let blue_part = ((540.0 - wavelength_nm) / 60.0).clamp(0.0, 1.0);
    let red_part = ((wavelength_nm - 540.0) / 60.0).clamp(0.0, 1.0);
    blue * blue_part + red * red_part + green * (1.0 - blue_part - red_part)
}

#[cfg(test)]
mod tests {
    use super::*;
    use tyndall_core::spectrum::WAVELENGTHS_NM;

    #[test]
    fn grey_ground_stays_grey_and_red_ground_is_red() {
        for nm in WAVELENGTHS_NM {
            assert!((albedo_from_rgb([0.3; 3], nm) - 0.3).abs() < 1e-12, "{nm}");
        }
        assert!(albedo_from_rgb([1.0, 0.0, 0.0], 654.0) > 0.99, "red light");
        assert!(albedo_from_rgb([1.0, 0.0, 0.0], 442.0) < 0.01, "blue light");
    }

    #[test]
    fn snow_is_white_water_dark_and_grass_greener_than_blue() {
        let at = |material: GroundMaterial, nm: f64| {
            ground_albedo(&GroundParams { material, ..GroundParams::default() }, nm)
        };
        assert!(WAVELENGTHS_NM.iter().all(|nm| at(GroundMaterial::Snow, *nm) > 0.95), "snow");
        assert!(WAVELENGTHS_NM.iter().all(|nm| at(GroundMaterial::Water, *nm) < 0.07), "water");
        assert!(at(GroundMaterial::Grass, 550.0) > 1.5 * at(GroundMaterial::Grass, 450.0), "grass is green");
        assert!(at(GroundMaterial::Grass, 700.0) > at(GroundMaterial::Grass, 660.0), "and bright beyond the red edge");
        assert!((at(GroundMaterial::Grass, 300.0) - GRASS[0]).abs() < 1e-12, "constant beyond the table");
    }
}

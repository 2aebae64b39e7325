//! Atmospheres as text: `key value...` a line, lengths in km, coefficients per km, one value per wavelength in spectral
//! rows. The format in which clear-sky models are compared; any number of wavelengths.
//!
//! Keys: `radius_km`, `top_km`, `wavelength_nm`, `solar` (W/m2/nm), `rayleigh_per_km`, `rayleigh_scale_km`, `mie_ext_per_km`,
//! `mie_sca_per_km`, `mie_scale_km`, `mie_g`, `mie_phase` (0 Cornette-Shanks, 1 Henyey-Greenstein), `ozone_profile`
//! (0 none, 2 tent 25 +- 15 km), `ozone_per_km`, `albedo`. Lines that start with `#` are comments. Profiles other than
//! these (a Rayleigh profile that is not exponential, an aerosol background) are refused rather than ignored.

use std::collections::BTreeMap;

use tyndall_core::units::M_PER_KM;

use crate::haze::no_haze;
use crate::medium::{Medium, Profile};
use crate::phase::Phase;
use crate::{Atmosphere, ScatteringError};

type Rows = BTreeMap<String, Vec<f64>>;

/// Reads an atmosphere from text.
///
/// # Errors
/// When a line is not `key number...`, a needed row is missing or has the wrong length, or the file asks for a profile
/// that is not supported; the message names line or row.
pub fn parse_atmosphere(text: &str) -> Result<Atmosphere, ScatteringError> {
    let rows = parse_rows(text)?;
    for (row, allowed) in
        [("rayleigh_profile", vec![0.0]), ("mie_background", vec![0.0]), ("ozone_profile", vec![0.0, 2.0])]
    {
        if rows.get(row).is_some_and(|values| values.len() != 1 || !allowed.contains(&values[0])) {
            let message = format!("`{row}` other than {allowed:?} is not supported");
            return Err(ScatteringError::AtmosphereFile { line: line_of(text, row), message });
        }
    }
    let wavelengths_nm = rows.get("wavelength_nm").cloned().unwrap_or_default();
    let count = wavelengths_nm.len();
    if count == 0 {
        return Err(ScatteringError::AtmosphereRow { row: "wavelength_nm", found: 0, expected: 1 });
    }
    let air = Medium {
        profile: Profile::Exponential { scale_height_m: number(&rows, "rayleigh_scale_km")? * M_PER_KM },
        scattering_per_m: per_m(&rows, "rayleigh_per_km", count)?,
        absorption_per_m: vec![0.0; count],
        phase: Phase::Rayleigh,
    };
    Ok(Atmosphere {
        planet_radius_m: number(&rows, "radius_km")? * M_PER_KM,
        top_altitude_m: (number(&rows, "top_km")? - number(&rows, "radius_km")?) * M_PER_KM,
        solar_irradiance_w_m2_nm: spectrum(&rows, "solar", count)?,
        media: [air, aerosol(&rows, count)?, ozone(&rows, count)?, no_haze(count)],
        ground_albedo: spectrum(&rows, "albedo", count)?,
        wavelengths_nm,
    })
}

fn parse_rows(text: &str) -> Result<Rows, ScatteringError> {
    let mut rows = Rows::new();
    for (index, line) in text.lines().enumerate() {
        let mut words = line.split_whitespace();
        let Some(key) = words.next().filter(|key| !key.starts_with('#')) else { continue };
        let values: Result<Vec<f64>, _> = words.map(str::parse).collect();
        let values = values.ok().filter(|values| values.iter().all(|value| value.is_finite()));
        let wrong = || ScatteringError::AtmosphereFile {
            line: index + 1,
            message: format!("`{key}` must be followed by finite numbers"),
        };
        rows.insert(key.to_owned(), values.ok_or_else(wrong)?);
    }
    Ok(rows)
}

fn line_of(text: &str, key: &str) -> usize {
    text.lines().position(|line| line.split_whitespace().next() == Some(key)).map_or(0, |index| index + 1)
}

fn spectrum(rows: &Rows, row: &'static str, count: usize) -> Result<Vec<f64>, ScatteringError> {
    let values = rows.get(row).cloned().unwrap_or_default();
    let found = values.len();
    if found == count { Ok(values) } else { Err(ScatteringError::AtmosphereRow { row, found, expected: count }) }
}

fn per_m(rows: &Rows, row: &'static str, count: usize) -> Result<Vec<f64>, ScatteringError> {
    Ok(spectrum(rows, row, count)?.into_iter().map(|per_km| per_km / M_PER_KM).collect())
}

fn number(rows: &Rows, row: &'static str) -> Result<f64, ScatteringError> {
    spectrum(rows, row, 1).map(|values| values[0])
}

fn aerosol(rows: &Rows, count: usize) -> Result<Medium, ScatteringError> {
    let scattering_per_m = per_m(rows, "mie_sca_per_km", count)?;
    let extinction_per_m = per_m(rows, "mie_ext_per_km", count)?;
    let absorption_per_m = extinction_per_m.iter().zip(&scattering_per_m).map(|(e, s)| e - s).collect();
    let g = number(rows, "mie_g")?;
    Ok(Medium {
        profile: Profile::Exponential { scale_height_m: number(rows, "mie_scale_km")? * M_PER_KM },
        scattering_per_m,
        absorption_per_m,
        phase: if number(rows, "mie_phase")? == 0.0 {
            Phase::CornetteShanks { g }
        } else {
            Phase::HenyeyGreenstein { g }
        },
    })
}

fn ozone(rows: &Rows, count: usize) -> Result<Medium, ScatteringError> {
    let present = rows.get("ozone_profile").is_some_and(|values| values[0] != 0.0);
    Ok(Medium {
        profile: Profile::Tent { centre_m: 25e3, half_width_m: 15e3 },
        scattering_per_m: vec![0.0; count],
        absorption_per_m: if present { per_m(rows, "ozone_per_km", count)? } else { vec![0.0; count] },
        phase: Phase::Rayleigh,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const SMALL: &str = "# comment\nradius_km 6360\ntop_km 6420\nrayleigh_scale_km 8\nmie_scale_km 1.2\nmie_g 0.7\nmie_phase 0\n\
        wavelength_nm 440 680\nsolar 1.9 1.5\nrayleigh_per_km 0.03 0.005\nmie_ext_per_km 0.06 0.04\nmie_sca_per_km 0.05 0.03\nalbedo 0.1 0.2\n";

    #[test]
    fn a_file_becomes_an_atmosphere_in_metres() {
        let atmosphere = parse_atmosphere(SMALL).unwrap();
        assert!((atmosphere.top_altitude_m - 60e3).abs() < 1e-6, "{}", atmosphere.top_altitude_m);
        assert!((atmosphere.media[0].scattering_per_m[1] - 5e-6).abs() < 1e-18, "per metre");
        assert!((atmosphere.media[1].absorption_per_m[0] - 1e-5).abs() < 1e-15, "extinction minus scattering");
    }

    #[test]
    fn broken_files_name_the_line_or_the_row() {
        let message = |text: &str| parse_atmosphere(text).unwrap_err().to_string();
        assert!(message(&SMALL.replace("mie_g 0.7", "mie_g zero")).starts_with("line 6:"), "not a number");
        assert!(message(&SMALL.replace("mie_g 0.7", "mie_g nan")).starts_with("line 6:"), "not finite");
        assert!(message(&SMALL.replace("solar 1.9 1.5", "solar 1.9")).contains("`solar` has 1"), "short row");
        assert!(message(&SMALL.replace("radius_km 6360\n", "")).contains("`radius_km` has 0"), "missing row");
        assert!(message(&format!("{SMALL}rayleigh_profile 1\n")).starts_with("line 14:"), "unsupported profile");
        assert!(message("").contains("wavelength_nm"), "empty file");
    }
}

//! Atmospheres as text: `key value...` a line, lengths in km, coefficients per km, one value per wavelength in spectral
//! rows. The format in which clear-sky models are compared; any number of wavelengths.
//!
//! Keys: `radius_km`, `top_km`, `wavelength_nm`, `solar` (W/m2/nm), `rayleigh_per_km`, `rayleigh_profile` (0 exponential, 1 a
//! fit that needs no scale), `rayleigh_scale_km`, `mie_ext_per_km`, `mie_sca_per_km`, `mie_scale_km`, `mie_background` (relative
//! density that is everywhere), `mie_g`, `mie_phase` (0 Cornette-Shanks, 1 Henyey-Greenstein), `ozone_profile` (0 none, 1
//! log-normal, 2 tent 25 +- 15 km), `ozone_per_km`, `albedo`. Lines that start with `#` are comments. Keys and profiles that
//! are not known are refused rather than ignored.

use std::collections::BTreeMap;

use tyndall_core::units::M_PER_KM;

use crate::haze::no_haze;
use crate::medium::{Medium, Profile};
use crate::phase::Phase;
use crate::{Atmosphere, ScatteringError};

type Rows = BTreeMap<String, Vec<f64>>;

/// Keys of the format.
const KEYS: [&str; 16] = [
    "radius_km",
    "top_km",
    "wavelength_nm",
    "solar",
    "rayleigh_per_km",
    "rayleigh_profile",
    "rayleigh_scale_km",
    "mie_ext_per_km",
    "mie_sca_per_km",
    "mie_scale_km",
    "mie_background",
    "mie_g",
    "mie_phase",
    "ozone_profile",
    "ozone_per_km",
    "albedo",
];

/// Density of air as exp(-factor h^power) with h in km: factor and power of the format's second profile.
const STRETCHED_AIR: [f64; 2] = [0.077_719_71, 1.163_642_43];

/// Density of ozone as exp(-a (ln h - b)^2) / h with h in km: a and b of the format's first profile.
const LOG_NORMAL_OZONE: [f64; 2] = [5.555_555_55, 3.222_61];

/// Reads an atmosphere from text.
///
/// # Errors
/// When a line is not `key number...`, a needed row is missing or has the wrong length, or the file asks for a profile
/// that is not supported; the message names line or row.
pub fn parse_atmosphere(text: &str) -> Result<Atmosphere, ScatteringError> {
    let rows = parse_rows(text)?;
    let wavelengths_nm = rows.get("wavelength_nm").cloned().unwrap_or_default();
    let count = wavelengths_nm.len();
    if count == 0 {
        return Err(ScatteringError::AtmosphereRow { row: "wavelength_nm", found: 0, expected: 1 });
    }
    let air = Medium {
        profile: air_profile(text, &rows)?,
        scattering_per_m: per_m(&rows, "rayleigh_per_km", count)?,
        absorption_per_m: vec![0.0; count],
        phase: Phase::Rayleigh,
    };
    Ok(Atmosphere {
        planet_radius_m: number(&rows, "radius_km")? * M_PER_KM,
        top_altitude_m: (number(&rows, "top_km")? - number(&rows, "radius_km")?) * M_PER_KM,
        solar_irradiance_w_m2_nm: spectrum(&rows, "solar", count)?,
        media: [air, aerosol(text, &rows, count)?, ozone(text, &rows, count)?, no_haze(count)],
        ground_albedo: spectrum(&rows, "albedo", count)?,
        wavelengths_nm,
    })
}

fn parse_rows(text: &str) -> Result<Rows, ScatteringError> {
    let mut rows = Rows::new();
    for (index, line) in text.lines().enumerate() {
        let mut words = line.split_whitespace();
        let Some(key) = words.next().filter(|key| !key.starts_with('#')) else { continue };
        if !KEYS.contains(&key) {
            let message = format!("`{key}` is no key of an atmosphere; keys are {}", KEYS.join(", "));
            return Err(ScatteringError::AtmosphereFile { line: index + 1, message });
        }
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

/// The one number of a row that may be left out.
fn number_or(rows: &Rows, row: &'static str, default: f64) -> Result<f64, ScatteringError> {
    if rows.contains_key(row) { number(rows, row) } else { Ok(default) }
}

/// The refusal of a row's value.
fn not_known(text: &str, row: &str, allowed: &str) -> ScatteringError {
    ScatteringError::AtmosphereFile { line: line_of(text, row), message: format!("`{row}` must be {allowed}") }
}

/// The choice of a row among the whole numbers from 0, 0 without the row.
fn choice<T: Copy>(text: &str, rows: &Rows, row: &'static str, choices: &[T]) -> Result<T, ScatteringError> {
    let value = number_or(rows, row, 0.0)?;
    let chosen = choices.iter().enumerate().find(|(index, _)| (*index as f64 - value).abs() < 1e-9);
    chosen.map(|(_, choice)| *choice).ok_or_else(|| {
        let names: Vec<String> = (0..choices.len()).map(|index| index.to_string()).collect();
        not_known(text, row, &format!("one of {}", names.join(", ")))
    })
}

fn air_profile(text: &str, rows: &Rows) -> Result<Profile, ScatteringError> {
    if choice(text, rows, "rayleigh_profile", &[false, true])? {
        let [factor, power] = STRETCHED_AIR;
        return Ok(Profile::Stretched { scale_m: factor.powf(-1.0 / power) * M_PER_KM, power });
    }
    Ok(Profile::Exponential { scale_height_m: scale_m(text, rows, "rayleigh_scale_km")? })
}

/// A length of a profile (m).
fn scale_m(text: &str, rows: &Rows, row: &'static str) -> Result<f64, ScatteringError> {
    let km = number(rows, row)?;
    if km > 0.0 { Ok(km * M_PER_KM) } else { Err(not_known(text, row, "greater than 0 km")) }
}

fn aerosol(text: &str, rows: &Rows, count: usize) -> Result<Medium, ScatteringError> {
    let scattering_per_m = per_m(rows, "mie_sca_per_km", count)?;
    let extinction_per_m = per_m(rows, "mie_ext_per_km", count)?;
    let absorption_per_m = extinction_per_m.iter().zip(&scattering_per_m).map(|(e, s)| e - s).collect();
    let g = number(rows, "mie_g")?;
    if !(-1.0 < g && g < 1.0) {
        return Err(not_known(text, "mie_g", "between -1 and 1"));
    }
    let scale_height_m = scale_m(text, rows, "mie_scale_km")?;
    let background = number_or(rows, "mie_background", 0.0)?;
    if background < 0.0 {
        return Err(not_known(text, "mie_background", "0 or greater"));
    }
    Ok(Medium {
        profile: if background > 0.0 {
            Profile::Background { scale_height_m, background }
        } else {
            Profile::Exponential { scale_height_m }
        },
        scattering_per_m,
        absorption_per_m,
        phase: choice(text, rows, "mie_phase", &[Phase::CornetteShanks { g }, Phase::HenyeyGreenstein { g }])?,
    })
}

fn ozone(text: &str, rows: &Rows, count: usize) -> Result<Medium, ScatteringError> {
    let tent = Profile::Tent { centre_m: 25e3, half_width_m: 15e3 };
    // The file's density is 1 / h exp(-a (ln h - b)^2) with h in km: that of the log-normal times e^-b.
    let [a, b] = LOG_NORMAL_OZONE;
    let log_normal = Profile::LogNormal { median_m: b.exp() * M_PER_KM, width: (0.5 / a).sqrt() };
    let profiles = [None, Some((log_normal, (-b).exp())), Some((tent, 1.0))];
    let chosen = choice(text, rows, "ozone_profile", &profiles)?;
    let per_m = if chosen.is_some() { per_m(rows, "ozone_per_km", count)? } else { vec![0.0; count] };
    let (profile, factor) = chosen.unwrap_or((tent, 0.0));
    Ok(Medium {
        profile,
        scattering_per_m: vec![0.0; count],
        absorption_per_m: per_m.into_iter().map(|value| value * factor).collect(),
        phase: Phase::Rayleigh,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::atmosphere::{AEROSOL, AIR, OZONE};
    use crate::column_table::ColumnTable;
    use crate::optical_length::columns_to_top;

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
        assert!(message(&format!("{SMALL}rayleigh_profile 2\n")).starts_with("line 14:"), "unknown profile");
        assert!(message(&format!("{SMALL}mie_phase 7\n")).contains("one of 0, 1"), "unknown phase");
        assert!(message(&format!("{SMALL}ozone 1\n")).contains("`ozone` is no key"), "unknown key");
        assert!(message(&SMALL.replace("mie_g 0.7", "mie_g 1")).contains("between -1 and 1"), "no lobe has g = 1");
        assert!(message(&SMALL.replace("mie_scale_km 1.2", "mie_scale_km 0")).starts_with("line 5:"), "no height");
        assert!(message("").contains("wavelength_nm"), "empty file");
    }

    #[test]
    fn every_profile_of_the_format_has_its_published_density_and_goes_through_the_tables() {
        let text =
            SMALL.replace("rayleigh_scale_km 8\n", "rayleigh_profile 1\nmie_background 0.001\nozone_profile 1\n");
        let atmosphere = parse_atmosphere(&format!("{text}ozone_per_km 0.0014 0.05\n")).unwrap();
        for km in [1.0_f64, 8.0, 20.0, 40.0] {
            let density = |medium: usize| atmosphere.media[medium].profile.density(km * M_PER_KM);
            let air = (-0.07771971 * km.powf(1.16364243)).exp();
            assert!((density(AIR) / air - 1.0).abs() < 1e-12, "air at {km} km: {}", density(AIR));
            assert!((density(AEROSOL) - (-km / 1.2).exp() - 0.001).abs() < 1e-12, "aerosol at {km} km");
            let ozone_per_km = 0.05 * (-5.55555555 * (km.ln() - 3.22261).powi(2) - km.ln()).exp();
            let got = atmosphere.media[OZONE].absorption_per_m[1] * M_PER_KM * density(OZONE);
            assert!((got / ozone_per_km - 1.0).abs() < 1e-9, "ozone at {km} km: {got} {ozone_per_km}");
        }
        let table = ColumnTable::new(&atmosphere);
        for (h_m, mu) in [(0.0, 0.9), (300.0, 0.02), (12e3, -0.02), (40e3, 0.1)] {
            let (got, want) = (table.lookup(h_m, mu), columns_to_top(&atmosphere, h_m, mu));
            for medium in [AIR, AEROSOL, OZONE] {
                let [got, want] =
                    [got, want].map(|columns| atmosphere.media[medium].extinction_per_m(0) * columns[medium]);
                assert!((got - want).abs() < 2e-3 * want.max(0.1), "medium {medium} from {h_m} m, {mu}: {got} {want}");
            }
        }
    }
}

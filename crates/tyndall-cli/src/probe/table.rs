//! The rows of a probe as CSV, with the columns that comparisons of clear skies use.

use std::fmt::Write as _;
use std::path::Path;

use tyndall_core::observer::{ColourRule, ColourWeights};
use tyndall_core::spectrum::chromaticity;

use super::directions::Line;
use crate::Failure;

/// A row: spectral radiance (W/m2/sr/nm) or irradiance (W/m2/nm).
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Row {
    pub(super) line: Line,
    pub(super) all: Vec<f64>,
    /// The part that was scattered or reflected once, where it is known.
    pub(super) single: Option<Vec<f64>>,
    /// Standard errors, of a Monte-Carlo result.
    pub(super) standard_error: Option<Vec<f64>>,
}

/// First and last wavelength (nm) of the median standard error.
const VISIBLE_NM: std::ops::RangeInclusive<f64> = 360.0..=720.0;

/// The whole table. `origin` says what made it, a line of comment each.
pub(super) fn csv(wavelengths_nm: &[f64], weights: &ColourWeights, origin: &[String], rows: &[Row]) -> String {
    let with_error = rows.iter().any(|row| row.standard_error.is_some());
    let with_single = rows.iter().any(|row| row.single.is_some());
    let mut text = String::new();
    for line in origin {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "# {line}");
    }
    text += "sun_zenith,view_zenith,azimuth";
    if with_error {
        text += ",median_stderr_pct";
    }
    for nm in wavelengths_nm {
        let _ = write!(text, ",L{nm}");
    }
    text += ",cd_m2,x,y";
    text += if with_single { ",single_fraction\n" } else { "\n" };
    for row in rows {
        let Line { sun_zenith_deg, view_zenith_deg, azimuth_deg, .. } = row.line;
        let _ = write!(text, "{sun_zenith_deg},{view_zenith_deg},{azimuth_deg}");
        if with_error {
            let _ = write!(text, ",{:.3}", median_error_pct(wavelengths_nm, row));
        }
        for value in &row.all {
            let _ = write!(text, ",{value:.5e}");
        }
        let xyz = weights.xyz(&row.all);
        // Black has no colour.
        let [x, y] = if xyz[1] > 0.0 { chromaticity(xyz) } else { [0.0; 2] };
        let _ = write!(text, ",{:.5e},{x:.5},{y:.5}", xyz[1]);
        if with_single {
            let single = row.single.as_ref().map_or(0.0, |single| weights.xyz(single)[1]);
            let _ = write!(text, ",{:.4}", if xyz[1] > 0.0 { single / xyz[1] } else { 0.0 });
        }
        text.push('\n');
    }
    text
}

/// Median over the visible wavelengths of the relative standard error (per cent).
fn median_error_pct(wavelengths_nm: &[f64], row: &Row) -> f64 {
    let Some(errors) = &row.standard_error else { return 0.0 };
    let visible = wavelengths_nm.iter().zip(errors.iter().zip(&row.all)).filter(|(nm, _)| VISIBLE_NM.contains(nm));
    let relative = visible.map(|(_, (error, value))| if *value > 0.0 { 100.0 * error / value } else { 0.0 });
    let mut ascending: Vec<f64> = relative.collect();
    ascending.sort_by(f64::total_cmp);
    ascending.get(ascending.len() / 2).copied().unwrap_or(0.0)
}

/// How luminance and colour were found, for the head of the table.
pub(super) fn colour_note(rule: Option<ColourRule>) -> &'static str {
    match rule {
        None => "cd_m2, x, y by the weights given",
        Some(ColourRule::Fitted) => "cd_m2, x, y: CIE 1931 2 deg, weights fitted for these eight wavelengths",
        Some(ColourRule::EvenSum) => "cd_m2, x, y: CIE 1931 2 deg, 683 times the sum over the even steps",
        Some(ColourRule::Linear) => {
            "cd_m2, x, y: CIE 1931 2 deg, spectrum linear between its wavelengths; a per cent or more off when they are few"
        }
    }
}

/// Reads weights from spectrum to XYZ: `wavelength_nm,X,Y,Z` a line, for the atmosphere's wavelengths; Y in units of
/// 1/683 cd/m2.
pub(super) fn read_weights(path: &Path, wavelengths_nm: &[f64]) -> Result<ColourWeights, Failure> {
    let wrong = |line: usize, message: &str| Failure::Usage(format!("{}:{line}: {message}", path.display()));
    let text = std::fs::read_to_string(path)
        .map_err(|error| Failure::Usage(format!("{}: cannot be read: {error}", path.display())))?;
    let mut found: Vec<(f64, [f64; 3])> = Vec::new();
    for (index, line) in text.lines().enumerate() {
        if !line.starts_with(|first: char| first.is_ascii_digit()) {
            continue;
        }
        let values: Vec<f64> = line.split(',').filter_map(|word| word.trim().parse().ok()).collect();
        let &[nm, x, y, z] = values.as_slice() else {
            return Err(wrong(index + 1, "four numbers are needed: wavelength_nm,X,Y,Z"));
        };
        found.push((nm, [x, y, z].map(|weight| weight * tyndall_core::observer::LUMINOUS_EFFICACY_LM_W)));
    }
    let weight = |nm: &f64| {
        let near = found.iter().find(|(wavelength, _)| (wavelength - nm).abs() < 0.01);
        near.map(|(_, weight)| *weight).ok_or_else(|| wrong(1, &format!("there is no weight for {nm} nm")))
    };
    Ok(ColourWeights { rule: ColourRule::Linear, xyz: wavelengths_nm.iter().map(weight).collect::<Result<_, _>>()? })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(part: Option<Vec<f64>>) -> Row {
        let line = Line { sun_zenith_deg: 30.0, view_zenith_deg: 89.5, azimuth_deg: 0.0, number: 1 };
        Row { line, single: part.clone(), standard_error: part, all: vec![0.2, 0.1] }
    }

    #[test]
    fn columns_are_those_of_the_reference_tables() {
        let weights = ColourWeights::new(&[450.0, 550.5]);
        let text = csv(&[450.0, 550.5], &weights, &["made by a test".to_owned()], &[row(Some(vec![0.1, 0.05]))]);
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines[0], "# made by a test", "origin first");
        assert_eq!(
            lines[1], "sun_zenith,view_zenith,azimuth,median_stderr_pct,L450,L550.5,cd_m2,x,y,single_fraction",
            "names"
        );
        assert!(lines[2].starts_with("30,89.5,0,50.000,2.00000e-1,1.00000e-1,"), "{}", lines[2]);
        assert!(lines[2].ends_with(",0.5000"), "{}", lines[2]);
        let plain = csv(&[450.0, 550.5], &weights, &[], &[row(None)]);
        assert!(plain.starts_with("sun_zenith,view_zenith,azimuth,L450,L550.5,cd_m2,x,y\n"), "{plain}");
    }
}

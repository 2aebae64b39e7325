//! A list of humid ellipsoids as a text that a scene can hold.
//!
//! Six numbers for each, in metres: east and north of the grid's middle, height above the condensation level, and the half
//! axes east, north and up; a semicolon between ellipsoids. No text leaves the layout to the pattern.

use std::fmt::Write as _;

use crate::ellipsoids::Ellipsoid;
use crate::error::CloudError;
use crate::params::CloudParams;

/// Name of the parameter in messages.
const NAME: &str = "cloud_vapour.ellipsoids";

/// One ellipsoid of a list.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedEllipsoid {
    /// Middle: east and north of the grid's middle, height above the condensation level (m).
    pub centre_m: [f64; 3],
    /// Half axes east, north and up (m).
    pub radii_m: [f64; 3],
}

/// Reads a list.
///
/// # Errors
/// When something is not a finite number, an ellipsoid has not six of them, or a half axis is not positive.
pub fn parse_ellipsoids(text: &str) -> Result<Vec<PlacedEllipsoid>, CloudError> {
    let entries = text.split(';').map(str::trim).enumerate();
    // Blank at the end of the list only: a semicolon may close it.
    entries
        .filter(|(index, entry)| !(entry.is_empty() && text.split(';').count() == index + 1))
        .map(parse_one)
        .collect()
}

fn parse_one((index, entry): (usize, &str)) -> Result<PlacedEllipsoid, CloudError> {
    let wrong =
        |problem: String| CloudError::Text { name: NAME, problem: format!("ellipsoid {}: {problem}", index + 1) };
    let number = |word: &str| {
        let value = word.parse::<f64>().ok().filter(|value| value.is_finite() && value.abs() <= 1e6);
        value.ok_or_else(|| wrong(format!("`{word}` is not a number from -1000000 to 1000000 m")))
    };
    let numbers = entry.split_whitespace().map(number).collect::<Result<Vec<_>, _>>()?;
    let &[east, north, up, radius_east, radius_north, radius_up] = numbers.as_slice() else {
        return Err(wrong(format!("it has {} numbers; 6 are needed", numbers.len())));
    };
    let radii_m = [radius_east, radius_north, radius_up];
    if let Some(radius) = radii_m.iter().find(|radius| **radius < 1.0) {
        return Err(wrong(format!("a half axis of {radius} m is below 1 m")));
    }
    Ok(PlacedEllipsoid { centre_m: [east, north, up], radii_m })
}

/// The text that [`parse_ellipsoids`] reads, to the metre.
#[must_use]
pub fn ellipsoids_to_text(ellipsoids: &[PlacedEllipsoid]) -> String {
    let mut text = String::new();
    for (index, ellipsoid) in ellipsoids.iter().enumerate() {
        text.push_str(if index == 0 { "" } else { "; " });
        let numbers = ellipsoid.centre_m.into_iter().chain(ellipsoid.radii_m.map(|radius| radius.max(1.0)));
        for (place, number) in numbers.enumerate() {
            // Writing to a String cannot fail; adding zero turns -0 into 0.
            let _ = write!(text, "{}{}", if place == 0 { "" } else { " " }, number.round() + 0.0);
        }
    }
    text
}

impl PlacedEllipsoid {
    /// In the cells of a grid.
    #[must_use]
    pub fn in_cells(&self, params: &CloudParams) -> Ellipsoid {
        let (grid, base) = (&params.grid, params.vapour.base_m / params.grid.cell_m);
        let [x, y, z] = self.centre_m.map(|metres| metres / grid.cell_m);
        Ellipsoid {
            centre_cells: [x + 0.5 * f64::from(grid.cells_east), y + 0.5 * f64::from(grid.cells_north), z + base],
            radii_cells: self.radii_m.map(|radius| (radius / grid.cell_m).max(0.5)),
            base_cells: base,
            strength: 1.0,
        }
    }

    /// From the cells of a grid.
    #[must_use]
    pub fn from_cells(ellipsoid: &Ellipsoid, params: &CloudParams) -> Self {
        let (grid, base) = (&params.grid, params.vapour.base_m / params.grid.cell_m);
        let [x, y, z] = ellipsoid.centre_cells;
        let centre = [x - 0.5 * f64::from(grid.cells_east), y - 0.5 * f64::from(grid.cells_north), z - base];
        Self {
            centre_m: centre.map(|cells| cells * grid.cell_m),
            radii_m: ellipsoid.radii_cells.map(|cells| cells * grid.cell_m),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_is_written_and_read_to_the_metre() {
        let one = PlacedEllipsoid { centre_m: [-1200.0, 340.0, 0.0], radii_m: [700.0, 650.0, 900.0] };
        let two = PlacedEllipsoid { centre_m: [0.0, 0.0, 50.0], ..one };
        let text = ellipsoids_to_text(&[one, two]);
        assert_eq!(text, "-1200 340 0 700 650 900; 0 0 50 700 650 900", "as people would write it");
        assert_eq!(parse_ellipsoids(&text).unwrap(), [one, two], "read");
        assert_eq!(parse_ellipsoids(&format!("{text};")).unwrap().len(), 2, "a last semicolon is no ellipsoid");
        assert!(parse_ellipsoids("").unwrap().is_empty(), "no text, no list");
    }

    #[test]
    fn cells_and_metres_lead_to_each_other() {
        let params = CloudParams::default();
        let one = PlacedEllipsoid { centre_m: [-1200.0, 340.0, 25.0], radii_m: [700.0, 650.0, 900.0] };
        let back = PlacedEllipsoid::from_cells(&one.in_cells(&params), &params);
        let away = (0..3).map(|axis| (back.centre_m[axis] - one.centre_m[axis]).abs()).fold(0.0, f64::max);
        assert!(away < 1e-9 && (back.radii_m[2] - 900.0).abs() < 1e-9, "{back:?}");
    }

    #[test]
    fn wrong_lists_are_refused_with_the_ellipsoid_and_what_is_allowed() {
        for (text, part) in [
            ("1 2 3 4 5", "ellipsoid 1: it has 5 numbers; 6 are needed"),
            ("0 0 0 9 9 9; 0 0 0 9 9 x", "ellipsoid 2: `x` is not a number"),
            ("0 0 0 9 0 9", "a half axis of 0 m is below 1 m"),
            ("0 0 0 9 nan 9", "`nan` is not a number"),
            (";0 0 0 9 9 9", "ellipsoid 1: it has 0 numbers"),
        ] {
            let message = parse_ellipsoids(text).unwrap_err().to_string();
            assert!(message.contains(part) && message.starts_with("`cloud_vapour.ellipsoids`"), "{text}: {message}");
        }
    }
}

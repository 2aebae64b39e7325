//! Lists of directions: `sun_zenith view_zenith azimuth` a line, in degrees, between spaces or commas.

use std::path::Path;

use crate::Failure;

/// The view zenith angle that stands for horizontal irradiance.
const IRRADIANCE: f64 = -1.0;

/// A line of the list.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Line {
    pub(super) sun_zenith_deg: f64,
    pub(super) view_zenith_deg: f64,
    pub(super) azimuth_deg: f64,
    /// Line in the file, from 1.
    pub(super) number: usize,
}

impl Line {
    /// Whether horizontal irradiance is asked for, not radiance.
    pub(super) fn is_irradiance(&self) -> bool {
        self.view_zenith_deg < 0.0
    }

    pub(super) fn mu_sun(&self) -> f64 {
        self.sun_zenith_deg.to_radians().cos()
    }
}

/// Reads a list. Lines that start with `#` are comments, and so is a line of column names.
pub(super) fn read(path: &Path) -> Result<Vec<Line>, Failure> {
    let text = std::fs::read_to_string(path)
        .map_err(|error| Failure::Usage(format!("{}: cannot be read: {error}", path.display())))?;
    parse(&text).map_err(|(line, message)| Failure::Usage(format!("{}:{line}: {message}", path.display())))
}

/// The list in a text, or the line that is wrong and what is wrong with it.
fn parse(text: &str) -> Result<Vec<Line>, (usize, String)> {
    let mut lines = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let words: Vec<&str> = line.split([',', ' ', '\t', '\r']).filter(|word| !word.is_empty()).collect();
        let named = words.first().is_some_and(|word| word.starts_with('#') || *word == "sun_zenith");
        if !words.is_empty() && !named {
            lines.push(parse_line(&words, index + 1).map_err(|message| (index + 1, message))?);
        }
    }
    if lines.is_empty() { Err((1, "there is no direction in this file".to_owned())) } else { Ok(lines) }
}

fn parse_line(words: &[&str], number: usize) -> Result<Line, String> {
    let &[sun, view, azimuth, ..] = words else {
        let count = words.len();
        return Err(format!("three angles in degrees are needed (sun_zenith view_zenith azimuth); {count} found"));
    };
    let angle = |name: &str, word: &str, [low, high]: [f64; 2]| {
        let value = word.parse::<f64>().ok().filter(|value| (low..=high).contains(value));
        value.ok_or_else(|| format!("{name} = {word:?} must be a number from {low} to {high} deg"))
    };
    let sun_zenith_deg = angle("sun_zenith", sun, [0.0, 180.0])?;
    let azimuth_deg = angle("azimuth", azimuth, [-360.0, 360.0])?;
    let view_zenith_deg = if view.parse() == Ok(IRRADIANCE) {
        IRRADIANCE
    } else {
        angle("view_zenith", view, [0.0, 180.0]).map_err(|message| format!("{message}, or -1 for irradiance"))?
    };
    Ok(Line { sun_zenith_deg, view_zenith_deg, azimuth_deg, number })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spaces_commas_comments_and_column_names_are_understood() {
        let lines =
            parse("# a comment\nsun_zenith,view_zenith,azimuth\n0 10 180\n\n30, 89.5, -45, 7\n60\t-1\t0\r\n").unwrap();
        let angles: Vec<[f64; 3]> =
            lines.iter().map(|line| [line.sun_zenith_deg, line.view_zenith_deg, line.azimuth_deg]).collect();
        assert_eq!(angles, [[0.0, 10.0, 180.0], [30.0, 89.5, -45.0], [60.0, -1.0, 0.0]], "three directions");
        assert!(lines[2].is_irradiance() && lines[2].number == 6 && !lines[1].is_irradiance(), "{lines:?}");
    }

    #[test]
    fn wrong_lines_are_named_with_their_number_and_the_range() {
        let refusal = |text: &str| parse(text).expect_err("refused");
        for (text, line, part) in [
            ("0 0 0\n1 2\n", 2, "2 found"),
            ("0 0 0\n\n0 181 0\n", 3, "view_zenith = \"181\" must be a number from 0 to 180 deg"),
            ("0 -2 0\n", 1, "-1 for irradiance"),
            ("nan 0 0\n", 1, "sun_zenith"),
            ("0 0 east\n", 1, "azimuth = \"east\""),
            ("# nothing\n", 1, "no direction"),
        ] {
            let (at, message) = refusal(text);
            assert!(at == line && message.contains(part), "{text:?}: {at}: {message}");
        }
    }
}

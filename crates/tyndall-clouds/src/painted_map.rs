//! A painted map of humidity as a short text that a scene can hold.
//!
//! The map covers the grid with 48 x 48 places, row 0 in the south, and is interpolated between their middles. A place has a
//! level from 0 to 20, written as a letter from `a` to `u`: `k` leaves the supply of vapour as it is, `a` takes it away, `u`
//! brings as much as in the middle of a bubble. A number before a letter repeats it; no text is a map of `k`.

use std::fmt::Write as _;

use tyndall_core::grid::Grid2;

use crate::error::CloudError;
use crate::narrow::narrow;

/// Places along a side of the map.
pub const PAINTED_SIDE: usize = 48;

/// Level that leaves the supply as it is, and the largest.
const NEUTRAL: u8 = 10;
const MOST: u8 = 20;

/// Name of the parameter in messages.
const NAME: &str = "cloud_vapour.painted";

/// Levels of all places.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PaintedMap {
    levels: Vec<u8>,
}

impl Default for PaintedMap {
    fn default() -> Self {
        Self { levels: vec![NEUTRAL; PAINTED_SIDE * PAINTED_SIDE] }
    }
}

impl PaintedMap {
    /// Reads a text.
    ///
    /// # Errors
    /// When it has other characters than digits and the letters `a` to `u`, or does not fill the map.
    pub fn parse(text: &str) -> Result<Self, CloudError> {
        if text.is_empty() {
            return Ok(Self::default());
        }
        let wrong = |problem| CloudError::Text { name: NAME, problem };
        let full = PAINTED_SIDE * PAINTED_SIDE;
        let (mut levels, mut count) = (Vec::with_capacity(full), None);
        for (index, letter) in text.char_indices() {
            if let Some(digit) = letter.to_digit(10) {
                // More than the map holds is refused at the letter.
                count = Some((10 * count.unwrap_or(0) + digit as usize).min(full + 1));
                continue;
            }
            let level =
                u8::try_from(letter).ok().and_then(|byte| byte.checked_sub(b'a')).filter(|level| *level <= MOST);
            let Some(level) = level else {
                return Err(wrong(format!("character {} is {letter:?}; digits and a to u are allowed", index + 1)));
            };
            levels.extend(std::iter::repeat_n(level, count.take().unwrap_or(1)));
            if levels.len() > full {
                return Err(wrong(format!("it has more than {full} places")));
            }
        }
        if levels.len() != full {
            return Err(wrong(format!("it has {} places; {full} are needed", levels.len())));
        }
        Ok(Self { levels })
    }

    /// The text that [`PaintedMap::parse`] reads.
    #[must_use]
    pub fn to_text(&self) -> String {
        if self.is_blank() {
            return String::new();
        }
        let mut text = String::new();
        for run in self.levels.chunk_by(|a, b| a == b) {
            if run.len() > 1 {
                // Writing to a String cannot fail.
                let _ = write!(text, "{}", run.len());
            }
            text.push(char::from(b'a' + run[0]));
        }
        text
    }

    /// Whether nothing is painted.
    #[must_use]
    pub fn is_blank(&self) -> bool {
        self.levels.iter().all(|level| *level == NEUTRAL)
    }

    /// Level of a place, 0 to 2: 1 leaves the supply as it is.
    #[must_use]
    pub fn level(&self, [x, y]: [usize; 2]) -> f64 {
        f64::from(self.levels[y * PAINTED_SIDE + x]) / f64::from(NEUTRAL)
    }

    /// Levels as numbers that a brush changes by less than a step.
    #[must_use]
    pub fn levels(&self) -> Grid2<f64> {
        Grid2::from_fn([PAINTED_SIDE; 2], |x, y| self.level([x, y]))
    }

    /// From numbers, each rounded to the nearest level.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "clamped to the levels before the cast")]
    pub fn from_levels(levels: &Grid2<f64>) -> Self {
        let round = |level: &f64| (f64::from(NEUTRAL) * level).round().clamp(0.0, f64::from(MOST)) as u8;
        let mut map = Self::default();
        map.levels.iter_mut().zip(levels.cells()).for_each(|(place, level)| *place = round(level));
        map
    }

    /// Levels at the middles of the columns of a grid of `columns`, interpolated; the map repeats.
    #[must_use]
    pub fn sampled(&self, columns: [usize; 2]) -> Grid2<f32> {
        Grid2::from_fn(columns, |x, y| {
            let place = [(x, columns[0]), (y, columns[1])].map(|(cell, count)| (cell as f64 + 0.5) / count as f64);
            narrow(self.at(place))
        })
    }

    /// Level at a place given as shares of the map's sides.
    #[must_use]
    pub fn at(&self, place: [f64; 2]) -> f64 {
        let side = PAINTED_SIDE as f64;
        let [(x, across), (y, along)] = place.map(|share| {
            let place = (share * side - 0.5).rem_euclid(side);
            (index(place), place.fract())
        });
        let row = |y: usize| {
            let next = (x + 1) % PAINTED_SIDE;
            self.level([x, y]) * (1.0 - across) + self.level([next, y]) * across
        };
        row(y) * (1.0 - along) + row((y + 1) % PAINTED_SIDE) * along
    }
}

/// The whole part of a place on the map.
#[expect(clippy::cast_possible_truncation, reason = "0 to the map's side")]
fn index(place: f64) -> usize {
    (place as usize).min(PAINTED_SIDE - 1)
}

/// Changes levels by up to `amount` within `radius` (shares of the map's side, which repeats) of a place, most in the middle.
pub fn brush(levels: &mut Grid2<f64>, place: [f64; 2], radius: [f64; 2], amount: f64) {
    let side = PAINTED_SIDE as f64;
    for (x, y) in (0..PAINTED_SIDE).flat_map(|y| (0..PAINTED_SIDE).map(move |x| (x, y))) {
        let away = [x, y].map(|index| (index as f64 + 0.5) / side);
        let distance2: f64 = (0..2)
            .map(|axis| {
                let direct = (away[axis] - place[axis]).rem_euclid(1.0);
                (direct.min(1.0 - direct) / radius[axis].max(0.5 / side)).powi(2)
            })
            .sum();
        let share = (1.0 - distance2).max(0.0);
        let level = &mut levels[[x, y]];
        *level = (*level + amount * share * share).clamp(0.0, 2.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_map_is_written_and_read_to_the_same_levels_in_few_letters() {
        let mut levels = PaintedMap::default().levels();
        brush(&mut levels, [0.25, 0.75], [0.1, 0.1], 0.9);
        brush(&mut levels, [0.0, 0.5], [0.2, 0.2], -0.7);
        let map = PaintedMap::from_levels(&levels);
        let text = map.to_text();
        assert_eq!(PaintedMap::parse(&text).unwrap(), map, "{text}");
        assert!(text.len() < 1500, "{} letters", text.len());
        assert!(
            map.level([12, 36]) > 1.7 && map.level([0, 24]) < 0.5 && map.level([47, 24]) < 0.5,
            "over the edge too"
        );
        assert_eq!(
            (PaintedMap::default().to_text(), PaintedMap::parse("").unwrap()),
            (String::new(), PaintedMap::default())
        );
    }

    #[test]
    fn the_longest_text_still_fits_a_parameter() {
        let mut map = PaintedMap::default();
        map.levels.iter_mut().enumerate().for_each(|(index, level)| *level = if index % 2 == 0 { 0 } else { 20 });
        assert!(map.to_text().len() <= 4096, "{} letters", map.to_text().len());
    }

    #[test]
    fn wrong_texts_are_refused_with_what_is_allowed() {
        for (text, part) in
            [("2304x", "a to u are allowed"), ("2303k", "2304 are needed"), ("99999999999k", "more than")]
        {
            let message = PaintedMap::parse(text).unwrap_err().to_string();
            assert!(message.starts_with("`cloud_vapour.painted`: ") && message.contains(part), "{text}: {message}");
        }
    }

    #[test]
    fn a_map_is_the_same_at_its_places_and_even_between_them() {
        let mut levels = PaintedMap::default().levels();
        levels[[10, 20]] = 2.0;
        let map = PaintedMap::from_levels(&levels);
        let at = |x: f64, y: f64| map.at([x / 48.0, y / 48.0]);
        assert!((at(10.5, 20.5) - 2.0).abs() < 1e-12 && (at(11.0, 20.5) - 1.5).abs() < 1e-12, "half way");
        assert!((at(0.0, 0.0) - 1.0).abs() < 1e-12, "elsewhere");
        assert_eq!(map.sampled([48, 48])[[10, 20]].to_bits(), 2.0_f32.to_bits(), "a grid as fine as the map");
    }
}

//! Winds and strokes of brushes by hand, as texts that a scene can hold.
//!
//! Winds: where each blows to (deg, anticlockwise from east) and its share of the sand that is moved, `0 1; 120 0.5`.
//! Strokes: the step before which the hand is laid on, what it does, the radius (m), how deep (m) or the share that is
//! flattened, and a path of points (m) east and north of the field's middle, `700 dig 6 0.4 10 -20 14 -22`.

use std::fmt::Write as _;

use crate::DuneError;
use crate::brush::{Brush, Stroke, check_stroke, trail, walk};
use crate::wind::Wind;

/// Most winds by hand.
pub const MOST_WINDS: usize = 64;

/// Distance between touches of a brush along its path, in radii.
const TOUCHES_APART: f64 = 0.5;

/// What a hand does to sand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HandTool {
    /// Puts sand down.
    Add,
    /// Takes sand away.
    Dig,
    /// Makes it level.
    Flatten,
    /// Walks over it.
    Walk,
}

impl HandTool {
    /// All, in the order in which they are offered.
    pub const ALL: [Self; 4] = [Self::Add, Self::Dig, Self::Flatten, Self::Walk];

    /// Its name in texts.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Add => "add",
            Self::Dig => "dig",
            Self::Flatten => "flatten",
            Self::Walk => "walk",
        }
    }
}

/// A stroke of a hand along a path.
#[derive(Clone, Debug, PartialEq)]
pub struct HandStroke {
    /// Steps that the wind has blown before it.
    pub step: u32,
    /// What it does.
    pub tool: HandTool,
    /// Radius (m); of footprints half their width.
    pub radius_m: f64,
    /// Depth (m) in the middle of each touch; of flattening the share.
    pub amount: f64,
    /// Points (m) east and north of the field's middle.
    pub path_m: Vec<[f64; 2]>,
}

/// One touch of a hand, in cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// Steps that the wind has blown before it.
    pub step: u32,
    /// Place of its stroke among all.
    pub stroke: usize,
    /// What it does to which cells.
    pub brush: Stroke,
}

impl HandStroke {
    /// The touches that it consists of, on a field of so many cells; a longer path adds touches at the end.
    ///
    /// # Errors
    /// [`DuneError::Value`] when a number is out of range in cells of this width.
    pub fn touches(&self, cell_m: f64, size: [usize; 2]) -> Result<Vec<Stroke>, DuneError> {
        let cells = |metres: f64| metres / cell_m;
        let in_cells = |place: &[f64; 2]| [0, 1].map(|axis| cells(place[axis]) + 0.5 * size[axis] as f64);
        let path: Vec<_> = self.path_m.iter().map(in_cells).collect();
        let radius_cells = cells(self.radius_m);
        let brush = match self.tool {
            HandTool::Add => Brush::Add(cells(self.amount)),
            HandTool::Dig => Brush::Dig(cells(self.amount)),
            HandTool::Flatten => Brush::Flatten(self.amount),
            HandTool::Walk => Brush::Footprint { depth_cells: cells(self.amount), toward_deg: 0.0 },
        };
        let at = |center_cells| Stroke { brush, center_cells, radius_cells };
        path.first().map_or(Ok(()), |first| check_stroke(&at(*first)))?;
        let touches = match (self.tool, path.as_slice()) {
            (HandTool::Walk, path) => trail(path, radius_cells, cells(self.amount)),
            (_, [only]) => vec![at(*only)],
            (_, path) => walk(path, TOUCHES_APART * radius_cells).into_iter().map(|step| at(step.place)).collect(),
        };
        touches.iter().try_for_each(check_stroke)?;
        Ok(touches)
    }
}

/// All touches of strokes, in the order in which they are made.
///
/// # Errors
/// As [`HandStroke::touches`].
pub fn touches(strokes: &[HandStroke], cell_m: f64, size: [usize; 2]) -> Result<Vec<Touch>, DuneError> {
    let mut all = Vec::new();
    for (index, stroke) in strokes.iter().enumerate() {
        let touches = stroke.touches(cell_m, size)?;
        all.extend(touches.into_iter().map(|touch| Touch { step: stroke.step, stroke: index, brush: touch }));
    }
    all.sort_by_key(|touch| touch.step);
    Ok(all)
}

/// Reads strokes.
///
/// # Errors
/// [`DuneError::Text`] with the first entry that cannot be read.
pub fn parse_strokes(text: &str) -> Result<Vec<HandStroke>, DuneError> {
    entries(text)
        .map(|(index, entry)| parse_stroke(entry).map_err(|problem| wrong("stroke", index, &problem)))
        .collect()
}

fn parse_stroke(entry: &str) -> Result<HandStroke, String> {
    let words: Vec<_> = entry.split_whitespace().collect();
    let [step, tool, radius, amount, path @ ..] = words.as_slice() else {
        return Err(format!("`{entry}` has not step, tool, radius, amount and a path"));
    };
    let step = step.parse().map_err(|_no_number| format!("`{step}` is no number of steps from 0 to {}", u32::MAX))?;
    let named = HandTool::ALL.into_iter().find(|known| known.name() == *tool);
    let tool = named.ok_or_else(|| format!("`{tool}` is no tool; add, dig, flatten and walk are"))?;
    let path = path.iter().map(|word| number(word, [-1e6, 1e6], " m")).collect::<Result<Vec<_>, _>>()?;
    let (points, rest) = path.as_chunks::<2>();
    if points.is_empty() || !rest.is_empty() {
        return Err(format!("its path has {} numbers; two for each point are needed", path.len()));
    }
    let amounts = if tool == HandTool::Flatten { ([0.0, 1.0], "") } else { ([0.0, 1e4], " m") };
    let (radius_m, amount) = (number(radius, [0.001, 1e5], " m")?, number(amount, amounts.0, amounts.1)?);
    Ok(HandStroke { step, tool, radius_m, amount, path_m: points.to_vec() })
}

/// The text that [`parse_strokes`] reads; places to the decimetre, smaller ones for small brushes.
#[must_use]
pub fn strokes_to_text(strokes: &[HandStroke]) -> String {
    let mut text = String::new();
    for (index, stroke) in strokes.iter().enumerate() {
        let HandStroke { step, tool, radius_m, amount, path_m } = stroke;
        text.push_str(if index == 0 { "" } else { "; " });
        let fine = if *radius_m < 1.0 { 100.0 } else { 10.0 };
        // Writing to a String cannot fail; adding zero turns -0 into 0.
        let _ = write!(text, "{step} {} {radius_m} {amount}", tool.name());
        for place in path_m.as_flattened() {
            let _ = write!(text, " {}", (place * fine).round() / fine + 0.0);
        }
    }
    text
}

/// Reads winds.
///
/// # Errors
/// [`DuneError::Text`] with the first entry that cannot be read, or when there are too many.
pub fn parse_winds(text: &str) -> Result<Vec<Wind>, DuneError> {
    let wind = |(index, entry): (usize, &str)| {
        let words: Vec<_> = entry.split_whitespace().collect();
        let read = match words.as_slice() {
            [toward, share] => number(toward, [-360.0, 360.0], " deg")
                .and_then(|toward_deg| Ok(Wind { toward_deg, share: number(share, [0.0, 1000.0], "")? })),
            _ => Err(format!("`{entry}` has not two numbers, where it blows to and its share")),
        };
        read.map_err(|problem| wrong("wind", index, &problem))
    };
    let winds = entries(text).map(wind).collect::<Result<Vec<_>, _>>()?;
    if winds.len() > MOST_WINDS {
        let problem = format!("there are {} winds; {MOST_WINDS} are allowed", winds.len());
        return Err(DuneError::Text { name: "desert.winds", problem });
    }
    Ok(winds)
}

/// The text that [`parse_winds`] reads, to the degree and a hundredth.
#[must_use]
pub fn winds_to_text(winds: &[Wind]) -> String {
    let one = |wind: &Wind| format!("{} {}", wind.toward_deg.round() + 0.0, (100.0 * wind.share).round() / 100.0 + 0.0);
    winds.iter().map(one).collect::<Vec<_>>().join("; ")
}

/// Entries between semicolons with their places; a last semicolon ends no entry.
fn entries(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let count = text.split(';').count();
    let all = text.split(';').map(str::trim).enumerate();
    all.filter(move |(index, entry)| !(entry.is_empty() && index + 1 == count))
}

fn number(word: &str, [low, high]: [f64; 2], unit: &str) -> Result<f64, String> {
    let value = word.parse::<f64>().ok().filter(|value| (low..=high).contains(value));
    value.ok_or_else(|| format!("`{word}` is no number from {low} to {high}{unit}"))
}

fn wrong(what: &str, index: usize, problem: &str) -> DuneError {
    let name = if what == "wind" { "desert.winds" } else { "desert.strokes" };
    DuneError::Text { name, problem: format!("{what} {}: {problem}", index + 1) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strokes_and_winds_are_written_and_read() {
        let dig = HandStroke {
            step: 700,
            tool: HandTool::Dig,
            radius_m: 6.0,
            amount: 0.4,
            path_m: vec![[10.0, -20.5], [14.0, -22.0]],
        };
        let walk = HandStroke { tool: HandTool::Walk, radius_m: 0.1, path_m: vec![[0.25, -0.0]], ..dig.clone() };
        let text = strokes_to_text(&[dig.clone(), walk.clone()]);
        assert_eq!(text, "700 dig 6 0.4 10 -20.5 14 -22; 700 walk 0.1 0.4 0.25 0", "as people would write it");
        assert_eq!(parse_strokes(&text), Ok(vec![dig, walk]), "read");
        let winds = [Wind { toward_deg: 0.0, share: 1.0 }, Wind { toward_deg: -120.0, share: 0.25 }];
        assert_eq!(winds_to_text(&winds), "0 1; -120 0.25", "winds");
        assert_eq!(parse_winds("0 1; -120 0.25;"), Ok(winds.to_vec()), "read");
        assert_eq!((parse_winds(""), parse_strokes("")), (Ok(Vec::new()), Ok(Vec::new())), "nothing is nothing");
    }

    #[test]
    fn what_cannot_be_read_is_named() {
        for (text, reason) in [
            ("1 add 2 3 4 5; 1 pour 2 3 4 5", "stroke 2: `pour` is no tool"),
            ("1 add 2 3 4", "stroke 1: its path has 1 numbers"),
            ("-1 add 2 3 4 5", "`-1` is no number of steps"),
            ("1 flatten 2 3 4 5", "`3` is no number from 0 to 1"),
            ("1 add 0 3 4 5", "`0` is no number from 0.001 to 100000 m"),
            ("1 add", "has not step, tool"),
        ] {
            let message = parse_strokes(text).unwrap_err().to_string();
            assert!(message.starts_with("desert.strokes: ") && message.contains(reason), "{message}");
        }
        let message = parse_winds("0 1; west 2").unwrap_err().to_string();
        assert_eq!(message, "desert.winds: wind 2: `west` is no number from -360 to 360 deg", "a word");
        assert!(parse_winds(&"0 1;".repeat(65)).unwrap_err().to_string().contains("65 winds"), "too many");
    }

    #[test]
    fn a_longer_path_adds_touches_at_the_end() {
        for tool in HandTool::ALL {
            let stroke = |points: usize| HandStroke {
                step: 0,
                tool,
                radius_m: 1.0,
                amount: 0.2,
                path_m: [[0.0, 0.0], [30.0, 4.0], [41.0, 20.0]][..points].to_vec(),
            };
            let [short, long] = [2, 3].map(|points| stroke(points).touches(1.0, [64, 64]).unwrap());
            assert!(long.len() > short.len() && long.starts_with(&short), "{tool:?}");
        }
    }
}

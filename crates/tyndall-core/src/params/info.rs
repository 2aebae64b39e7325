//! What is known about a parameter besides its value.

use std::ops::RangeInclusive;

use super::{ParamError, types::choice_index};

/// Words of parameter names that people write in capitals.
const ACRONYMS: [&str; 2] = ["utc", "ev100"];

/// How a slider maps its travel to the value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Equal travel, equal difference.
    Linear,
    /// Equal travel, equal ratio; a range that starts at 0 needs a smallest positive value in the slider.
    Log,
}

/// What values a parameter takes. Every value travels as `f64`: integers exactly, toggles as 0 and 1, choices as the
/// index of their name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParamKind {
    /// A real number.
    Real,
    /// A whole number.
    Integer,
    /// On or off.
    Toggle,
    /// One of the names.
    Choice(&'static [&'static str]),
}

/// Static description of one parameter.
#[derive(Clone, Debug)]
pub struct ParamInfo {
    /// Key in scene files and on the command line; dimensioned values end in their unit (`altitude_m`).
    pub name: &'static str,
    /// Unit symbol; "1" when dimensionless.
    pub unit: &'static str,
    /// Real number, whole number, toggle or choice.
    pub kind: ParamKind,
    /// Allowed values; refuses NaN, because NaN lies in no range.
    pub range: RangeInclusive<f64>,
    /// Value of a new scene.
    pub default: f64,
    /// Mapping of the slider.
    pub scale: Scale,
    /// What the parameter does; tooltip and help text.
    pub doc: &'static str,
    /// Paper, section or equation that the parameter comes from.
    pub source: &'static str,
}

impl ParamInfo {
    /// The name for people: `elevation_deg` becomes "Elevation".
    #[must_use]
    pub fn label(&self) -> String {
        let suffix = format!("_{}", self.unit.replace('/', "_").to_lowercase());
        label_of(self.name.strip_suffix(suffix.as_str()).unwrap_or(self.name))
    }

    /// Checks kind and range.
    ///
    /// # Errors
    /// When the value is not finite, outside the range, or not whole where it must be.
    pub fn check(&self, value: f64) -> Result<f64, ParamError> {
        if !value.is_finite() || !self.range.contains(&value) {
            return Err(ParamError::OutOfRange {
                name: self.name,
                value,
                low: *self.range.start(),
                high: *self.range.end(),
                unit: self.unit_suffix(),
            });
        }
        if self.kind != ParamKind::Real && value.fract() != 0.0 {
            return Err(ParamError::NotWhole { name: self.name, value });
        }
        Ok(value)
    }

    /// Reads a value as users write it: a number, `true`, `false`, or a choice's name.
    ///
    /// # Errors
    /// When the text is not a value of this parameter's kind, or the value is not allowed.
    pub fn parse(&self, text: &str) -> Result<f64, ParamError> {
        let text = text.trim();
        let wrong = || ParamError::WrongKind { name: self.name, text: text.to_owned(), expected: self.expected() };
        match self.kind {
            ParamKind::Real | ParamKind::Integer => self.check(text.parse().map_err(|_not_a_number| wrong())?),
            ParamKind::Toggle => match text {
                "true" | "on" => Ok(1.0),
                "false" | "off" => Ok(0.0),
                _ => Err(wrong()),
            },
            ParamKind::Choice(names) => {
                names.iter().position(|name| *name == text).map(|index| index as f64).ok_or_else(wrong)
            }
        }
    }

    /// Writes a value as [`ParamInfo::parse`] reads it.
    #[must_use]
    pub fn format(&self, value: f64) -> String {
        match self.kind {
            ParamKind::Real => {
                let text = value.to_string();
                if text.contains('.') { text } else { text + ".0" }
            }
            ParamKind::Integer => format!("{value:.0}"),
            ParamKind::Toggle => (value != 0.0).to_string(),
            ParamKind::Choice(names) => names.get(choice_index(value)).copied().unwrap_or_default().to_owned(),
        }
    }

    /// What the parameter takes, for messages: `a number from -90 to 90 deg`, `one of "agx", "aces", "none"`.
    #[must_use]
    pub fn expected(&self) -> String {
        let (low, high) = (self.range.start(), self.range.end());
        match self.kind {
            ParamKind::Real => format!("a number from {low} to {high}{}", self.unit_suffix()),
            ParamKind::Integer => format!("a whole number from {low} to {high}{}", self.unit_suffix()),
            ParamKind::Toggle => "true or false".to_owned(),
            ParamKind::Choice(names) => {
                let quoted: Vec<_> = names.iter().map(|name| format!("{name:?}")).collect();
                format!("one of {}", quoted.join(", "))
            }
        }
    }

    /// The unit with a space before it, or nothing for a dimensionless parameter.
    #[must_use]
    pub fn unit_suffix(&self) -> String {
        if self.unit == "1" { String::new() } else { format!(" {}", self.unit) }
    }
}

/// A parameter's name for people: words in place of underscores, the first with a capital.
pub(super) fn label_of(name: &str) -> String {
    let shown = |word: &str| if ACRONYMS.contains(&word) { word.to_uppercase() } else { word.to_owned() };
    let words = name.split('_').map(shown).collect::<Vec<_>>().join(" ");
    let mut letters = words.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

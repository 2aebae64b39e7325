//! A place in a text file, shown as `file:line:column` and as an excerpt with a caret.

use std::{fmt, ops::Range};

/// Characters of a line that an excerpt shows at most, so that a line of a megabyte stays readable.
const SHOWN: usize = 100;

/// Characters shown before the place when the beginning of the line is left out.
const BEFORE: usize = 40;

/// Where in a file something is wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The file's name as the user gave it.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1, in characters.
    pub column: usize,
    /// What the excerpt shows of the line.
    shown: String,
    /// Characters of `shown` before the place, and those of the place itself.
    indent: usize,
    width: usize,
}

impl Place {
    /// The place of a range of bytes in a text.
    pub(crate) fn new(file: &str, text: &str, span: Range<usize>) -> Self {
        let start = text.floor_char_boundary(span.start.min(text.len()));
        let line_start = text[..start].rfind('\n').map_or(0, |at| at + 1);
        let line_end = text[start..].find('\n').map_or(text.len(), |at| start + at);
        let end = text.floor_char_boundary(span.end.clamp(start, line_end));
        let column = text[line_start..start].chars().count();
        let line_text = text[line_start..line_end].trim_end();
        let left_out = if line_text.chars().count() > SHOWN { column.saturating_sub(BEFORE) } else { 0 };
        let indent = column - left_out;
        Self {
            file: file.to_owned(),
            line: text[..start].matches('\n').count() + 1,
            column: column + 1,
            shown: line_text.chars().skip(left_out).take(SHOWN).map(printable).collect(),
            indent,
            width: text[start..end].chars().count().clamp(1, SHOWN - indent.min(SHOWN - 1)),
        }
    }

    /// The line with a caret under the place, below an arrow with the position.
    #[must_use]
    pub fn excerpt(&self) -> String {
        let Self { line, shown, indent, width, .. } = self;
        let margin = " ".repeat(line.to_string().len());
        let caret = " ".repeat(*indent) + &"^".repeat(*width);
        format!("{margin}--> {self}\n{margin} |\n{line} | {shown}\n{margin} | {caret}\n")
    }
}

impl fmt::Display for Place {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}:{}:{}", self.file, self.line, self.column)
    }
}

/// A tab becomes a space, so that the caret stays below its place; other control characters could steer the terminal.
fn printable(letter: char) -> char {
    match letter {
        '\t' => ' ',
        control if control.is_control() => char::REPLACEMENT_CHARACTER,
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_and_columns_count_characters_from_one() {
        for (text, needle, line, column) in
            [("a = 1", "a", 1, 1), ("a = 1\nb = 2", "2", 2, 5), ("# \u{00e4}\u{4e2d}\u{1f305} x", "x", 1, 7)]
        {
            let start = text.find(needle).unwrap();
            let place = Place::new("f.toml", text, start..start + 1);
            assert_eq!((place.line, place.column), (line, column), "{text:?}");
        }
    }

    #[test]
    fn the_end_of_the_text_is_a_place_too() {
        let place = Place::new("f.toml", "a = 1\n", 6..6);
        assert_eq!(place.to_string(), "f.toml:2:1", "after the last line break");
        assert_eq!(Place::new("f.toml", "", 0..0).excerpt(), " --> f.toml:1:1\n  |\n1 | \n  | ^\n", "an empty file");
    }

    #[test]
    fn the_caret_stands_below_its_place_after_a_tab() {
        let excerpt = Place::new("f.toml", "[sun]\n\tdisc = 3 # no\r\n", 14..15).excerpt();
        assert_eq!(excerpt, " --> f.toml:2:9\n  |\n2 |  disc = 3 # no\n  |         ^\n", "{excerpt}");
    }

    #[test]
    fn a_long_line_is_cut_to_the_neighbourhood_of_the_place() {
        let text = format!("{}X{}", "a".repeat(5000), "b".repeat(5000));
        let excerpt = Place::new("f.toml", &text, 5000..5001).excerpt();
        assert!(excerpt.lines().all(|line| line.chars().count() <= SHOWN + 10), "{excerpt}");
        let lines: Vec<_> = excerpt.lines().collect();
        assert_eq!(lines[2].find('X'), lines[3].find('^'), "{excerpt}");
    }

    #[test]
    fn control_characters_do_not_reach_the_terminal() {
        let excerpt = Place::new("f.toml", "a = \u{1b}[31m", 4..5).excerpt();
        assert!(!excerpt.contains('\u{1b}'), "{excerpt:?}");
    }
}

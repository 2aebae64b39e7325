//! Errors of TOML itself.

use std::ops::Range;

use toml_edit::TomlError;

use crate::{Place, Scene, SceneError, brief::brief};

/// The error of the TOML reader with its place and, as the reader does not know one, a field from the text around it.
pub(super) fn error(name: &str, text: &str, error: &TomlError) -> SceneError {
    let span = error.span().unwrap_or_else(|| line_with_most_dots(text));
    let near = Near::new(text, span.start);
    let field = near.field();
    let info = field.as_deref().filter(|_| near.after_equals).and_then(|path| Scene::default().info(path).ok());
    let expected = info.map(tyndall_core::ParamInfo::expected);
    let message = message(error.message(), &text[span.clone()]);
    SceneError::Syntax { message, field, expected }.at(Place::new(name, text, span))
}

/// The reader's words, except where they mislead: it takes everything that is no value for a string without quotes.
fn message(words: &str, found: &str) -> String {
    match (words.starts_with("string values must be quoted"), found.trim()) {
        (true, "") => "the value is missing".to_owned(),
        (true, found) => format!("`{}` is not a value; strings need quotes", brief(found)),
        (false, _) => words.to_owned(),
    }
}

/// The one error without a place is that of dotted keys nested too deeply.
fn line_with_most_dots(text: &str) -> Range<usize> {
    let line = text.lines().max_by_key(|line| line.matches('.').count()).unwrap_or_default();
    let start = line.as_ptr() as usize - text.as_ptr() as usize;
    start..start
}

/// The text around an error. Meant for people: in a file that is not TOML nothing is certain.
struct Near<'a> {
    /// Name of the table that the line belongs to.
    table: Option<&'a str>,
    /// Key on the line.
    key: Option<&'a str>,
    /// Whether the place is in the value.
    after_equals: bool,
}

impl<'a> Near<'a> {
    fn new(text: &'a str, offset: usize) -> Self {
        let line_start = text[..offset].rfind('\n').map_or(0, |at| at + 1);
        let line_end = text[offset..].find('\n').map_or(text.len(), |at| offset + at);
        let line = &text[line_start..line_end];
        let table = if line.trim_start().starts_with('[') {
            header(line)
        } else {
            text[..line_start].lines().rev().find_map(header)
        };
        let key = line.split_whitespace().next().and_then(|word| word.split('=').next()).filter(|key| is_path(key));
        Self { table, key, after_equals: text[line_start..offset].contains('=') }
    }

    /// Path of the key, or else of the table.
    fn field(&self) -> Option<String> {
        match (self.table, self.key) {
            (Some(table), Some(key)) => Some(brief(&format!("{table}.{key}"))),
            (table, key) => table.or(key).map(brief),
        }
    }
}

/// Name in a table header, with or without its closing bracket.
fn header(line: &str) -> Option<&str> {
    let name = line.trim().strip_prefix('[')?.trim_start_matches('[').split([']', '#']).next()?.trim();
    is_path(name).then_some(name)
}

fn is_path(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"_-.".contains(&byte))
}

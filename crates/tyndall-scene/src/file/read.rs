//! From the TOML document to the scene, with the place of everything that is wrong.

use std::ops::Range;

use toml_edit::{Document, Item, TableLike, Value};
use tyndall_core::{ParamError, ParamInfo, ParamKind, ParamSet, TextInfo};

use super::FORMAT;
use crate::{Scene, SceneError, brief::brief};

/// Key of the format's number.
pub(super) const FORMAT_KEY: &str = "format";
/// Key of the scene's title.
pub(super) const TITLE_KEY: &str = "title";
/// Key of the scene's description.
pub(super) const DESCRIPTION_KEY: &str = "description";

/// What is wrong, and the bytes that it concerns.
type Problem = (SceneError, Range<usize>);

/// Reads the whole document; `format` before all else, as it decides what the rest means.
pub(super) fn scene(document: &Document<&str>) -> Result<Scene, Problem> {
    check_format(document)?;
    let mut scene = Scene::default();
    for (key, item) in document.iter() {
        match key {
            FORMAT_KEY => {}
            TITLE_KEY => scene.title = string(document, key, item)?,
            DESCRIPTION_KEY => scene.description = string(document, key, item)?,
            group => read_group(document, &mut scene, group, item)?,
        }
    }
    scene.check().map_err(|error| {
        let span = error.fields().iter().find_map(|path| span_of_path(document, path)).unwrap_or(0..0);
        (error, span)
    })?;
    Ok(scene)
}

/// Value of a parameter as written, when type and range are right.
pub(super) fn value_of(info: &ParamInfo, value: &Value) -> Option<Result<f64, ParamError>> {
    match (info.kind, value) {
        (ParamKind::Real, Value::Float(number)) => Some(info.check(*number.value())),
        (ParamKind::Real | ParamKind::Integer, Value::Integer(number)) => Some(info.check(*number.value() as f64)),
        (ParamKind::Toggle, Value::Boolean(on)) => Some(info.check(f64::from(u8::from(*on.value())))),
        (ParamKind::Choice(_), Value::String(name)) => Some(info.parse(name.value())),
        _ => None,
    }
}

/// A string with the line breaks of Unix, which TOML leaves to the platform.
pub(super) fn text_of(item: &Item) -> Option<String> {
    item.as_str().map(|text| text.replace("\r\n", "\n"))
}

fn check_format(document: &Document<&str>) -> Result<(), Problem> {
    let Some(item) = document.get(FORMAT_KEY) else {
        return Err((SceneError::FormatMissing, 0..0));
    };
    let Some(found) = item.as_integer() else {
        return Err(wrong_type(document, FORMAT_KEY.to_owned(), item, format!("the whole number {FORMAT}")));
    };
    if found == FORMAT { Ok(()) } else { Err((SceneError::FormatUnknown { found }, span(document, FORMAT_KEY, item))) }
}

fn string(document: &Document<&str>, key: &str, item: &Item) -> Result<String, Problem> {
    text_of(item).ok_or_else(|| wrong_type(document, key.to_owned(), item, "a string".to_owned()))
}

fn read_group(document: &Document<&str>, scene: &mut Scene, group: &str, item: &Item) -> Result<(), Problem> {
    let Some(position) = scene.groups().iter().position(|(known, _)| *known == group) else {
        return Err((scene.unknown_group(group), key_span(document.as_table(), group)));
    };
    let Some(table) = item.as_table_like() else {
        return Err(wrong_type(document, group.to_owned(), item, "a table of parameters".to_owned()));
    };
    for (name, item) in table.iter() {
        if let Some(index) = scene.groups()[position].1.text_position(name) {
            let (group, set) = &mut scene.groups_mut()[position];
            let text = text_parameter(document, group, *set, index, item)?;
            set.put_text_unchecked(index, &text);
            continue;
        }
        let Ok(index) = scene.groups()[position].1.position(name) else {
            return Err((scene.unknown_parameter(group, name), key_span(table, name)));
        };
        let (group, set) = &mut scene.groups_mut()[position];
        let value = parameter(document, group, *set, index, item)?;
        set.set_unchecked(index, value);
    }
    Ok(())
}

fn parameter(
    document: &Document<&str>,
    group: &'static str,
    set: &dyn ParamSet,
    index: usize,
    item: &Item,
) -> Result<f64, Problem> {
    let info = &set.info()[index];
    let Some(value) = item.as_value().and_then(|value| value_of(info, value)) else {
        return Err(wrong_type(document, format!("{group}.{}", info.name), item, info.expected()));
    };
    value.map_err(|source| (SceneError::Value { group, source }, span(document, info.name, item)))
}

fn text_parameter(
    document: &Document<&str>,
    group: &'static str,
    set: &dyn ParamSet,
    index: usize,
    item: &Item,
) -> Result<String, Problem> {
    let info = &set.text_info()[index];
    let Some(text) = text_of(item) else {
        return Err(wrong_type(document, format!("{group}.{}", info.name), item, TextInfo::EXPECTED.to_owned()));
    };
    let checked = info.check(&text).map(str::to_owned);
    checked.map_err(|source| (SceneError::Value { group, source }, span(document, info.name, item)))
}

fn wrong_type(document: &Document<&str>, path: String, item: &Item, expected: String) -> Problem {
    let span = span(document, &path, item);
    let text = if item.is_value() { brief(&document.raw()[span.clone()]) } else { String::new() };
    let found = match item.type_name() {
        name @ ("integer" | "array" | "array of tables" | "inline table") => format!("an {name}"),
        "datetime" => "a date or time".to_owned(),
        name => format!("a {name}"),
    };
    (SceneError::WrongType { path, text, found, expected }, span)
}

/// Bytes of a value or, for tables made of dotted keys, of the key that names them.
fn span(document: &Document<&str>, path: &str, item: &Item) -> Range<usize> {
    item.span().or_else(|| span_of_path(document, path)).unwrap_or(0..0)
}

fn key_span(table: &dyn TableLike, name: &str) -> Range<usize> {
    table.key(name).and_then(toml_edit::Key::span).unwrap_or(0..0)
}

/// Bytes of the value at a path like `sun.day`, when the document has it.
fn span_of_path(document: &Document<&str>, path: &str) -> Option<Range<usize>> {
    let (group, name) = path.split_once('.').unwrap_or((path, ""));
    let table = document.get(group)?;
    if name.is_empty() {
        return document.key(group)?.span();
    }
    let table = table.as_table_like()?;
    table.get(name)?.span().or_else(|| table.key(name)?.span())
}

//! From the scene back to the document, changing as little as possible.

use toml_edit::{DocumentMut, Item, Table, TableLike, Value};
use tyndall_core::{ParamInfo, ParamKind, TextInfo};

use super::read::{DESCRIPTION_KEY, TITLE_KEY, text_of, value_of};
use crate::Scene;

/// Writes into the document what differs from the scene.
pub(super) fn update(document: &mut DocumentMut, scene: &Scene) {
    for (key, text) in [(TITLE_KEY, &scene.title), (DESCRIPTION_KEY, &scene.description)] {
        if document.get(key).and_then(text_of).unwrap_or_default() != *text {
            put(document.as_table_mut(), key, Value::from(text));
        }
    }
    for (group, set) in scene.groups() {
        let written = document.get(group).and_then(Item::as_table_like);
        let now = set.info().iter().enumerate().map(|(index, info)| (info, set.get(index)));
        let changed: Vec<_> =
            now.filter(|(info, value)| written_value(written, info).total_cmp(value).is_ne()).collect();
        let texts = set.text_info().iter().enumerate().map(|(index, info)| (info, set.text(index)));
        let changed_texts: Vec<_> = texts.filter(|(info, text)| written_text(written, info) != *text).collect();
        if changed.is_empty() && changed_texts.is_empty() {
            continue;
        }
        if document.get(group).is_none() {
            let table = new_table(document);
            document.insert(group, Item::Table(table));
        }
        let table = document.get_mut(group).and_then(Item::as_table_like_mut);
        let table = table.expect("reading has refused a document in which a group is not a table");
        for (info, value) in changed {
            put(table, info.name, to_toml(info, value));
        }
        for (info, text) in changed_texts {
            put(table, info.name, Value::from(text));
        }
    }
}

/// A table below all that the document has, its last comments included.
fn new_table(document: &mut DocumentMut) -> Table {
    let last_comments = document.trailing().as_str().unwrap_or_default().to_owned();
    document.set_trailing("");
    let line_break = if last_comments.is_empty() || last_comments.ends_with('\n') { "" } else { "\n" };
    let mut table = Table::new();
    table.decor_mut().set_prefix(format!("{last_comments}{line_break}\n"));
    table
}

/// Value that a reader of the document takes: the one written, or the default.
fn written_value(table: Option<&dyn TableLike>, info: &ParamInfo) -> f64 {
    let value = table.and_then(|table| table.get(info.name)).and_then(Item::as_value);
    value.and_then(|value| value_of(info, value)).and_then(Result::ok).unwrap_or(info.default)
}

/// Text that a reader of the document takes: the one written, or the default.
fn written_text(table: Option<&dyn TableLike>, info: &TextInfo) -> String {
    table.and_then(|table| table.get(info.name)).and_then(text_of).unwrap_or_else(|| info.default.to_owned())
}

/// Sets a key; a value that was there hands its comment and its spacing on.
fn put(table: &mut dyn TableLike, key: &str, mut value: Value) {
    match table.get_mut(key).and_then(Item::as_value_mut) {
        Some(old) => {
            *value.decor_mut() = old.decor().clone();
            *old = value;
        }
        None => {
            table.insert(key, Item::Value(value));
        }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "whole parameters are far below 2^53")]
fn to_toml(info: &ParamInfo, value: f64) -> Value {
    match info.kind {
        ParamKind::Real => Value::from(value),
        ParamKind::Integer => Value::from(value as i64),
        ParamKind::Toggle => Value::from(value != 0.0),
        ParamKind::Choice(_) => Value::from(info.format(value)),
    }
}

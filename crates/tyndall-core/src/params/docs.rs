//! Parameter tables for documentation and the JSON schema for editors, both made from [`ParamInfo`].

use std::fmt::Write as _;

use serde_json::{Map, Value, json};

use super::{MAX_TEXT_BYTES, ParamInfo, ParamKind, ParamSet};

/// A Markdown table of the named groups, one row per parameter. The same text in the README, in `tyndall params` and in
/// a test that compares the two.
#[must_use]
pub fn markdown_table(groups: &[(&str, &dyn ParamSet)]) -> String {
    let mut table = "| parameter | default | allowed | what it does | source |\n|---|---|---|---|---|\n".to_owned();
    for (group, set) in groups {
        for info in set.info() {
            let default = info.format(info.default);
            let unit = info.unit_suffix();
            // Writing to a String cannot fail.
            let _ = writeln!(
                table,
                "| `{group}.{}` | {default}{unit} | {} | {} | {} |",
                info.name,
                allowed(info),
                info.doc,
                info.source
            );
        }
        for info in set.text_info() {
            let _ = writeln!(
                table,
                "| `{group}.{}` | {:?} | text | {} | {} |",
                info.name, info.default, info.doc, info.source
            );
        }
    }
    table
}

fn allowed(info: &ParamInfo) -> String {
    match info.kind {
        ParamKind::Toggle => "true, false".to_owned(),
        ParamKind::Choice(names) => names.join(", "),
        ParamKind::Real | ParamKind::Integer => format!("{} to {}", info.range.start(), info.range.end()),
    }
}

/// JSON schema (draft 2020-12) of one group: an object without unknown keys.
#[must_use]
pub fn json_schema(set: &dyn ParamSet) -> Value {
    let texts = set.text_info().iter().map(|info| {
        let description = format!("{} Source: {}.", info.doc, info.source);
        let schema = json!({
            "type": "string", "maxLength": MAX_TEXT_BYTES, "default": info.default, "description": description,
        });
        (info.name.to_owned(), schema)
    });
    let numbers = set.info().iter().map(|info| (info.name.to_owned(), json_schema_of(info)));
    let properties: Map<String, Value> = numbers.chain(texts).collect();
    json!({ "type": "object", "additionalProperties": false, "properties": properties })
}

fn json_schema_of(info: &ParamInfo) -> Value {
    let description = format!("{} Unit: {}. Source: {}.", info.doc, info.unit, info.source);
    let (low, high) = (*info.range.start(), *info.range.end());
    match info.kind {
        ParamKind::Real => json!({
            "type": "number", "minimum": low, "maximum": high, "default": info.default, "description": description,
        }),
        ParamKind::Integer => json!({
            "type": "integer", "minimum": low, "maximum": high, "default": info.default, "description": description,
        }),
        ParamKind::Toggle => json!({ "type": "boolean", "default": info.default != 0.0, "description": description }),
        ParamKind::Choice(names) => json!({
            "enum": names, "default": info.format(info.default), "description": description,
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    crate::params! {
        /// Example.
        struct Example {
            /// Height of the thing.
            height_m: f64 = 2.0, ["m", 0.5..=8.0, Linear], "Example, eq. 1";
            /// Shown or not.
            shown: bool = false, "Example, eq. 2";
        }
        text {
            /// What it is called.
            nickname = "it", "Example";
        }
    }

    #[test]
    fn the_markdown_table_has_a_row_per_parameter() {
        let table = markdown_table(&[("thing", &Example::default())]);
        let rows: Vec<_> = table.lines().skip(2).collect();
        assert_eq!(rows[0], "| `thing.height_m` | 2.0 m | 0.5 to 8 | Height of the thing. | Example, eq. 1 |");
        assert_eq!(rows[1], "| `thing.shown` | false | true, false | Shown or not. | Example, eq. 2 |");
        assert_eq!(rows[2], "| `thing.nickname` | \"it\" | text | What it is called. | Example |");
    }

    #[test]
    fn the_schema_carries_range_and_default() {
        let schema = json_schema(&Example::default());
        assert_eq!(schema["properties"]["height_m"]["maximum"], 8.0, "{schema}");
        assert_eq!(schema["properties"]["shown"]["type"], "boolean", "{schema}");
        assert_eq!(schema["properties"]["nickname"]["type"], "string", "{schema}");
        assert_eq!(schema["additionalProperties"], false, "{schema}");
    }
}

//! The scene format for editors and for readers, made from the parameters' declarations.

use serde_json::{Map, Value, json};
use tyndall_core::params::docs;

use crate::{FORMAT, Scene};

/// JSON schema (draft 2020-12) of scene files: completion, tooltips and checks in every editor that knows TOML schemas.
#[must_use]
pub fn schema() -> Value {
    let scene = Scene::default();
    let mut properties = Map::from_iter([
        ("format".to_owned(), json!({ "const": FORMAT, "description": "Format of the scene file." })),
        ("title".to_owned(), json!({ "type": "string", "description": "Title for people." })),
        ("description".to_owned(), json!({ "type": "string", "description": "What the scene shows." })),
    ]);
    properties.extend(scene.groups().map(|(group, set)| (group.to_owned(), docs::json_schema(set))));
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Tyndall scene",
        "type": "object",
        "required": ["format"],
        "additionalProperties": false,
        "properties": properties,
    })
}

/// Markdown table of all parameters.
#[must_use]
pub fn markdown_table() -> String {
    docs::markdown_table(&Scene::default().groups())
}

#[cfg(test)]
mod tests {
    use toml_edit::{DocumentMut, Item};

    use super::*;

    fn assert_known(schema: &Value, table: &dyn toml_edit::TableLike, path: &str) {
        for (key, item) in table.iter() {
            let known = &schema["properties"][key];
            assert!(known.is_object(), "{path}{key} is not in the schema");
            if let Some(group) = Item::as_table_like(item) {
                assert_known(known, group, &format!("{path}{key}."));
            }
        }
    }

    #[test]
    fn the_schema_knows_every_key_of_every_preset() {
        for preset in crate::presets() {
            let document: DocumentMut = preset.text.parse().unwrap();
            assert_known(&schema(), document.as_table(), &format!("{}: ", preset.name));
        }
    }

    #[test]
    fn the_schema_has_the_groups_and_refuses_other_keys() {
        let schema = schema();
        for (group, set) in Scene::default().groups() {
            let properties = schema["properties"][group]["properties"].as_object();
            assert_eq!(properties.map(Map::len), Some(set.info().len() + set.text_info().len()), "{group}");
        }
        assert_eq!(schema["additionalProperties"], false, "{schema}");
        assert_eq!(schema["properties"]["format"]["const"], FORMAT, "{schema}");
    }

    #[test]
    fn the_table_has_a_row_per_parameter_of_every_group() {
        let table = markdown_table();
        for (group, set) in Scene::default().groups() {
            for info in set.info() {
                let path = format!("| `{group}.{}` |", info.name);
                assert_eq!(table.matches(&path).count(), 1, "{path}");
            }
        }
    }
}

//! `tyndall params`: every parameter of a scene, from its declaration.

use std::fmt::Write as _;

use serde_json::{Value, json};
use tyndall_core::{ParamInfo, ParamKind, Scale, TextInfo};
use tyndall_scene::{Scene, markdown_table};

use crate::{Failure, output};

/// What `tyndall params` takes.
#[derive(Clone, Debug, clap::Args)]
pub struct ParamsArguments {
    /// Only parameters whose path contains this text, such as `sun` or `ozone`
    #[arg(conflicts_with = "markdown")]
    pub filter: Option<String>,
    /// As a Markdown table, the one in the documentation
    #[arg(long, conflicts_with = "json")]
    pub markdown: bool,
    /// As a JSON array, for programs
    #[arg(long)]
    pub json: bool,
}

/// Prints the parameters.
///
/// # Errors
/// When the filter leaves nothing.
pub fn run(arguments: &ParamsArguments) -> Result<(), Failure> {
    if arguments.markdown {
        return output::print(&markdown_table());
    }
    let filter = arguments.filter.as_deref().unwrap_or_default();
    let found = matching(filter);
    let texts = matching_texts(filter);
    if found.is_empty() && texts.is_empty() {
        let groups = Scene::default().groups().map(|(group, _)| group).join(", ");
        let sentence = format!("no parameter's path contains `{filter}`; the groups are {groups}");
        return Err(Failure::Usage(sentence));
    }
    let text = if arguments.json { format!("{:#}\n", as_json(&found, &texts)) } else { as_text(&found, &texts) };
    output::print(&text)
}

/// Group and declaration of the parameters whose path contains the text.
fn matching(filter: &str) -> Vec<(&'static str, &'static ParamInfo)> {
    let scene = Scene::default();
    let all = scene.groups().into_iter().flat_map(|(group, set)| set.info().iter().map(move |info| (group, info)));
    all.filter(|(group, info)| path(group, info).contains(filter)).collect()
}

/// Group and declaration of the texts whose path contains the text.
fn matching_texts(filter: &str) -> Vec<(&'static str, &'static TextInfo)> {
    let scene = Scene::default();
    let all = scene.groups().into_iter().flat_map(|(group, set)| set.text_info().iter().map(move |info| (group, info)));
    all.filter(|(group, info)| format!("{group}.{}", info.name).contains(filter)).collect()
}

fn path(group: &str, info: &ParamInfo) -> String {
    format!("{group}.{}", info.name)
}

/// Two lines a parameter: path, default and what it takes; what it does and where it comes from.
fn as_text(found: &[(&str, &ParamInfo)], texts: &[(&str, &TextInfo)]) -> String {
    let numbers = found.iter().fold(String::new(), |mut text, (group, info)| {
        let (path, default, unit) = (path(group, info), info.format(info.default), info.unit_suffix());
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{path} = {default}{unit}  ({})", info.expected());
        let _ = writeln!(text, "    {} [{}]", info.doc, info.source);
        text
    });
    texts.iter().fold(numbers, |mut text, (group, info)| {
        let _ = writeln!(text, "{group}.{} = {:?}  ({})", info.name, info.default, TextInfo::EXPECTED);
        let _ = writeln!(text, "    {} [{}]", info.doc, info.source);
        text
    })
}

fn as_json(found: &[(&str, &ParamInfo)], texts: &[(&str, &TextInfo)]) -> Value {
    let numbers = found.iter().map(|(group, info)| json_of(group, info));
    numbers.chain(texts.iter().map(|(group, info)| json_of_text(group, info))).collect()
}

fn json_of_text(group: &str, info: &TextInfo) -> Value {
    json!({
        "path": format!("{group}.{}", info.name),
        "label": info.label(),
        "kind": "text",
        "default": info.default,
        "doc": info.doc,
        "source": info.source,
    })
}

fn json_of(group: &str, info: &ParamInfo) -> Value {
    let (kind, choices) = match info.kind {
        ParamKind::Real => ("real", Value::Null),
        ParamKind::Integer => ("integer", Value::Null),
        ParamKind::Toggle => ("toggle", Value::Null),
        ParamKind::Choice(names) => ("choice", json!(names)),
    };
    let is_number = matches!(info.kind, ParamKind::Real | ParamKind::Integer);
    json!({
        "path": path(group, info),
        "label": info.label(),
        "kind": kind,
        "unit": info.unit,
        "default": info.format(info.default),
        "low": is_number.then_some(info.range.start()),
        "high": is_number.then_some(info.range.end()),
        "choices": choices,
        "scale": match info.scale { Scale::Linear => "linear", Scale::Log => "log" },
        "doc": info.doc,
        "source": info.source,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn count() -> usize {
        Scene::default().groups().iter().map(|(_, set)| set.info().len() + set.text_info().len()).sum()
    }

    #[test]
    fn the_list_and_the_json_have_every_parameter() {
        let (all, texts) = (matching(""), matching_texts(""));
        assert_eq!(all.len() + texts.len(), count(), "no filter, every parameter");
        assert_eq!(as_text(&all, &texts).lines().count(), 2 * count(), "two lines each");
        assert_eq!(as_json(&all, &texts).as_array().map(Vec::len), Some(count()), "one object each");
    }

    #[test]
    fn defaults_in_the_json_are_accepted_by_the_scene() {
        let mut scene = Scene::default();
        for parameter in as_json(&matching(""), &matching_texts("")).as_array().unwrap() {
            let (path, default) = (parameter["path"].as_str().unwrap(), parameter["default"].as_str().unwrap());
            scene.set_text(path, default).unwrap_or_else(|error| panic!("{path} = {default}: {error}"));
        }
        assert_eq!(scene, Scene::default(), "setting all defaults changes nothing");
    }

    #[test]
    fn a_filter_keeps_the_paths_that_contain_it() {
        let found = matching("sun.elevation");
        assert_eq!(found.len(), 1, "{found:?}");
        let text = as_text(&found, &[]);
        assert!(text.starts_with("sun.elevation_deg = 35.0 deg  (a number from -90 to 90 deg)\n"), "{text}");
    }

    #[test]
    fn a_filter_that_fits_nothing_is_refused_with_the_groups() {
        let arguments = ParamsArguments { filter: Some("volcano".to_owned()), markdown: false, json: false };
        let sentence = run(&arguments).expect_err("no volcano").to_string();
        assert!(sentence.contains("`volcano`") && sentence.contains("camera, sun"), "{sentence}");
    }
}

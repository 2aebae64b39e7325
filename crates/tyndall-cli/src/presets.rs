//! `tyndall presets`: the scenes that come with Tyndall.

use std::fmt::Write as _;

use tyndall_scene::{Preset, presets};

use crate::{Failure, output};

/// What `tyndall presets` takes.
#[derive(Clone, Debug, clap::Args)]
pub struct PresetsArguments {
    /// Print this preset as a scene file, to start a scene of one's own from
    pub name: Option<String>,
}

/// Prints the list, or one preset's file.
///
/// # Errors
/// When there is no such preset.
pub fn run(arguments: &PresetsArguments) -> Result<(), Failure> {
    match &arguments.name {
        Some(name) => output::print(find(name)?.text),
        None => output::print(&list(&presets())),
    }
}

/// The preset of this name.
///
/// # Errors
/// When there is none; the sentence lists those there are.
pub fn find(name: &str) -> Result<Preset, Failure> {
    let known = presets();
    let names: Vec<_> = known.iter().map(|preset| preset.name).collect();
    let names = names.join(", ");
    let found = known.into_iter().find(|preset| preset.name == name);
    found.ok_or_else(|| Failure::Usage(format!("there is no preset `{name}`; the presets are {names}")))
}

/// A line per preset: name and title.
fn list(presets: &[Preset]) -> String {
    let width = presets.iter().map(|preset| preset.name.len()).max().unwrap_or(0);
    presets.iter().fold(String::new(), |mut text, preset| {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{:width$}  {}", preset.name, preset.title);
        text
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unknown_preset_is_refused_with_the_names_of_all() {
        let sentence = find("midnight").expect_err("no such preset").to_string();
        assert!(sentence.contains("`midnight`") && sentence.contains("noon, low-sun"), "{sentence}");
    }

    #[test]
    fn the_list_has_a_line_per_preset_with_titles_in_one_column() {
        let text = list(&presets());
        assert_eq!(text.lines().count(), presets().len(), "{text}");
        let columns: Vec<_> =
            text.lines().zip(presets()).map(|(line, preset)| line.find(preset.title.as_str())).collect();
        assert!(columns[0].is_some_and(|column| column > "noon".len()), "{text}");
        assert!(columns.iter().all(|column| *column == columns[0]), "{text}");
    }
}

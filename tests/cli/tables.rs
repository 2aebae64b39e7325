//! What the program says about scenes and about the computer.

use serde_json::Value;
use tyndall_scene::{Scene, markdown_table, presets, schema};

use crate::program::Place;

fn stdout(words: &[&str]) -> String {
    Place::new().run(words).succeeded().stdout
}

fn json(words: &[&str]) -> Value {
    let text = stdout(words);
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error} in {text}"))
}

fn parameter_count() -> usize {
    Scene::default().groups().iter().map(|(_, set)| set.info().len() + set.text_info().len()).sum()
}

#[test]
fn the_parameters_are_listed_for_people_programs_and_documents() {
    assert_eq!(stdout(&["params"]).lines().count(), 2 * parameter_count(), "two lines a parameter");
    assert_eq!(json(&["params", "--json"]).as_array().map(Vec::len), Some(parameter_count()), "one object each");
    assert_eq!(stdout(&["params", "--markdown"]), markdown_table(), "the table of the documentation");
    Place::new().run(&["params", "volcano"]).refused(2, "no parameter's path contains `volcano`");
}

#[test]
fn the_schema_is_the_scene_crates_own() {
    assert_eq!(json(&["schema"]), schema(), "the schema on stdout");
}

#[test]
fn a_printed_preset_is_a_scene_file_of_the_same_picture() {
    let listed = stdout(&["presets"]);
    for preset in presets() {
        assert!(listed.contains(&preset.title), "{} is not in {listed}", preset.name);
        assert_eq!(stdout(&["presets", preset.name]), preset.text, "{}", preset.name);
    }
}

#[test]
fn the_doctor_finds_the_adapter_that_renders() {
    let report = json(&["doctor", "--json"]);
    let adapters = report["adapters"].as_array().expect("a list");
    assert!(!adapters.is_empty(), "{report}");
    assert!(adapters.iter().any(|adapter| adapter["name"] == report["device"]["name"]), "{report}");
    assert!(report["device"]["max_memory_bytes"].as_u64().is_some_and(|bytes| bytes > 0), "{report}");
    assert!(report["device"]["limits"]["maxTextureDimension2D"].as_u64() >= Some(8192), "{report}");
    let text = stdout(&["doctor"]);
    assert!(text.contains("0: ") && text.contains("memory budget"), "{text}");
}

#[test]
fn the_help_shows_examples_and_exit_codes() {
    for words in [&["--help"][..], &["render", "--help"]] {
        let help = stdout(words);
        for part in ["Examples:", "tyndall render", "Exit codes:", "130  Ctrl-C"] {
            assert!(help.contains(part), "{part:?} is not in {help}");
        }
    }
    assert_eq!(stdout(&["--version"]), format!("tyndall {}\n", env!("CARGO_PKG_VERSION")), "name and version");
}

#[test]
fn verbose_runs_say_on_stderr_what_happens() {
    let run = Place::new().run(&["render", "preset:noon", "-o", "a.png", "--size", "16x16", "-v"]).succeeded();
    assert!(run.stderr.contains("graphics device opened"), "{}", run.stderr);
}

/// `head` closes its end of the pipe early.
#[cfg(unix)]
#[test]
fn a_reader_that_stops_early_is_no_error() {
    let place = Place::new();
    let mut child = place.command(&["params"]).stdout(std::process::Stdio::piped()).spawn().expect("it starts");
    drop(child.stdout.take());
    assert!(child.wait().expect("it ends").success(), "a closed pipe ends the program quietly");
}

//! Progress for programs.

use serde_json::Value;

use crate::program::{Place, Run};

fn events(run: &Run) -> Vec<Value> {
    run.stdout.lines().map(|line| serde_json::from_str(line).unwrap_or_else(|_| panic!("{line}"))).collect()
}

#[test]
fn json_progress_rises_and_ends_with_the_facts_of_the_file() {
    let place = Place::new();
    let words = ["render", "preset:noon", "-o", "a.png", "--size", "96x64", "--progress", "json"];
    let events = events(&place.run(&words).succeeded());
    let (finished, progress) = events.split_last().expect("events");
    let done: Vec<_> = progress.iter().map(|event| event["done"].as_f64().expect("a share")).collect();
    assert!(done.len() >= 3 && done.is_sorted() && done.iter().all(|share| (0.0..1.0).contains(share)), "{done:?}");
    assert!(progress.iter().all(|event| event["event"] == "progress"), "{progress:?}");
    assert_eq!(finished["event"], "finished", "{finished}");
    assert_eq!(finished["file"], "a.png", "{finished}");
    assert_eq!(finished["bytes"], place.read("a.png").len(), "{finished}");
    assert_eq!(finished["scene_hash"].as_str().map(str::len), Some(64), "{finished}");
    assert!(finished["seconds"].as_f64().is_some_and(|seconds| seconds > 0.0), "{finished}");
    assert!(finished["adapter"].as_str().is_some_and(|name| !name.is_empty()), "{finished}");
}

#[test]
fn json_progress_reports_errors_with_their_exit_code() {
    let run = Place::new().run(&["render", "missing.toml", "-o", "a.png", "--progress", "json"]);
    run.refused(2, "missing.toml");
    let events = events(&run);
    assert_eq!(events.len(), 1, "{events:?}");
    assert_eq!((&events[0]["event"], &events[0]["exit_code"]), (&"error".into(), &2.into()), "{events:?}");
}

#[test]
fn human_progress_keeps_stdout_clean() {
    let run = Place::new().run(&["render", "preset:noon", "-o", "a.png", "--size", "16x16"]).succeeded();
    assert_eq!(run.stdout, "", "sentences go to stderr");
}

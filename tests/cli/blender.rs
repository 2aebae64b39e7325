//! What Blender makes of our files. Runs where a Python with Blender's package is found; elsewhere it says how to get one.

use std::path::PathBuf;
use std::process::Command;

use serde_json::Value;

use crate::program::Place;

/// Names the Python to use.
const PYTHON_VARIABLE: &str = "TYNDALL_BLENDER_PYTHON";

/// A Python that has Blender's package.
fn python() -> Option<PathBuf> {
    let named = std::env::var_os(PYTHON_VARIABLE).map(PathBuf::from);
    let candidates = named.into_iter().chain(["python3.11", "python3"].map(PathBuf::from));
    candidates.into_iter().find(|python| {
        // The package takes seconds to load; whether it is there takes none.
        let look = "import importlib.util, sys; sys.exit(importlib.util.find_spec('bpy') is None)";
        Command::new(python).args(["-c", look]).output().is_ok_and(|output| output.status.success())
    })
}

/// What the script says of a file.
fn checked(python: &PathBuf, place: &Place, words: &[&str]) -> Value {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/blender/check_hdri.py");
    let output = Command::new(python).arg(script).args(words).current_dir(place).output().expect("it was found");
    let text = String::from_utf8_lossy(&output.stdout);
    let result = text.lines().find_map(|line| line.strip_prefix("RESULT "));
    let result = result.unwrap_or_else(|| panic!("{text}\n{}", String::from_utf8_lossy(&output.stderr)));
    serde_json::from_str(result).expect("JSON")
}

#[test]
fn blender_sees_the_sun_in_its_place_and_a_grey_plane_as_bright_as_computed() {
    let Some(python) = python() else {
        println!(
            "skipped: no Python with Blender's package; python3.11 -m venv V && V/bin/pip install 'numpy<2' bpy==5.0.1, then \
             set {PYTHON_VARIABLE}=V/bin/python"
        );
        return;
    };
    let place = Place::new();
    let sun = ["--set", "sun.elevation_deg=33", "--set", "sun.azimuth_deg=120", "--width", "1024"];
    for (file, how) in [("disc.exr", "disc"), ("lamp.exr", "lamp")] {
        place.run(&[&["hdri", "preset:noon", "-o", file, "--sun", how], &sun[..]].concat()).succeeded();
    }
    let disc = checked(&python, &place, &["disc.exr", "--samples", "256"]);
    let lamp = checked(&python, &place, &["lamp.exr", "--lamp", "--samples", "256"]);
    println!("by the disc: {disc}\nby the lamp: {lamp}");
    let number = |value: &Value| value.as_f64().expect("a number");
    assert!(number(&disc["sun_error_px"]) < 0.5, "the sun is {} px away", disc["sun_error_px"]);
    for (how, result) in [("disc", &disc), ("lamp", &lamp)] {
        assert!(number(&result["plane_error"]) < 0.02, "by the {how} the plane is off by {}", result["plane_error"]);
    }
    // The same light either way.
    let ratio = number(&disc["plane"][1]) / number(&lamp["plane"][1]);
    assert!((ratio - 1.0).abs() < 0.02, "disc against lamp: {ratio}");
}

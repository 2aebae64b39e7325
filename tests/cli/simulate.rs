//! `tyndall simulate`: steps, states, hashes.

use serde_json::Value;
use tyndall_core::array::ArrayData;
use tyndall_io::read_npz;

use crate::program::{Place, Run};

/// A small sky with wind in shear.
const SCENE: &str = "format = 1\n[clouds]\nkind = \"automaton\"\n[cloud_grid]\ncells_east = 72\ncells_north = 60\n\
                     cells_up = 40\nwarm_up_steps = 20\n[cloud_vapour]\nbubble_radius_m = 400\n";

fn place() -> Place {
    let place = Place::new();
    place.write("sky.toml", SCENE);
    place
}

/// `tyndall simulate sky.toml` with these words.
fn simulate(place: &Place, words: &[&str]) -> Run {
    place.run(&[&["simulate", "sky.toml"], words].concat())
}

/// What the program prints: `step N hash 0x..`.
fn printed(place: &Place, words: &[&str]) -> String {
    simulate(place, words).succeeded().stdout
}

#[test]
fn five_hundred_steps_with_wind_give_the_same_state_on_one_and_two_threads_and_in_two_parts() {
    let place = place();
    let whole = printed(&place, &["--steps", "500", "--threads", "1", "-o", "one.npz"]);
    assert!(
        whole.starts_with("step 500 hash 0x") && whole.trim_end().len() == "step 500 hash 0x".len() + 16,
        "{whole}"
    );
    assert_eq!(printed(&place, &["--steps", "500", "--threads", "2", "-o", "two.npz"]), whole, "two threads");
    assert!(place.read("one.npz") == place.read("two.npz"), "byte for byte");
    printed(&place, &["--steps", "217", "-o", "part.npz"]);
    let rest = printed(&place, &["--state", "part.npz", "--steps", "283", "-o", "rest.npz"]);
    assert_eq!(rest, whole, "in two parts");
    assert!(place.read("rest.npz") == place.read("one.npz"), "the whole state");
    assert_eq!(place.files(), ["one.npz", "part.npz", "rest.npz", "sky.toml", "two.npz"], "nothing else is left");
}

#[test]
fn a_state_holds_cells_step_seed_and_hash_by_name() {
    let place = place();
    let text = printed(&place, &["--steps", "30", "-o", "a.npz"]);
    let arrays = read_npz(place.path("a.npz")).unwrap();
    let array = |name: &str| &arrays.iter().find(|(found, _)| found == name).expect(name).1;
    assert_eq!(array("cells").shape(), [72, 60, 40], "one byte a cell");
    let number = |name: &str| match array(name).data() {
        ArrayData::U64(values) => values[0],
        other => panic!("{name}: {other:?}"),
    };
    assert_eq!((number("step"), number("seed")), (30, 1), "step and seed");
    assert_eq!(text, format!("step 30 hash {:#018x}\n", number("hash")), "the hash that was told");
}

#[test]
fn without_a_number_of_steps_it_goes_to_the_moment_of_the_picture() {
    let place = place();
    assert!(printed(&place, &[]).starts_with("step 20 "), "the end of the warm-up");
    assert!(printed(&place, &["--set", "clouds.time_s=50"]).starts_with("step 23 "), "two steps and a half later");
    assert_eq!(place.files(), ["sky.toml"], "no file unless asked for");
}

#[test]
fn programs_learn_step_and_hash_from_the_last_event() {
    let place = place();
    let text = printed(&place, &["--steps", "25", "-o", "a.npz", "--progress", "json"]);
    let events: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).expect(line)).collect();
    let (finished, progress) = events.split_last().expect("events");
    assert!(progress.iter().all(|event| event["event"] == "progress"), "{progress:?}");
    assert_eq!((&finished["event"], &finished["step"]), (&"finished".into(), &25.into()), "{finished}");
    let plain = printed(&place, &["--steps", "25"]);
    assert_eq!(format!("step 25 hash {}\n", finished["hash"].as_str().expect("text")), plain, "{finished}");
}

#[test]
fn states_of_other_grids_and_other_files_are_refused_with_their_name() {
    let place = place();
    printed(&place, &["--steps", "3", "-o", "a.npz"]);
    let refused = |words: &[&str], part: &str| simulate(&place, words).refused(2, part);
    refused(
        &["--state", "a.npz", "--set", "cloud_grid.cells_up=39"],
        "cannot start from a.npz: array `cells` has [72, 60, 40]",
    );
    refused(&["--state", "sky.toml"], "sky.toml: this is no NPZ file");
    refused(&["--state", "none.npz"], "none.npz");
    refused(&["-o", "a.txt"], "a state is an .npz file");
    refused(&["-o", "nowhere/a.npz"], "the folder nowhere does not exist");
    refused(&["--set", "clouds.kind=none"], "nothing in the scene goes on in steps");
    let other = simulate(&place, &["--state", "a.npz", "--steps", "1", "--set", "cloud_wind.floor_speed_m_s=9"]);
    assert!(other.succeeded().stderr.contains("warning: the state comes from other parameters"), "told, not refused");
}

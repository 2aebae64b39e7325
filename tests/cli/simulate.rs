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

/// A small desert.
const DESERT: &str =
    "format = 1\n[desert]\nkind = \"dunes\"\nsteps = 25\n[dunes]\nside = \"64\"\n[dune_plants]\nenabled = true\n";

#[test]
fn sand_goes_on_from_a_state_bit_for_bit_on_any_number_of_threads() {
    let place = Place::new();
    place.write("sand.toml", DESERT);
    let run = |words: &[&str]| place.run(&[&["simulate", "sand.toml"], words].concat()).succeeded().stdout;
    let whole = run(&["--steps", "300", "--threads", "1", "-o", "one.npz"]);
    assert!(whole.starts_with("step 300 hash 0x"), "{whole}");
    assert_eq!(run(&["--steps", "300", "--threads", "2", "-o", "two.npz"]), whole, "two threads");
    run(&["-o", "part.npz"]);
    assert_eq!(
        run(&["--state", "part.npz", "--steps", "275", "-o", "rest.npz"]),
        whole,
        "25 steps, the scene's, and 275"
    );
    for file in ["two.npz", "rest.npz"] {
        assert!(place.read(file) == place.read("one.npz"), "{file} is one.npz, byte for byte");
    }
    let arrays = read_npz(place.path("one.npz")).unwrap();
    let array = |name: &str| match &arrays.iter().find(|(found, _)| found == name).expect(name).1.data() {
        ArrayData::I32(values) => values.clone(),
        other => panic!("{name}: {other:?}"),
    };
    let (height, sand, bedrock) = (array("height"), array("sand"), array("bedrock"));
    let depth: Vec<i32> = height.iter().zip(&bedrock).map(|(height, rock)| height - rock).collect();
    assert!(sand == depth && sand.iter().all(|depth| *depth >= 0), "the sand lies on the rock");
    assert_eq!(sand.len(), 64 * 64, "every cell");
}

#[test]
fn of_clouds_and_sand_the_one_is_simulated_that_is_named_or_that_the_state_belongs_to() {
    let place = place();
    place.write("sand.toml", DESERT);
    let both = ["--set", "desert.kind=dunes", "--set", "dunes.side=64"];
    let run = |words: &[&str]| simulate(&place, &[&both[..], words].concat());
    run(&[]).refused(2, "say which is meant: clouds or desert");
    let clouds = run(&["--of", "clouds", "--steps", "2", "-o", "sky.npz"]).succeeded().stdout;
    let sand = run(&["--of", "desert", "--steps", "2", "-o", "sand.npz"]).succeeded().stdout;
    assert_ne!(clouds, sand, "two simulations");
    let more = run(&["--state", "sand.npz", "--steps", "1"]).succeeded().stdout;
    assert!(more.starts_with("step 3 "), "the sand's state goes on: {more}");
    run(&["--of", "clouds", "--state", "sand.npz"])
        .refused(2, "cannot start from sand.npz: the state is one of desert");
    run(&["--of", "smoke"]).refused(2, "\"smoke\" is none of clouds, desert");
    simulate(&place, &["--state", "sand.npz"]).refused(2, "which clouds cannot start from");
    place
        .run(&["simulate", "sand.toml", "--state", "sand.npz", "--set", "dunes.side=128"])
        .refused(2, "array `height`");
}

#[test]
fn terrain_and_winds_of_files_shape_the_sand() {
    let place = Place::new();
    place.write("sand.toml", DESERT);
    place.write("winds.csv", "direction_deg,speed_m_s\n180,12\n");
    std::fs::write(place.path("rock.r16"), [0_u8, 0, 255, 255, 0, 0, 0, 0]).unwrap();
    let run = |words: &[&str]| place.run(&[&["simulate", "sand.toml"], words].concat());
    let hash = |words: &[&str]| run(words).succeeded().stdout;
    let level = hash(&[]);
    assert_ne!(hash(&["--set", "desert.terrain=rock.r16"]), level, "a hill");
    assert_eq!(
        hash(&["--set", "desert.wind_table=winds.csv"]),
        hash(&["--set", "dune_wind.direction_deg=90"]),
        "a south wind"
    );
    run(&["--set", "desert.terrain=none.png"]).refused(2, "none.png");
    run(&["--set", "desert.wind_table=sand.toml"]).refused(2, "sand.toml: line 1, column 1: no column is called");
}

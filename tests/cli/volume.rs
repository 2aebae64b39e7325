//! `tyndall volume`: clouds as data.

use tyndall_clouds::Metaballs;
use tyndall_core::array::{Array, ArrayData};
use tyndall_io::read_npz;

use crate::program::Place;

const SCENE: &str = "format = 1\n[clouds]\nkind = \"automaton\"\n[cloud_grid]\ncells_east = 40\ncells_north = 32\n\
                     cells_up = 24\nwarm_up_steps = 20\n[cloud_vapour]\nbubble_radius_m = 400\n";

fn place() -> Place {
    let place = Place::new();
    place.write("sky.toml", SCENE);
    place
}

fn volume(place: &Place, words: &[&str]) {
    place.run(&[&["volume", "sky.toml"], words].concat()).succeeded();
}

/// The numbers of an array.
fn floats(array: &Array) -> Vec<f64> {
    match array.data() {
        ArrayData::F32(values) => values.iter().map(|value| f64::from(*value)).collect(),
        ArrayData::F64(values) => values.clone(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn grid_and_balls_hold_the_same_cloud() {
    let place = place();
    for file in ["a.npz", "a.csv", "a.json", "a.vdb"] {
        volume(&place, &["-o", file]);
    }
    let text = |name: &str| String::from_utf8(place.read(name)).unwrap();
    let balls = Metaballs::from_csv(&text("a.csv")).unwrap();
    assert_eq!(Metaballs::from_json(&text("a.json")).unwrap(), balls, "both lists, bit for bit");
    let arrays = read_npz(place.path("a.npz")).unwrap();
    let array = |name: &str| &arrays.iter().find(|(found, _)| found == name).expect(name).1;
    assert_eq!(array("density").shape(), [40, 32, 24], "cells");
    assert_eq!(floats(array("low_corner_m")), [-1000.0, -800.0, 1000.0], "centred on the origin, on its floor");
    let mass = floats(array("density")).iter().sum::<f64>() * 50.0_f64.powi(3);
    // What spills over floor and ceiling is lost to the grid.
    assert!(mass > 0.0 && (mass / balls.mass_m2() - 1.0).abs() < 0.02, "{mass} and {} m2", balls.mass_m2());
    assert_eq!(&place.read("a.vdb")[..4], b" BDV", "a VDB file");
}

#[test]
fn a_state_in_place_of_the_warm_up_gives_the_cloud_of_its_step() {
    let place = place();
    place.run(&["simulate", "sky.toml", "--steps", "23", "-o", "s.npz"]).succeeded();
    volume(&place, &["-o", "from.csv", "--state", "s.npz"]);
    volume(&place, &["-o", "whole.csv", "--set", "clouds.time_s=60"]);
    assert!(place.read("from.csv") == place.read("whole.csv"), "three steps of 20 s after the warm-up");
}

#[test]
fn what_cannot_be_written_is_refused() {
    let place = place();
    let refused = |words: &[&str], part: &str| place.run(&[&["volume", "sky.toml"], words].concat()).refused(2, part);
    refused(&["-o", "a.obj"], ".vdb, .npz, .csv or .json");
    refused(&["-o", "a.npz", "--half"], "--half concerns VDB files only");
    refused(&["-o", "a.vdb", "--set", "clouds.kind=none"], "the scene has no clouds");
    refused(&["-o", "a.vdb", "--state", "none.npz"], "none.npz");
    assert_eq!(place.files(), ["sky.toml"], "nothing was left");
}

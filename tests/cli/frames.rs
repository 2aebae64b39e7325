//! `tyndall render --frames`: animations.

use serde_json::Value;

use crate::program::{Place, Run};

const SCENE: &str = "format = 1\n[camera]\npitch_deg = 20\n[sky]\norders = \"single\"\n[clouds]\nkind = \"automaton\"\n\
                     [cloud_grid]\ncells_east = 40\ncells_north = 40\ncells_up = 16\nwarm_up_steps = 10\n\
                     [image]\nwidth_px = 48\nheight_px = 32\n";

fn place() -> Place {
    let place = Place::new();
    place.write("sky.toml", SCENE);
    place
}

fn render(place: &Place, words: &[&str]) -> Run {
    place.run(&[&["render", "sky.toml"], words].concat())
}

#[test]
fn every_frame_is_a_still_of_its_moment_and_is_drawn_once() {
    let place = place();
    let run = render(&place, &["-o", "f-###.png", "--frames", "0-4x2", "--fps", "2", "--progress", "json"]).succeeded();
    assert_eq!(place.files(), ["f-000.png", "f-002.png", "f-004.png", "sky.toml"], "three frames and nothing else");
    let events: Vec<Value> = run.stdout.lines().map(|line| serde_json::from_str(line).expect(line)).collect();
    let frames: Vec<_> = events.iter().filter(|event| event["event"] == "frame").map(|event| &event["frame"]).collect();
    assert_eq!(frames, [0, 2, 4], "each is told");
    assert_eq!(events.last().expect("events")["frames"], 3, "{events:?}");

    // Frame 4 at two frames a second is two seconds on, in which 120 pass for the clouds.
    render(&place, &["-o", "still.png", "--set", "clouds.time_s=120"]).succeeded();
    assert!(place.read("still.png") == place.read("f-004.png"), "byte for byte");
    assert!(place.read("f-000.png") != place.read("f-004.png"), "the clouds have moved");

    place.write("f-002.png", "half a picture");
    let whole = place.read("f-004.png");
    let run = render(&place, &["-o", "f-###.png", "--frames", "0-4x2", "--fps", "2", "--resume"]).succeeded();
    assert!(run.stderr.contains("1 frames in") && run.stderr.contains("2 were there already"), "{}", run.stderr);
    assert!(place.read("f-002.png").len() > 500 && place.read("f-004.png") == whole, "what was missing is there");
}

#[test]
fn a_still_starts_from_a_state_as_the_volume_does() {
    let place = place();
    place.run(&["simulate", "sky.toml", "--steps", "13", "-o", "s.npz"]).succeeded();
    render(&place, &["-o", "from.png", "--state", "s.npz"]).succeeded();
    render(&place, &["-o", "whole.png", "--set", "clouds.time_s=60"]).succeeded();
    let pixels = |name: &str| image::open(place.path(name)).unwrap().to_rgb8();
    assert!(pixels("from.png") == pixels("whole.png"), "the same picture");
}

#[test]
fn ranges_and_names_that_do_not_fit_are_refused() {
    let place = place();
    let refused = |words: &[&str], part: &str| render(&place, words).refused(2, part);
    refused(&["-o", "f.png", "--frames", "1-3"], "--frames needs a place in the file's name");
    refused(&["-o", "f-##.png", "--frames", "3-1"], "the range is empty");
    refused(&["-o", "f-##.png", "--frames", "some"], "such as 7, 1-48");
    refused(&["-o", "f-##.png", "--frames", "1-9", "--fps", "0"], "a number from 0.001");
    refused(&["-o", "f-##.png", "--frames", "1-999999", "--fps", "1"], "`clouds.time_s` = ");
    refused(&["-o", "f.png", "--resume"], "--frames");
    refused(&["-o", "f-##.png", "--frames", "1-2", "--set", "clouds.kind=none", "--state", "x.npz"], "x.npz");
    assert_eq!(place.files(), ["sky.toml"], "nothing was drawn");
}

#[test]
fn clouds_do_not_jump_where_the_automaton_makes_a_step() {
    let place = place();
    // Steps of 20 s: 33 frames of 1.25 s lie over two of them, and begin in the middle of one.
    let words = ["--frames", "8-40", "--fps", "4", "--speed", "5", "--set", "clouds.detail=0"];
    render(&place, &[&["-o", "f-##.exr", "--float"], &words[..]].concat()).succeeded();
    let frame = |index: usize| {
        let path = place.path(&format!("f-{index:02}.exr"));
        tyndall_io::read_exr(path).expect("a frame").0.rgba
    };
    let differences: Vec<f64> = (8..40)
        .map(|index| {
            let (now, next) = (frame(index), frame(index + 1));
            let sum: f64 = now.iter().zip(&next).map(|(a, b)| f64::from((a[1] - b[1]).abs())).sum();
            sum / now.len() as f64
        })
        .collect();
    let mut sorted = differences.clone();
    sorted.sort_by(f64::total_cmp);
    let (median, worst) = (sorted[16], sorted[31]);
    println!("from frame to frame {median:.2} cd/m2 in the median, {worst:.2} at most: {differences:.1?}");
    assert!(median > 0.0, "the clouds move");
    assert!(worst < 2.0 * median, "a jump: {differences:?}");
}

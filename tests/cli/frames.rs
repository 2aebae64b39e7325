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
    let pixels = |name: &str| image::open(place.path(name)).expect("a picture").to_rgb8();
    assert!(pixels("from.png") == pixels("whole.png"), "the same picture");
}

/// A small desert, from above.
const SAND: &str = "format = 1\n[camera]\naltitude_m = 40\npitch_deg = -60\n[sky]\norders = \"single\"\n[desert]\n\
                    kind = \"dunes\"\nsteps = 40\n[dunes]\nside = \"64\"\n[image]\nwidth_px = 48\nheight_px = 32\n";

/// Pixels of a picture file.
fn pixels(place: &Place, name: &str) -> image::RgbImage {
    image::open(place.path(name)).expect("a picture").to_rgb8()
}

#[test]
fn sand_that_starts_from_a_state_is_drawn_as_if_it_had_never_stopped() {
    let place = Place::new();
    place.write("sand.toml", SAND);
    let draw = |words: &[&str]| place.run(&[&["render", "sand.toml"], words].concat());
    place.run(&["simulate", "sand.toml", "--steps", "25", "-o", "s.npz"]).succeeded();
    draw(&["-o", "whole.png"]).succeeded();
    draw(&["-o", "rest.png", "--state", "s.npz"]).succeeded();
    assert!(pixels(&place, "whole.png") == pixels(&place, "rest.png"), "25 steps and 15 more are 40");

    // Sand of another seed, so that the state shows; it is further than the scene.
    let other = ["--set", "dunes.seed=9"];
    place.run(&[&["simulate", "sand.toml", "--steps", "60", "-o", "far.npz"], &other[..]].concat()).succeeded();
    draw(&["-o", "far.png", "--state", "far.npz"]).succeeded();
    draw(&[&["-o", "sixty.png", "--set", "desert.steps=60"], &other[..]].concat()).succeeded();
    assert!(pixels(&place, "far.png") == pixels(&place, "sixty.png"), "the state's own step");
    assert!(pixels(&place, "far.png") != pixels(&place, "whole.png"), "other sand");

    let refused =
        |words: &[&str], part: &str| draw(&[&["-o", "f.png", "--state", "s.npz"], words].concat()).refused(2, part);
    refused(&["--set", "dunes.side=128"], "cannot start from s.npz: ");
}

#[test]
fn sand_moves_from_frame_to_frame_and_goes_on_where_an_animation_broke_off() {
    let place = Place::new();
    place.write("sand.toml", SAND);
    let draw = |words: &[&str]| place.run(&[&["render", "sand.toml", "--fps", "2"], words].concat());
    draw(&["-o", "f-#.png", "--frames", "0-2", "--sand-speed", "20"]).succeeded();
    place.run(&["render", "sand.toml", "-o", "still.png", "--set", "desert.steps=60"]).succeeded();
    assert!(pixels(&place, "still.png") == pixels(&place, "f-2.png"), "a second later, 20 steps");
    assert!(pixels(&place, "f-0.png") != pixels(&place, "f-1.png"), "the sand has moved");

    let whole = place.read("f-2.png");
    std::fs::remove_file(place.path("f-2.png")).unwrap();
    let run = draw(&["-o", "f-#.png", "--frames", "0-2", "--sand-speed", "20", "--resume"]).succeeded();
    assert!(run.stderr.contains("1 frames in") && run.stderr.contains("2 were there already"), "{}", run.stderr);
    assert!(place.read("f-2.png") == whole, "the same bytes without those before it");
    draw(&["-o", "g-#.png", "--frames", "1-2", "--sand-speed", "0"]).succeeded();
    assert!(pixels(&place, "g-1.png") == pixels(&place, "g-2.png"), "it stands still at 0");
    draw(&["-o", "g-#.png", "--frames", "1-2", "--sand-speed=-1"]).refused(2, "a number of steps from 0 to 100000");
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

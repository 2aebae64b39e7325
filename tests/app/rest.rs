//! A window at rest costs nothing.

use std::time::Duration;

use crate::harness::{Program, picture, quick_scene, rest, set_slider, start_with_scene};
use egui::ViewportId;

/// Frames that the program asks for in a time, as its window would give them.
fn frames_in(program: &mut Program, time: Duration) -> u32 {
    // The harness lets a quarter of a second pass in each frame.
    let step = Duration::from_millis(250);
    let (mut passed, mut frames) = (Duration::ZERO, 0);
    while let Some(output) = program.output().viewport_output.get(&ViewportId::ROOT) {
        passed = passed.saturating_add(output.repaint_delay.max(step));
        if passed > time {
            break;
        }
        program.step();
        frames += 1;
    }
    frames
}

/// Lets everything arrive that is on its way: undo point, timings of the last picture, thumbnails.
fn settle(program: &mut Program) {
    rest(program);
    for _try in 0..3 {
        std::thread::sleep(Duration::from_millis(200));
        program.run();
    }
}

#[test]
fn at_rest_the_window_repaints_at_most_twice_in_five_seconds() {
    let mut program = start_with_scene(quick_scene());
    settle(&mut program);
    let drawn = program.state().frames_drawn();
    let frames = frames_in(&mut program, Duration::from_secs(5));
    assert!(frames <= 2, "{frames} frames in 5 s at rest");
    assert_eq!(program.state().frames_drawn(), drawn, "pictures drawn at rest");
}

#[test]
fn after_a_change_the_window_comes_to_rest_again() {
    let mut program = start_with_scene(quick_scene());
    set_slider(&mut program, "sun: Elevation", 12.0);
    settle(&mut program);
    let frames = frames_in(&mut program, Duration::from_secs(5));
    assert!(frames <= 2, "{frames} frames in 5 s after a change");
}

#[test]
fn a_repaint_without_a_change_draws_no_picture() {
    let mut program = start_with_scene(quick_scene());
    let (before, drawn) = (picture(&program), program.state().frames_drawn());
    program.run_steps(10);
    assert_eq!(program.state().frames_drawn(), drawn, "nothing has changed");
    assert!(picture(&program) == before, "the same bytes");
}

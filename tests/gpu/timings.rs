//! GPU time of passes.

use std::time::Instant;

use tyndall_gpu::{Gpu, PassTimer};
use tyndall_tests::gpu;

use crate::rendering::draw;

/// Below what any pass of the tests can take, and above what a clock without a meaning would give.
const LONGEST_MS: f64 = 60_000.0;

fn needs_timestamps(gpu: &Gpu) -> bool {
    if !gpu.has_timestamps() {
        let timer = PassTimer::new(gpu, 4).and_then(|mut timer| timer.read(gpu));
        assert_eq!(timer, Ok(Vec::new()), "without timestamps there are no timings and no errors");
    }
    gpu.has_timestamps()
}

#[test]
fn a_pass_is_timed_under_its_name_and_takes_less_than_the_whole_call() {
    let gpu = gpu();
    if !needs_timestamps(gpu) {
        return;
    }
    let mut timer = PassTimer::new(gpu, 4).expect("small");
    let start = Instant::now();
    draw(gpu, [256, 256], &mut timer);
    let wall_ms = start.elapsed().as_secs_f64() * 1e3;
    let timings = timer.read(gpu).expect("the frame was submitted");
    assert_eq!(timings.len(), 1, "one pass: {timings:?}");
    assert_eq!(timings[0].name, "gradient", "the name it was given");
    assert!(timings[0].ms > 0.0 && timings[0].ms <= wall_ms.min(LONGEST_MS), "{timings:?} of {wall_ms} ms");
}

#[test]
fn timings_of_many_frames_arrive_without_waiting_and_never_repeat() {
    let gpu = gpu();
    if !needs_timestamps(gpu) {
        return;
    }
    let mut timer = PassTimer::new(gpu, 1).expect("small");
    for frame in 0..10 {
        draw(gpu, [16, 16], &mut timer);
        // The read-back of the picture has waited for the frame, so its timings are there after one poll.
        let timings = timer.poll(gpu).expect("no error");
        assert_eq!(timings.map(|timings| timings.len()), Some(1), "frame {frame}");
        assert_eq!(timer.poll(gpu), Ok(None), "frame {frame} is reported once");
    }
}

#[test]
fn frames_that_nobody_reads_are_given_up() {
    let gpu = gpu();
    if !needs_timestamps(gpu) {
        return;
    }
    let mut timer = PassTimer::new(gpu, 1).expect("small");
    for _ in 0..10 {
        draw(gpu, [16, 16], &mut timer);
    }
    assert_eq!(timer.read(gpu).expect("the last frame").len(), 1, "the ring was not blocked");
}

#[test]
fn passes_beyond_the_capacity_are_drawn_but_not_timed() {
    let gpu = gpu();
    if !needs_timestamps(gpu) {
        return;
    }
    let mut timer = PassTimer::new(gpu, 1).expect("small");
    timer.begin_frame();
    assert!(timer.render_writes("first").is_some(), "there is a slot");
    assert!(timer.compute_writes("second").is_none(), "there is one slot only");
}

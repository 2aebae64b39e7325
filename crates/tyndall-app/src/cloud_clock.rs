//! Playing clouds: the time of their simulation runs with that of the room, as fast as volumes can be made.

use std::ops::RangeInclusive;

/// Longest step (s) of the room's clock; a window that was asleep must not jump.
const MAX_STEP_S: f64 = 0.5;

/// Speeds that can be chosen (simulated seconds per second).
pub(crate) const SPEEDS: RangeInclusive<f64> = 1.0..=1000.0;

/// Whether time runs, and how fast.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct CloudClock {
    pub(crate) is_playing: bool,
    /// Simulated seconds per second.
    pub(crate) speed: f64,
    /// Time (s) of the room's clock up to which the clouds' time has run.
    run_to_s: Option<f64>,
}

impl Default for CloudClock {
    fn default() -> Self {
        Self { is_playing: false, speed: 40.0, run_to_s: None }
    }
}

impl CloudClock {
    /// Moves the clouds' time (s, up to `last_s`) to where it should be at `now_s` of the room's clock. It waits while
    /// `is_ready` says that the moment before is still being made: then it goes on with a longer step, not with a queue.
    pub(crate) fn run(&mut self, time_s: &mut f64, last_s: f64, now_s: f64, is_ready: bool) {
        if !self.is_playing {
            self.run_to_s = None;
            return;
        }
        if !is_ready {
            return;
        }
        let passed_s = self.run_to_s.replace(now_s).map_or(0.0, |before_s| now_s - before_s);
        *time_s = (*time_s + passed_s.clamp(0.0, MAX_STEP_S) * self.speed).min(last_s);
        self.is_playing = *time_s < last_s;
    }
}

/// The end of the next whole step (s) after a time.
pub(crate) fn next_step_s(time_s: f64, step_s: f64) -> f64 {
    // A time that is a whole number of steps but for rounding counts as one.
    ((time_s / step_s + 1e-6).floor() + 1.0) * step_s
}

/// A time for people: "1 h 02 min", "3 min 20 s", "14 s".
pub(crate) fn clock(time_s: f64) -> String {
    #[expect(clippy::cast_possible_truncation, reason = "at most a day or so")]
    let whole = time_s.max(0.0).round() as u32;
    match (whole / 3600, whole / 60 % 60, whole % 60) {
        (0, 0, seconds) => format!("{seconds} s"),
        (0, minutes, seconds) => format!("{minutes} min {seconds:02} s"),
        (hours, minutes, _) => format!("{hours} h {minutes:02} min"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_runs_at_its_speed_and_waits_for_what_is_being_made() {
        let mut clock = CloudClock { speed: 100.0, ..CloudClock::default() };
        let mut time_s = 50.0;
        clock.run(&mut time_s, 1e5, 10.0, true);
        assert!((time_s - 50.0).abs() < 1e-12, "stopped: {time_s}");
        clock.is_playing = true;
        clock.run(&mut time_s, 1e5, 11.0, true);
        assert!((time_s - 50.0).abs() < 1e-12, "the first frame starts the clock: {time_s}");
        clock.run(&mut time_s, 1e5, 11.1, false);
        assert!((time_s - 50.0).abs() < 1e-12, "the moment before is still being made: {time_s}");
        clock.run(&mut time_s, 1e5, 11.2, true);
        assert!((time_s - 70.0).abs() < 1e-9, "0.2 s at 100 s/s: {time_s}");
        clock.run(&mut time_s, 1e5, 99.0, true);
        assert!((time_s - 120.0).abs() < 1e-9, "a window that was asleep: {time_s}");
    }

    #[test]
    fn time_stops_at_the_end_of_its_range() {
        let mut clock = CloudClock { is_playing: true, speed: 1000.0, run_to_s: Some(0.0) };
        let mut time_s = 99_900.0;
        clock.run(&mut time_s, 1e5, 0.4, true);
        assert!(!clock.is_playing && (time_s - 1e5).abs() < 1e-9, "{time_s}");
    }

    #[test]
    fn steps_end_at_whole_multiples_and_times_are_read_out() {
        for (time_s, next_s) in [(0.0, 20.0), (19.0, 20.0), (20.0, 40.0), (0.3 * 3.0 - 1e-13, 1.2)] {
            let step_s = if time_s > 0.5 && time_s < 1.0 { 0.3 } else { 20.0 };
            assert!((next_step_s(time_s, step_s) - next_s).abs() < 1e-9, "after {time_s} s");
        }
        for (time_s, text) in [(14.2, "14 s"), (200.0, "3 min 20 s"), (3725.0, "1 h 02 min"), (-3.0, "0 s")] {
            assert_eq!(clock(time_s), text, "{time_s} s");
        }
    }
}

//! Playing the desert: steps of the wind, as many a second as were asked for and can be made.

use std::ops::RangeInclusive;

use crate::steps_on::StepsOn;

/// Longest step (s) of the room's clock; a window that was asleep must not jump.
const MAX_STEP_S: f64 = 0.5;

/// Speeds that can be chosen (steps per second).
pub(crate) const SPEEDS: RangeInclusive<f64> = 1.0..=1000.0;

/// Whether the wind blows, and how fast.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct DesertClock {
    pub(crate) is_playing: bool,
    /// Steps per second that are wanted.
    pub(crate) speed: f64,
    /// Steps per second that came out of it lately; 0 before any did.
    pub(crate) reached: f64,
    /// Who makes the steps.
    pub(crate) steps_on: StepsOn,
    /// Time (s) of the room's clock up to which the wind has blown.
    run_to_s: Option<f64>,
    /// The part of a step that is left over.
    part: f64,
}

impl Default for DesertClock {
    fn default() -> Self {
        Self { is_playing: false, speed: 30.0, reached: 0.0, steps_on: StepsOn::default(), run_to_s: None, part: 0.0 }
    }
}

impl DesertClock {
    /// Moves the number of steps (up to `last`) to where it should be at `now_s` of the room's clock. It waits while
    /// `is_ready` says that the step before is still being made, and then goes on no further than `most` steps at once, so
    /// that sand is never long under way.
    pub(crate) fn run(&mut self, steps: &mut u32, (most, last): (u32, u32), now_s: f64, is_ready: bool) {
        if !self.is_playing {
            (self.run_to_s, self.part, self.reached) = (None, 0.0, 0.0);
            return;
        }
        if !is_ready {
            return;
        }
        let waited_s = self.run_to_s.replace(now_s).map_or(0.0, |before_s| (now_s - before_s).max(0.0));
        self.part += waited_s.min(MAX_STEP_S) * self.speed;
        #[expect(clippy::cast_possible_truncation, reason = "at most half a second at the highest speed")]
        let whole = (self.part.floor() as u32).min(most.max(1)).min(last.saturating_sub(*steps));
        // What cannot be made in time is dropped: a computer that is too slow plays slower.
        self.part = (self.part - f64::from(whole)).clamp(0.0, 1.0);
        *steps += whole;
        if waited_s > 0.0 {
            let now = f64::from(whole) / waited_s;
            let share = (waited_s / 2.0).min(1.0);
            self.reached = if self.reached > 0.0 { self.reached + share * (now - self.reached) } else { now };
        }
        self.is_playing = *steps < last;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_run_at_their_speed_and_wait_for_what_is_being_made() {
        let mut clock = DesertClock { speed: 10.0, ..DesertClock::default() };
        let mut steps = 5;
        let ends = (100, 1_000_000);
        clock.run(&mut steps, ends, 1.0, true);
        assert_eq!(steps, 5, "stopped");
        clock.is_playing = true;
        for (now_s, is_ready, expected) in
            [(1.0, true, 5), (1.25, true, 7), (1.3, true, 8), (1.5, false, 8), (1.6, true, 11), (99.0, true, 16)]
        {
            clock.run(&mut steps, ends, now_s, is_ready);
            assert_eq!(steps, expected, "at {now_s} s");
        }
    }

    #[test]
    fn a_slow_computer_plays_slower_and_the_last_step_ends_it() {
        let mut clock = DesertClock { speed: 1000.0, is_playing: true, ..DesertClock::default() };
        let mut steps = 0;
        for tenths in 0..=10 {
            clock.run(&mut steps, (4, 30), 0.1 * f64::from(tenths), true);
        }
        assert_eq!((steps, clock.is_playing), (30, false), "four steps a time up to the last one");
        assert!(clock.reached < 45.0, "{} steps a second", clock.reached);
    }
}

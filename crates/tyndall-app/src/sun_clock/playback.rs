//! A time-lapse: the clock of the scene runs faster than that of the room.

use tyndall_scene::SunParams;

use super::calendar::advance;

/// Longest step (s) of the room's clock; a window that was asleep must not jump.
const MAX_STEP_S: f64 = 0.25;

/// Speeds that can be chosen (minutes of the scene a second), and their names.
pub(crate) const SPEEDS: [(f64, &str); 5] =
    [(1.0, "1 min/s"), (5.0, "5 min/s"), (15.0, "15 min/s"), (60.0, "1 h/s"), (240.0, "4 h/s")];

/// Whether the clock runs, and how fast.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Playback {
    pub(crate) is_playing: bool,
    pub(crate) minutes_per_s: f64,
}

impl Default for Playback {
    fn default() -> Self {
        Self { is_playing: false, minutes_per_s: SPEEDS[2].0 }
    }
}

impl Playback {
    /// Moves the sun by what has passed on the room's clock (s) since the last frame; whether it has moved.
    pub(crate) fn run(&self, sun: &mut SunParams, passed_s: f64) -> bool {
        if self.is_playing {
            advance(sun, passed_s.min(MAX_STEP_S) * self.minutes_per_s / 60.0);
        }
        self.is_playing
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_clock_runs_at_its_speed_and_only_while_it_plays() {
        let mut sun = SunParams::default();
        let mut playback = Playback { is_playing: false, minutes_per_s: 60.0 };
        assert!(!playback.run(&mut sun, 0.1) && (sun.time_h - 12.0).abs() < 1e-12, "stopped: {sun:?}");
        playback.is_playing = true;
        assert!(playback.run(&mut sun, 0.1) && (sun.time_h - 12.1).abs() < 1e-12, "0.1 s: {sun:?}");
        playback.run(&mut sun, 3600.0);
        assert!((sun.time_h - 12.35).abs() < 1e-12, "a window that was asleep: {sun:?}");
    }
}

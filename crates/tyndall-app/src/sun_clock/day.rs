//! The course of the sun over one day of the local clock.

use tyndall_scene::{Scene, SunParams, SunPosition};

/// Hours of a day.
pub(crate) const HOURS: f64 = 24.0;

/// Positions computed a day: every ten minutes, so that no rise and set lie between two of them except within a few minutes
/// of midsummer at the polar circle.
const SAMPLES: usize = 144;

/// Halvings of a sample's ten minutes: below a tenth of a second.
const HALVINGS: usize = 13;

/// What the sun's height means for the light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Level {
    Sun,
    Civil,
    Nautical,
    Astronomical,
}

impl Level {
    /// All, the highest first.
    pub(crate) const ALL: [Self; 4] = [Self::Sun, Self::Civil, Self::Nautical, Self::Astronomical];

    /// Geometric elevation (deg) of the sun's centre at which it begins and ends. The upper edge of the sun is seen until
    /// refraction (34') and its radius (16') no longer reach.
    pub(crate) const fn elevation_deg(self) -> f64 {
        match self {
            Self::Sun => -0.833,
            Self::Civil => -6.0,
            Self::Nautical => -12.0,
            Self::Astronomical => -18.0,
        }
    }

    /// What happens in the morning and in the evening.
    pub(crate) const fn names(self) -> [&'static str; 2] {
        match self {
            Self::Sun => ["Sunrise", "Sunset"],
            Self::Civil => ["Civil dawn", "Civil dusk"],
            Self::Nautical => ["Nautical dawn", "Nautical dusk"],
            Self::Astronomical => ["Astronomical dawn", "Astronomical dusk"],
        }
    }
}

/// The day of a date and a place.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Day {
    /// Elevations (deg), from 0 h to 24 h.
    elevations_deg: Vec<f64>,
    /// Times (h) at which the sun rises and sets through each level of [`Level::ALL`].
    crossings_h: [[Option<f64>; 2]; Level::ALL.len()],
    /// Time (h) and elevation (deg) of the highest sun.
    pub(crate) noon: (f64, f64),
}

impl Day {
    /// The day of the parameters' date and place; `None` when the date does not exist.
    pub(crate) fn of(sun: &SunParams) -> Option<Self> {
        let elevation = |time_h: f64| elevation_deg(sun, time_h);
        let elevations_deg = (0..=SAMPLES).map(|i| elevation(time_of(i))).collect::<Option<Vec<_>>>()?;
        let crossings_h = Level::ALL.map(|level| {
            let above: Vec<bool> = elevations_deg.iter().map(|e| *e > level.elevation_deg()).collect();
            [true, false].map(|rising| {
                let step = above.windows(2).position(|pair| pair[0] != rising && pair[1] == rising)?;
                crossing_h(&elevation, level.elevation_deg(), step, rising)
            })
        });
        let noon = highest(&elevation, &elevations_deg)?;
        Some(Self { elevations_deg, crossings_h, noon })
    }

    /// Elevation (deg) at a time (h), between the computed ones.
    pub(crate) fn elevation_deg(&self, time_h: f64) -> f64 {
        let position = (time_h / HOURS).clamp(0.0, 1.0) * SAMPLES as f64;
        let index = whole(position).min(SAMPLES - 1);
        let share = position - index as f64;
        self.elevations_deg[index] * (1.0 - share) + self.elevations_deg[index + 1] * share
    }

    /// Times (h) of rise and set through a level.
    pub(crate) fn crossings_h(&self, level: Level) -> [Option<f64>; 2] {
        Level::ALL.iter().position(|known| *known == level).map_or([None; 2], |index| self.crossings_h[index])
    }

    /// Whether the sun never leaves one side of a level: `Some(true)` when it stays above.
    pub(crate) fn stays(&self, level: Level) -> Option<bool> {
        let above = |e: &f64| *e > level.elevation_deg();
        if self.elevations_deg.iter().all(above) {
            return Some(true);
        }
        (!self.elevations_deg.iter().any(above)).then_some(false)
    }
}

/// Elevation (deg) at a time (h) of the parameters' date; `None` when the date does not exist.
fn elevation_deg(sun: &SunParams, time_h: f64) -> Option<f64> {
    let sun = SunParams { position: SunPosition::Date, time_h, ..sun.clone() };
    let direction = Scene { sun, ..Scene::default() }.sun_direction().ok()?;
    Some(direction.elevation_rad.to_degrees())
}

/// Time (h) within a sample's step at which the sun passes a level.
fn crossing_h(elevation: &impl Fn(f64) -> Option<f64>, level_deg: f64, step: usize, rising: bool) -> Option<f64> {
    let (mut before, mut after) = (time_of(step), time_of(step + 1));
    for _half in 0..HALVINGS {
        let middle = 0.5 * (before + after);
        if (elevation(middle)? > level_deg) == rising { after = middle } else { before = middle }
    }
    Some(0.5 * (before + after))
}

/// Time (h) and elevation (deg) of the highest sun: the top of the parabola through the highest sample and its neighbours.
fn highest(elevation: &impl Fn(f64) -> Option<f64>, samples_deg: &[f64]) -> Option<(f64, f64)> {
    let (index, _) = samples_deg.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1))?;
    if index == 0 || index == SAMPLES {
        return Some((time_of(index), samples_deg[index]));
    }
    let [before, top, after] = [samples_deg[index - 1], samples_deg[index], samples_deg[index + 1]];
    let bend = before - 2.0 * top + after;
    let offset = if bend < 0.0 { 0.5 * (before - after) / bend } else { 0.0 };
    let time_h = time_of(index) + offset * HOURS / SAMPLES as f64;
    Some((time_h, elevation(time_h)?))
}

fn time_of(sample: usize) -> f64 {
    sample as f64 * HOURS / SAMPLES as f64
}

#[expect(clippy::cast_possible_truncation, reason = "positions in a list of samples")]
fn whole(position: f64) -> usize {
    position as usize
}

/// A time (h) as people write it: 18:05, to the nearest minute.
#[expect(clippy::cast_possible_truncation, reason = "minutes of a day")]
pub(crate) fn clock(time_h: f64) -> String {
    let minutes = (time_h * 60.0).round() as i64;
    format!("{:02}:{:02}", minutes.div_euclid(60), minutes.rem_euclid(60))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn greenwich(month: u32, day: u32, latitude_deg: f64) -> Day {
        let sun = SunParams { year: 2026, month, day, latitude_deg, longitude_deg: 0.0, ..SunParams::default() };
        Day::of(&sun).expect("a date that exists")
    }

    #[test]
    fn sunrise_and_sunset_are_those_of_the_almanac() {
        // HM Nautical Almanac Office, Greenwich on 21 June: rise 3:43, set 20:21 UT, to the minute.
        let [rise, set] = greenwich(6, 21, 51.4779).crossings_h(Level::Sun).map(|time| time.expect("a day with both"));
        assert!((rise - (3.0 + 43.0 / 60.0)).abs() < 1.5 / 60.0, "{}", clock(rise));
        assert!((set - (20.0 + 21.0 / 60.0)).abs() < 1.5 / 60.0, "{}", clock(set));
    }

    #[test]
    fn the_lights_of_a_day_follow_each_other_and_mirror_each_other_about_noon() {
        let day = greenwich(3, 20, 40.0);
        let mut before: Option<[f64; 2]> = None;
        for level in Level::ALL {
            let [rise, set] = day.crossings_h(level).map(|time| time.expect("both at 40 degrees"));
            assert!(before.is_none_or(|[r, s]| rise < r && s < set), "{level:?}: {} {}", clock(rise), clock(set));
            // The declination moves by 0.2 degrees between the two at the equinox.
            assert!((0.5 * (rise + set) - day.noon.0).abs() < 0.02, "{level:?} about {}", clock(day.noon.0));
            before = Some([rise, set]);
        }
    }

    #[test]
    fn noon_is_as_high_as_latitude_and_declination_say() {
        let (time_h, elevation_deg) = greenwich(6, 21, 51.4779).noon;
        assert!((elevation_deg - (90.0 - 51.4779 + 23.44)).abs() < 0.01, "{elevation_deg}");
        // The equation of time is -1.9 minutes.
        assert!((time_h - (12.0 + 1.9 / 60.0)).abs() < 0.01, "{}", clock(time_h));
    }

    #[test]
    fn beyond_the_polar_circle_the_sun_neither_rises_nor_sets() {
        let (summer, winter) = (greenwich(6, 21, 75.0), greenwich(12, 21, 75.0));
        assert_eq!(summer.stays(Level::Sun), Some(true), "midnight sun");
        assert_eq!(winter.stays(Level::Sun), Some(false), "polar night");
        assert_eq!(summer.crossings_h(Level::Sun), [None, None], "no sunrise");
        assert_eq!(winter.stays(Level::Astronomical), None, "there is twilight");
    }

    #[test]
    fn a_date_that_does_not_exist_has_no_day() {
        assert_eq!(Day::of(&SunParams { month: 2, day: 31, ..SunParams::default() }), None, "31 February");
    }

    #[test]
    fn elevations_between_the_computed_ones_are_good_to_a_fiftieth_of_a_degree() {
        let day = greenwich(6, 21, 51.0);
        let sun = SunParams { year: 2026, month: 6, day: 21, latitude_deg: 51.0, ..SunParams::default() };
        for time_h in [0.0, 3.21, 6.083, 11.95, 18.77, 24.0] {
            let exact = elevation_deg(&sun, time_h).expect("a position");
            // Ten minutes are 2.5 degrees; the sagitta of the curve's sharpest turn, at noon, is 0.016.
            assert!((day.elevation_deg(time_h) - exact).abs() < 0.02, "{time_h} h: {exact}");
        }
    }

    #[test]
    fn clocks_round_to_the_minute() {
        for (time_h, text) in [(0.0, "00:00"), (18.5, "18:30"), (23.9999, "24:00"), (7.0 + 59.6 / 60.0, "08:00")] {
            assert_eq!(clock(time_h), text, "{time_h} h");
        }
    }
}

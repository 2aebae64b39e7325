//! Instants. Meeus, Astronomical Algorithms, 1998, chapters 7 and 12.

use crate::{SceneError, SunParams};

use crate::sun::instant;

/// Julian day of 2000 January 1, 12 h.
const J2000: f64 = 2_451_545.0;
const DAYS_PER_CENTURY: f64 = 36_525.0;
const SECONDS_PER_DAY: f64 = 86_400.0;

/// An instant in the two times that astronomers use.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instant {
    /// Julian day in universal time, which turns with the earth.
    pub julian_day: f64,
    /// Julian centuries from J2000 in dynamical time, which runs evenly.
    pub centuries: f64,
}

impl Instant {
    /// From a Julian day in universal time and the difference (s) of dynamical time to it.
    #[must_use]
    pub fn new(julian_day: f64, delta_t_s: f64) -> Self {
        Self { julian_day, centuries: (julian_day + delta_t_s / SECONDS_PER_DAY - J2000) / DAYS_PER_CENTURY }
    }

    /// The instant of a scene's date and time.
    pub(crate) fn of(sun: &SunParams) -> Result<Self, SceneError> {
        let time = instant(sun)?;
        Ok(Self::new(time.julian_date(), time.delta_t()))
    }

    /// Mean sidereal time at Greenwich (rad); formula 12.4.
    #[must_use]
    pub fn sidereal_rad(&self) -> f64 {
        let days = self.julian_day - J2000;
        let t = days / DAYS_PER_CENTURY;
        let degrees = 280.46061837 + 360.98564736629 * days + (0.000387933 - t / 38_710_000.0) * t * t;
        degrees.rem_euclid(360.0).to_radians()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sidereal_time_is_that_of_the_published_examples() {
        // Examples 12.a and 12.b: 1987 April 10, 0 h and 19 h 21 m 0 s.
        for (julian_day, hours) in
            [(2446895.5, 13.0 + 10.0 / 60.0 + 46.3668 / 3600.0), (2446896.30625, 128.7378734 / 15.0)]
        {
            let found = Instant::new(julian_day, 0.0).sidereal_rad().to_degrees() / 15.0;
            assert!((found - hours).abs() < 1e-6, "{julian_day}: {found} h");
        }
    }
}

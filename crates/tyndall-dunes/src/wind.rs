//! Winds that follow each other.

use tyndall_core::params;

use crate::DuneError;
use crate::direction::Direction;
use crate::error::check_params;

params! {
    /// Winds that take turns; angles anticlockwise from east say where they blow to.
    pub struct WindParams {
        /// Where the first wind blows to, anticlockwise from east.
        direction_deg: f64 = 0.0, ["deg", -360.0..=360.0, Linear], "design";
        /// Number of winds: 1 makes barchans and transverse dunes, 2 seifs, 3 or more stars.
        winds: u32 = 1, ["1", 1.0..=8.0, Linear], "Rubin and Hunter 1987";
        /// Angle from each wind to the next.
        divergence_deg: f64 = 120.0, ["deg", -180.0..=180.0, Linear], "Rubin and Hunter 1987, gamma";
        /// How long the first wind blows, in turns of the others; in equal winds the ratio of transport.
        ratio: f64 = 1.0, ["1", 0.1..=10.0, Log], "Rubin and Hunter 1987, R";
        /// Steps until the first wind comes again; short against the time in which a dune turns over.
        period_steps: u32 = 100, ["steps", 1.0..=100000.0, Log], "design";
    }
}

/// One wind of a schedule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wind {
    /// Where it blows to, anticlockwise from +x (deg).
    pub toward_deg: f64,
    /// Its share of the sand that is moved (1), relative to the other winds'.
    pub share: f64,
}

/// Winds that take turns, each for its share of a period.
#[derive(Clone, Debug, PartialEq)]
pub struct WindSchedule {
    winds: Vec<Wind>,
    directions: Vec<Direction>,
    /// Step of the period at which each wind ends.
    ends: Vec<u32>,
}

impl WindSchedule {
    /// One wind all the time.
    #[must_use]
    pub fn steady(toward_deg: f64) -> Self {
        let wind = Wind { toward_deg, share: 1.0 };
        Self { winds: vec![wind], directions: vec![Direction::from_degrees(toward_deg)], ends: vec![1] }
    }

    /// Winds that take turns in a period of so many steps; a wind that is due for less than half a step is left out.
    ///
    /// # Errors
    /// [`DuneError::NoWind`] when no share is above 0; [`DuneError::Value`] when a share is negative or no number, an
    /// angle is not finite, or the period is 0.
    pub fn new(winds: &[Wind], period_steps: u32) -> Result<Self, DuneError> {
        if period_steps == 0 {
            return Err(DuneError::Value {
                what: "period",
                value: 0.0,
                unit: " steps",
                low: 1.0,
                high: 4_294_967_295.0,
            });
        }
        for wind in winds {
            check("share of a wind", wind.share, "", [0.0, 1e300])?;
            check("direction of a wind", wind.toward_deg, " deg", [-36_000.0, 36_000.0])?;
        }
        let total: f64 = winds.iter().map(|wind| wind.share).sum();
        if total <= 0.0 {
            return Err(DuneError::NoWind);
        }
        let mut blown = 0.0;
        let mut ends = Vec::with_capacity(winds.len());
        for wind in winds {
            blown += wind.share;
            ends.push((blown / total * f64::from(period_steps)).round() as u32);
        }
        let directions = winds.iter().map(|wind| Direction::from_degrees(wind.toward_deg)).collect();
        Ok(Self { winds: winds.to_vec(), directions, ends })
    }

    /// The winds of these parameters.
    ///
    /// # Errors
    /// [`DuneError::Parameter`] when a parameter is outside its range.
    pub fn from_params(params: &WindParams) -> Result<Self, DuneError> {
        check_params(params)?;
        let wind = |index: u32| Wind {
            toward_deg: params.direction_deg + f64::from(index) * params.divergence_deg,
            share: if index == 0 { params.ratio } else { 1.0 },
        };
        Self::new(&(0..params.winds).map(wind).collect::<Vec<_>>(), params.period_steps)
    }

    /// The winds.
    #[must_use]
    pub fn winds(&self) -> &[Wind] {
        &self.winds
    }

    /// Where the wind of a step blows to.
    #[must_use]
    pub fn direction(&self, step: u32) -> Direction {
        let period = self.ends.last().copied().unwrap_or(1).max(1);
        let wind = self.ends.partition_point(|&end| end <= step % period);
        self.directions.get(wind).copied().unwrap_or(Direction::EAST)
    }
}

fn check(what: &'static str, value: f64, unit: &'static str, [low, high]: [f64; 2]) -> Result<(), DuneError> {
    if (low..=high).contains(&value) { Ok(()) } else { Err(DuneError::Value { what, value, unit, low, high }) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_wind_blows_for_its_share_of_the_period() {
        let params =
            WindParams { winds: 2, ratio: 2.0, divergence_deg: 90.0, period_steps: 30, ..WindParams::default() };
        let schedule = WindSchedule::from_params(&params).unwrap();
        let east = (0..300).filter(|&step| schedule.direction(step) == Direction::EAST).count();
        assert_eq!(east, 200, "two of three steps");
        assert_eq!(schedule.direction(25), Direction::from_degrees(90.0), "then the other");
        assert_eq!(schedule.direction(30), Direction::EAST, "and again");
    }

    #[test]
    fn a_schedule_without_wind_is_refused() {
        let calm = Wind { toward_deg: 0.0, share: 0.0 };
        assert_eq!(WindSchedule::new(&[calm], 10).unwrap_err(), DuneError::NoWind, "no share");
        assert_eq!(WindSchedule::new(&[], 10).unwrap_err(), DuneError::NoWind, "no wind");
        let message = WindSchedule::new(&[Wind { toward_deg: f64::NAN, share: 1.0 }], 10).unwrap_err().to_string();
        assert!(message.starts_with("direction of a wind = NaN deg is outside"), "{message}");
    }
}

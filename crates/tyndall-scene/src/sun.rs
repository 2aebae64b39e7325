//! Direction of the sun.
//!
//! From date, time and place it follows the solar position algorithm of Reda and Andreas 2004 (NREL/TP-560-34302), good to
//! 0.0003 degrees for years near ours. The observer stands at sea level (an airliner sees the sun 4e-6 degrees elsewhere),
//! and angles are those without air: [`Scene::refractive_air`](crate::Scene::refractive_air) says how much higher the sun
//! appears.

use glam::DVec3;
use solar_positioning::{Location, SolarPositions, delta_t, time::JulianDate};

use crate::{SceneError, SunParams, SunPosition};

const HOURS_PER_DAY: f64 = 24.0;

/// Direction towards the sun's centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SunDirection {
    /// Angle above the horizon in radians.
    pub elevation_rad: f64,
    /// Angle clockwise from north in radians.
    pub azimuth_rad: f64,
}

impl SunDirection {
    /// Unit vector towards the sun: x east, y north, z up.
    #[must_use]
    pub fn unit(&self) -> DVec3 {
        let (sin_elevation, cos_elevation) = self.elevation_rad.sin_cos();
        let (sin_azimuth, cos_azimuth) = self.azimuth_rad.sin_cos();
        DVec3::new(sin_azimuth * cos_elevation, cos_azimuth * cos_elevation, sin_elevation)
    }
}

/// Direction to the sun as its parameters say.
pub(crate) fn direction(sun: &SunParams) -> Result<SunDirection, SceneError> {
    match sun.position {
        SunPosition::Angles => Ok(SunDirection {
            elevation_rad: sun.elevation_deg.to_radians(),
            azimuth_rad: sun.azimuth_deg.to_radians(),
        }),
        SunPosition::Date => direction_by_date(sun),
    }
}

fn direction_by_date(sun: &SunParams) -> Result<SunDirection, SceneError> {
    let time = instant(sun)?;
    let refused = |error: solar_positioning::Error| SceneError::SunPosition { reason: error.to_string() };
    let place = Location { latitude: sun.latitude_deg, longitude: sun.longitude_deg };
    let position = SolarPositions::new().at_from_julian(time, place, 0.0, None).map_err(refused)?;
    Ok(SunDirection {
        elevation_rad: position.elevation_angle().to_radians(),
        azimuth_rad: position.azimuth().to_radians(),
    })
}

/// The instant of a date that exists.
pub(crate) fn instant(sun: &SunParams) -> Result<JulianDate, SceneError> {
    let days = days_in_month(sun.year, sun.month);
    if sun.day > days {
        return Err(SceneError::Day { year: sun.year, month: sun.month, day: sun.day, days });
    }
    julian_date(sun).map_err(|error| SceneError::SunPosition { reason: error.to_string() })
}

/// The instant in universal time; the clock's offset may move it into the day before or after.
fn julian_date(sun: &SunParams) -> Result<JulianDate, solar_positioning::Error> {
    let year = i32::try_from(sun.year).unwrap_or(i32::MAX);
    let delta_t_s = delta_t::estimate_from_date(year, sun.month)?;
    let midnight = JulianDate::from_utc(year, sun.month, sun.day, 0, 0, 0.0, delta_t_s)?;
    JulianDate::new(midnight.julian_date() + (sun.time_h - sun.utc_offset_h) / HOURS_PER_DAY, delta_t_s)
}

/// Days of a month in the Gregorian calendar.
fn days_in_month(year: u32, month: u32) -> u32 {
    let leap = year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400));
    match month {
        2 => 28 + u32::from(leap),
        4 | 6 | 9 | 11 => 30,
        _ => 31,
    }
}

#[cfg(test)]
mod tests;

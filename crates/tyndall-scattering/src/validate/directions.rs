//! Where skies are compared: a fixed, even set of directions, dense at the horizon and around the sun.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::Atmosphere;
use crate::geometry::{Ray, horizon_mu};

/// Steps of the two-dimensional recurrence of Roberts 2018: x^-1, x^-2 for the root x of x^3 = x + 1.
const STEPS: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_2];

/// Elevation above the horizon (rad) below which a direction belongs to [`Band::Horizon`].
const HORIZON_BAND: f64 = 0.14;

/// Zenith angle (rad) below which a direction belongs to [`Band::Zenith`].
const ZENITH_BAND: f64 = 0.61;

/// Angle from the sun (rad) below which a direction belongs to [`Band::Aureole`].
const AUREOLE_BAND: f64 = 0.35;

/// Smallest angle from the sun (rad): closer, only the aerosol's phase function is compared with itself.
const CLOSEST_TO_SUN: f64 = 0.03;

/// Tangent altitudes (m) of a view from space reach this high.
const LIMB_TOP_M: f64 = 60e3;

/// A part of the sky in which errors have causes of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Band {
    /// Within 35 degrees of the zenith.
    Zenith,
    /// Between zenith and horizon.
    Middle,
    /// Up to 8 degrees above the horizon; from space the limb.
    Horizon,
    /// Within 20 degrees of the sun.
    Aureole,
    /// Ground, seen through the air in front of it.
    Ground,
}

impl Band {
    /// All bands.
    pub const ALL: [Self; 5] = [Self::Zenith, Self::Middle, Self::Horizon, Self::Aureole, Self::Ground];

    /// Name for tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Zenith => "zenith",
            Self::Middle => "middle",
            Self::Horizon => "horizon",
            Self::Aureole => "aureole",
            Self::Ground => "ground",
        }
    }
}

/// A direction of view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Direction {
    /// Zenith angle (rad).
    pub view_zenith: f64,
    /// Azimuth from the sun (rad), 0 to pi; the sky is its own mirror image.
    pub azimuth: f64,
    /// Where in the sky it lies.
    pub band: Band,
}

/// `count` directions for an observer at `h_m` (m) under a sun of zenith cosine `mu_sun`; the first ones of a longer list
/// are a shorter list.
#[must_use]
pub fn directions(atmosphere: &Atmosphere, h_m: f64, mu_sun: f64, count: usize) -> Vec<Direction> {
    (0..count).map(|index| direction(atmosphere, h_m, mu_sun, index)).collect()
}

fn direction(atmosphere: &Atmosphere, h_m: f64, mu_sun: f64, index: usize) -> Direction {
    let [u, v] = STEPS.map(|step| (0.5 + step * (index + 1) as f64).fract());
    let horizon = horizon_mu(atmosphere.planet_radius_m, h_m.min(1e9)).asin();
    let (view_zenith, azimuth) = if h_m > atmosphere.top_altitude_m {
        (from_space(atmosphere, h_m, index, u), PI * v)
    } else {
        let elevation = match index % 10 {
            // Even over the sky.
            0 | 2 | 5 | 8 => (horizon.sin() + (1.0 - horizon.sin()) * u).asin(),
            1 | 4 | 7 => horizon + HORIZON_BAND * (0.003 + 0.997 * u * u),
            9 => horizon - (FRAC_PI_2 + horizon) * (0.001 + 0.999 * u * u),
            _ => return around_the_sun(mu_sun, horizon, [u, v]),
        };
        (FRAC_PI_2 - elevation, PI * v)
    };
    let nu = Ray::from_angles(h_m, view_zenith, mu_sun.acos(), azimuth).nu;
    let below = view_zenith.cos() < horizon.sin();
    Direction { view_zenith, azimuth, band: band(FRAC_PI_2 - view_zenith - horizon, view_zenith, nu, below) }
}

/// Half of the views from space are even over the planet's disc, half look along its limb.
fn from_space(atmosphere: &Atmosphere, h_m: f64, index: usize, u: f64) -> f64 {
    let radius_m = atmosphere.planet_radius_m;
    let limb_m = radius_m + LIMB_TOP_M.min(atmosphere.top_altitude_m);
    let impact_m = if index.is_multiple_of(2) { radius_m * u.sqrt() } else { radius_m + (limb_m - radius_m) * u };
    PI - (impact_m / (radius_m + h_m)).asin()
}

/// A direction close to the sun, mirrored upwards when it falls below the horizon.
fn around_the_sun(mu_sun: f64, horizon: f64, [u, v]: [f64; 2]) -> Direction {
    let distance = CLOSEST_TO_SUN + (AUREOLE_BAND - CLOSEST_TO_SUN) * u * u;
    let (sin_turn, cos_turn) = (TAU * v).sin_cos();
    let sun_elevation = mu_sun.asin();
    let elevation = sun_elevation + distance * sin_turn;
    let above = horizon + 1e-3 + (elevation - horizon - 1e-3).abs();
    let beyond_zenith = above > FRAC_PI_2;
    let elevation = if beyond_zenith { PI - above } else { above };
    let turn = (distance * cos_turn.abs() / sun_elevation.cos().max(0.1)).min(PI);
    let azimuth = if beyond_zenith { PI - turn } else { turn };
    let view_zenith = FRAC_PI_2 - elevation;
    let nu = Ray::from_angles(0.0, view_zenith, mu_sun.acos(), azimuth).nu;
    Direction { view_zenith, azimuth, band: band(elevation - horizon, view_zenith, nu, false) }
}

fn band(above_horizon: f64, view_zenith: f64, nu: f64, below: bool) -> Band {
    if below {
        Band::Ground
    } else if nu > AUREOLE_BAND.cos() {
        Band::Aureole
    } else if above_horizon < HORIZON_BAND {
        Band::Horizon
    } else if view_zenith < ZENITH_BAND {
        Band::Zenith
    } else {
        Band::Middle
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::{AtmosphereParams, GroundParams};

    fn set(h_m: f64, sun_deg: f64, count: usize) -> Vec<Direction> {
        let atmosphere = Atmosphere::new(&AtmosphereParams::default(), &GroundParams::default());
        directions(&atmosphere, h_m, sun_deg.to_radians().cos(), count)
    }

    #[test]
    fn every_band_has_its_share_by_day() {
        let set = set(2.0, 50.0, 100);
        for band in Band::ALL {
            let count = set.iter().filter(|direction| direction.band == band).count();
            assert!(count >= 8, "{}: {count} of 100", band.name());
        }
    }

    #[test]
    fn directions_are_angles_for_any_observer_and_sun() {
        for h_m in [0.1, 2.0, 10e3, 99e3, 400e3, 6e7] {
            for sun_deg in [0.0, 3.0, 45.0, 89.0, 96.0, 120.0, 180.0] {
                for Direction { view_zenith, azimuth, .. } in set(h_m, sun_deg, 60) {
                    let fine = (0.0..=PI).contains(&view_zenith) && (0.0..=PI).contains(&azimuth);
                    assert!(fine, "altitude {h_m} sun {sun_deg}: {view_zenith} {azimuth}");
                }
            }
        }
    }

    #[test]
    fn every_view_from_space_meets_the_atmosphere() {
        let lowest = (6.46e6_f64 / 6.76e6).asin();
        let all = set(400e3, 60.0, 80);
        assert!(all.iter().all(|direction| direction.view_zenith > PI - lowest), "within the disc");
        assert!(all.iter().filter(|direction| direction.band == Band::Horizon).count() >= 30, "the limb");
    }

    #[test]
    fn a_shorter_list_is_the_beginning_of_a_longer_one() {
        assert_eq!(set(2.0, 60.0, 10), set(2.0, 60.0, 30)[..10], "the same directions");
    }
}

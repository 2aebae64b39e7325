//! The moon of a scene: direction, phase and light.

use std::f64::consts::PI;

use glam::DVec3;

use super::equator::{equatorial, obliquity, world_from_equator};
use super::moon_series::moon_place;
use super::time::Instant;
use crate::{MoonParams, MoonPhase, MoonPosition, SceneError, SunParams};

const EARTH_RADIUS_M: f64 = 6_378_140.0;
const SUN_DISTANCE_M: f64 = 149_597_870_700.0;
/// Mean distance of the moon (m), where only its angles are known.
const MOON_DISTANCE_M: f64 = 384_400_000.0;

/// Illuminance (lux) of a star of magnitude 0 above the atmosphere; Allen 1973.
pub const MAGNITUDE_ZERO_LUX: f64 = 2.54e-6;

/// Magnitude of the mean full moon; Krisciunas and Schaefer 1991.
const FULL_MOON_MAGNITUDE: f64 = -12.73;

/// Illuminance (lux) of the full moon above the atmosphere.
pub const FULL_MOON_LUX: f64 = 0.3142;

/// Phase angle (deg) beyond which the law of magnitudes was not measured; the sickle follows Lommel and Seeliger from there.
const MEASURED_TO_DEG: f64 = 150.0;

/// Where the moon stands and how it is lit. Unit vectors: x east, y north, z up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MoonState {
    /// Towards the moon.
    pub direction: DVec3,
    /// From the moon towards the sun.
    pub sunlight: DVec3,
    /// Towards the celestial pole that the moon's north is near.
    pub north: DVec3,
    /// Angle at the moon between sun and observer (rad): 0 full, pi new.
    pub phase_rad: f64,
}

/// The state of a scene's moon, `None` without one. `sun` is the unit vector towards the sun.
pub(crate) fn moon_state(moon: &MoonParams, date: &SunParams, sun: DVec3) -> Result<Option<MoonState>, SceneError> {
    let (direction, distance_m, north) = match moon.position {
        MoonPosition::None => return Ok(None),
        MoonPosition::Angles => (by_angles(moon), MOON_DISTANCE_M, DVec3::Z),
        MoonPosition::Date => by_date(date)?,
    };
    let to_sun = (sun * SUN_DISTANCE_M - direction * distance_m).normalize();
    let sunlight = match moon.phase {
        MoonPhase::Sun => to_sun,
        MoonPhase::Angle => at_phase(direction, to_sun, moon.phase_deg.to_radians()),
    };
    Ok(Some(MoonState { direction, sunlight, north, phase_rad: sunlight.angle_between(-direction) }))
}

fn by_angles(moon: &MoonParams) -> DVec3 {
    let (sin_elevation, cos_elevation) = moon.elevation_deg.to_radians().sin_cos();
    let (sin_azimuth, cos_azimuth) = moon.azimuth_deg.to_radians().sin_cos();
    DVec3::new(sin_azimuth * cos_elevation, cos_azimuth * cos_elevation, sin_elevation)
}

/// Direction, distance (m) and north of the moon seen from a place on the surface.
fn by_date(date: &SunParams) -> Result<(DVec3, f64, DVec3), SceneError> {
    let instant = Instant::of(date)?;
    let place = moon_place(&instant);
    let (sin_tilt, cos_tilt) = obliquity(&instant).sin_cos();
    let ecliptic = equatorial(place.longitude, place.latitude);
    let centre = DVec3::new(
        ecliptic.x,
        cos_tilt * ecliptic.y - sin_tilt * ecliptic.z,
        sin_tilt * ecliptic.y + cos_tilt * ecliptic.z,
    );
    let sidereal = instant.sidereal_rad() + date.longitude_deg.to_radians();
    let world = world_from_equator(sidereal, date.latitude_deg.to_radians());
    // From the surface the moon stands up to a degree lower than from the centre.
    let seen = world * centre * place.distance_m - DVec3::Z * EARTH_RADIUS_M;
    Ok((seen.normalize(), seen.length(), world * DVec3::Z))
}

/// Sunlight from the side where the sun stands, at a phase angle (rad).
fn at_phase(direction: DVec3, to_sun: DVec3, phase: f64) -> DVec3 {
    let aside = to_sun - direction * to_sun.dot(direction);
    // A sun opposite to the moon, or behind it, is on no side.
    let aside = if aside.length() < 1e-6 { direction.any_orthonormal_vector() } else { aside.normalize() };
    aside * phase.sin() - direction * phase.cos()
}

/// Illuminance (lux) of the moon above the atmosphere on a plane facing it, at a phase angle (rad); Krisciunas and Schaefer
/// 1991, formula 9, the mean of waxing and waning, without the peak of the last degrees before full.
#[must_use]
pub fn moon_illuminance_lux(phase_rad: f64) -> f64 {
    let measured = |degrees: f64| {
        let magnitude = FULL_MOON_MAGNITUDE + 0.026 * degrees + 4e-9 * degrees.powi(4);
        MAGNITUDE_ZERO_LUX * 10.0_f64.powf(-0.4 * magnitude)
    };
    let degrees = phase_rad.to_degrees();
    if degrees <= MEASURED_TO_DEG {
        return measured(degrees);
    }
    let share = lommel_seeliger_phase(phase_rad) / lommel_seeliger_phase(MEASURED_TO_DEG.to_radians());
    measured(MEASURED_TO_DEG) * share
}

/// Light of a sphere that scatters by the law of Lommel and Seeliger, relative to its full phase.
#[must_use]
pub fn lommel_seeliger_phase(phase_rad: f64) -> f64 {
    let half = 0.5 * phase_rad.clamp(1e-6, PI - 1e-6);
    (1.0 - half.sin() * half.tan() * (1.0 / (0.5 * half).tan()).ln()).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Scene, SunPosition};

    fn scene(moon: MoonParams) -> Scene {
        Scene { moon, ..Scene::default() }
    }

    #[test]
    fn the_full_moon_gives_a_third_of_a_lux_and_the_half_moon_a_tenth_of_that() {
        assert!((moon_illuminance_lux(0.0) / FULL_MOON_LUX - 1.0).abs() < 1e-3, "{}", moon_illuminance_lux(0.0));
        let half = moon_illuminance_lux(0.5 * PI) / FULL_MOON_LUX;
        // 2.6 magnitudes: 0.026 x 90 + 4e-9 x 90^4.
        assert!((half - 10.0_f64.powf(-0.4 * 2.6024)).abs() < 1e-4, "{half}");
        assert!(moon_illuminance_lux(PI) < 1e-9, "new moon: {}", moon_illuminance_lux(PI));
    }

    #[test]
    fn the_moons_light_falls_steadily_with_its_phase() {
        let mut before = f64::INFINITY;
        for degrees in 0..=180 {
            let lux = moon_illuminance_lux(f64::from(degrees).to_radians());
            assert!(lux < before && lux >= 0.0, "{degrees} deg: {lux}");
            before = lux;
        }
    }

    #[test]
    fn the_phase_law_is_the_integral_over_the_lit_part_of_a_sphere() {
        for degrees in [0.0, 30.0, 90.0, 140.0] {
            let phase = f64::to_radians(degrees);
            let light = DVec3::new(phase.sin(), 0.0, phase.cos());
            let count = 800;
            let unit = |i: i32| (f64::from(i) + 0.5) / f64::from(count) * 2.0 - 1.0;
            let mut sum = 0.0;
            for (i, j) in (0..count).flat_map(|i| (0..count).map(move |j| (i, j))) {
                let (x, y) = (unit(i), unit(j));
                let squared = 1.0 - x * x - y * y;
                let normal = DVec3::new(x, y, squared.max(0.0).sqrt());
                let lit = normal.dot(light);
                if squared > 0.0 && lit > 0.0 {
                    sum += lit / (lit + normal.z);
                }
            }
            let mean = sum * 4.0 / f64::from(count * count) / (0.5 * PI);
            assert!((mean - lommel_seeliger_phase(phase)).abs() < 3e-3, "{degrees} deg: {mean}");
        }
    }

    /// Full moon of 2000 January 21, 4 h 41 m universal time, at the middle of its total eclipse 4 h 44 m: the moon stands
    /// opposite to the sun.
    #[test]
    fn a_total_eclipse_finds_the_moon_opposite_to_the_sun() {
        let mut scene = scene(MoonParams { position: MoonPosition::Date, ..MoonParams::default() });
        let sun = &mut scene.sun;
        sun.position = SunPosition::Date;
        (sun.year, sun.month, sun.day, sun.time_h) = (2000, 1, 21, 4.0 + 44.0 / 60.0);
        (sun.latitude_deg, sun.longitude_deg) = (19.8, -68.6);
        let moon = scene.moon().unwrap().expect("there is a moon");
        // The umbra is 0.7 degrees wide; the place has the moon near its zenith.
        assert!(moon.direction.z > 0.95, "{moon:?}");
        assert!(moon.phase_rad.to_degrees() < 0.6, "{moon:?}");
    }

    #[test]
    fn a_set_phase_is_the_angle_at_the_moon_and_its_light_comes_from_the_suns_side() {
        for (degrees, elevation_deg) in [(0.0, 30.0), (40.0, 30.0), (120.0, 30.0), (180.0, 30.0), (90.0, -35.0)] {
            let moon = MoonParams {
                position: MoonPosition::Angles,
                phase: MoonPhase::Angle,
                phase_deg: degrees,
                elevation_deg,
                ..MoonParams::default()
            };
            let scene = scene(moon);
            let moon = scene.moon().unwrap().expect("there is a moon");
            assert!((moon.phase_rad.to_degrees() - degrees).abs() < 1e-5, "{moon:?}");
            let sun = scene.sun_direction().unwrap().unit();
            let sides = moon.sunlight.cross(moon.direction).dot(sun.cross(moon.direction));
            // Full and new moons have no side.
            assert!(sides > -1e-9, "{moon:?}");
        }
    }

    #[test]
    fn without_a_moon_there_is_none() {
        assert_eq!(Scene::default().moon().unwrap(), None, "a new scene");
    }
}

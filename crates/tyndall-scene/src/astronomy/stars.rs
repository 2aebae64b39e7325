//! The fixed stars, and how the sky turns.

use glam::{DMat3, DVec3};

use super::equator::{date_from_j2000, equatorial, world_from_equator};
use super::moon::MAGNITUDE_ZERO_LUX;
use super::time::Instant;
use crate::{SceneError, StarsParams, SunParams, SunPosition};

const RADIANS_PER_HOUR: f64 = std::f64::consts::PI / 12.0;

/// A star.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Star {
    /// Unit vector in the axes of the equator of J2000.
    pub direction: DVec3,
    /// Illuminance above the atmosphere (lux).
    pub illuminance_lux: f64,
    /// Colour index B-V (magnitudes): 0 white, 1.5 red.
    pub colour_index: f64,
}

/// The stars of the Bright Star Catalogue, from the brightest to the faintest.
#[must_use]
pub fn bright_stars() -> Vec<Star> {
    tyndall_assets::BRIGHT_STARS.lines().enumerate().filter_map(|(row, line)| star(row, line)).collect()
}

/// A row "declination (deg),right ascension (h),magnitude,colour index"; nothing for the heading.
fn star(row: usize, line: &str) -> Option<Star> {
    let mut numbers = line.split(',').map(|number| number.trim().parse::<f64>());
    let (declination_deg, right_ascension_h) = (numbers.next()?.ok()?, numbers.next()?.ok()?);
    let magnitude = numbers.next()?.ok()?;
    let colour_index = numbers.next().and_then(Result::ok).unwrap_or_else(|| usual_colour_index(row));
    Some(Star {
        direction: equatorial(right_ascension_h * RADIANS_PER_HOUR, declination_deg.to_radians()),
        illuminance_lux: MAGNITUDE_ZERO_LUX * 10.0_f64.powf(-0.4 * magnitude),
        colour_index,
    })
}

/// A colour index for a star without one, spread as those of the catalogue: a third white, a fifth yellowish, the rest
/// orange giants.
fn usual_colour_index(row: usize) -> f64 {
    let share = tyndall_core::rng::CellRng::new(0x57A2).uniform(0, row as u64, 0);
    let knots = [(0.0, -0.15), (0.35, 0.12), (0.55, 0.6), (0.85, 1.15), (1.0, 1.65)];
    let share = f64::from(share);
    let pair = knots.windows(2).find(|pair| share <= pair[1].0).map_or([knots[3], knots[4]], |pair| [pair[0], pair[1]]);
    pair[0].1 + (share - pair[0].0) / (pair[1].0 - pair[0].0) * (pair[1].1 - pair[0].1)
}

/// Rotation from the axes of the catalogue to those of the scene.
pub(crate) fn world_from_stars(stars: &StarsParams, date: &SunParams) -> Result<DMat3, SceneError> {
    if date.position == SunPosition::Angles {
        return Ok(world_from_equator(stars.sidereal_h * RADIANS_PER_HOUR, stars.latitude_deg.to_radians()));
    }
    let instant = Instant::of(date)?;
    let sidereal = instant.sidereal_rad() + date.longitude_deg.to_radians();
    Ok(world_from_equator(sidereal, date.latitude_deg.to_radians()) * date_from_j2000(&instant))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_catalogue_begins_with_sirius_and_has_all_that_an_eye_sees() {
        let stars = bright_stars();
        assert!(stars.len() > 9000, "{} stars", stars.len());
        let sirius = stars[0];
        assert!((sirius.illuminance_lux / 9.75e-6 - 1.0).abs() < 0.01, "{sirius:?}");
        let declination = sirius.direction.z.asin().to_degrees();
        assert!((declination + 16.716).abs() < 0.01, "{declination}");
        let naked_eye =
            stars.iter().filter(|star| star.illuminance_lux > MAGNITUDE_ZERO_LUX * 10.0_f64.powf(-2.4)).count();
        assert!((4500..5600).contains(&naked_eye), "{naked_eye} stars of magnitude 6 and brighter");
    }

    #[test]
    fn every_star_is_a_direction_with_light_and_a_colour() {
        for star in bright_stars() {
            assert!((star.direction.length() - 1.0).abs() < 1e-12, "{star:?}");
            assert!(star.illuminance_lux > 0.0 && (-0.5..3.5).contains(&star.colour_index), "{star:?}");
        }
    }

    #[test]
    fn the_pole_star_stands_still_in_the_north_while_the_others_turn() {
        let stars = bright_stars();
        let polaris =
            stars.iter().find(|star| star.direction.z > 0.9999 && star.illuminance_lux > 3e-7).expect("Polaris");
        for sidereal_h in [0.0, 7.0, 19.0] {
            let params = StarsParams { sidereal_h, latitude_deg: 50.0, ..StarsParams::default() };
            let seen = world_from_stars(&params, &SunParams::default()).unwrap() * polaris.direction;
            assert!((seen.z.asin().to_degrees() - 50.0).abs() < 0.8, "{sidereal_h} h: {seen}");
            assert!(seen.y > 0.6 && seen.x.abs() < 0.02, "{sidereal_h} h: {seen}");
        }
    }
}

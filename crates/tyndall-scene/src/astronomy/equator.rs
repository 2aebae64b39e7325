//! From the axes of the equator to those of a place: x east, y north, z up.

use glam::{DMat3, DVec3};

use super::time::Instant;

const ARC_SECOND: f64 = std::f64::consts::PI / (180.0 * 3600.0);

/// Unit vector of a right ascension and a declination (rad).
#[must_use]
pub fn equatorial(right_ascension: f64, declination: f64) -> DVec3 {
    let (sin_ra, cos_ra) = right_ascension.sin_cos();
    let (sin_dec, cos_dec) = declination.sin_cos();
    DVec3::new(cos_ra * cos_dec, sin_ra * cos_dec, sin_dec)
}

/// Rotation from the equator of date to the place's east, north and up, for the local sidereal time and the latitude
/// (rad).
#[must_use]
pub fn world_from_equator(sidereal: f64, latitude: f64) -> DMat3 {
    let (sin_time, cos_time) = sidereal.sin_cos();
    let (sin_latitude, cos_latitude) = latitude.sin_cos();
    let east = DVec3::new(-sin_time, cos_time, 0.0);
    let north = DVec3::new(-sin_latitude * cos_time, -sin_latitude * sin_time, cos_latitude);
    DMat3::from_cols(east, north, east.cross(north)).transpose()
}

/// Precession from the equator of J2000 to that of date; Meeus 1998, formulas 21.3.
#[must_use]
pub fn date_from_j2000(instant: &Instant) -> DMat3 {
    let t = instant.centuries;
    let zeta = (2306.2181 + (0.30188 + 0.017998 * t) * t) * t * ARC_SECOND;
    let z = (2306.2181 + (1.09468 + 0.018203 * t) * t) * t * ARC_SECOND;
    let theta = (2004.3109 - (0.42665 + 0.041833 * t) * t) * t * ARC_SECOND;
    DMat3::from_rotation_z(z) * DMat3::from_rotation_y(-theta) * DMat3::from_rotation_z(zeta)
}

/// Mean obliquity of the ecliptic (rad); formula 22.2.
#[must_use]
pub fn obliquity(instant: &Instant) -> f64 {
    let t = instant.centuries;
    (23.4392911 - (46.8150 + (0.00059 - 0.001813 * t) * t) * t / 3600.0).to_radians()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pole_stands_due_north_as_high_as_the_latitude() {
        for latitude in [-0.9_f64, 0.0, 0.7] {
            let pole = world_from_equator(2.1, latitude) * DVec3::Z;
            assert!((pole - DVec3::new(0.0, latitude.cos(), latitude.sin())).length() < 1e-12, "{latitude}: {pole}");
        }
    }

    #[test]
    fn a_star_culminates_due_south_at_its_own_sidereal_time_and_was_in_the_east_before() {
        let (right_ascension, declination, latitude) = (1.2, 0.1, 0.9);
        let star = equatorial(right_ascension, declination);
        let above = world_from_equator(right_ascension, latitude) * star;
        assert!(above.x.abs() < 1e-12 && above.y < 0.0, "{above}");
        assert!((above.z - (latitude - declination).cos()).abs() < 1e-12, "{above}");
        let before = world_from_equator(right_ascension - 1.0, latitude) * star;
        assert!(before.x > 0.0, "{before}");
    }

    /// Meeus 1998, example 21.b: theta Persei, with its own motion, on 2028 November 13.19 dynamical time.
    #[test]
    fn precession_is_that_of_the_published_example() {
        let instant = Instant { julian_day: 0.0, centuries: 0.288670500 };
        let star = equatorial(41.054063_f64.to_radians(), 49.227750_f64.to_radians());
        let moved = date_from_j2000(&instant) * star;
        let right_ascension = moved.y.atan2(moved.x).to_degrees();
        assert!((right_ascension - 41.547214).abs() < 2e-5, "{right_ascension}");
        assert!((moved.z.asin().to_degrees() - 49.348483).abs() < 2e-5, "{}", moved.z.asin().to_degrees());
    }
}

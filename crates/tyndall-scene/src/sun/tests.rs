//! Published positions of the sun, and laws of its motion.

use crate::{Scene, SceneError, SunDirection, SunParams, SunPosition};

fn position(sun: SunParams) -> SunDirection {
    Scene { sun, ..Scene::default() }.sun_direction().unwrap()
}

fn by_date((year, month, day): (u32, u32, u32), time_h: f64, (latitude_deg, longitude_deg): (f64, f64)) -> SunParams {
    SunParams {
        position: SunPosition::Date,
        year,
        month,
        day,
        time_h,
        latitude_deg,
        longitude_deg,
        ..Default::default()
    }
}

#[track_caller]
fn assert_near_deg(found_rad: f64, expected_deg: f64, tolerance_deg: f64, what: &str) {
    let found_deg = found_rad.to_degrees();
    assert!((found_deg - expected_deg).abs() <= tolerance_deg, "{what}: {found_deg} deg, expected {expected_deg} deg");
}

fn nrel_example() -> SunDirection {
    let sun = by_date((2003, 10, 17), 12.0 + 30.5 / 60.0, (39.742476, -105.1786));
    position(SunParams { utc_offset_h: -7.0, ..sun })
}

/// Reda and Andreas 2004, table A5.1: elevation before refraction 39.872046 deg, azimuth 194.34024 deg. They take
/// delta T = 67 s, ours is estimated (64.6 s), which moves the sun by 3e-5 deg; their observer is at 1830 m.
#[test]
fn the_example_of_the_algorithms_paper_comes_out() {
    let sun = nrel_example();
    assert_near_deg(sun.elevation_rad, 39.872046, 5e-5, "elevation");
    assert_near_deg(sun.azimuth_rad, 194.34024, 5e-5, "azimuth");
}

/// The same table's zenith angle 50.11162 deg includes refraction, equation 42 of the paper at 820 mbar and 11 Celsius.
#[test]
fn the_examples_zenith_angle_comes_out_with_refraction_added() {
    let elevation_deg = nrel_example().elevation_rad.to_degrees();
    let cotangent_of_deg = elevation_deg + 10.3 / (elevation_deg + 5.11);
    let refraction_deg = 820.0 / 1010.0 * 283.0 / (273.0 + 11.0) * 1.02 / (60.0 * cotangent_of_deg.to_radians().tan());
    assert_near_deg((90.0 - elevation_deg - refraction_deg).to_radians(), 50.11162, 5e-5, "zenith angle");
}

/// Meeus 1998, example 25.b: 1992 October 13, 0 h dynamical time (59 s before that in universal time), declination
/// -7 deg 47' 01.74". Seen from the pole the elevation is the declination less the parallax, 8.79". The tolerance is the
/// 0.2" by which variants of that example differ and 3 s of delta T.
#[test]
fn at_the_pole_the_elevation_is_the_published_declination() {
    let sun = position(by_date((1992, 10, 12), 24.0 - 59.0 / 3600.0, (90.0, 0.0)));
    let declination_deg = -(7.0 + 47.0 / 60.0 + 1.74 / 3600.0);
    assert_near_deg(sun.elevation_rad, declination_deg - 8.79 / 3600.0, 7e-5, "elevation");
}

/// The declination is that of the June solstice, 23.44 deg, on the day's noon in Greenwich within 0.01 deg.
#[test]
fn the_midsummer_sun_culminates_at_the_complement_of_latitude_plus_obliquity() {
    // The equation of time is -1.9 minutes on that day.
    let noon = position(by_date((2026, 6, 21), 12.0 + 1.9 / 60.0, (51.4779, 0.0)));
    assert_near_deg(noon.elevation_rad, 90.0 - 51.4779 + 23.44, 0.01, "elevation");
    assert_near_deg(noon.azimuth_rad, 180.0, 0.2, "azimuth");
}

/// On 2026-03-20 the sun crosses the equator at 14:46 UTC; in half a day its declination moves by 0.2 deg.
#[test]
fn at_the_equinox_the_sun_rises_in_the_east_and_sets_in_the_west_everywhere() {
    for latitude_deg in [-50.0, 0.0, 35.0, 60.0] {
        for (clock_h, azimuth_deg) in [(6.0, 90.0), (18.0, 270.0)] {
            // 7.4 minutes: the equation of time on that day.
            let sun = position(by_date((2026, 3, 20), clock_h + 7.4 / 60.0, (latitude_deg, 0.0)));
            assert_near_deg(sun.elevation_rad, 0.0, 0.25, "elevation");
            assert_near_deg(sun.azimuth_rad, azimuth_deg, 0.25, "azimuth");
        }
    }
}

/// The two places see the sun along parallel rays: same azimuth from the east-west line, north mirrored to south.
#[test]
fn at_the_equinox_the_hemispheres_mirror_each_other() {
    let [north, south] = [40.0, -40.0].map(|latitude| position(by_date((2026, 3, 20), 14.77, (latitude, 0.0))).unit());
    let mirrored = glam::DVec3::new(south.x, -south.y, south.z);
    // Declination and parallax, each a few arc seconds, act the same way on both.
    assert!(north.angle_between(mirrored) < 2e-4, "{north} {mirrored}");
}

#[test]
fn the_sun_turns_by_fifteen_degrees_an_hour_at_the_equinox() {
    for hour in 0..23 {
        let [now, later] =
            [hour, hour + 1].map(|h| position(by_date((2026, 3, 20), f64::from(h), (35.0, 20.0))).unit());
        // 8.8 arc seconds of parallax and the change of the equation of time.
        assert_near_deg(now.angle_between(later), 15.0, 0.01, "turn in an hour");
    }
}

#[test]
fn a_clock_ahead_of_utc_shows_the_same_sun_later() {
    let utc = by_date((2026, 2, 28), 20.0, (47.0, 8.0));
    let ahead = SunParams { month: 3, day: 1, time_h: 1.5, utc_offset_h: 5.5, ..utc.clone() };
    // The estimate of delta T is by month: 0.01 s, or 1e-7 rad at the most.
    let (utc, ahead) = (position(utc), position(ahead));
    assert!(utc.unit().angle_between(ahead.unit()) < 1e-7, "{utc:?} {ahead:?}");
}

#[test]
fn angles_are_taken_as_they_are() {
    let sun = position(SunParams { elevation_deg: 30.0, azimuth_deg: 90.0, ..SunParams::default() });
    let expected = glam::DVec3::new(0.75_f64.sqrt(), 0.0, 0.5);
    assert!((sun.unit() - expected).length() < 1e-15, "{}", sun.unit());
}

#[test]
fn dates_that_do_not_exist_are_refused_with_the_days_of_their_month() {
    for ((year, month, day), days) in
        [((2026, 2, 31), 28), ((2024, 2, 30), 29), ((1900, 2, 29), 28), ((2000, 2, 30), 29), ((2026, 4, 31), 30)]
    {
        let scene = Scene { sun: by_date((year, month, day), 12.0, (0.0, 0.0)), ..Scene::default() };
        let error = scene.check().unwrap_err();
        assert!(matches!(error, SceneError::Day { days: found, .. } if found == days), "{error}");
        assert_eq!(error.field().as_deref(), Some("sun.day"), "{error}");
    }
}

#[test]
fn every_allowed_year_and_clock_has_a_sun() {
    for year in [1600, 1972, 2026, 2999] {
        for (time_h, utc_offset_h) in [(0.0, 14.0), (24.0, -12.0)] {
            let sun = by_date((year, 12, 31), time_h, (-33.0, 151.0));
            let unit = position(SunParams { utc_offset_h, ..sun }).unit();
            assert!((unit.length() - 1.0).abs() < 1e-12, "{year} {time_h}: {unit}");
        }
    }
}

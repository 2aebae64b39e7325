//! The moon's geocentric place; Meeus, Astronomical Algorithms, 1998, chapter 47, the larger terms of tables 47.A and B.

use super::time::Instant;

/// Multiples of D, M, M' and F, and the terms of longitude (1e-6 deg) and distance (m).
const LONGITUDE_AND_DISTANCE: [([f64; 4], f64, f64); 32] = [
    ([0.0, 0.0, 1.0, 0.0], 6288774.0, -20905355.0),
    ([2.0, 0.0, -1.0, 0.0], 1274027.0, -3699111.0),
    ([2.0, 0.0, 0.0, 0.0], 658314.0, -2955968.0),
    ([0.0, 0.0, 2.0, 0.0], 213618.0, -569925.0),
    ([0.0, 1.0, 0.0, 0.0], -185116.0, 48888.0),
    ([0.0, 0.0, 0.0, 2.0], -114332.0, -3149.0),
    ([2.0, 0.0, -2.0, 0.0], 58793.0, 246158.0),
    ([2.0, -1.0, -1.0, 0.0], 57066.0, -152138.0),
    ([2.0, 0.0, 1.0, 0.0], 53322.0, -170733.0),
    ([2.0, -1.0, 0.0, 0.0], 45758.0, -204586.0),
    ([0.0, 1.0, -1.0, 0.0], -40923.0, -129620.0),
    ([1.0, 0.0, 0.0, 0.0], -34720.0, 108743.0),
    ([0.0, 1.0, 1.0, 0.0], -30383.0, 104755.0),
    ([2.0, 0.0, 0.0, -2.0], 15327.0, 10321.0),
    ([0.0, 0.0, 1.0, 2.0], -12528.0, 0.0),
    ([0.0, 0.0, 1.0, -2.0], 10980.0, 79661.0),
    ([4.0, 0.0, -1.0, 0.0], 10675.0, -34782.0),
    ([0.0, 0.0, 3.0, 0.0], 10034.0, -23210.0),
    ([4.0, 0.0, -2.0, 0.0], 8548.0, -21636.0),
    ([2.0, 1.0, -1.0, 0.0], -7888.0, 24208.0),
    ([2.0, 1.0, 0.0, 0.0], -6766.0, 30824.0),
    ([1.0, 0.0, -1.0, 0.0], -5163.0, -8379.0),
    ([1.0, 1.0, 0.0, 0.0], 4987.0, -16675.0),
    ([2.0, -1.0, 1.0, 0.0], 4036.0, -12831.0),
    ([2.0, 0.0, 2.0, 0.0], 3994.0, -10445.0),
    ([4.0, 0.0, 0.0, 0.0], 3861.0, -11650.0),
    ([2.0, 0.0, -3.0, 0.0], 3665.0, 14403.0),
    ([0.0, 1.0, -2.0, 0.0], -2689.0, -7003.0),
    ([2.0, 0.0, -1.0, 2.0], -2602.0, 0.0),
    ([2.0, -1.0, -2.0, 0.0], 2390.0, 10056.0),
    ([1.0, 0.0, 1.0, 0.0], -2348.0, 6322.0),
    ([2.0, -2.0, 0.0, 0.0], 2236.0, -9884.0),
];

/// Multiples of D, M, M' and F, and the terms of latitude (1e-6 deg).
const LATITUDE: [([f64; 4], f64); 23] = [
    ([0.0, 0.0, 0.0, 1.0], 5128122.0),
    ([0.0, 0.0, 1.0, 1.0], 280602.0),
    ([0.0, 0.0, 1.0, -1.0], 277693.0),
    ([2.0, 0.0, 0.0, -1.0], 173237.0),
    ([2.0, 0.0, -1.0, 1.0], 55413.0),
    ([2.0, 0.0, -1.0, -1.0], 46271.0),
    ([2.0, 0.0, 0.0, 1.0], 32573.0),
    ([0.0, 0.0, 2.0, 1.0], 17198.0),
    ([2.0, 0.0, 1.0, -1.0], 9266.0),
    ([0.0, 0.0, 2.0, -1.0], 8822.0),
    ([2.0, -1.0, 0.0, -1.0], 8216.0),
    ([2.0, 0.0, -2.0, -1.0], 4324.0),
    ([2.0, 0.0, 1.0, 1.0], 4200.0),
    ([2.0, 1.0, 0.0, -1.0], -3359.0),
    ([2.0, -1.0, -1.0, 1.0], 2463.0),
    ([2.0, -1.0, 0.0, 1.0], 2211.0),
    ([2.0, -1.0, -1.0, -1.0], 2065.0),
    ([0.0, 1.0, -1.0, -1.0], -1870.0),
    ([4.0, 0.0, -1.0, -1.0], 1828.0),
    ([0.0, 1.0, 0.0, 1.0], -1794.0),
    ([0.0, 0.0, 0.0, 3.0], -1749.0),
    ([0.0, 1.0, -1.0, 1.0], -1565.0),
    ([1.0, 0.0, 0.0, 1.0], -1491.0),
];

/// Mean distance (m) to which the terms are added.
const MEAN_DISTANCE_M: f64 = 385_000_560.0;

/// The moon seen from the centre of the earth, in the ecliptic of date.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MoonPlace {
    /// Ecliptic longitude (rad).
    pub longitude: f64,
    /// Ecliptic latitude (rad).
    pub latitude: f64,
    /// Distance of the centres (m).
    pub distance_m: f64,
}

/// The moon at an instant.
#[must_use]
pub fn moon_place(instant: &Instant) -> MoonPlace {
    let t = instant.centuries;
    let angle = |at_epoch: f64, per_century: f64, squared: f64| {
        (at_epoch + (per_century + squared * t) * t).rem_euclid(360.0).to_radians()
    };
    let mean_longitude = angle(218.3164477, 481267.88123421, -0.0015786);
    let arguments = [
        angle(297.8501921, 445267.1114034, -0.0018819),
        angle(357.5291092, 35999.0502909, -0.0001536),
        angle(134.9633964, 477198.8675055, 0.0087414),
        angle(93.2720950, 483202.0175233, -0.0036539),
    ];
    // The sun's eccentricity shrinks: terms with M fade with it.
    let eccentricity = 1.0 - (0.002516 + 0.0000074 * t) * t;
    let phase =
        |multiples: &[f64; 4]| multiples.iter().zip(arguments).map(|(multiple, angle)| multiple * angle).sum::<f64>();
    let fade = |multiples: &[f64; 4]| eccentricity.powf(multiples[1].abs());
    let venus = angle(119.75, 131.849, 0.0);
    let sum: f64 = LONGITUDE_AND_DISTANCE.iter().map(|(by, term, _)| term * fade(by) * phase(by).sin()).sum();
    let longitude = sum + 3958.0 * venus.sin() + 1962.0 * (mean_longitude - arguments[3]).sin();
    let latitude: f64 = LATITUDE.iter().map(|(by, term)| term * fade(by) * phase(by).sin()).sum();
    let distance: f64 = LONGITUDE_AND_DISTANCE.iter().map(|(by, _, term)| term * fade(by) * phase(by).cos()).sum();
    MoonPlace {
        longitude: mean_longitude + (longitude * 1e-6).to_radians(),
        latitude: ((latitude - 2235.0 * mean_longitude.sin()) * 1e-6).to_radians(),
        distance_m: MEAN_DISTANCE_M + distance,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Meeus 1998, example 47.a: 1992 April 12, 0 h dynamical time.
    #[test]
    fn the_moon_of_the_published_example_is_found_within_a_hundredth_of_a_degree() {
        let instant = Instant { julian_day: 2448724.5, centuries: -0.077221081451 };
        let found = moon_place(&instant);
        let (longitude, latitude) = (found.longitude.to_degrees().rem_euclid(360.0), found.latitude.to_degrees());
        println!("moon: {longitude:.4} {latitude:.4} deg, {:.0} km", found.distance_m / 1e3);
        assert!((longitude - 133.162655).abs() < 0.01, "longitude {longitude}");
        assert!((latitude + 3.229126).abs() < 0.01, "latitude {latitude}");
        assert!((found.distance_m - 368_409_700.0).abs() < 100_000.0, "distance {} m", found.distance_m);
    }
}

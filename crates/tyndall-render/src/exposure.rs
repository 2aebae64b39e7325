//! Exposure values.
//!
//! EV100 is the exposure value at ISO 100. A radiance L is shown as white when L = 1.2 x 2^EV100 cd/m^2 (saturation-based
//! sensitivity, ISO 12232); an average of 0.125 x 2^EV100 cd/m^2 is metered as EV100 (ISO 2720, K = 12.5).

/// Luminance (cd/m^2) that becomes white, per 2^EV100.
const WHITE_CD_M2: f64 = 1.2;

/// How far the sun's elevation (deg) sets the light of a clear day (EV100); the guess behind the pre-exposure.
const LIGHT_OF_DAY: [(f64, f64); 6] =
    [(-18.0, -3.0), (-12.0, -1.0), (-6.0, 5.0), (0.0, 11.5), (20.0, 15.0), (90.0, 15.5)];

/// Exposed value per radiance [1/(cd/m^2)] of an exposure value.
#[must_use]
pub fn gain_from_ev100(ev100: f64) -> f64 {
    1.0 / (WHITE_CD_M2 * ev100.exp2())
}

/// Exposure value of a gain; the inverse of [`gain_from_ev100`].
#[must_use]
pub fn ev100_from_gain(gain: f64) -> f64 {
    -(WHITE_CD_M2 * gain).log2()
}

/// A guess at the exposure before anything is drawn: that of a clear day with the sun at this elevation (rad). It only has
/// to keep the frame within the range of half floats, the full moon's disc of 5000 cd/m^2 in the darkest night included, so
/// that it does not follow the exposure that a user sets.
#[must_use]
pub fn expected_ev100(sun_elevation_rad: f64) -> f64 {
    daylight_ev100(sun_elevation_rad.to_degrees())
}

/// Exposure value of a clear day with the sun at this elevation (deg).
pub(crate) fn daylight_ev100(elevation_deg: f64) -> f64 {
    let [first, .., last] = LIGHT_OF_DAY;
    let clamped = elevation_deg.clamp(first.0, last.0);
    let pair = LIGHT_OF_DAY.windows(2).find(|pair| clamped <= pair[1].0);
    pair.map_or(last.1, |pair| {
        let share = (clamped - pair[0].0) / (pair[1].0 - pair[0].0);
        pair[0].1 + share * (pair[1].1 - pair[0].1)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gain_and_exposure_value_are_inverse_and_one_stop_halves() {
        for ev100 in [-4.0, 0.0, 9.3, 15.0] {
            assert!((ev100_from_gain(gain_from_ev100(ev100)) - ev100).abs() < 1e-12, "{ev100}");
            let ratio = gain_from_ev100(ev100) / gain_from_ev100(ev100 + 1.0);
            assert!((ratio - 2.0).abs() < 1e-12, "{ratio}");
        }
    }

    #[test]
    fn the_expected_exposure_rises_with_the_sun_and_has_no_jumps() {
        let mut before = expected_ev100(-1.6);
        for step in 0..3200 {
            let here = expected_ev100(-1.6 + 0.001 * f64::from(step));
            assert!(here >= before && here - before < 0.1, "step {step}: {before} {here}");
            before = here;
        }
    }
}

//! Where crests are expected to run under a set of winds.
//!
//! Angles anticlockwise from +x; crests modulo 180. Winds act by the sand that they move (their share).

use crate::wind::Wind;

/// Gain of the flux over a crest, gamma: Gao et al. 2015.
pub const FLUX_UP_RATIO: f64 = 1.6;

/// Steps of the search before it is refined: a degree each.
const SEARCH: u32 = 180;

/// Crest direction (deg) of greatest gross transport across it (Rubin and Hunter 1987): maximises the sum of
/// `share |sin(toward - crest)|`. `None` without wind.
///
/// Two winds: the crest is normal to their sum below 90 degrees of divergence, to their difference above; at 90 degrees
/// there is a tie.
#[must_use]
pub fn gross_bedform_normal_deg(winds: &[Wind]) -> Option<f64> {
    best_direction(winds, |across, _| across.abs())
}

/// Crest direction (deg) of fastest growth where sand covers the ground, with flux-up: maximises the sum of
/// `share (|s| + gamma s^2)`, s = sin(toward - crest); Courrech du Pont et al. 2014. `None` without wind.
#[must_use]
pub fn bed_instability_deg(winds: &[Wind]) -> Option<f64> {
    best_direction(winds, |across, _| across.abs() + FLUX_UP_RATIO * across * across)
}

/// Direction (deg, 0 to 360) in which dunes grow long where sand is scarce: along the flux at their own crest;
/// Courrech du Pont et al. 2014. `None` without wind or when the winds cancel.
#[must_use]
pub fn elongation_deg(winds: &[Wind]) -> Option<f64> {
    let flux = |crest_deg: f64| {
        winds.iter().fold([0.0, 0.0], |[x, y], wind| {
            let across = (wind.toward_deg - crest_deg).to_radians().sin().abs();
            let (sin, cos) = wind.toward_deg.to_radians().sin_cos();
            let amount = wind.share * (1.0 + FLUX_UP_RATIO * across);
            [x + amount * cos, y + amount * sin]
        })
    };
    let off = |crest_deg: f64| {
        let [x, y] = flux(crest_deg);
        let (sin, cos) = crest_deg.to_radians().sin_cos();
        [x * cos + y * sin, y * cos - x * sin]
    };
    // The crest whose own flux runs along it, forwards: where the flux across changes sign downwards.
    let at = |index: u32| f64::from(index) * 360.0 / 720.0;
    let brackets = (0..720).map(|index| (at(index), at(index + 1)));
    let roots = brackets.filter(|&(low, high)| off(low)[1] >= 0.0 && off(high)[1] < 0.0);
    let along = |root: f64| off(root)[0];
    let found = roots.map(|(low, high)| bisect(low, high, |angle| off(angle)[1] >= 0.0));
    found
        .filter(|&root| along(root) > 1e-9)
        .max_by(|&a, &b| along(a).total_cmp(&along(b)))
        .map(|deg| deg.rem_euclid(360.0))
}

fn bisect(mut low: f64, mut high: f64, is_low: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if is_low(middle) { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// The direction that maximises the sum of `share growth(sin, cos)`, modulo 180.
fn best_direction(winds: &[Wind], growth: impl Fn(f64, f64) -> f64) -> Option<f64> {
    let value = |crest_deg: f64| {
        let each = |wind: &Wind| {
            let (sin, cos) = (wind.toward_deg - crest_deg).to_radians().sin_cos();
            wind.share * growth(sin, cos)
        };
        winds.iter().map(each).sum::<f64>()
    };
    if winds.iter().all(|wind| wind.share <= 0.0) {
        return None;
    }
    let angles = (0..SEARCH).map(f64::from);
    let coarse = angles.max_by(|&a, &b| value(a).total_cmp(&value(b)))?;
    // Golden section on the one maximum around it.
    let shrink = 0.5 * (5f64.sqrt() - 1.0);
    let (mut low, mut high) = (coarse - 1.0, coarse + 1.0);
    for _ in 0..60 {
        let (a, b) = (high - shrink * (high - low), low + shrink * (high - low));
        if value(a) < value(b) { low = a } else { high = b }
    }
    Some((0.5 * (low + high)).rem_euclid(180.0))
}

/// Difference of two crest directions, 0 to 90 (deg).
#[must_use]
pub fn crest_difference_deg(a_deg: f64, b_deg: f64) -> f64 {
    ((a_deg - b_deg + 90.0).rem_euclid(180.0) - 90.0).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two(ratio: f64, divergence_deg: f64) -> [Wind; 2] {
        [Wind { toward_deg: 0.0, share: ratio }, Wind { toward_deg: divergence_deg, share: 1.0 }]
    }

    #[test]
    fn predictions_are_those_of_the_table() {
        let table = include_str!("../tests/data/two_wind_orientation.csv");
        for line in table.lines().filter(|line| !line.starts_with('#')).skip(1) {
            let cells: Vec<Option<f64>> = line.split(',').map(|cell| cell.parse().ok()).collect();
            let (Some(ratio), Some(divergence)) = (cells[0], cells[1]) else { panic!("two numbers: {line}") };
            let winds = two(ratio, divergence);
            let found = [gross_bedform_normal_deg(&winds), bed_instability_deg(&winds)];
            for (what, found, expected) in [("gross", found[0], cells[4]), ("instability", found[1], cells[6])] {
                let off = crest_difference_deg(found.unwrap(), expected.unwrap());
                // The table is rounded to 0.01 deg.
                assert!(off < 0.011, "{what}, R {ratio}, {divergence} deg: {found:?} of {expected:?}");
            }
            if let Some(expected) = cells[7] {
                let found = elongation_deg(&winds).unwrap();
                assert!(
                    (found - expected).abs() < 0.011,
                    "elongation, R {ratio}, {divergence} deg: {found} of {expected}"
                );
            }
        }
    }

    #[test]
    fn two_winds_follow_the_closed_form_for_any_ratio() {
        for ratio in [0.3, 1.0, 1.7, 5.0] {
            for divergence in [10.0f64, 40.0, 80.0, 100.0, 130.0, 170.0] {
                let (sin, cos) = divergence.to_radians().sin_cos();
                let sign = if divergence < 90.0 { 1.0 } else { -1.0 };
                let normal_deg = (sign * sin).atan2(ratio + sign * cos).to_degrees();
                let found = gross_bedform_normal_deg(&two(ratio, divergence)).unwrap();
                assert!(crest_difference_deg(found, normal_deg + 90.0) < 1e-5, "R {ratio}, {divergence} deg: {found}");
            }
        }
    }

    #[test]
    fn without_wind_there_is_no_direction() {
        let calm = [Wind { toward_deg: 10.0, share: 0.0 }];
        assert_eq!(gross_bedform_normal_deg(&calm), None, "no crest");
        assert_eq!(elongation_deg(&two(1.0, 180.0)), None, "opposite winds cancel");
    }
}

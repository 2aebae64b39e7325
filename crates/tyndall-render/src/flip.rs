//! How different two pictures look to somebody who flips between them: LDR-FLIP.
//!
//! Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström and Fairchild, "FLIP: A Difference Evaluator for Alternating Images"
//! (2020). Both pictures are blurred as the eye blurs them at a distance (section 4.1: contrast sensitivity in `YyCxCz`), compared
//! in a space where distances are seen alike (`HyAB` in CIELAB with Hunt's adjustment), and the difference is amplified where edges
//! and points come or go (section 4.2). 0 is equal, 1 black beside white.
//!
//! Takes linear Rec.709 in 0..1: a scene's light has to be tone-mapped before. Agrees with the authors' program to four
//! digits (tested). Not done: HDR-FLIP, which takes the worst of many exposures.

mod colour;
mod filters;

use rayon::prelude::*;

use colour::{hunt_lab, hyab, linear_from_ycxcz, ycxcz_from_linear};
use filters::{FeatureFilters, Kernel, Plane, sensitivity_kernels};

/// Pixels a degree of view that the authors assume: 0.7 m before a screen 0.7 m and 3840 px wide.
pub const PIXELS_PER_DEGREE: f64 = 3840.0 * std::f64::consts::PI / 180.0;

/// Exponent of differences of colour.
const COLOUR_POWER: f64 = 0.7;
/// Exponent of differences of features.
const FEATURE_POWER: f64 = 0.5;
/// Share of the largest difference up to which errors are spread over ...
const SMALL_SHARE: f64 = 0.4;
/// ... this share of the result's range.
const SMALL_RANGE: f64 = 0.95;

/// A difference in 0..1 for each pixel of two pictures, `width_px` wide, in linear Rec.709; values beyond 0..1 count as the
/// nearest within. Pictures of different size are compared as far as both reach.
#[must_use]
pub fn flip(reference: &[[f64; 3]], test: &[[f64; 3]], width_px: usize, pixels_per_degree: f64) -> Vec<f64> {
    let width = width_px.max(1);
    let count = reference.len().min(test.len()) / width * width;
    let sides = [&reference[..count], &test[..count]].map(|picture| Seen::new(picture, width, pixels_per_degree));
    let largest = hyab(hunt_lab([0.0, 1.0, 0.0]), hunt_lab([0.0, 0.0, 1.0])).powf(COLOUR_POWER);
    let [reference, test] = &sides;
    (0..count)
        .into_par_iter()
        .map(|pixel| {
            let colour = spread(hyab(reference.lab[pixel], test.lab[pixel]).powf(COLOUR_POWER), largest);
            let apart = |a: &Plane, b: &Plane| (a.values[pixel] - b.values[pixel]).abs();
            let feature = apart(&reference.edges, &test.edges).max(apart(&reference.points, &test.points));
            let feature = (feature / 2.0_f64.sqrt()).powf(FEATURE_POWER).clamp(0.0, 1.0);
            colour.powf(1.0 - feature)
        })
        .collect()
}

/// The mean of [`flip`] at [`PIXELS_PER_DEGREE`]; 0 without pixels.
#[must_use]
pub fn mean_flip(reference: &[[f64; 3]], test: &[[f64; 3]], width_px: usize) -> f64 {
    let map = flip(reference, test, width_px, PIXELS_PER_DEGREE);
    map.iter().sum::<f64>() / map.len().max(1) as f64
}

/// What is seen of a picture.
struct Seen {
    /// Blurred colours, in CIELAB after Hunt.
    lab: Vec<[f64; 3]>,
    edges: Plane,
    points: Plane,
}

impl Seen {
    fn new(picture: &[[f64; 3]], width: usize, pixels_per_degree: f64) -> Self {
        let opponent: Vec<[f64; 3]> =
            picture.par_iter().map(|rgb| ycxcz_from_linear(rgb.map(|value| value.clamp(0.0, 1.0)))).collect();
        let plane = |channel: usize, scale: fn(f64) -> f64| Plane {
            width,
            values: opponent.iter().map(|colour| scale(colour[channel])).collect(),
        };
        let kernels = sensitivity_kernels(pixels_per_degree);
        let blurred = [0, 1, 2].map(|channel| {
            let channel_plane = plane(channel, |value| value);
            let parts =
                kernels[channel].iter().map(|(weight, kernel)| (*weight, channel_plane.filtered(kernel, kernel)));
            parts.fold(vec![0.0; opponent.len()], |mut sum, (weight, part)| {
                sum.iter_mut().zip(&part.values).for_each(|(sum, value)| *sum += weight * value);
                sum
            })
        });
        let lab = |pixel: usize| {
            let seen = [0, 1, 2].map(|channel: usize| blurred[channel][pixel]);
            hunt_lab(linear_from_ycxcz(seen).map(|value| value.clamp(0.0, 1.0)))
        };
        let lightness = plane(0, |y| (y + 16.0) / 116.0);
        let filters = FeatureFilters::new(pixels_per_degree);
        let strength = |kernel: &Kernel| {
            let across = lightness.filtered(kernel, &filters.smooth);
            let along = lightness.filtered(&filters.smooth, kernel);
            let values = across.values.iter().zip(&along.values).map(|(x, y)| x.hypot(*y)).collect();
            Plane { width, values }
        };
        Self {
            lab: (0..opponent.len()).into_par_iter().map(lab).collect(),
            edges: strength(&filters.edge),
            points: strength(&filters.point),
        }
    }
}

/// Spreads differences over 0..1, small ones over most of it.
fn spread(difference: f64, largest: f64) -> f64 {
    let knee = SMALL_SHARE * largest;
    if difference < knee {
        SMALL_RANGE / knee * difference
    } else {
        SMALL_RANGE + (difference - knee) / (largest - knee) * (1.0 - SMALL_RANGE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values in 0..1 that look like noise and are the same everywhere.
    fn noise(count: usize, seed: u32) -> Vec<f64> {
        let mut state = seed;
        let next = |_| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / 16_777_216.0
        };
        (0..count).map(next).collect()
    }

    fn picture(seed: u32) -> Vec<[f64; 3]> {
        noise(3 * 24 * 16, seed).as_chunks().0.to_vec()
    }

    fn even(rgb: [f64; 3]) -> Vec<[f64; 3]> {
        vec![rgb; 24 * 16]
    }

    #[test]
    fn equal_pictures_do_not_differ_and_black_beside_white_differs_fully() {
        let grain = picture(7);
        assert!(
            flip(&grain, &grain, 24, PIXELS_PER_DEGREE).iter().all(|value| value.abs() < 1e-12),
            "the same picture"
        );
        let found = mean_flip(&even([0.0; 3]), &even([1.0; 3]), 24);
        // 100 in lightness, not the 200 of green beside blue that fills the scale.
        assert!(found > 0.9 && found <= 1.0, "black beside white: {found}");
        let opposite = mean_flip(&even([0.0, 1.0, 0.0]), &even([0.0, 0.0, 1.0]), 24);
        assert!((opposite - 1.0).abs() < 1e-9, "green beside blue is the largest difference: {opposite}");
    }

    #[test]
    fn either_picture_may_be_the_reference() {
        let (a, b) = (picture(1), picture(2));
        let (there, back) = (mean_flip(&a, &b, 24), mean_flip(&b, &a, 24));
        assert!((there - back).abs() < 1e-12, "{there} and {back}");
        assert!(there > 0.01, "they do differ: {there}");
    }

    #[test]
    fn larger_errors_are_seen_more_and_fine_patterns_less() {
        let grey = even([0.2; 3]);
        let with = |step: usize, height: f64| -> Vec<[f64; 3]> {
            let pixel = |index: usize| [0.2 + if (index % 24 / step).is_multiple_of(2) { height } else { -height }; 3];
            (0..grey.len()).map(pixel).collect()
        };
        let found = |step, height| mean_flip(&grey, &with(step, height), 24);
        assert!(found(4, 0.1) > found(4, 0.05) && found(4, 0.05) > found(4, 0.01), "higher steps");
        assert!(found(1, 0.05) < 0.5 * found(4, 0.05), "pixels from afar: {} {}", found(1, 0.05), found(4, 0.05));
        let near = flip(&grey, &with(1, 0.05), 24, 20.0).iter().sum::<f64>() / 384.0;
        assert!(near > found(1, 0.05), "from nearby: {near}");
    }

    #[test]
    fn the_means_are_those_of_the_authors_program() {
        let line: Vec<[f64; 3]> = (0..384).map(|index| [if index % 24 == 12 { 0.9 } else { 0.1 }; 3]).collect();
        let ramp: Vec<[f64; 3]> = (0..384).map(|index| [0.3, f64::from(index % 24) / 24.0, 0.6]).collect();
        // From flip-evaluator 1.7, which counts in 32 bits and has a white that differs in the fifth digit.
        let cases = [
            ("noise", picture(1), picture(2), 0.426_898),
            ("a line", even([0.1; 3]), line, 0.134_370),
            ("a ramp", ramp, even([0.3, 0.5, 0.6]), 0.710_121),
            ("greys", even([0.2; 3]), even([0.25; 3]), 0.183_436),
        ];
        for (name, reference, test, wanted) in cases {
            let found = mean_flip(&reference, &test, 24);
            assert!((found - wanted).abs() < 1e-4, "{name}: {found}, the authors' {wanted}");
        }
    }

    #[test]
    fn what_only_one_picture_has_is_not_compared() {
        assert!(flip(&[], &picture(1), 24, PIXELS_PER_DEGREE).is_empty(), "no pixels");
        assert_eq!(flip(&picture(1)[..60], &picture(1), 24, PIXELS_PER_DEGREE).len(), 48, "two whole rows");
        assert!(mean_flip(&[], &[], 24).abs() < 1e-300, "nothing differs from nothing");
    }
}

//! The sun pass: how much cloud lies between the light and each ball.
//!
//! The paper draws the balls into a buffer as the sun sees them, near to far, and reads at each ball's centre what is left of
//! the light: once a ball, back to the processor. In the logarithm that is a sum, the optical depth of the columns between
//! the light and the centre; here every ball adds them up, from a list of those that lie on its way. Columns end exactly at
//! the centre, where the paper takes each ball whole or not at all, so that no order among balls at equal distance matters.

use rayon::prelude::*;

use super::bins::{Bins, Disc, LightAxes};
use super::column::{column, column_to, column_to_by_u, field};
use crate::error::{CloudError, in_range};
use crate::metaballs::Metaball;

/// Optical depths on the line through a ball's centre along the light.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BallDepth {
    /// Of other balls between the light and the centre: what a light buffer holds *before* the ball's own splat.
    pub before: f32,
    /// Of the ball itself, its whole column; half of it lies before the centre.
    pub own: f32,
    /// Of other balls behind the centre.
    pub behind: f32,
    /// How the depth towards the light changes about the centre (1/m), the ball itself included: east, north, up.
    pub gradient_per_m: [f32; 3],
}

/// Optical depths from the light for each of `balls`, which stand in the shadow of each other and of `neighbours`.
/// `to_light` points east, north and up; its length does not matter.
///
/// # Errors
/// When `to_light` is zero or not finite.
pub fn ball_depths(
    balls: &[Metaball],
    neighbours: &[Metaball],
    to_light: [f64; 3],
) -> Result<Vec<BallDepth>, CloudError> {
    let length = to_light.iter().map(|part| part * part).sum::<f64>().sqrt();
    in_range("length of the direction to the light", length, (1e-100, 1e100), "")?;
    let axes = LightAxes::new(middle(balls), to_light.map(|part| part / length));
    let discs: Vec<_> = balls.iter().chain(neighbours).map(|ball| axes.disc(ball)).collect();
    let bins = Bins::new(&discs);
    Ok(discs[..balls.len()].par_iter().map(|disc| depth_of(disc, bins.near(disc.place), &axes)).collect())
}

/// Middle of the balls' centres, so that places are small numbers.
pub(super) fn middle(balls: &[Metaball]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for ball in balls {
        for (sum, place) in sum.iter_mut().zip(ball.centre_m) {
            *sum += f64::from(place);
        }
    }
    sum.map(|sum| sum / balls.len().max(1) as f64)
}

fn depth_of(disc: &Disc, others: &[Disc], axes: &LightAxes) -> BallDepth {
    let (mut before, mut whole, mut gradient) = (0.0_f32, 0.0_f32, [0.0_f32; 3]);
    for other in others {
        let apart = [0, 1].map(|axis| (other.place[axis] - disc.place[axis]) * other.per_radius);
        let u = 1.0 - apart[0] * apart[0] - apart[1] * apart[1];
        if u > 0.0 {
            let s = (other.toward - disc.toward) * other.per_radius;
            whole += other.peak * column(u);
            before += other.peak * column_to(u, s);
            let steepness = other.peak * other.per_radius;
            let across = 2.0 * steepness * column_to_by_u(u, s);
            gradient[0] += across * apart[0];
            gradient[1] += across * apart[1];
            gradient[2] -= steepness * field(u, s);
        }
    }
    // The ball itself is among the others, half of it on either side. Its own field falls off before its rim: half of it in
    // the middle is its mean slope.
    let own = disc.peak * column(1.0);
    gradient[2] += 0.5 * disc.peak * disc.per_radius;
    let before = (before - 0.5 * own).max(0.0);
    BallDepth { before, own, behind: (whole - own - before).max(0.0), gradient_per_m: axes.world(gradient) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ball(x: f32, y: f32, z: f32) -> Metaball {
        Metaball { centre_m: [x, y, z], radius_m: 2.0, extinction_per_m: 0.5 }
    }

    #[test]
    fn balls_in_a_row_have_those_before_and_behind_and_their_own() {
        let row = [ball(0.0, 0.0, 0.0), ball(5.0, 0.0, 0.0), ball(10.0, 0.0, 0.0), ball(40.0, 3.0, 0.0)];
        let one = 0.998_941_8_f32;
        for (to_light, order) in [([1.0, 0.0, 0.0], [2.0, 1.0, 0.0, 0.0]), ([-3.0, 0.0, 0.0], [0.0, 1.0, 2.0, 0.0])] {
            let depths = ball_depths(&row, &[], to_light).unwrap();
            for (depth, before) in depths.iter().zip(order) {
                assert!((depth.before - before * one).abs() < 1e-5, "{to_light:?}: {depths:?}");
                assert!((depth.own - one).abs() < 1e-6, "{depths:?}");
            }
            let behind = depths[1].behind;
            assert!((behind - one).abs() < 1e-5, "{behind}");
        }
    }

    #[test]
    fn depths_are_the_integral_of_the_others_extinction_up_to_the_centre() {
        let balls: Vec<_> = (0..60_u8)
            .map(|i| Metaball {
                centre_m: [i % 5, i % 7, i % 11].map(f32::from),
                radius_m: 1.5 + f32::from(i % 3),
                extinction_per_m: 0.1 + f32::from(i % 4) / 10.0,
            })
            .collect();
        let to_light = [0.36, -0.48, 0.8];
        let depths = ball_depths(&balls, &[], to_light).unwrap();
        for index in [0, 17, 41] {
            let others = crate::Metaballs {
                balls: balls.iter().enumerate().filter(|(other, _)| *other != index).map(|(_, ball)| *ball).collect(),
            };
            let count = 4000;
            let step = 20.0 / f64::from(count);
            let along = |sign: f64| -> f64 {
                let at = |i: i32| {
                    let t = sign * (f64::from(i) + 0.5) * step;
                    [0, 1, 2].map(|axis| f64::from(balls[index].centre_m[axis]) + t * to_light[axis])
                };
                (0..count).map(|i| others.extinction_per_m(at(i)) * step).sum()
            };
            for (found, wanted) in [(depths[index].before, along(1.0)), (depths[index].behind, along(-1.0))] {
                assert!((f64::from(found) - wanted).abs() < 1e-4, "ball {index}: {found} {wanted}");
            }
        }
    }

    #[test]
    fn neighbours_throw_shadows_and_are_not_lit() {
        let depths = ball_depths(&[ball(0.0, 0.0, 0.0)], &[ball(0.0, 0.0, 9.0)], [0.0, 0.0, 1.0]).unwrap();
        assert_eq!(depths.len(), 1, "one ball is lit");
        assert!((depths[0].before - 0.998_941_8).abs() < 1e-5, "{depths:?}");
    }

    #[test]
    fn a_light_without_direction_is_refused() {
        let text = ball_depths(&[], &[], [0.0; 3]).unwrap_err().to_string();
        assert!(text.starts_with("length of the direction to the light = 0 is outside"), "{text}");
    }
}

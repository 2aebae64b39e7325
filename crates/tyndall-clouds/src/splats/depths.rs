//! The sun pass: how much cloud lies between the light and each ball.
//!
//! The paper draws the balls into a buffer as the sun sees them, near to far, and reads at each ball's centre what is left of
//! the light: once a ball, back to the processor. In the logarithm that is a sum, the optical depth of the columns between
//! the light and the centre; here every ball adds them up, from a list of those that lie on its way. Columns end exactly at
//! the centre, where the paper takes each ball whole or not at all, so that no order among balls at equal distance matters.
//! Balls on the way are taken eight at a time, with a sum for each of the eight places: the same bits on every processor.
#![expect(clippy::inline_always, reason = "only what is inlined is compiled for the processor's wider instructions")]

use rayon::prelude::*;

use super::bins::{Bins, Disc, DiscGroup, LANES, LightAxes};
use super::column::{column, column_to, column_to_by_u, field};
use crate::error::{CloudError, in_range};
use crate::metaballs::Metaball;

/// Balls that one task lights.
const BALLS_PER_TASK: usize = 256;

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
    depths(balls, neighbours, (to_light, true))
}

/// [`ball_depths`] with gradients that are 0, in about half of the time.
pub(super) fn ball_depths_alone(
    balls: &[Metaball],
    neighbours: &[Metaball],
    to_light: [f64; 3],
) -> Result<Vec<BallDepth>, CloudError> {
    depths(balls, neighbours, (to_light, false))
}

fn depths(
    balls: &[Metaball],
    neighbours: &[Metaball],
    (to_light, with_gradient): ([f64; 3], bool),
) -> Result<Vec<BallDepth>, CloudError> {
    let length = to_light.iter().map(|part| part * part).sum::<f64>().sqrt();
    in_range("length of the direction to the light", length, (1e-100, 1e100), "")?;
    let axes = LightAxes::new(middle(balls), to_light.map(|part| part / length));
    let discs: Vec<_> = balls.iter().chain(neighbours).map(|ball| axes.disc(ball)).collect();
    let bins = Bins::new(&discs);
    let mut depths = vec![BallDepth::default(); balls.len()];
    let (arch, lit) = (pulp::Arch::new(), &discs[..balls.len()]);
    let tasks = depths.par_chunks_mut(BALLS_PER_TASK).zip(lit.par_chunks(BALLS_PER_TASK));
    let axes = with_gradient.then_some(&axes);
    tasks.for_each(|(depths, discs)| arch.dispatch(Task { discs, bins: &bins, axes, depths }));
    Ok(depths)
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

/// Some balls to be lit.
struct Task<'a> {
    discs: &'a [Disc],
    bins: &'a Bins,
    /// The light's, where the gradient is wanted.
    axes: Option<&'a LightAxes>,
    depths: &'a mut [BallDepth],
}

impl pulp::WithSimd for Task<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _simd: S) {
        for (depth, disc) in self.depths.iter_mut().zip(self.discs) {
            let near = self.bins.near(disc.place);
            // The branch is out here, so that each half is compiled without the other.
            *depth = if self.axes.is_some() { depth_of(disc, near, self.axes) } else { depth_of(disc, near, None) };
        }
    }
}

/// Sums over the balls on the way, place by place.
#[derive(Default)]
struct Sums {
    before: [f32; LANES],
    whole: [f32; LANES],
    gradient: [[f32; LANES]; 3],
}

impl Sums {
    /// Adds the balls of a group; one whose disc does not reach the centre adds nothing.
    #[inline(always)]
    fn add(&mut self, disc: &Disc, others: &DiscGroup, with_gradient: bool) {
        for lane in 0..LANES {
            let (per_radius, peak) = (others.per_radius[lane], others.peak[lane]);
            let apart = [0, 1].map(|axis: usize| (others.place[axis][lane] - disc.place[axis]) * per_radius);
            let u = (1.0 - apart[0] * apart[0] - apart[1] * apart[1]).max(0.0);
            let s = (others.toward[lane] - disc.toward) * per_radius;
            self.whole[lane] += peak * column(u);
            self.before[lane] += peak * column_to(u, s);
            if with_gradient {
                let steepness = peak * per_radius;
                let across = 2.0 * steepness * column_to_by_u(u, s);
                self.gradient[0][lane] += across * apart[0];
                self.gradient[1][lane] += across * apart[1];
                self.gradient[2][lane] -= steepness * field(u, s);
            }
        }
    }
}

#[inline(always)]
fn depth_of(disc: &Disc, others: &[DiscGroup], axes: Option<&LightAxes>) -> BallDepth {
    let mut sums = Sums::default();
    for others in others {
        sums.add(disc, others, axes.is_some());
    }
    let sum = |lanes: &[f32; LANES]| lanes.iter().sum::<f32>();
    let (before, whole) = (sum(&sums.before), sum(&sums.whole));
    let mut gradient = [sum(&sums.gradient[0]), sum(&sums.gradient[1]), sum(&sums.gradient[2])];
    // The ball itself is among the others, half of it on either side. Its own field falls off before its rim: half of it in
    // the middle is its mean slope.
    let own = disc.peak * column(1.0);
    gradient[2] += 0.5 * disc.peak * disc.per_radius;
    let before = (before - 0.5 * own).max(0.0);
    let gradient_per_m = axes.map_or([0.0; 3], |axes| axes.world(gradient));
    BallDepth { before, own, behind: (whole - own - before).max(0.0), gradient_per_m }
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

//! Balls as a camera sees them, from back to front.

use rayon::prelude::*;

use super::light::LitBall;
use super::view::SplatView;
use crate::narrow::narrow;

/// Share of half a picture's opening that sets apart a ball's box from its disc, against rounding.
const MARGIN: f32 = 1e-4;

/// Smallest optical depth through a ball's centre that is drawn.
const LEAST_DEPTH: f32 = 1e-6;

/// A ball in a camera's axes, with its light.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SeenBall {
    /// Centre in the camera's axes (m): right, up, forward.
    pub centre_m: [f32; 3],
    /// Radius (m).
    pub radius_m: f32,
    /// The box it covers in the picture, -1 to 1: left, bottom, right, top.
    pub extent: [f32; 4],
    /// Extinction in the centre times the radius.
    pub peak: f32,
    /// Distance of the centre from the camera (m).
    pub distance_m: f32,
    /// Optical depth towards the sun at the centre.
    pub sun_depth: f32,
    /// Share of sunlight scattered forward alone.
    pub forward: f32,
    /// Radiance (1/sr) of sunlight scattered often.
    pub diffuse: f32,
    /// The sky's share.
    pub sky: f32,
    /// How the depth towards the sun changes to the right and upwards, per unit of the picture's plane.
    pub slope: [f32; 2],
}

/// Balls that a camera sees, sorted from back to front: by the distance of their centres, and of balls at the same distance by
/// their place, so that the order of the list does not matter.
#[must_use]
pub fn project(balls: &[LitBall], view: &SplatView) -> Vec<SeenBall> {
    let mut keyed: Vec<(u32, SeenBall)> =
        balls.par_iter().filter_map(|lit| see(lit, view)).map(|seen| (order(seen.distance_m), seen)).collect();
    keyed.par_sort_unstable_by(|(a, first), (b, second)| a.cmp(b).then_with(|| tie(first, second)));
    keyed.into_par_iter().map(|(_, seen)| seen).collect()
}

/// Larger for nearer balls: the bits of positive floats are in their order.
fn order(distance_m: f32) -> u32 {
    !distance_m.to_bits()
}

fn tie(first: &SeenBall, second: &SeenBall) -> std::cmp::Ordering {
    let key = |ball: &SeenBall| {
        let [right, up, forward] = ball.centre_m;
        [up, right, forward, ball.radius_m, ball.peak].map(f32::to_bits)
    };
    key(first).cmp(&key(second))
}

fn see(lit: &LitBall, view: &SplatView) -> Option<SeenBall> {
    let centre = view.place(lit.ball.centre_m.map(f64::from));
    let distance = (centre[0] * centre[0] + centre[1] * centre[1] + centre[2] * centre[2]).sqrt();
    let radius = f64::from(lit.ball.radius_m);
    if centre[2] <= -radius {
        return None;
    }
    let peak = lit.ball.extinction_per_m * lit.ball.radius_m * view.fade(distance);
    let half = view.half();
    let [across, above] = [0, 1].map(|axis| {
        let span = if view.is_perspective() {
            tangents(centre[axis], centre[2], radius)
        } else {
            [centre[axis] - radius, centre[axis] + radius]
        };
        span.map(|edge| narrow(edge / half[axis]))
    });
    let extent = [across[0] - MARGIN, above[0] - MARGIN, across[1] + MARGIN, above[1] + MARGIN];
    let is_outside = extent[0] > 1.0 || extent[1] > 1.0 || extent[2] < -1.0 || extent[3] < -1.0;
    if is_outside || peak < LEAST_DEPTH {
        return None;
    }
    Some(SeenBall {
        centre_m: centre.map(narrow),
        radius_m: lit.ball.radius_m,
        extent: extent.map(|edge| edge.clamp(-1.0, 1.0)),
        peak,
        distance_m: narrow(distance),
        sun_depth: lit.sun_depth,
        forward: lit.forward,
        diffuse: lit.diffuse,
        sky: lit.sky,
        slope: slope(lit.gradient_per_m, centre, radius, view),
    })
}

/// How the depth towards the sun changes in the picture: along lines across the line of sight, through the ball's centre.
fn slope(gradient_per_m: [f32; 3], centre: [f64; 3], radius: f64, view: &SplatView) -> [f32; 2] {
    let gradient = view.turned(gradient_per_m.map(f64::from));
    if !view.is_perspective() {
        return [narrow(gradient[0]), narrow(gradient[1])];
    }
    if is_at_camera(centre[2], radius) {
        return [0.0; 2];
    }
    let length2: f64 = centre.iter().map(|part| part * part).sum();
    let along: f64 = gradient.iter().zip(centre).map(|(slope, place)| slope * place).sum::<f64>() / length2;
    [0, 1].map(|axis| narrow(centre[2] * (gradient[axis] - along * centre[axis])))
}

/// Whether a ball reaches the plane of the camera, nearly.
fn is_at_camera(before_m: f64, radius_m: f64) -> bool {
    before_m <= 1.001 * radius_m
}

/// Tangents of the lines from the camera that touch a circle, in a plane through the axis of view; everything to a side on
/// which the circle reaches the plane of the camera.
fn tangents(beside: f64, before: f64, radius: f64) -> [f64; 2] {
    let power = beside * beside + before * before - radius * radius;
    if power <= 0.0 {
        return [-1e9, 1e9];
    }
    let (root, base) = (radius * power.sqrt(), before * before - radius * radius);
    if base > 1e-6 * radius * radius {
        return [(beside * before - root) / base, (beside * before + root) / base];
    }
    // One line of touch still meets the picture's plane, on the side of the camera's axis.
    let inner = (beside * beside - radius * radius) / (beside * before + root.copysign(beside));
    if before > -radius && beside > 0.0 { [inner.min(1e9), 1e9] } else { [-1e9, inner.max(-1e9)] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Metaball;
    use crate::splats::SplatProjection;

    fn view() -> SplatView {
        SplatView {
            position_m: [0.0; 3],
            axes: [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]],
            projection: SplatProjection::Perspective { tan_half: [1.0, 0.75] },
            size_px: [80, 60],
            planet_radius_m: f64::INFINITY,
            reach_m: f64::INFINITY,
        }
    }

    fn lit(centre_m: [f32; 3], radius_m: f32) -> LitBall {
        let ball = Metaball { centre_m, radius_m, extinction_per_m: 1.0 };
        LitBall { ball, sun_depth: 0.0, gradient_per_m: [0.0; 3], forward: 0.0, diffuse: 0.0, sky: 1.0, seen: 1.0 }
    }

    #[test]
    fn a_balls_box_holds_every_line_of_sight_that_meets_it() {
        for (centre, radius) in [
            ([0.0_f32, 10.0, 0.0], 2.0_f32),
            ([6.0, 8.0, -3.0], 1.5),
            ([3.0, 1.0, 0.5], 2.0),
            ([3.0, 2.0, -1.0], 2.0),
            ([-2.5, 0.5, 2.0], 1.9),
            ([0.5, 0.2, 0.1], 3.0),
            ([-4.0, -0.5, 1.0], 3.0),
        ] {
            let seen = project(&[lit(centre, radius)], &view());
            let extent = seen.first().map(|seen| seen.extent);
            let places = (0..=200_i16).flat_map(|i| (0..=200_i16).map(move |j| [i, j]));
            for [x, y] in places.map(|place| place.map(|part| f32::from(part) / 100.0 - 1.0)) {
                let ray = [f64::from(x), 1.0, f64::from(0.75 * y)];
                let c = centre.map(f64::from);
                let along = (0..3).map(|k| ray[k] * c[k]).sum::<f64>() / ray.iter().map(|r| r * r).sum::<f64>();
                let off2: f64 = (0..3).map(|k| (along.max(0.0) * ray[k] - c[k]).powi(2)).sum();
                let holds = extent.is_some_and(|e| e[0] <= x && x <= e[2] && e[1] <= y && y <= e[3]);
                let misses = off2 >= f64::from(radius * radius);
                assert!(misses || holds, "{centre:?}, {radius}: ({x}, {y}) is outside of {extent:?}");
            }
        }
    }

    #[test]
    fn balls_come_from_back_to_front_whatever_their_order() {
        let mut balls: Vec<_> =
            (0..50_u8).map(|i| lit([f32::from(i % 5) - 2.0, 10.0 + f32::from(i % 7), f32::from(i % 3)], 1.0)).collect();
        let seen = project(&balls, &view());
        assert!(seen.windows(2).all(|pair| pair[0].distance_m >= pair[1].distance_m), "from back to front");
        balls.reverse();
        assert_eq!(project(&balls, &view()), seen, "the other way round");
    }

    #[test]
    fn what_is_behind_the_camera_or_beside_the_picture_is_left_out() {
        let gone = [lit([0.0, -5.0, 0.0], 2.0), lit([30.0, 10.0, 0.0], 2.0), lit([0.0, 10.0, -20.0], 2.0)];
        assert_eq!(project(&gone, &view()), [], "none is seen");
    }
}

//! The light of each ball, from its optical depths.

use rayon::prelude::*;

use super::column::exp_minus;
use super::depths::{BallDepth, ball_depths, ball_depths_alone};
use crate::cloud_light::{sky_share, sun_diffusion};
use crate::error::{CloudError, in_range};
use crate::metaballs::Metaball;
use crate::narrow::narrow;

/// Share of the depth's gradient that a ball shows across its own splat: balls overlap, and each shows its neighbours' part of
/// it. Of 0 (the paper's one colour a ball), 1/2, 3/4 and 1 this is nearest to a march: 34, 42, 39 and 34 dB.
const SHOWN_GRADIENT: f32 = 0.5;

/// What lights balls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SplatLighting {
    /// Direction to the sun: east, north, up.
    pub to_sun: [f64; 3],
    /// One less the mean cosine of scattering, for light that is scattered often; `None` for light scattered once alone, as
    /// in the paper.
    pub transport: Option<f64>,
}

/// A ball with its light, for a sun of irradiance 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LitBall {
    /// The ball.
    pub ball: Metaball,
    /// Optical depth between the sun and the ball's centre: what a light buffer holds before the ball's own splat.
    pub sun_depth: f32,
    /// How that changes about the centre (1/m): east, north, up. All of a ball has the same light where this is 0, as in the paper.
    pub gradient_per_m: [f32; 3],
    /// Share that arrives after narrow forward scattering alone.
    pub forward: f32,
    /// Mean radiance (1/sr) of sunlight that was scattered often.
    pub diffuse: f32,
    /// Share of the sky in the light from sky and ground.
    pub sky: f32,
    /// How well the ball is seen from outside, 0 to 1: by which its light counts when balls are merged.
    pub seen: f32,
}

/// Lights balls that stand in the shadow of each other and of `neighbours`. Light that was scattered often obeys the diffusion
/// of [`mod@crate::cloud_light`], with the balls' own columns along the sun and along the vertical.
///
/// # Errors
/// When the direction to the sun is zero or `transport` is not positive.
pub fn light_balls(
    balls: &[Metaball],
    neighbours: &[Metaball],
    lighting: SplatLighting,
) -> Result<Vec<LitBall>, CloudError> {
    let depths = ball_depths(balls, neighbours, lighting.to_sun)?;
    let mut lit: Vec<_> = balls.par_iter().zip(&depths).map(|(ball, depth)| lit_once(ball, depth)).collect();
    let Some(transport) = lighting.transport else { return Ok(lit) };
    in_range("transport", transport, (1e-6, 2.0), "")?;
    let level = ball_depths_alone(balls, neighbours, [0.0, 0.0, 1.0])?;
    lit.par_iter_mut().zip(depths.par_iter().zip(&level)).for_each(|(lit, (depth, level))| {
        let scaled = |far: f32, own: f32| transport * f64::from(far + 0.5 * own);
        let (before, behind) = (scaled(depth.before, depth.own), scaled(depth.behind, depth.own));
        // Before the ball's own splat, like direct light, so that both together are not more than there is.
        lit.forward = (exp_minus(narrow(transport) * depth.before) - exp_minus(depth.before)).max(0.0);
        lit.diffuse = narrow(sun_diffusion(before, behind));
        lit.seen = 0.5 * lit.seen + 0.25 * (exp_minus(level.before) + exp_minus(level.behind));
        lit.sky = narrow(sky_share(scaled(level.before, level.own), scaled(level.behind, level.own)));
    });
    Ok(lit)
}

/// A ball with direct sunlight alone.
fn lit_once(ball: &Metaball, depth: &BallDepth) -> LitBall {
    LitBall {
        ball: *ball,
        sun_depth: depth.before,
        gradient_per_m: depth.gradient_per_m.map(|part| SHOWN_GRADIENT * part),
        forward: 0.0,
        diffuse: 0.0,
        sky: 1.0,
        seen: 0.5 * (exp_minus(depth.before) + exp_minus(depth.behind)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_ball_gets_more_sunlight_than_there_is_and_lower_ones_get_less() {
        let ball =
            |z: u8| Metaball { centre_m: [0.0, 0.0, 30.0 * f32::from(z)], radius_m: 50.0, extinction_per_m: 0.02 };
        let column: Vec<_> = (0..20).map(ball).collect();
        let lighting = SplatLighting { to_sun: [0.0, 0.0, 1.0], transport: Some(0.15) };
        let lit = light_balls(&column, &[], lighting).unwrap();
        // The lowest balls lack what others have of those below them.
        for pair in lit[2..].windows(2) {
            assert!(pair[0].sun_depth > pair[1].sun_depth, "direct light grows upwards: {pair:?}");
            assert!(pair[0].sky < pair[1].sky, "sky light grows upwards: {pair:?}");
        }
        for lit in &lit {
            let bounds = [lit.forward, (-lit.sun_depth).exp() + lit.forward, lit.sky];
            assert!(bounds.iter().all(|share| (0.0..=1.0).contains(share)), "{lit:?}");
            assert!((0.0..0.5).contains(&lit.diffuse), "{lit:?}");
        }
    }

    #[test]
    fn a_transport_of_nothing_is_refused() {
        let lighting = SplatLighting { to_sun: [0.0, 0.0, 1.0], transport: Some(0.0) };
        let text = light_balls(&[], &[], lighting).unwrap_err().to_string();
        assert!(text.starts_with("transport = 0 is outside"), "{text}");
    }
}

// Light that was scattered a few times, mostly forward: a long turn at a place on the ray, small ones before or after it.
// Such light follows the beam of the sun up to there, or the line of sight from there, and is lost only as in a medium thinner
// by `transport`; what turns both before and after is part of the diffuse light.
// @import clouds/clouds.wgsl
// @import common/phase.wgsl

/// Share of small turns after the long one that counts; fitted on random walks through thick and thin clouds, where some of the
/// light leaves by their sides.
const CLOUD_LATE: f32 = 0.6;

/// A piece of a ray and how light comes to it.
struct CloudTurn {
    sun_depth: f32, // 1, optical depth towards the sun
    eye_depth: f32, // 1, optical depth towards the eye
    seen: f32,      // 1, of the ray's light scattered in the piece
    seen_thin: f32, // 1, of the thinner medium's
}

/// Radiance (1/sr) of light scattered at least twice, of a sun of irradiance 1 at a cosine nu from the line of sight.
fn cloud_forward(nu: f32, turn: CloudTurn) -> f32 {
    let straight = exp(-turn.sun_depth);
    let early = turn.seen * (exp(-clouds.transport * turn.sun_depth) - straight);
    let late = (turn.seen_thin / clouds.transport - turn.seen) * straight;
    // Small turns on the way are as many as Poisson's law has, at least one of them.
    let turns = max((1.0 - clouds.transport) * (turn.sun_depth + turn.eye_depth), 1e-3);
    let orders = 1.0 + turns / (1.0 - exp(-turns));
    return max(early + CLOUD_LATE * late, 0.0) * phase_of_orders(nu, orders, clouds.asymmetry, clouds.forward_weight);
}

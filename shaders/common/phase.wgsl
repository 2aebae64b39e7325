// Phase functions, normalised to one over the sphere [1/sr]. Twins: tyndall_scattering::phase.

const PHASE_INV_16PI: f32 = 0.019894367886486918;
const PHASE_INV_8PI: f32 = 0.039788735772973836;
const PHASE_INV_4PI: f32 = 0.07957747154594767;

/// Rayleigh, 3/(16 pi) (1 + cos^2 theta); paper eq. (1), F / (4 pi).
fn phase_rayleigh(cos_theta: f32) -> f32 {
    return 3.0 * PHASE_INV_16PI * (1.0 + cos_theta * cos_theta);
}

/// Cornette and Shanks 1992; -1 < g < 1.
fn phase_cornette_shanks(cos_theta: f32, g: f32) -> f32 {
    let d = 1.0 + g * g - 2.0 * g * cos_theta;
    return 3.0 * PHASE_INV_8PI * (1.0 - g * g) / (2.0 + g * g) * (1.0 + cos_theta * cos_theta) / (d * sqrt(d));
}

/// Henyey and Greenstein 1941; -1 < g < 1 is the mean cosine.
fn phase_henyey_greenstein(cos_theta: f32, g: f32) -> f32 {
    let d = 1.0 + g * g - 2.0 * g * cos_theta;
    return PHASE_INV_4PI * (1.0 - g * g) / (d * sqrt(d));
}

/// Two lobes of Henyey and Greenstein with mean cosines g.x and g.y; the first has the share forward_weight.
fn phase_double_henyey_greenstein(cos_theta: f32, g: vec2<f32>, forward_weight: f32) -> f32 {
    return mix(phase_henyey_greenstein(cos_theta, g.y), phase_henyey_greenstein(cos_theta, g.x), forward_weight);
}

/// The same after `orders` scatterings, more than 1: mean cosines of a lobe multiply. Light never turned back keeps to the first
/// lobe; what did counts as turned once.
fn phase_of_orders(cos_theta: f32, orders: f32, g: vec2<f32>, forward_weight: f32) -> f32 {
    let narrow = pow(g.x, orders - 1.0);
    return phase_double_henyey_greenstein(cos_theta, narrow * g, pow(forward_weight, orders));
}

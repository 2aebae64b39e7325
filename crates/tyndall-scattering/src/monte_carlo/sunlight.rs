//! Roughly how much sunlight reaches a point: where random walks look for light. It steers them and changes no result.

use crate::Atmosphere;
use crate::geometry::{distance_to_top, horizon_mu};

use super::layers::Layers;

const ALTITUDES: usize = 48;
const SUNS: usize = 129;

/// Share that a point in the shadow counts of a sunlit one: it gets light from its neighbours.
const SHADOW_SHARE: f64 = 0.02;

/// Transmittance towards the sun, averaged over the wavelengths, by altitude and zenith cosine of the sun.
#[derive(Clone, Debug)]
pub(super) struct Sunlight {
    top_altitude_m: f64,
    shares: Vec<f64>,
}

impl Sunlight {
    pub(super) fn new(atmosphere: &Atmosphere, layers: &Layers) -> Self {
        let (radius_m, top_altitude_m) = (atmosphere.planet_radius_m, atmosphere.top_altitude_m);
        let share = |h_m: f64, mu_sun: f64| {
            if mu_sun <= horizon_mu(radius_m, h_m) {
                return SHADOW_SHARE;
            }
            let length_m = distance_to_top(radius_m, top_altitude_m, h_m, mu_sun);
            let columns = layers.columns(&layers.line(h_m, mu_sun), length_m);
            let count = atmosphere.wavelengths_nm.len();
            let mean = (0..count).map(|k| layers.transmittance(&columns, k)).sum::<f64>() / count as f64;
            mean + SHADOW_SHARE
        };
        let shares = (0..ALTITUDES * SUNS)
            .map(|index| {
                let height = (index / SUNS) as f64 / (ALTITUDES - 1) as f64;
                let side = (index % SUNS) as f64 / (SUNS - 1) as f64 * 2.0 - 1.0;
                share(top_altitude_m * height * height, side * side.abs())
            })
            .collect();
        Self { top_altitude_m, shares }
    }

    /// Share of the sunlight at a point.
    pub(super) fn at(&self, h_m: f64, mu_sun: f64) -> f64 {
        let side = 0.5 + 0.5 * mu_sun.signum() * mu_sun.abs().sqrt();
        let (x, fx) = cell(side, SUNS);
        let (y, fy) = cell((h_m / self.top_altitude_m).max(0.0).sqrt(), ALTITUDES);
        let row = |y: usize| {
            let first = y * SUNS + x;
            self.shares[first] * (1.0 - fx) + self.shares[first + 1] * fx
        };
        row(y) * (1.0 - fy) + row(y + 1) * fy
    }
}

/// The cell of a unit coordinate and the place in it.
#[expect(clippy::cast_possible_truncation, reason = "0 to 1 times a small count")]
fn cell(unit: f64, count: usize) -> (usize, f64) {
    let place = unit.clamp(0.0, 1.0) * (count - 1) as f64;
    let below = (place as usize).min(count - 2);
    (below, place - below as f64)
}

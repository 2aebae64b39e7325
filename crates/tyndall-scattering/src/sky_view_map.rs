//! Place of a direction in the tables of the sky: azimuth from the sun, and elevation from the horizon, quadratically
//! dense there. Directions above and below the horizon are parts of their own. WGSL: `shaders/sky/sky_view_map.wgsl`.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::Atmosphere;
use crate::geometry::{Ray, distance_to_ground, distance_to_top};

/// One row in so many lies below the horizon.
pub const ROWS_PER_ROW_BELOW: usize = 4;

/// Length of a ray. The row decides on which side of the horizon it ends; at the horizon itself rounding must not.
pub(crate) fn row_length_m(atmosphere: &Atmosphere, ray: &Ray, above: bool) -> f64 {
    let radius_m = atmosphere.planet_radius_m;
    if above {
        return distance_to_top(radius_m, atmosphere.top_altitude_m, ray.h_m, ray.mu);
    }
    let to_tangent_m = || -(radius_m + ray.h_m) * ray.mu;
    distance_to_ground(radius_m, ray.h_m, ray.mu).unwrap_or_else(to_tangent_m)
}

/// Elevation of the geometric horizon (rad), 0 or below.
#[must_use]
pub fn horizon_elevation(planet_radius_m: f64, h_m: f64) -> f64 {
    -((h_m * (2.0 * planet_radius_m + h_m)).sqrt() / planet_radius_m).atan()
}

/// Place in a part of the table: azimuth from the sun over pi, and the root of the share of the way from the horizon to
/// the zenith (or nadir).
#[must_use]
pub fn sky_view_map(horizon_elevation: f64, elevation: f64, azimuth: f64) -> [f64; 2] {
    let from_horizon = elevation - horizon_elevation;
    let whole = if from_horizon >= 0.0 { FRAC_PI_2 - horizon_elevation } else { -FRAC_PI_2 - horizon_elevation };
    let folded = azimuth.rem_euclid(2.0 * PI);
    [folded.min(2.0 * PI - folded) / PI, (from_horizon / whole).clamp(0.0, 1.0).sqrt()]
}

/// Elevation and azimuth (rad) of a place in a part of the table; the inverse of [`sky_view_map`].
#[must_use]
pub fn sky_view_map_inverse(horizon_elevation: f64, above: bool, unit: [f64; 2]) -> (f64, f64) {
    let whole = if above { FRAC_PI_2 - horizon_elevation } else { -FRAC_PI_2 - horizon_elevation };
    (horizon_elevation + whole * unit[1] * unit[1], PI * unit[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_map_and_its_inverse_are_inverse_and_the_horizon_is_an_edge() {
        for horizon in [0.0, -0.03, -1.2] {
            for above in [true, false] {
                for unit in [[0.0, 0.0], [0.5, 0.25], [1.0, 1.0], [0.1, 0.01]] {
                    let (elevation, azimuth) = sky_view_map_inverse(horizon, above, unit);
                    let back = sky_view_map(horizon, elevation, azimuth);
                    let near = (back[0] - unit[0]).abs() < 1e-9 && (back[1] - unit[1]).abs() < 1e-7;
                    assert!(near, "{horizon} {above} {unit:?} {back:?}");
                }
            }
        }
    }

    #[test]
    fn azimuths_on_both_sides_of_the_sun_are_the_same_texel() {
        let [left, right] = [0.7, -0.7].map(|azimuth| sky_view_map(-0.1, 0.4, azimuth));
        assert!((left[0] - right[0]).abs() < 1e-12, "{left:?} {right:?}");
    }
}

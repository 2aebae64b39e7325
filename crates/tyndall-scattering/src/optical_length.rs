//! Equation (2): the optical length of a path, by direct quadrature.
//!
//! The density integral is kept apart from the wavelength: the *column* of a medium is the length (m) of a path of the
//! same number of particles at relative density 1. Optical depth = sum over media of extinction times column. The paper
//! prints no limit for the path towards the sun; it ends at the top of the atmosphere.

use crate::atmosphere::{Atmosphere, MEDIUM_COUNT};
use crate::geometry::{altitude_along, distance_to_top};
use crate::quadrature::integrate_many;

/// Columns (m) of air, aerosol and ozone.
pub type Columns = [f64; MEDIUM_COUNT];

/// Panels of four nodes on each side of the lowest point; twice as many change no column of air or aerosol by 1e-9. The
/// tent of the ozone has kinks, which leave 2e-4.
const PANELS: usize = 48;

/// Columns (m) along a ray from altitude `h_m` with zenith cosine `mu`, from its start to `length_m`.
///
/// Exact to quadrature error; nodes cluster quadratically at the lowest point, where densities change fastest.
#[must_use]
pub fn columns_along(atmosphere: &Atmosphere, h_m: f64, mu: f64, length_m: f64) -> Columns {
    let radius_m = atmosphere.planet_radius_m;
    let lowest_m = (-(radius_m + h_m) * mu).clamp(0.0, length_m);
    let mut columns = [0.0; MEDIUM_COUNT];
    for span_m in [-lowest_m, length_m - lowest_m].into_iter().filter(|span_m| *span_m != 0.0) {
        let side = integrate_many(0.0, 1.0, PANELS, |x| {
            let altitude_m = altitude_along(radius_m, h_m, mu, lowest_m + span_m * x * x).max(0.0);
            let step_m = 2.0 * x * span_m.abs();
            atmosphere.media.each_ref().map(|medium| medium.profile.density(altitude_m) * step_m)
        });
        columns = std::array::from_fn(|medium| columns[medium] + side[medium]);
    }
    columns
}

/// Columns (m) from altitude `h_m` in the direction of zenith cosine `mu` to the top of the atmosphere. The planet does
/// not stand in the way: callers test the shadow first.
#[must_use]
pub fn columns_to_top(atmosphere: &Atmosphere, h_m: f64, mu: f64) -> Columns {
    let length_m = distance_to_top(atmosphere.planet_radius_m, atmosphere.top_altitude_m, h_m, mu);
    columns_along(atmosphere, h_m, mu, length_m)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::atmosphere::{AEROSOL, AIR};
    use crate::params::{AtmosphereParams, GroundParams};

    fn unearthly() -> Atmosphere {
        let params = AtmosphereParams {
            planet_radius_km: 1000.0,
            top_altitude_km: 500.0,
            air_scale_height_km: 20.0,
            ..AtmosphereParams::default()
        };
        Atmosphere::new(&params, &GroundParams::default())
    }

    #[test]
    fn the_vertical_column_of_an_exponential_is_analytic() {
        let atmosphere = unearthly();
        for h in [0.0_f64, 5e3, 1e5] {
            let want = 20e3 * ((-h / 20e3).exp() - (-500.0_f64 / 20.0).exp());
            let got = columns_to_top(&atmosphere, h, 1.0)[0];
            assert!((got / want - 1.0).abs() < 1e-9, "{h}: {got} {want}");
        }
    }

    #[test]
    fn columns_add_up_along_a_ray() {
        let atmosphere = unearthly();
        let (h, mu, cut) = (3e3, 0.05, 1.2e5);
        let h_cut = altitude_along(1e6, h, mu, cut);
        let mu_cut = crate::geometry::mu_along(1e6, h, mu, 1.0, cut, h_cut);
        let (whole, first) = (columns_to_top(&atmosphere, h, mu), columns_along(&atmosphere, h, mu, cut));
        let second = columns_to_top(&atmosphere, h_cut, mu_cut);
        // Ozone is left out: the kinks of its tent cost the quadrature its order.
        for medium in [AIR, AEROSOL] {
            let sum = first[medium] + second[medium];
            assert!((sum / whole[medium] - 1.0).abs() < 1e-6, "medium {medium}: {sum} {}", whole[medium]);
        }
    }

    #[test]
    fn a_ray_and_its_reverse_have_the_same_column() {
        let atmosphere = unearthly();
        let (h, mu, length) = (8e4, -0.3, 3e5);
        let h_end = altitude_along(1e6, h, mu, length);
        let mu_end = crate::geometry::mu_along(1e6, h, mu, 1.0, length, h_end);
        let there = columns_along(&atmosphere, h, mu, length);
        let back = columns_along(&atmosphere, h_end, -mu_end, length);
        for medium in [AIR, AEROSOL] {
            assert!((there[medium] / back[medium] - 1.0).abs() < 1e-6, "medium {medium}: {there:?} {back:?}");
        }
    }
}

//! Equation (2): the optical length of a path, by direct quadrature.
//!
//! The density integral is kept apart from the wavelength: the *column* of a medium is the length (m) of a path of the
//! same number of particles at relative density 1. Optical depth = sum over media of extinction times column. The paper
//! prints no limit for the path towards the sun; it ends at the top of the atmosphere.

use crate::atmosphere::{Atmosphere, HAZE, MEDIUM_COUNT};
use crate::geometry::{altitude_along, altitude_crossings, distance_to_top};
use crate::quadrature::integrate_many;

/// Columns (m) of air, aerosol, ozone and haze.
pub type Columns = [f64; MEDIUM_COUNT];

/// Panels of four nodes on each side of the lowest point, and the fewest between two breaks; twice as many change no column
/// by 1e-8.
const PANELS: f64 = 48.0;
const FEWEST_PANELS: f64 = 6.0;

/// Columns (m) along a ray from altitude `h_m` with zenith cosine `mu`, from its start to `length_m`.
///
/// Exact to quadrature error: nodes cluster quadratically at the lowest point, where densities change fastest, and no panel
/// crosses an altitude at which a density has a kink.
#[must_use]
pub fn columns_along(atmosphere: &Atmosphere, h_m: f64, mu: f64, length_m: f64) -> Columns {
    let is_hazy = !atmosphere.media[HAZE].is_absent();
    columns_of(atmosphere, is_hazy, (h_m, mu), length_m)
}

/// Columns (m) from altitude `h_m` in the direction of zenith cosine `mu` to the top of the atmosphere. The planet does
/// not stand in the way: callers test the shadow first.
#[must_use]
pub fn columns_to_top(atmosphere: &Atmosphere, h_m: f64, mu: f64) -> Columns {
    let length_m = distance_to_top(atmosphere.planet_radius_m, atmosphere.top_altitude_m, h_m, mu);
    columns_along(atmosphere, h_m, mu, length_m)
}

/// As [`columns_to_top`], without that of the haze.
pub(crate) fn clear_columns_to_top(atmosphere: &Atmosphere, h_m: f64, mu: f64) -> Columns {
    let length_m = distance_to_top(atmosphere.planet_radius_m, atmosphere.top_altitude_m, h_m, mu);
    columns_of(atmosphere, false, (h_m, mu), length_m)
}

fn columns_of(atmosphere: &Atmosphere, with_haze: bool, (h_m, mu): (f64, f64), length_m: f64) -> Columns {
    let radius_m = atmosphere.planet_radius_m;
    let lowest_m = (-(radius_m + h_m) * mu).clamp(0.0, length_m);
    let breaks = breaks_m(atmosphere, with_haze, (h_m, mu), length_m, lowest_m);
    let sides = [lowest_m.sqrt(), (length_m - lowest_m).sqrt()];
    let mut columns = [0.0; MEDIUM_COUNT];
    for pair in breaks.windows(2) {
        // The root of the distance from the lowest point, negative before it.
        let [from, to] = [pair[0], pair[1]].map(|t_m| (t_m - lowest_m).abs().sqrt().copysign(t_m - lowest_m));
        let side = if to <= 0.0 { sides[0] } else { sides[1] };
        let panels = (PANELS * (to - from) / side).max(FEWEST_PANELS).ceil();
        let piece: Columns = integrate_many(from, to, small(panels), |root| {
            let altitude_m = altitude_along(radius_m, h_m, mu, lowest_m + root * root.abs()).max(0.0);
            let density = |medium: usize| atmosphere.media[medium].profile.density(altitude_m) * 2.0 * root.abs();
            std::array::from_fn(|medium| if medium == HAZE && !with_haze { 0.0 } else { density(medium) })
        });
        columns = std::array::from_fn(|medium| columns[medium] + piece[medium]);
    }
    columns
}

/// Start, end, lowest point and kinks of the densities along a ray, ascending (m).
fn breaks_m(atmosphere: &Atmosphere, with_haze: bool, (h_m, mu): (f64, f64), length_m: f64, lowest_m: f64) -> Vec<f64> {
    let media = atmosphere.media.iter().enumerate().filter(|(medium, _)| with_haze || *medium != HAZE);
    let mut breaks = vec![0.0, lowest_m, length_m];
    for altitude_m in media.flat_map(|(_, medium)| medium.profile.breaks_m()) {
        let crossings = altitude_crossings(atmosphere.planet_radius_m, h_m, mu, altitude_m);
        breaks.extend(crossings.into_iter().flatten().filter(|t_m| 0.0 < *t_m && *t_m < length_m));
    }
    breaks.sort_by(f64::total_cmp);
    breaks.dedup();
    breaks
}

#[expect(clippy::cast_possible_truncation, reason = "at most a hundred")]
fn small(panels: f64) -> usize {
    panels as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::atmosphere::{AEROSOL, AIR, OZONE};
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
        for medium in [AIR, AEROSOL, OZONE] {
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
        for medium in [AIR, AEROSOL, OZONE] {
            assert!((there[medium] / back[medium] - 1.0).abs() < 1e-6, "medium {medium}: {there:?} {back:?}");
        }
    }
}

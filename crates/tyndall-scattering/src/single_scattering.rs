//! Equation (1): light of the sun scattered once towards the observer, by direct quadrature. The reference of all sky
//! tables; about 10 ms a direction.
//!
//! Corrections to the printed equation: phase functions are normalised to 1 over the sphere; the upper limit `H_a` is a
//! length along the ray; points from which the sun is hidden by the planet contribute nothing; aerosols ("omitted for
//! brevity") add a second term with its own profile, phase function and absorption; rays that meet the ground end there.

use std::f64::consts::PI;

use crate::Atmosphere;
use crate::atmosphere::{MEDIUM_COUNT, SCATTERER_COUNT, SCATTERERS};
use crate::geometry::{
    Ray, altitude_along, distance_to_ground, distance_to_top, horizon_mu, mu_along, shadow_interval,
};
use crate::haze_breaks::{HazeBreaks, Spacing};
use crate::optical_length::{Columns, columns_along, columns_to_top};
use crate::quadrature::{NODES, RUNNING, WEIGHTS};

/// Where a ray ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayEnd {
    /// Distance (m).
    pub length_m: f64,
    /// Whether it ends at the ground.
    pub on_ground: bool,
}

/// End of a ray at the ground or at the top of the atmosphere.
#[must_use]
pub fn ray_end(atmosphere: &Atmosphere, h_m: f64, mu: f64) -> RayEnd {
    let radius_m = atmosphere.planet_radius_m;
    distance_to_ground(radius_m, h_m, mu).map_or_else(
        || RayEnd { length_m: distance_to_top(radius_m, atmosphere.top_altitude_m, h_m, mu), on_ground: false },
        |length_m| RayEnd { length_m, on_ground: true },
    )
}

/// Radiance of the sky in one direction (W/m^2/sr/nm) per wavelength: air, aerosol, haze and the sunlit ground, each behind
/// the atmosphere in front of it.
#[must_use]
pub fn single_scattering(atmosphere: &Atmosphere, ray: &Ray) -> Vec<f64> {
    single_scattering_to(atmosphere, ray, ray_end(atmosphere, ray.h_m, ray.mu))
}

/// As [`single_scattering`], for a ray that ends at `end`.
#[must_use]
pub fn single_scattering_to(atmosphere: &Atmosphere, ray: &Ray, end: RayEnd) -> Vec<f64> {
    let parts = scattered_parts(atmosphere, ray, end.length_m);
    let ground = if end.on_ground { sunlit_ground(atmosphere, ray, end.length_m) } else { vec![0.0; parts[0].len()] };
    let phases = atmosphere.phases(ray.nu);
    let scattered = |i: usize| phases.iter().zip(&parts).map(|(phase, part)| phase * part[i]).sum::<f64>();
    ground.iter().enumerate().map(|(i, ground)| scattered(i) + ground).collect()
}

/// Panels of four nodes on each lit stretch; doubling them changes no direction by more than 1e-6.
const PANELS: usize = 96;

/// The same between two breaks in haze.
const PANELS_IN_HAZE: usize = 12;

/// The integral of equation (1) up to `length_m` for each scatterer, before the phase function (W/m^2/nm).
#[must_use]
pub fn scattered_parts(atmosphere: &Atmosphere, ray: &Ray, length_m: f64) -> [Vec<f64>; SCATTERER_COUNT] {
    let mut parts = SCATTERERS.map(|_| vec![0.0; atmosphere.wavelengths_nm.len()]);
    let radius_m = atmosphere.planet_radius_m;
    let shadow = shadow_interval(radius_m, ray, length_m).unwrap_or((length_m, length_m));
    let lowest_m = (-(radius_m + ray.h_m) * ray.mu).clamp(0.0, length_m);
    let stretches = [(0.0, shadow.0), (shadow.1, length_m)];
    let haze = atmosphere.haze_layer();
    let haze = haze.map(|layer| (layer, HazeBreaks::new(&layer, ray, lowest_m, &Spacing::EXACT)));
    // The next break behind a distance, and the panels up to there.
    let piece = |from_m: f64, to_m: f64| {
        let Some((layer, breaks)) = &haze else { return (to_m, PANELS) };
        let next_m = breaks.next(from_m).min(to_m);
        let middle_m = altitude_along(radius_m, ray.h_m, ray.mu, 0.5 * (from_m + next_m));
        (next_m, if middle_m < layer.zone_m { PANELS_IN_HAZE } else { PANELS })
    };
    for (start_m, end_m) in stretches {
        for (mut from_m, to_m) in [(start_m, end_m.min(lowest_m)), (start_m.max(lowest_m), end_m)] {
            while from_m < to_m {
                let (next_m, panels) = piece(from_m, to_m);
                add_stretch(atmosphere, ray, (from_m, next_m), (from_m >= lowest_m, panels), &mut parts);
                from_m = next_m;
            }
        }
    }
    parts
}

/// Adds a lit stretch that does not cross the lowest point of the ray; nodes cluster at its lower end.
fn add_stretch(
    atmosphere: &Atmosphere,
    ray: &Ray,
    (from_m, to_m): (f64, f64),
    (rising, panels): (bool, usize),
    parts: &mut [Vec<f64>; SCATTERER_COUNT],
) {
    let span_m = to_m - from_m;
    let position = |x: f64| if rising { from_m + span_m * x * x } else { to_m - span_m * (1.0 - x) * (1.0 - x) };
    let speed = |x: f64| 2.0 * span_m * if rising { x } else { 1.0 - x };
    let mut columns = columns_along(atmosphere, ray.h_m, ray.mu, from_m);
    for panel in 0..panels {
        let width = 1.0 / panels as f64;
        let nodes = NODES.map(|node| {
            let x = (panel as f64 + node) * width;
            (position(x), speed(x) * width)
        });
        let densities: [[f64; MEDIUM_COUNT]; 4] = nodes.map(|(t_m, step_m)| {
            let altitude_m = altitude_along(atmosphere.planet_radius_m, ray.h_m, ray.mu, t_m).max(0.0);
            atmosphere.media.each_ref().map(|medium| medium.profile.density(altitude_m) * step_m)
        });
        for (i, (t_m, _)) in nodes.into_iter().enumerate() {
            let here: Columns =
                std::array::from_fn(|m| columns[m] + (0..4).map(|j| RUNNING[i][j] * densities[j][m]).sum::<f64>());
            let sun = sun_columns(atmosphere, ray, t_m);
            let path: Columns = std::array::from_fn(|m| here[m] + sun[m]);
            for (wavelength, solar) in atmosphere.solar_irradiance_w_m2_nm.iter().enumerate() {
                let light = solar * (-atmosphere.optical_depth(&path, wavelength)).exp() * WEIGHTS[i];
                for (part, medium) in parts.iter_mut().zip(SCATTERERS) {
                    part[wavelength] +=
                        light * atmosphere.media[medium].scattering_per_m[wavelength] * densities[i][medium];
                }
            }
        }
        for (m, column) in columns.iter_mut().enumerate() {
            *column += (0..4).map(|j| WEIGHTS[j] * densities[j][m]).sum::<f64>();
        }
    }
}

/// Columns (m) from a point of the ray to the top of the atmosphere towards the sun.
fn sun_columns(atmosphere: &Atmosphere, ray: &Ray, t_m: f64) -> Columns {
    let radius_m = atmosphere.planet_radius_m;
    let altitude_m = altitude_along(radius_m, ray.h_m, ray.mu, t_m).max(0.0);
    let mu_sun = mu_along(radius_m, ray.h_m, ray.mu_sun, ray.nu, t_m, altitude_m);
    columns_to_top(atmosphere, altitude_m, mu_sun)
}

/// Radiance of the ground in the sun, seen through the air in front of it (W/m^2/sr/nm); skylight on the ground is left
/// out here.
fn sunlit_ground(atmosphere: &Atmosphere, ray: &Ray, length_m: f64) -> Vec<f64> {
    let radius_m = atmosphere.planet_radius_m;
    let mu_sun = mu_along(radius_m, ray.h_m, ray.mu_sun, ray.nu, length_m, 0.0);
    if mu_sun <= horizon_mu(radius_m, 0.0) {
        return vec![0.0; atmosphere.wavelengths_nm.len()];
    }
    let view = columns_along(atmosphere, ray.h_m, ray.mu, length_m);
    let sun = columns_to_top(atmosphere, 0.0, mu_sun);
    let path: Columns = std::array::from_fn(|m| view[m] + sun[m]);
    let solar = atmosphere.solar_irradiance_w_m2_nm.iter().zip(&atmosphere.ground_albedo).enumerate();
    solar
        .map(|(i, (solar, albedo))| albedo / PI * solar * mu_sun * (-atmosphere.optical_depth(&path, i)).exp())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::atmosphere::{AIR, HAZE};
    use crate::haze::HazeParams;
    use crate::params::{AtmosphereParams, GroundParams};

    fn with(change: impl FnOnce(&mut AtmosphereParams)) -> Atmosphere {
        let mut params = AtmosphereParams::default();
        change(&mut params);
        Atmosphere::new(&params, &GroundParams { red: 0.0, green: 0.0, blue: 0.0, ..GroundParams::default() })
    }

    #[test]
    fn thin_air_scatters_in_proportion_to_its_optical_depth() {
        // In the limit of thin air L = E p tau / mu, an analytic answer.
        let atmosphere = with(|p| {
            (p.air_density, p.aerosol_optical_depth, p.ozone_du) = (1e-6, 0.0, 0.0);
        });
        let ray = Ray::from_angles(0.0, 0.0, 0.7, 0.0);
        let radiance = single_scattering(&atmosphere, &ray);
        for (i, value) in radiance.iter().enumerate() {
            let depth = atmosphere.media[AIR].scattering_per_m[i] * 8e3;
            let want = atmosphere.solar_irradiance_w_m2_nm[i] * crate::phase::phase_rayleigh(ray.nu) * depth;
            assert!((value / want - 1.0).abs() < 1e-5, "wavelength {i}: {value} {want}");
        }
    }

    #[test]
    fn a_plane_parallel_sky_has_the_analytic_radiance() {
        // A planet so large that it is flat, one exponential medium: for mu = mu_sun
        // L = E p (tau / mu) exp(-tau / mu), because every point's path has the same optical depth.
        let atmosphere = with(|p| {
            (p.planet_radius_km, p.aerosol_optical_depth, p.ozone_du) = (100_000.0, 0.0, 0.0);
        });
        let mu: f64 = 0.8;
        let ray = Ray::from_angles(0.0, mu.acos(), mu.acos(), 1.0);
        for (i, value) in single_scattering(&atmosphere, &ray).iter().enumerate() {
            let tau = atmosphere.media[AIR].scattering_per_m[i] * 8e3 / mu;
            let solar = atmosphere.solar_irradiance_w_m2_nm[i];
            let want = solar * crate::phase::phase_rayleigh(ray.nu) * tau * (-tau).exp();
            // The sphere of 100,000 km leaves a curvature of H / R = 8e-5.
            assert!((value / want - 1.0).abs() < 2e-4, "wavelength {i}: {value} {want}");
        }
    }

    #[test]
    fn the_sky_is_symmetric_about_the_suns_meridian() {
        let atmosphere = with(|_| {});
        let left = single_scattering(&atmosphere, &Ray::from_angles(10.0, 1.2, 1.0, 0.8));
        let right = single_scattering(&atmosphere, &Ray::from_angles(10.0, 1.2, 1.0, -0.8));
        assert_eq!(left, right, "mirror image");
    }

    #[test]
    fn the_earths_shadow_is_dark_and_the_air_above_it_is_lit() {
        let atmosphere = with(|_| {});
        let sun_zenith = 96.0_f64.to_radians();
        let at = |elevation: f64| {
            let ray = Ray::from_angles(0.0, (90.0 - elevation).to_radians(), sun_zenith, PI);
            single_scattering(&atmosphere, &ray)[5]
        };
        // Opposite the sun, 6 degrees down, the shadow's edge stands near 6 degrees.
        assert!(at(2.0) < 0.05 * at(15.0), "{} {}", at(2.0), at(15.0));
    }

    #[test]
    fn a_change_of_the_wavelength_list_changes_no_wavelength() {
        let all = with(|_| {});
        let mut one = all.clone();
        one.wavelengths_nm = vec![all.wavelengths_nm[2]];
        one.solar_irradiance_w_m2_nm = vec![all.solar_irradiance_w_m2_nm[2]];
        one.ground_albedo = vec![all.ground_albedo[2]];
        for (medium, full) in one.media.iter_mut().zip(&all.media) {
            medium.scattering_per_m = vec![full.scattering_per_m[2]];
            medium.absorption_per_m = vec![full.absorption_per_m[2]];
        }
        let ray = Ray::from_angles(100.0, 1.0, 0.5, 2.0);
        let (alone, among) = (single_scattering(&one, &ray)[0], single_scattering(&all, &ray)[2]);
        assert!((alone - among).abs() < 1e-12 * among, "{alone} {among}");
    }

    #[test]
    fn an_even_layer_of_fog_has_the_analytic_radiance() {
        // Nothing but fog with a sharp top on a planet so large that it is flat: seen from the ground
        // L = E p albedo mu_sun / (mu - mu_sun) (e^(-tau / mu) - e^(-tau / mu_sun)), tau the vertical optical depth.
        for visibility_km in [0.1, 1.0, 20.0] {
            let atmosphere = with(|p| {
                (p.planet_radius_km, p.air_density) = (100_000.0, 0.0);
                (p.aerosol_optical_depth, p.ozone_du) = (0.0, 0.0);
            });
            let params =
                HazeParams { enabled: true, visibility_km, top_m: 300.0, scale_height_m: 1.0, ..HazeParams::default() };
            let atmosphere = atmosphere.with_haze(&params);
            let fog = &atmosphere.media[HAZE];
            let tau = fog.extinction_per_m(0) * fog.profile.vertical_column_m();
            for (mu, mu_sun) in [(0.9_f64, 0.4_f64), (0.3, 0.8), (0.15, 0.2)] {
                let ray = Ray::from_angles(0.0, mu.acos(), mu_sun.acos(), 1.0);
                let albedo = fog.scattering_per_m[0] / fog.extinction_per_m(0);
                let fade = (-tau / mu).exp() - (-tau / mu_sun).exp();
                let want = atmosphere.solar_irradiance_w_m2_nm[0] * fog.phase.value(ray.nu) * albedo * mu_sun
                    / (mu - mu_sun)
                    * fade;
                let got = single_scattering(&atmosphere, &ray)[0];
                // The top is 1 m soft in 300 m, and the sphere changes a slant depth by 2e-4 of itself.
                let allowed = 1e-3 + 2e-4 * tau / mu.min(mu_sun);
                assert!((got / want - 1.0).abs() < allowed, "{visibility_km} km, {mu} {mu_sun}: {got} {want}");
            }
        }
    }
}

//! Monte-Carlo for pictures: few walks for each of many rays.
//!
//! The first order comes from the march of the tables (0.2 %), because the exact integral would take longer than the walks;
//! all that makes a difference, the higher orders, is walked.

use rayon::prelude::*;
use tyndall_core::spectrum::{Spectrum, WAVELENGTH_COUNT};

use super::path::Walker;
use super::random::BatchRandom;
use super::{MonteCarlo, place};
use crate::geometry::{Ray, altitude_along, distance_to_top, enter_atmosphere, horizon_mu, mu_along};
use crate::march::Marcher;
use crate::single_scattering::RayEnd;
use crate::{Atmosphere, ScatteringError};

/// Panels of four nodes along each ray of the first order.
const PANELS: usize = 12;

/// What a stretch of air does to what is seen through it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AirStretch {
    /// Light scattered into the line of sight (W/m^2/sr/nm).
    pub light: Spectrum,
    /// Share of the light from its far end that arrives.
    pub transmittance: Spectrum,
}

/// An atmosphere at the eight wavelengths, ready for pictures.
#[derive(Clone, Debug)]
pub struct PictureWalks {
    model: MonteCarlo,
    marcher: Marcher,
}

impl PictureWalks {
    /// Prepares an atmosphere.
    ///
    /// # Errors
    /// When the atmosphere does not have the eight wavelengths of the tables.
    pub fn new(atmosphere: &Atmosphere) -> Result<Self, ScatteringError> {
        Ok(Self { model: MonteCarlo::new(atmosphere), marcher: Marcher::new(atmosphere.clone(), PANELS)? })
    }

    /// Radiance (W/m^2/sr/nm) along each ray, with `paths` walks a ray. `first` is the number of the first ray in the whole
    /// picture: each ray has random numbers of its own, whatever rays are asked for together.
    #[must_use]
    pub fn radiance(&self, rays: &[Ray], first: u32, (paths, seed): (u32, u64)) -> Vec<Spectrum> {
        let count = u32::try_from(rays.len()).unwrap_or(u32::MAX);
        (0..count)
            .into_par_iter()
            .map_init(
                || Walker::new(WAVELENGTH_COUNT),
                |walker, index| self.ray(&rays[index as usize], walker, (first.wrapping_add(index), paths, seed)),
            )
            .collect()
    }

    /// Radiance (W/m^2/sr/nm) along the ray of a number; see [`PictureWalks::radiance`].
    #[must_use]
    pub fn radiance_of(&self, ray: &Ray, number: u32, (paths, seed): (u32, u64)) -> Spectrum {
        self.ray(ray, &mut Walker::new(WAVELENGTH_COUNT), (number, paths, seed))
    }

    /// Radius of the planet (m).
    #[must_use]
    pub fn planet_radius_m(&self) -> f64 {
        self.marcher.atmosphere.planet_radius_m
    }

    /// The first `length_m` of a ray, by `paths` walks with the random numbers of ray `number`; the ground ends it.
    #[must_use]
    pub fn stretch(&self, ray: &Ray, length_m: f64, number: u32, (paths, seed): (u32, u64)) -> AirStretch {
        let clear = AirStretch { light: [0.0; WAVELENGTH_COUNT], transmittance: [1.0; WAVELENGTH_COUNT] };
        let Atmosphere { planet_radius_m, top_altitude_m, .. } = self.marcher.atmosphere;
        let Some((_, before_m)) = enter_atmosphere(planet_radius_m, top_altitude_m, ray) else { return clear };
        let Some((ray, end)) = self.model.visible(ray, Some((length_m - before_m).max(0.0))) else { return clear };
        let end = RayEnd { on_ground: false, ..end };
        let layers = &self.model.layers;
        let columns = layers.columns(&layers.line(ray.h_m, ray.mu), end.length_m);
        let light = self.light(&ray, end, &mut Walker::new(WAVELENGTH_COUNT), (number, paths, seed));
        AirStretch { light, transmittance: std::array::from_fn(|k| layers.transmittance(&columns, k)) }
    }

    /// Irradiance (W/m^2/nm) of the sun on a surface that faces it at an altitude (m); none in the planet's shadow.
    #[must_use]
    pub fn sunlight(&self, h_m: f64, mu_sun: f64) -> Spectrum {
        let Atmosphere { planet_radius_m, top_altitude_m, .. } = self.marcher.atmosphere;
        if mu_sun <= horizon_mu(planet_radius_m, h_m) {
            return [0.0; WAVELENGTH_COUNT];
        }
        let layers = &self.model.layers;
        let length_m = distance_to_top(planet_radius_m, top_altitude_m, h_m, mu_sun);
        let columns = layers.columns(&layers.line(h_m, mu_sun), length_m);
        let solar = &self.marcher.coefficients.solar_irradiance_w_m2_nm;
        std::array::from_fn(|k| solar[k] * layers.transmittance(&columns, k))
    }

    /// Altitude (m) and cosine of the sun's zenith angle at a distance along a ray.
    #[must_use]
    pub fn place_along(&self, ray: &Ray, distance_m: f64) -> [f64; 2] {
        let radius_m = self.marcher.atmosphere.planet_radius_m;
        let h_m = altitude_along(radius_m, ray.h_m, ray.mu, distance_m).max(0.0);
        [h_m, mu_along(radius_m, ray.h_m, ray.mu_sun, ray.nu, distance_m, h_m)]
    }

    fn ray(&self, ray: &Ray, walker: &mut Walker, (number, paths, seed): (u32, u32, u64)) -> Spectrum {
        let Some((ray, end)) = self.model.visible(ray, None) else { return [0.0; WAVELENGTH_COUNT] };
        self.light(&ray, end, walker, (number, paths, seed))
    }

    fn light(&self, ray: &Ray, end: RayEnd, walker: &mut Walker, (number, paths, seed): (u32, u32, u64)) -> Spectrum {
        let mut sum = [0.0; WAVELENGTH_COUNT];
        let random = BatchRandom::new(seed, number, 0);
        let start = place(ray);
        for path in 0..paths {
            walker.walk(&self.model, start, (end, 2), &mut random.path(path), &mut sum);
        }
        let solar = &self.marcher.coefficients.solar_irradiance_w_m2_nm;
        let first = self.first_order(ray, end);
        std::array::from_fn(|k| first[k] + sum[k] * solar[k] / f64::from(paths))
    }

    fn first_order(&self, ray: &Ray, end: RayEnd) -> Spectrum {
        let marcher = &self.marcher;
        let (parts, phases) = (marcher.scattered_parts_to(ray, end.length_m), marcher.atmosphere.phases(ray.nu));
        let mut light: Spectrum =
            std::array::from_fn(|k| parts.iter().zip(phases).map(|(part, phase)| phase * part[k]).sum());
        if end.on_ground {
            let layers = &self.model.layers;
            let columns = layers.columns(&layers.line(ray.h_m, ray.mu), end.length_m);
            let mu_sun = mu_along(layers.radius_m, ray.h_m, ray.mu_sun, ray.nu, end.length_m, 0.0);
            let sun = marcher.sun_on_ground(mu_sun);
            for (k, light) in light.iter_mut().enumerate() {
                let reflected = marcher.coefficients.ground_albedo[k] / std::f64::consts::PI * sun[k];
                *light += reflected * layers.transmittance(&columns, k);
            }
        }
        light
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::monte_carlo::Sampling;
    use crate::params::{AtmosphereParams, GroundParams};

    #[test]
    fn the_mean_of_many_pixels_is_the_estimate_of_one_direction() {
        let atmosphere = Atmosphere::new(&AtmosphereParams::default(), &GroundParams::default());
        let walks = PictureWalks::new(&atmosphere).expect("eight wavelengths");
        for view in [1.2, 1.8] {
            let ray = Ray::from_angles(2.0, view, 0.9, 0.7);
            let pixels = walks.radiance(&[ray; 256], 0, (16, 1));
            let sampling = Sampling { paths: 4096, seed: 2, direction: 0 };
            let want = MonteCarlo::new(&atmosphere).radiance(&ray, None, sampling);
            for k in 0..WAVELENGTH_COUNT {
                let mean = pixels.iter().map(|pixel| pixel[k]).sum::<f64>() / 256.0;
                let spread = pixels.iter().map(|pixel| (pixel[k] - mean).powi(2)).sum::<f64>() / (256.0 * 255.0);
                let allowed = 4.0 * spread.sqrt().hypot(want.standard_error[k]) + 2e-3 * want.mean[k];
                assert!((mean - want.mean[k]).abs() < allowed, "view {view} {k}: {mean} {} {allowed}", want.mean[k]);
            }
        }
    }

    #[test]
    fn a_stretch_of_air_is_that_of_the_exact_integral_and_the_whole_ray_without_ground_is_the_sky() {
        let atmosphere = Atmosphere::new(&AtmosphereParams::default(), &GroundParams::default());
        let walks = PictureWalks::new(&atmosphere).expect("eight wavelengths");
        let ray = Ray::from_angles(50.0, 1.55, 0.9, 0.7);
        let want =
            MonteCarlo::new(&atmosphere).radiance(&ray, Some(3e4), Sampling { paths: 16_384, seed: 2, direction: 0 });
        let found = walks.stretch(&ray, 3e4, 0, (8192, 5));
        for k in 0..WAVELENGTH_COUNT {
            let gap = (found.light[k] - want.mean[k]).abs();
            assert!(gap < 0.02 * want.mean[k], "{k}: {} {}", found.light[k], want.mean[k]);
            assert!(found.transmittance[k] > 0.0 && found.transmittance[k] < 0.95, "{:?}", found.transmittance);
        }
        let up = Ray::from_angles(50.0, 0.8, 0.9, 0.7);
        let [all, sky] = [walks.stretch(&up, 1e9, 3, (8, 1)).light, walks.radiance(&[up], 3, (8, 1))[0]];
        assert!(all.iter().zip(&sky).all(|(a, b)| (a - b).abs() <= 1e-12 * b), "all of the sky: {all:?} {sky:?}");
        assert!(walks.sunlight(1e3, -0.2).iter().all(|light| light.abs() < 1e-300), "the planet's shadow");
    }

    #[test]
    fn a_pixel_is_the_same_bits_whatever_is_asked_for_with_it() {
        let atmosphere = Atmosphere::new(&AtmosphereParams::default(), &GroundParams::default());
        let walks = PictureWalks::new(&atmosphere).expect("eight wavelengths");
        let rays = [1.0, 1.3, 1.5].map(|view| Ray::from_angles(2.0, view, 0.9, 0.7));
        let together = walks.radiance(&rays, 10, (8, 3));
        assert_eq!(together[1..], walks.radiance(&rays[1..], 11, (8, 3)), "the second and third");
    }
}

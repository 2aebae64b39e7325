//! The clouds of a scene by random walks, in its air.
//!
//! Walks through the cells as in [`super::reference`]; where one leaves the clouds, walks through the air go on to sky and
//! ground, and the air before the cloud is that of the exact integral. Sunlight has the colour of the first collision's place.
//! Lines of sight bend with the Earth's curvature up to the middle of the cells, within 4 m for cells over 13 km.
//!
//! The air before a pixel's collisions is known at three distances, between which it is interpolated. Not done: the clouds'
//! shade on ground and air, and moonlight. Costs twice what the walks without air do.

use tyndall_clouds::reference::PathSample;
use tyndall_core::spectrum::{Spectrum, WAVELENGTH_COUNT};
use tyndall_scattering::geometry::Ray;
use tyndall_scattering::monte_carlo::{AirStretch, PictureWalks};

use super::reference::CloudReference;

/// Distances at which the air before a pixel's collisions is known.
const STRETCHES: u32 = 3;

/// Clouds and the air around them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CloudsInAir<'a> {
    /// The clouds.
    pub(crate) clouds: &'a CloudReference,
    /// The air.
    pub(crate) air: &'a PictureWalks,
    /// Direction to the sun.
    pub(crate) to_sun: [f64; 3],
}

impl CloudsInAir<'_> {
    /// Radiance (W/m^2/sr/nm) of a pixel, whose centre `ray` goes through, before a `background`.
    pub(crate) fn pixel(
        &self,
        pixel: [u32; 2],
        (ray, background): (&Ray, Spectrum),
        (paths, seed): (u32, u64),
    ) -> Spectrum {
        let samples = self.clouds.samples(pixel, (paths, seed), self.air.planet_radius_m());
        if samples.is_empty() {
            return background;
        }
        let number = self.clouds.number(pixel);
        let before = AirBefore::new(self.air, ray, &samples, (number, paths, seed));
        let clear = f64::from(paths) - samples.len() as f64;
        let mut sum = background.map(|light| light * clear);
        for (index, sample) in (0..).zip(&samples) {
            let light = self.light(ray, sample, (number.wrapping_mul(paths).wrapping_add(index), seed));
            let AirStretch { light: veil, transmittance } = before.at(sample.distance);
            for k in 0..WAVELENGTH_COUNT {
                sum[k] += veil[k] + transmittance[k] * light[k];
            }
        }
        sum.map(|light| light / f64::from(paths))
    }

    /// Radiance of the cloud along a path, where the path meets it.
    fn light(&self, ray: &Ray, sample: &PathSample, (number, seed): (u32, u64)) -> Spectrum {
        let [h_m, mu_sun] = self.air.place_along(ray, sample.distance);
        let mut light = self.air.sunlight(h_m, mu_sun).map(|sun| sun * sample.sunlight);
        if let Some(exit) = sample.exit {
            let nu = exit.direction.iter().zip(self.to_sun).map(|(a, b)| a * b).sum::<f64>().clamp(-1.0, 1.0);
            let away = Ray { h_m, mu: exit.direction[2], mu_sun, nu };
            let around = self.air.radiance_of(&away, number, (1, seed));
            light.iter_mut().zip(around).for_each(|(light, around)| *light += exit.weight * around);
        }
        light
    }
}

/// The air between the camera and a pixel's collisions.
struct AirBefore {
    first_m: f64,
    step_m: f64,
    stretches: Vec<AirStretch>,
}

impl AirBefore {
    fn new(air: &PictureWalks, ray: &Ray, samples: &[PathSample], (number, paths, seed): (u32, u32, u64)) -> Self {
        let ends = |ends: [f64; 2], sample: &PathSample| [ends[0].min(sample.distance), ends[1].max(sample.distance)];
        let [first_m, last_m] = samples.iter().fold([f64::INFINITY, 0.0], ends);
        let step_m = ((last_m - first_m) / f64::from(STRETCHES - 1)).max(1e-3);
        // The same random numbers for all, so that differences are the air's.
        let walks = (paths.div_ceil(STRETCHES), seed);
        let stretch = |index: u32| air.stretch(ray, first_m + f64::from(index) * step_m, number, walks);
        Self { first_m, step_m, stretches: (0..STRETCHES).map(stretch).collect() }
    }

    /// By parabolas through the three distances: of light, and of optical depth.
    fn at(&self, distance_m: f64) -> AirStretch {
        let x = (distance_m - self.first_m) / self.step_m;
        let weights = [0.5 * (x - 1.0) * (x - 2.0), x * (2.0 - x), 0.5 * x * (x - 1.0)];
        let mean = |of: &dyn Fn(&AirStretch) -> f64| {
            self.stretches.iter().zip(weights).map(|(stretch, weight)| weight * of(stretch)).sum::<f64>()
        };
        AirStretch {
            light: std::array::from_fn(|k| mean(&|stretch| stretch.light[k]).max(0.0)),
            transmittance: std::array::from_fn(|k| {
                mean(&|stretch| stretch.transmittance[k].max(1e-300).ln()).exp().min(1.0)
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tyndall_scattering::Atmosphere;
    use tyndall_scattering::params::{AtmosphereParams, GroundParams};

    #[test]
    fn between_three_distances_the_air_is_that_of_the_walks() {
        let air = PictureWalks::new(&Atmosphere::new(&AtmosphereParams::default(), &GroundParams::default()))
            .expect("eight wavelengths");
        let ray = Ray::from_angles(50.0, 1.52, 0.9, 0.7);
        let sample = |distance: f64| PathSample { distance, sunlight: 0.0, exit: None };
        let before = AirBefore::new(&air, &ray, &[26e3, 34e3, 30e3].map(sample), (3, 24_576, 1));
        for distance_m in [26e3, 28e3, 31e3, 34e3] {
            let (found, wanted) = (before.at(distance_m), air.stretch(&ray, distance_m, 3, (8192, 1)));
            for k in 0..WAVELENGTH_COUNT {
                // Walks end elsewhere: their noise is in the light.
                let gap = (found.light[k] / wanted.light[k] - 1.0).abs();
                assert!(gap < 0.03, "light, {distance_m} m, {k}: {gap}");
                let gap = (found.transmittance[k] / wanted.transmittance[k] - 1.0).abs();
                assert!(gap < 1e-3, "transmittance, {distance_m} m, {k}: {gap}");
            }
        }
    }
}

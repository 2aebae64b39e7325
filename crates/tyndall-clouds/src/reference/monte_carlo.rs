//! Light scattered any number of times, by following paths.
//!
//! Delta tracking (Woodcock et al. 1965): flights in a medium of the largest extinction everywhere, of whose collisions only
//! the share of the true extinction counts. At each true collision the sun is added, through a transmittance estimated by
//! ratio tracking in the same way. Both are free of bias in any medium.

use std::f64::consts::PI;

use tyndall_core::rng::CellRng;

use super::medium::Medium;
use super::phase::TabulatedPhase;
use super::ray::Ray;
use super::vector::{Vec3, along, dot, normalised, turned};

/// What shines on the medium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Direction to the sun; its length does not matter.
    pub to_sun: [f64; 3],
    /// Irradiance of the sun on a surface that faces it.
    pub sun_irradiance: f64,
    /// Radiance of the sky, the same from everywhere.
    pub sky_radiance: f64,
}

/// How paths are followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathSettings {
    /// Share of a collision that is scattering.
    pub albedo: f64,
    /// Most scatterings of a path: 1 is single scattering.
    pub max_orders: u32,
    /// Paths of each pixel.
    pub samples: u32,
    /// Seed of the random numbers.
    pub seed: u64,
}

/// What a pixel's paths found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PathResult {
    /// Mean radiance of scattered light; the background is not in it.
    pub radiance: f64,
    /// Standard error of the radiance.
    pub error: f64,
    /// Share of paths that met the medium.
    pub opacity: f64,
}

/// What one path through the medium found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathSample {
    /// Length of the line of sight to the first collision.
    pub distance: f64,
    /// Sunlight that all collisions scattered into the path (1/sr), for a sun of irradiance 1.
    pub sunlight: f64,
    /// Where the path left the medium; none when it was given up inside.
    pub exit: Option<PathExit>,
}

/// Where a path left the medium: light from there is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathExit {
    /// The last collision.
    pub point: [f64; 3],
    /// Where the path goes, of length 1.
    pub direction: [f64; 3],
    /// Share of the light from there that the path stands for.
    pub weight: f64,
}

/// Random numbers of one path.
struct PathRng {
    rng: CellRng,
    pixel: u64,
    sample: u32,
    drawn: u32,
    words: [u32; 4],
}

impl PathRng {
    fn new(seed: u64, pixel: u64, sample: u32) -> Self {
        Self { rng: CellRng::new(seed), pixel, sample, drawn: 0, words: [0; 4] }
    }

    /// A number in 0..1, never 0 or 1.
    fn uniform(&mut self) -> f64 {
        let place = self.drawn % 4;
        if place == 0 {
            self.words = self.rng.words(self.sample, self.pixel, self.drawn / 4);
        }
        self.drawn += 1;
        (f64::from(self.words[place as usize]) + 0.5) / 4_294_967_296.0
    }

    /// Length of a flight in a medium of this extinction.
    fn flight(&mut self, extinction: f64) -> f64 {
        -self.uniform().ln() / extinction
    }
}

/// The mean over all paths of one pixel; `ray` gives a ray for two numbers in 0..1 across the pixel.
#[must_use]
pub fn path_radiance(
    medium: &Medium,
    phase: &TabulatedPhase,
    light: &Light,
    settings: &PathSettings,
    pixel: u64,
    ray: impl Fn([f64; 2]) -> Ray,
) -> PathResult {
    let (mut sum, mut squares, mut met) = (0.0, 0.0, 0.0);
    for sample in 0..settings.samples {
        if let Some(path) = path_sample(medium, phase, light, settings, (pixel, sample), &ray) {
            let sky = path.exit.map_or(0.0, |exit| exit.weight * light.sky_radiance);
            let radiance = path.sunlight * light.sun_irradiance + sky;
            sum += radiance;
            squares += radiance * radiance;
            met += 1.0;
        }
    }
    let count = f64::from(settings.samples.max(1));
    let radiance = sum / count;
    let variance = (squares / count - radiance * radiance).max(0.0) / (count - 1.0).max(1.0);
    PathResult { radiance, error: variance.sqrt(), opacity: met / count }
}

/// The path of a number of one pixel; none when it goes through without a collision. Sunlight is looked for where
/// `light` has a sun.
#[must_use]
pub fn path_sample(
    medium: &Medium,
    phase: &TabulatedPhase,
    light: &Light,
    settings: &PathSettings,
    (pixel, sample): (u64, u32),
    ray: impl Fn([f64; 2]) -> Ray,
) -> Option<PathSample> {
    let world = World { medium, phase, light, settings, to_sun: normalised(light.to_sun) };
    let mut rng = PathRng::new(settings.seed, pixel, sample);
    let place = [rng.uniform(), rng.uniform()];
    world.follow(ray(place), &mut rng)
}

struct World<'a> {
    medium: &'a Medium,
    phase: &'a TabulatedPhase,
    light: &'a Light,
    settings: &'a PathSettings,
    to_sun: Vec3,
}

impl World<'_> {
    /// What a path finds; none when it goes through without a collision.
    fn follow(&self, ray: Ray, rng: &mut PathRng) -> Option<PathSample> {
        let mut direction = normalised(ray.direction);
        let mut point = self.collision(ray.origin, direction, rng)?;
        let away = [0, 1, 2].map(|axis| point[axis] - ray.origin[axis]);
        let (mut sample, mut weight) = (PathSample { distance: dot(away, direction), sunlight: 0.0, exit: None }, 1.0);
        for order in 1..=self.settings.max_orders {
            weight *= self.settings.albedo;
            if self.light.sun_irradiance > 0.0 {
                let scattered = self.phase.value(dot(self.to_sun, direction));
                sample.sunlight += weight * scattered * self.sun_share(point, rng);
            }
            // Light that is weak already is followed now and then, for all that it stands for.
            if weight < 0.01 {
                if rng.uniform() >= 0.1 {
                    break;
                }
                weight *= 10.0;
            }
            direction = turned(direction, self.phase.sample(rng.uniform()), 2.0 * PI * rng.uniform());
            match self.collision(point, direction, rng) {
                Some(next) if order < self.settings.max_orders => point = next,
                Some(_) => break,
                None => {
                    sample.exit = Some(PathExit { point, direction, weight });
                    break;
                }
            }
        }
        Some(sample)
    }

    /// Where a flight from `origin` ends; none when it leaves the box.
    fn collision(&self, origin: Vec3, direction: Vec3, rng: &mut PathRng) -> Option<Vec3> {
        let [near, far] = self.medium.crossing(origin, direction)?;
        let largest = self.medium.largest();
        let mut distance = near;
        loop {
            // In an empty medium a flight is infinite.
            distance += rng.flight(largest);
            if distance >= far {
                return None;
            }
            let point = along(origin, direction, distance);
            if rng.uniform() * largest < self.medium.extinction(point) {
                return Some(point);
            }
        }
    }

    /// An estimate of the sun's transmittance to a point.
    fn sun_share(&self, origin: Vec3, rng: &mut PathRng) -> f64 {
        let Some([near, far]) = self.medium.crossing(origin, self.to_sun) else { return 1.0 };
        let largest = self.medium.largest();
        let (mut distance, mut share) = (near, 1.0);
        while share > 0.0 {
            distance += rng.flight(largest);
            if distance >= far {
                break;
            }
            share *= 1.0 - self.medium.extinction(along(origin, self.to_sun, distance)) / largest;
        }
        share
    }
}

#[cfg(test)]
mod tests {
    use tyndall_core::grid::Grid3;

    use super::*;
    use crate::reference::single_scattering;

    fn lumps() -> Medium {
        let value = |i: u32| (i.wrapping_mul(2_654_435_761) >> 24) as f32 / 255.0;
        Medium::new(Grid3::from_cells([12, 10, 8], (0..960).map(value).collect()).unwrap(), 1.0).unwrap()
    }

    const SETTINGS: PathSettings = PathSettings { albedo: 1.0, max_orders: 10_000, samples: 4000, seed: 3 };

    fn ray(_: [f64; 2]) -> Ray {
        Ray { origin: [-3.0, 5.0, 3.7], direction: [1.0, 0.05, 0.02] }
    }

    #[test]
    fn under_an_even_sky_a_white_medium_cannot_be_seen() {
        let light = Light { to_sun: [0.0, 0.0, 1.0], sun_irradiance: 0.0, sky_radiance: 2.5 };
        for phase in [TabulatedPhase::new(|_| 1.0).unwrap(), TabulatedPhase::new(|mu| (1.2 - mu).powi(-2)).unwrap()] {
            let found = path_radiance(&lumps(), &phase, &light, &SETTINGS, 0, ray);
            assert!((found.radiance - 2.5 * found.opacity).abs() < 1e-9, "{found:?}");
        }
    }

    #[test]
    fn single_scattering_by_paths_is_that_of_the_march() {
        let light = Light { to_sun: [0.3, 0.4, 0.8], sun_irradiance: 1.0, sky_radiance: 0.0 };
        let phase = TabulatedPhase::new(|mu| 1.0 + 0.5 * mu).unwrap();
        let settings = PathSettings { max_orders: 1, samples: 40_000, ..SETTINGS };
        let found = path_radiance(&lumps(), &phase, &light, &settings, 7, ray);
        let [radiance, transmittance] = single_scattering(&lumps(), &phase, light.to_sun, ray([0.0; 2]), 0.02);
        // The share of paths that meet nothing is binomial.
        let spread = (transmittance * (1.0 - transmittance) / 40_000.0).sqrt();
        assert!((found.opacity - (1.0 - transmittance)).abs() < 4.0 * spread, "{found:?} {transmittance}");
        assert!((found.radiance - radiance).abs() < 4.0 * found.error, "{found:?} {radiance}");
        assert!(found.error < 0.01 * radiance, "{found:?}");
    }

    #[test]
    fn absorption_takes_light_and_higher_orders_add_it() {
        let light = Light { to_sun: [0.0, 0.0, 1.0], sun_irradiance: 1.0, sky_radiance: 0.0 };
        let phase = TabulatedPhase::new(|_| 1.0).unwrap();
        let radiance = |albedo, max_orders| {
            let settings = PathSettings { albedo, max_orders, ..SETTINGS };
            path_radiance(&lumps(), &phase, &light, &settings, 1, ray).radiance
        };
        let (once, all, grey) = (radiance(1.0, 1), radiance(1.0, 10_000), radiance(0.8, 10_000));
        assert!(all > 1.5 * once && grey < 0.8 * all && grey > 0.8 * once, "{once} {all} {grey}");
    }
}

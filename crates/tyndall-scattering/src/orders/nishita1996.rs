//! The second order of scattering by eight directions, after Nishita et al. 1996 (reference 7 of the paper).
//!
//! The light that a point scatters a second time is light scattered once, and that one is looked up in eight directions of
//! the sun's meridian plane only: up, down, both ways along the ground, to the sun, away from it, and both ways across it.
//! Each stands for the directions that it is the nearest one to. Those cells are lunes of 45 degrees whatever the sun's
//! height, for the eight angles are two crosses: the edges are those of eight even lunes turned by half of the angle
//! between the crosses. Nothing degenerates where the crosses coincide, under a sun in the zenith or on the horizon; under
//! the former every upright plane is the sun's meridian plane, and the mean over all of them is taken.
//! Higher orders are dropped.
//!
//! Where this differs from the original: light in a direction is a function of altitude and the sun's zenith angle alone,
//! by the symmetry of the sphere, so that one table over these two replaces voxel grids for each sun; "up" is up at the
//! scattering point, not at the observer; sunlight from the ground counts as scattered once. The phase integrals over
//! the lunes are taken to the fourth degree of spherical harmonics, so that all that reads the table of
//! [`super::SourceTable`] works with this one as well: exact for air; aerosol blurs the edges of the lunes more than its
//! phase function would, which changes the sky by 3 % (median, 9 % in the worst direction of the test below), against the
//! 4 to 10 % by which the method itself is off, near a half at the horizon.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use rayon::prelude::*;

use super::basis::{MAX_DEGREE, MAX_HARMONICS, azimuth_parts, harmonic_count, harmonic_index, zenith_parts};
use super::build::OrderLoop;
use super::directions::gauss_legendre;
use super::field::{DARK, Field, Light, add_scaled};
use super::path::narrow;
use crate::geometry::Ray;
use crate::irradiance_table::sky_irradiance;

/// Directions in which light scattered once is looked up.
const DIRECTIONS: usize = 8;

/// Nodes of the quadrature over a lune, in each of its two angles: the integrands are of low degree.
const NODES: usize = 10;

/// A direction in the plane of zenith and sun: its components upwards and towards the sun's azimuth.
type InPlane = (f64, f64);

/// The eight directions, by their angle from the zenith over the sun's side, and the angle (rad) between the two crosses
/// that they are.
fn directions(mu_sun: f64) -> ([InPlane; DIRECTIONS], f64) {
    let sine = (1.0 - mu_sun * mu_sun).max(0.0).sqrt();
    // The second cross is the sun's, turned back by a right angle where the sun is below the horizon.
    let (up, along) = if mu_sun >= 0.0 { (mu_sun, sine) } else { (sine, -mu_sun) };
    let directions =
        [(1.0, 0.0), (up, along), (0.0, 1.0), (-along, up), (-1.0, 0.0), (-up, -along), (0.0, -1.0), (along, -up)];
    (directions, along.atan2(up))
}

/// First edge (rad) of the lune of direction `index`: the middle between it and the direction before.
fn lune_start(index: usize, between_crosses: f64) -> f64 {
    0.5 * between_crosses + FRAC_PI_4 * (index as f64 - 1.0)
}

/// Integrals of all harmonics over the lune of 45 degrees from `start` (rad from the zenith over the sun's side).
fn lune_harmonics(start: f64) -> [f64; MAX_HARMONICS] {
    let nodes = gauss_legendre(NODES);
    let mut sums = [0.0; MAX_HARMONICS];
    for (across, to_across) in &nodes {
        // The angle out of the plane, on one side; the other is its mirror image.
        let (sine, cosine) = (FRAC_PI_2 * across).sin_cos();
        for (along, to_along) in &nodes {
            let (towards_sun, up) = (start + FRAC_PI_4 * along).sin_cos();
            let (mu, horizontal) = (cosine * up, cosine * towards_sun);
            let solid_angle = 2.0 * FRAC_PI_2 * to_across * FRAC_PI_4 * to_along * cosine;
            let (zenith, azimuth) = (zenith_parts(mu, MAX_DEGREE), azimuth_parts(horizontal / horizontal.hypot(sine)));
            for l in 0..=MAX_DEGREE {
                for (m, azimuth) in azimuth.iter().enumerate().take(l + 1) {
                    sums[harmonic_index(l, m)] += solid_angle * zenith[harmonic_index(l, m)] * azimuth;
                }
            }
        }
    }
    sums
}

/// Light scattered or reflected once, as the eight directions see it: constant in the lune of each. The irradiance on the
/// ground is that of the whole sky.
pub(crate) fn first_order(orders: &OrderLoop<'_>) -> Field {
    let nodes = *orders.nodes();
    let once = orders.once();
    let mut field = Field::dark(nodes, MAX_DEGREE);
    let by_sun = field.harmonics.par_chunks_mut(nodes.altitude_count() * harmonic_count(MAX_DEGREE));
    by_sun.zip(&mut field.irradiance).enumerate().for_each(|(sun, (altitudes, irradiance))| {
        let mu_sun = nodes.mu_sun(sun);
        let (directions, between_crosses) = directions(mu_sun);
        let lunes: [[f32; MAX_HARMONICS]; DIRECTIONS] =
            std::array::from_fn(|index| narrow(lune_harmonics(lune_start(index, between_crosses))));
        for (altitude, harmonics) in altitudes.chunks_mut(harmonic_count(MAX_DEGREE)).enumerate() {
            let lights = directions.map(|direction| once.radiance(&ray(nodes.altitude_m(altitude), mu_sun, direction)));
            sum_lunes(harmonics, &lights, &lunes);
            if mu_sun >= 1.0 {
                average_over_planes(harmonics);
            }
        }
        *irradiance = narrow(sky_irradiance(&once.marcher, mu_sun));
    });
    field
}

/// Turns light about the vertical: what depends on the azimuth vanishes.
fn average_over_planes(harmonics: &mut [Light]) {
    for (l, m) in (1..=MAX_DEGREE).flat_map(|l| (1..=l).map(move |m| (l, m))) {
        harmonics[harmonic_index(l, m)] = DARK;
    }
}

fn ray(h_m: f64, mu_sun: f64, (up, along): InPlane) -> Ray {
    let sine = (1.0 - mu_sun * mu_sun).max(0.0).sqrt();
    Ray { h_m, mu: up, mu_sun, nu: (up * mu_sun + along * sine).clamp(-1.0, 1.0) }
}

fn sum_lunes(harmonics: &mut [Light], lights: &[Light; DIRECTIONS], lunes: &[[f32; MAX_HARMONICS]; DIRECTIONS]) {
    for (k, harmonic) in harmonics.iter_mut().enumerate() {
        *harmonic = DARK;
        for (light, lune) in lights.iter().zip(lunes) {
            add_scaled(harmonic, light, lune[k]);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use tyndall_core::spectrum::WAVELENGTH_COUNT;

    use super::*;
    use crate::Atmosphere;
    use crate::atmosphere::{AEROSOL, AIR};
    use crate::geometry::{altitude_along, mu_along};
    use crate::march::Marcher;
    use crate::optical_length::columns_along;
    use crate::orders::build::Once;
    use crate::orders::media::ScatteringMedia;
    use crate::orders::path::azimuth_between;
    use crate::orders::{OrdersQuality, SourceTable, diffuse_scattered};
    use crate::params::{AtmosphereParams, GroundParams};
    use crate::phase::Phase;
    use crate::quadrature;
    use crate::single_scattering::ray_end;

    /// Of the eight: 536 nm.
    const WAVELENGTH: usize = 3;

    fn marcher() -> Marcher {
        let atmosphere = Atmosphere::new(&AtmosphereParams::default(), &GroundParams::default());
        Marcher::new(atmosphere, 8).expect("eight wavelengths")
    }

    const SUNS: [f64; 7] = [0.0, 20.0, 60.0, 89.999, 90.0, 90.001, 97.0];

    #[test]
    fn every_direction_lies_in_its_lune_and_is_the_nearest_one_there() {
        for sun_zenith in SUNS.map(f64::to_radians) {
            let (directions, between) = directions(sun_zenith.cos());
            for (index, (up, along)) in directions.into_iter().enumerate() {
                let turn = along.atan2(up) - lune_start(index, between);
                let turn = (turn + 1e-9).rem_euclid(2.0 * PI) - 1e-9;
                assert!(turn <= FRAC_PI_4 + 1e-9, "sun {sun_zenith}, direction {index}: {turn} from the edge");
                // Just inside of both edges no other direction is nearer.
                for edge in [1e-6, FRAC_PI_4 - 1e-6].map(|inside| lune_start(index, between) + inside) {
                    let cosine = |(up, along): InPlane| up * edge.cos() + along * edge.sin();
                    let nearest = directions.into_iter().map(cosine).fold(-1.0, f64::max);
                    let own = cosine((up, along));
                    assert!(own > nearest - 1e-5, "sun {sun_zenith}, direction {index}: {own} and {nearest}");
                }
            }
        }
    }

    #[test]
    fn the_sun_is_one_of_the_directions_and_so_is_its_opposite() {
        for sun_zenith in SUNS.map(f64::to_radians) {
            let cosines = directions(sun_zenith.cos()).0.map(|direction| ray(0.0, sun_zenith.cos(), direction).nu);
            let [most, least] = [cosines.into_iter().fold(-1.0, f64::max), cosines.into_iter().fold(1.0, f64::min)];
            assert!((most - 1.0).abs() < 1e-12 && (least + 1.0).abs() < 1e-12, "{sun_zenith}: {cosines:?}");
        }
    }

    #[test]
    fn the_lunes_fill_the_sphere() {
        for sun_zenith in SUNS.map(f64::to_radians) {
            let between = directions(sun_zenith.cos()).1;
            let mut sums = [0.0; MAX_HARMONICS];
            for index in 0..DIRECTIONS {
                for (sum, lune) in sums.iter_mut().zip(lune_harmonics(lune_start(index, between))) {
                    *sum += lune;
                }
            }
            assert!((sums[0] - (4.0 * PI).sqrt()).abs() < 1e-9, "solid angle: {}", sums[0]);
            assert!(sums[1..].iter().all(|sum| sum.abs() < 1e-9), "even light has no other harmonic: {sums:?}");
        }
    }

    /// Integral of a phase function over the lune from `start`, for light that leaves in a direction.
    fn phase_integral(phase: Phase, start: f64, leaving: [f64; 3]) -> f64 {
        const STEPS: usize = 48;
        let step = |count: usize| (count as f64 + 0.5) / STEPS as f64;
        let mut sum = 0.0;
        for across in 0..2 * STEPS {
            let (sine, cosine) = (FRAC_PI_2 * (step(across) - 1.0)).sin_cos();
            for along in 0..STEPS {
                let (towards_sun, up) = (start + FRAC_PI_4 * step(along)).sin_cos();
                let nu = leaving[0] * cosine * towards_sun + leaving[1] * sine + leaving[2] * cosine * up;
                sum += cosine * phase.value(nu.clamp(-1.0, 1.0));
            }
        }
        sum * FRAC_PI_2 * FRAC_PI_4 / (STEPS * STEPS) as f64
    }

    /// What the harmonics make of it.
    fn phase_integral_of_harmonics(moments: &[f32; MAX_DEGREE + 1], start: f64, leaving: [f64; 3]) -> f64 {
        let (lune, zenith) = (lune_harmonics(start), zenith_parts(leaving[2], MAX_DEGREE));
        let azimuth = azimuth_parts(leaving[0] / leaving[0].hypot(leaving[1]));
        let harmonics = (0..=MAX_DEGREE).flat_map(|l| (0..=l).map(move |m| (l, m)));
        let terms = harmonics.map(|(l, m)| {
            let k = harmonic_index(l, m);
            f64::from(moments[l]) * lune[k] * zenith[k] * azimuth[m]
        });
        terms.sum()
    }

    /// Directions that light leaves in: towards the sun's azimuth, across, up.
    fn leaving() -> impl Iterator<Item = [f64; 3]> {
        let views = [10.0_f64, 30.0, 50.0, 70.0, 80.0, 89.0, 120.0].map(f64::to_radians);
        let azimuths = [0.01_f64, 0.8, 1.6, 2.4, 3.1];
        views.into_iter().flat_map(move |view| {
            azimuths.map(|azimuth| [view.sin() * azimuth.cos(), view.sin() * azimuth.sin(), view.cos()])
        })
    }

    #[test]
    fn the_phase_integrals_of_air_over_the_lunes_are_exact() {
        let moments = ScatteringMedia::new(&marcher().atmosphere).moments[AIR];
        for leaving in leaving() {
            for start in (0..DIRECTIONS).map(|index| lune_start(index, 0.7)) {
                let want = phase_integral(Phase::Rayleigh, start, leaving);
                let got = phase_integral_of_harmonics(&moments, start, leaving);
                // The error of the midpoint rule.
                assert!((got - want).abs() < 2e-5, "{leaving:?}, {start}: {got} {want}");
            }
        }
    }

    /// Light at 536 nm that the media at a place scatter into a ray, by exact phase integrals over the lunes.
    fn scattered_exactly(once: &Once<'_>, (h_m, mu, mu_sun, nu): (f64, f64, f64, f64)) -> f64 {
        let (directions, between) = directions(mu_sun);
        let (cosine, sine) = (azimuth_between(mu, mu_sun, nu), (1.0 - mu * mu).sqrt());
        let leaving = [sine * cosine, sine * (1.0 - cosine * cosine).sqrt(), mu];
        let lunes = directions.into_iter().enumerate().map(|(index, direction)| {
            let light = f64::from(once.radiance(&ray(h_m, mu_sun, direction))[WAVELENGTH]);
            let media = [AIR, AEROSOL].map(|medium| &once.marcher.atmosphere.media[medium]);
            let scattered = media.map(|medium| {
                let per_m = medium.profile.density(h_m) * medium.scattering_per_m[WAVELENGTH];
                per_m * phase_integral(medium.phase, lune_start(index, between), leaving)
            });
            light * scattered.into_iter().sum::<f64>()
        });
        lunes.sum()
    }

    /// The second order in a ray that does not meet the ground, by exact phase integrals, in 20 nodes.
    fn second_order(once: &Once<'_>, ray: &Ray) -> f64 {
        const PANELS: usize = 5;
        let (marcher, radius_m) = (&once.marcher, once.marcher.atmosphere.planet_radius_m);
        let length_m = ray_end(&marcher.atmosphere, ray.h_m, ray.mu).length_m;
        let nodes = (0..PANELS)
            .flat_map(|panel| quadrature::NODES.into_iter().zip(quadrature::WEIGHTS).map(move |n| (panel, n)));
        let light = nodes.map(|(panel, (node, weight))| {
            let x = (panel as f64 + node) / PANELS as f64;
            let (t_m, step_m) = (length_m * x * x, weight / PANELS as f64 * 2.0 * x * length_m);
            let columns = columns_along(&marcher.atmosphere, ray.h_m, ray.mu, t_m);
            let h_m = altitude_along(radius_m, ray.h_m, ray.mu, t_m);
            let mu = mu_along(radius_m, ray.h_m, ray.mu, 1.0, t_m, h_m);
            let mu_sun = mu_along(radius_m, ray.h_m, ray.mu_sun, ray.nu, t_m, h_m);
            let here = scattered_exactly(once, (h_m, mu, mu_sun, ray.nu));
            step_m * marcher.coefficients.transmittance(&columns)[WAVELENGTH] * here
        });
        light.sum()
    }

    #[test]
    fn the_sky_by_harmonics_is_the_one_by_exact_phase_integrals() {
        let marcher = marcher();
        let quality = OrdersQuality::nishita1996();
        let (orders, source) = (OrderLoop::new(&marcher, &quality), SourceTable::new(&marcher, &quality));
        let once = orders.once();
        let mut errors = Vec::new();
        for sun_zenith in [30.0_f64, 60.0, 85.0] {
            for (view, azimuth) in [(2.0_f64, 0.5_f64), (40.0, 0.2), (40.0, 3.0), (65.0, 1.5), (80.0, 0.6), (88.0, 2.4)]
            {
                let ray = Ray::from_angles(2.0, view.to_radians(), sun_zenith.to_radians(), azimuth);
                let first = f64::from(once.radiance(&ray)[WAVELENGTH]);
                let want = second_order(&once, &ray);
                let end = ray_end(&marcher.atmosphere, ray.h_m, ray.mu);
                let got = diffuse_scattered(&marcher, &source, &ray, end)[WAVELENGTH];
                errors.push((got - want).abs() / (first + want));
            }
        }
        errors.sort_by(f64::total_cmp);
        let [median, worst] = [errors[errors.len() / 2], errors[errors.len() - 1]];
        println!(
            "sky with the second order by harmonics: median {:.1} %, worst {:.1} %",
            100.0 * median,
            100.0 * worst
        );
        assert!(median < 0.04 && worst < 0.1, "median {median}, worst {worst}");
    }

    #[test]
    fn in_even_light_the_second_order_is_that_light() {
        // Lights of the eight directions alike: only the mean harmonic is left, whatever the sun.
        let lights = [[2.0_f32; WAVELENGTH_COUNT]; DIRECTIONS];
        let lunes = std::array::from_fn(|index| narrow(lune_harmonics(lune_start(index, 0.4))));
        let mut harmonics = [DARK; MAX_HARMONICS];
        sum_lunes(&mut harmonics, &lights, &lunes);
        assert!((f64::from(harmonics[0][3]) - 2.0 * (4.0 * PI).sqrt()).abs() < 1e-5, "{:?}", harmonics[0]);
        assert!(harmonics[1..].iter().flatten().all(|light| light.abs() < 1e-5), "{harmonics:?}");
    }

    #[test]
    fn the_light_of_eight_directions_is_finite_and_smooth_across_the_horizon() {
        let marcher = marcher();
        let started = std::time::Instant::now();
        let source = SourceTable::new(&marcher, &OrdersQuality::nishita1996());
        println!("table of the second order by eight directions: {:.0} ms", started.elapsed().as_secs_f64() * 1e3);
        let field = source.field();
        let lights = field.harmonics.iter().chain(&field.irradiance).flatten();
        assert!(lights.into_iter().all(|light| light.is_finite()), "NaN or infinite");
        for sun in 0..field.nodes.sun_count() {
            for altitude in 0..field.nodes.altitude_count() {
                let mean = field.at(sun, altitude)[0];
                assert!(mean.iter().all(|light| *light >= 0.0), "sun {sun}, altitude {altitude}: {mean:?}");
            }
        }
        // Under a sun in the zenith all azimuths are alike.
        let overhead = |cos_azimuth: f64| {
            let (sun_zenith, view) = (1e-4_f64, 1.0_f64);
            let ray = Ray::from_angles(2.0, view, sun_zenith, cos_azimuth.acos());
            diffuse_scattered(&marcher, &source, &ray, ray_end(&marcher.atmosphere, ray.h_m, ray.mu))[WAVELENGTH]
        };
        let [along, across] = [1.0, 0.0].map(overhead);
        assert!((along / across - 1.0).abs() < 1e-3, "sun in the zenith: {along} along, {across} across");
        let on_ground = source.irradiance_beyond_first(0.5);
        assert!(on_ground.iter().all(|light| light.abs() < 1e-30), "the ground is lit as by one order: {on_ground:?}");
        let near = |mu_sun: f64| {
            let between = directions(mu_sun).1;
            let lights = directions(mu_sun).0.map(|(up, _)| [narrow([1.0 + up])[0]; WAVELENGTH_COUNT]);
            let lunes = std::array::from_fn(|index| narrow(lune_harmonics(lune_start(index, between))));
            let mut harmonics = [DARK; MAX_HARMONICS];
            sum_lunes(&mut harmonics, &lights, &lunes);
            harmonics
        };
        // The order of the directions changes where the sun crosses the horizon; the light does not.
        let [above, below] = [near(1e-6), near(-1e-6)];
        for (above, below) in above.iter().zip(&below) {
            assert!((above[0] - below[0]).abs() < 1e-4, "{} {}", above[0], below[0]);
        }
    }
}

//! Laws that the orders of scattering obey.

use std::f64::consts::PI;

use tyndall_core::spectrum::WAVELENGTH_COUNT;

use super::basis::{harmonic_index, zenith_parts};
use super::build::OrderLoop;
use super::directions::zeniths;
use super::path::{Path, azimuth_between};
use super::{OrdersQuality, SourceTable, diffuse_radiance};
use crate::Atmosphere;
use crate::atmosphere::{AEROSOL, AIR, MEDIUM_COUNT};
use crate::geometry::{Ray, altitude_along, horizon_mu, mu_along};
use crate::haze::HazeParams;
use crate::march::Marcher;
use crate::monte_carlo::{MonteCarlo, Sampling};
use crate::optical_length::columns_along;
use crate::params::{AtmosphereParams, GroundParams};
use crate::quadrature::{NODES, WEIGHTS, integrate};
use crate::single_scattering::{ray_end, single_scattering};
use crate::table_sky::TableSky;

fn marcher(change: impl FnOnce(&mut AtmosphereParams), albedo: f64) -> Marcher {
    let mut params = AtmosphereParams::default();
    change(&mut params);
    let ground = GroundParams { red: albedo, green: albedo, blue: albedo, ..GroundParams::default() };
    Marcher::new(Atmosphere::new(&params, &ground), 8).expect("eight wavelengths")
}

/// Light that a point scatters towards the start of a ray, from single scattering in all directions: by definition.
fn scattered_twice_at(marcher: &Marcher, ray: &Ray, t_m: f64) -> [[f64; WAVELENGTH_COUNT]; 2] {
    const ZENITHS: usize = 24;
    const AZIMUTHS: usize = 48;
    let radius_m = marcher.atmosphere.planet_radius_m;
    let h_m = altitude_along(radius_m, ray.h_m, ray.mu, t_m);
    let mu = mu_along(radius_m, ray.h_m, ray.mu, 1.0, t_m, h_m);
    let mu_sun = mu_along(radius_m, ray.h_m, ray.mu_sun, ray.nu, t_m, h_m);
    let to_sun = azimuth_between(mu, mu_sun, ray.nu).acos();
    let mut sums = [[0.0; WAVELENGTH_COUNT]; 2];
    for zenith in zeniths(horizon_mu(radius_m, h_m), ZENITHS, AZIMUTHS) {
        for azimuth in 0..2 * AZIMUTHS {
            let phi = PI * (azimuth as f64 + 0.5) / AZIMUTHS as f64;
            let cosine = |mu_other: f64, phi: f64| {
                let sines = ((1.0 - zenith.mu.powi(2)) * (1.0 - mu_other * mu_other)).sqrt();
                (zenith.mu * mu_other + sines * phi.cos()).clamp(-1.0, 1.0)
            };
            let incoming = Ray { h_m, mu: zenith.mu, mu_sun, nu: cosine(mu_sun, phi) };
            let parts = marcher.scattered_parts(&incoming);
            let phase = |medium: usize, cosine: f64| marcher.atmosphere.media[medium].phase.value(cosine);
            let turn = cosine(mu, phi - to_sun);
            for (medium, sum) in sums.iter_mut().enumerate() {
                // The quadrature's solid angle stands for a direction and its mirror image.
                let weight = 0.5 * zenith.solid_angle * phase(medium, turn);
                for (k, sum) in sum.iter_mut().enumerate() {
                    let light =
                        phase(AIR, incoming.nu) * parts[AIR][k] + phase(AEROSOL, incoming.nu) * parts[AEROSOL][k];
                    *sum += weight * light;
                }
            }
        }
    }
    sums
}

/// Light scattered exactly twice in a ray that does not meet the ground, in 20 nodes.
fn second_order(marcher: &Marcher, ray: &Ray) -> [f64; WAVELENGTH_COUNT] {
    const PANELS: usize = 5;
    let atmosphere = &marcher.atmosphere;
    let length_m = ray_end(atmosphere, ray.h_m, ray.mu).length_m;
    let mut sum = [0.0; WAVELENGTH_COUNT];
    for (panel, (node, weight)) in (0..PANELS).flat_map(|panel| NODES.into_iter().zip(WEIGHTS).map(move |n| (panel, n)))
    {
        let x = (panel as f64 + node) / PANELS as f64;
        let (t_m, step_m) = (length_m * x * x, weight / PANELS as f64 * 2.0 * x * length_m);
        let transmittance = marcher.coefficients.transmittance(&columns_along(atmosphere, ray.h_m, ray.mu, t_m));
        let altitude_m = altitude_along(atmosphere.planet_radius_m, ray.h_m, ray.mu, t_m);
        let light = scattered_twice_at(marcher, ray, t_m);
        for (medium, light) in atmosphere.media.iter().zip(light) {
            for (k, sum) in sum.iter_mut().enumerate() {
                let scattering = medium.scattering_per_m[k] * medium.profile.density(altitude_m);
                *sum += step_m * transmittance[k] * scattering * light[k];
            }
        }
    }
    sum
}

#[test]
fn the_second_order_equals_the_direct_double_integral() {
    let marcher = marcher(|p| p.aerosol_asymmetry = 0.5, 0.0);
    let quality = OrdersQuality::best();
    let orders = OrderLoop::new(&marcher, &quality);
    let first = orders.first();
    let ray = Ray::from_angles(0.0, 1.0, 0.7, 0.9);
    let end = ray_end(&marcher.atmosphere, ray.h_m, ray.mu);
    let path = Path::new(&marcher, &orders.media, &first, (ray.h_m, ray.mu, end), 8);
    let got = path.gather_once(&first, &ray);

    let want = second_order(&marcher, &ray);
    for (k, (got, want)) in got.into_iter().zip(want).enumerate() {
        // The harmonics end at degree 4, where the aerosol still has 6 % of its moments.
        assert!((f64::from(got) / want - 1.0).abs() < 0.01, "wavelength {k}: {got} {want}");
    }
}

#[test]
fn a_white_furnace_gives_back_all_light() {
    // No absorption and a white ground: what enters the planet's atmosphere leaves it again, summed over the planet.
    let marcher = marcher(|p| (p.aerosol_albedo, p.ozone_du) = (1.0, 0.0), 1.0);
    let quality = OrdersQuality { orders: 12, ..OrdersQuality::best() };
    let orders = OrderLoop::new(&marcher, &quality);
    let total = orders.sum(&orders.first());
    let (radius_m, top_m) = (marcher.atmosphere.planet_radius_m, marcher.atmosphere.top_altitude_m);
    let top = total.nodes.altitude_count() - 1;
    let upward_unit = zenith_parts(1.0, 1)[harmonic_index(1, 0)];
    for k in 0..WAVELENGTH_COUNT {
        let solar = marcher.coefficients.solar_irradiance_w_m2_nm[k];
        // The harmonics are those of the direction of view: light that leaves is seen from above.
        let upward = |mu_sun: f64| {
            let place = total.nodes.sun_place(mu_sun);
            let at = |sun: usize| f64::from(total.at(sun, top)[harmonic_index(1, 0)][k]) / upward_unit;
            at(place.index) * (1.0 - place.fraction) + at(place.index + 1) * place.fraction
        };
        let lowest = total.nodes.lowest_mu_sun();
        // The planet's surface element is 2 pi R^2 d(mu_sun), the sun's cross-section pi R^2.
        let leaving = -2.0 * (integrate(lowest, 0.0, 40, upward) + integrate(0.0, 1.0, 40, upward));
        // Sunlight that only grazes the air passes through: b db over impact parameters from ground to top.
        let passing = integrate(0.0, 1.0, 40, |x| {
            let h_m = top_m * x * x;
            let half = marcher.columns.lookup(h_m, 0.0);
            let transmittance =
                marcher.coefficients.transmittance(&std::array::from_fn::<f64, MEDIUM_COUNT, _>(|m| 2.0 * half[m]));
            2.0 * (radius_m + h_m) * transmittance[k] * 2.0 * x * top_m
        });
        let entering = solar * (1.0 - passing / (radius_m + top_m).powi(2));
        println!("white furnace, wavelength {k}: {:.5}", leaving / entering);
        assert!((leaving / entering - 1.0).abs() < 5e-3, "wavelength {k}: {leaving} of {entering}");
    }
}

#[test]
fn higher_orders_add_most_light_where_the_air_is_thickest() {
    let marcher = marcher(|p| (p.aerosol_optical_depth, p.ozone_du) = (0.0, 0.0), 0.0);
    let quality = OrdersQuality::preview();
    let orders = OrderLoop::new(&marcher, &quality);
    let first = orders.first();
    let total = orders.sum(&first);
    let zenith_sun = total.nodes.sun_count() - 1;
    let gain = |k: usize| total.irradiance[zenith_sun][k] / first.irradiance[zenith_sun][k];
    assert!((1..WAVELENGTH_COUNT).all(|k| 1.0 < gain(k) && gain(k) < gain(k - 1)), "violet gains most");
}

#[test]
fn the_sky_of_all_orders_is_the_same_on_any_number_of_threads() {
    let marcher = marcher(|_| {}, 0.2);
    let quality = OrdersQuality { altitudes: 4, suns_above: 4, suns_below: 3, ..OrdersQuality::preview() };
    let build = || {
        let orders = OrderLoop::new(&marcher, &quality);
        orders.sum(&orders.first()).harmonics
    };
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("one thread").install(build);
    assert_eq!(alone, build(), "bit by bit");
}

#[test]
fn the_light_of_higher_orders_is_finite_and_positive_at_any_altitude_and_sun() {
    let marcher = marcher(|_| {}, 0.15);
    let source = SourceTable::new(&marcher, &OrdersQuality::preview());
    for sun in [0.0_f64, 60.0, 88.0, 94.0, 100.0, 106.0] {
        for zenith in [0.5_f64, 45.0, 80.0, 89.0, 91.0, 135.0, 179.5] {
            for h_m in [1.0, 1e3, 12e3, 99e3] {
                let ray = Ray::from_angles(h_m, zenith.to_radians(), sun.to_radians(), 1.0);
                let more = diffuse_radiance(&marcher, &source, &ray);
                let first = single_scattering(&marcher.atmosphere, &ray);
                let fine =
                    more.iter().zip(&first).all(|(more, first)| more.is_finite() && *more >= 0.0 && *first >= 0.0);
                assert!(fine, "sun {sun}, view {zenith}, altitude {h_m}: {more:?}");
            }
        }
    }
}

#[test]
fn all_orders_in_haze_are_those_of_random_walks() {
    let haze =
        HazeParams { enabled: true, visibility_km: 50.0, top_m: 500.0, scale_height_m: 200.0, ..HazeParams::default() };
    let atmosphere = marcher(|_| {}, 0.15).atmosphere.with_haze(&haze);
    let sky = TableSky::new(&atmosphere, &OrdersQuality::preview()).expect("wavelengths");
    let truth = MonteCarlo::new(&atmosphere);
    let directions = [(0.0_f64, 0.0), (30.0, 0.3), (45.0, 3.0), (70.0, 1.0), (85.0, 2.0)];
    let mut errors = directions.map(|(view, azimuth)| {
        let ray = Ray::from_angles(2.0, view.to_radians(), 1.05, azimuth);
        let want = truth.radiance(&ray, None, Sampling { paths: 3000, seed: 1, direction: 0 }).mean[3];
        (sky.radiance(&ray, None).all[3] / want - 1.0).abs()
    });
    errors.sort_by(f64::total_cmp);
    println!("all orders in haze of 50 km against random walks: {errors:.3?}");
    // Half of it is the noise of the walks.
    assert!(errors[2] < 0.025 && errors[4] < 0.06, "{errors:.3?}");
}

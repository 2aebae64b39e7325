//! Laws that random walks obey.

use super::path::Walker;
use super::*;
use crate::geometry::distance_to_top;
use crate::optical_length::columns_to_top;
use crate::params::{AtmosphereParams, GroundParams};
use crate::quadrature::integrate;
use crate::single_scattering::single_scattering;

fn model(change: impl FnOnce(&mut AtmosphereParams), albedo: f64) -> MonteCarlo {
    let mut params = AtmosphereParams::default();
    change(&mut params);
    let ground = GroundParams { red: albedo, green: albedo, blue: albedo, ..GroundParams::default() };
    MonteCarlo::new(&Atmosphere::new(&params, &ground))
}

fn sampling(paths: u32) -> Sampling {
    Sampling { paths, seed: 11, direction: 3 }
}

fn ray(sun_deg: f64, view_deg: f64) -> Ray {
    Ray::from_angles(2.0, view_deg.to_radians(), sun_deg.to_radians(), 0.9)
}

#[test]
fn walks_are_the_same_bits_on_any_number_of_threads_and_other_seeds_give_others() {
    let model = model(|_| {}, 0.2);
    let run = || model.radiance(&ray(60.0, 80.0), None, sampling(640));
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("one thread").install(run);
    assert_eq!(alone, run(), "bit by bit");
    let other = model.radiance(&ray(60.0, 80.0), None, Sampling { seed: 12, ..sampling(640) });
    assert_ne!(alone.mean, other.mean, "another seed");
}

#[test]
fn the_first_order_of_the_walks_is_the_exact_integral() {
    let model = model(|_| {}, 0.3);
    for (sun, view) in [(30.0, 45.0), (80.0, 88.0), (93.0, 80.0), (40.0, 120.0)] {
        let ray = ray(sun, view);
        let end = ray_end(model.atmosphere(), ray.h_m, ray.mu);
        let place = place(&ray);
        // The same walk with and without its first stop differs by the first order.
        let first = model.estimate(sampling(20_000), 1.0, |walker: &mut Walker, random, sum| {
            let mut beyond = vec![0.0; sum.len()];
            walker.walk(&model, place, (end, 2), &mut random.clone(), &mut beyond);
            for value in &mut beyond {
                *value = -*value;
            }
            walker.walk(&model, place, (end, 1), random, &mut beyond);
            sum.iter_mut().zip(beyond).for_each(|(sum, value)| *sum += value);
        });
        let exact = single_scattering(model.atmosphere(), &ray);
        for (k, want) in exact.iter().enumerate() {
            let (got, error) = (first.mean[k], first.standard_error[k]);
            assert!((got - want).abs() < 4.0 * error + 3e-4 * want, "sun {sun} view {view} {k}: {got} {want} {error}");
            assert!(error < 0.02 * want, "sun {sun} view {view} {k}: a standard error of {error} for {want}");
        }
    }
}

#[test]
fn a_white_furnace_gives_back_all_light() {
    // No absorption and white ground: the mean radiance over all rays that enter the atmosphere, evenly over its surface
    // and by Lambert's law, is the light that it stops over the sphere: E / (4 pi) for a unit cross-section.
    let model = model(|p| (p.aerosol_albedo, p.ozone_du, p.aerosol_asymmetry) = (1.0, 0.0, 0.3), 1.0);
    let atmosphere = model.atmosphere();
    let (radius_m, top_m) = (atmosphere.planet_radius_m, atmosphere.top_altitude_m);
    let seen = model.estimate(sampling(160_000), 1.0, |walker, random, sum| {
        let mut place = place(&Ray { h_m: top_m, mu: -1.0, mu_sun: 0.0, nu: 0.0 });
        let mu_sun = 2.0 * random.next() - 1.0;
        place.sun = [(1.0 - mu_sun * mu_sun).sqrt(), 0.0, mu_sun];
        place.direction = around([0.0, 0.0, -1.0], random.next().sqrt(), random.next());
        let end = ray_end(atmosphere, top_m, place.mu());
        walker.walk(&model, place, (end, 1), random, sum);
    });
    for k in 0..8 {
        // Sunlight that only grazes the air passes through: b db over impact parameters from ground to top.
        let passing = integrate(0.0, 1.0, 40, |x| {
            let h_m = top_m * x * x;
            let half = columns_to_top(atmosphere, h_m, 0.0);
            let transmittance = (-2.0 * atmosphere.optical_depth(&half, k)).exp();
            2.0 * (radius_m + h_m) * transmittance * 2.0 * x * top_m
        });
        let stopped = 1.0 - passing / (radius_m + top_m).powi(2);
        let want = atmosphere.solar_irradiance_w_m2_nm[k] / (4.0 * PI) * stopped;
        let (got, error) = (seen.mean[k], seen.standard_error[k]);
        println!("white furnace of random walks, wavelength {k}: {:.4} +- {:.4}", got / want, error / want);
        assert!((got - want).abs() < 4.0 * error && error < 6e-3 * want, "{k}: {got} {want} {error}");
    }
}

#[test]
fn a_wavelength_has_the_same_light_alone_and_among_others() {
    let all = model(|_| {}, 0.3);
    let mut one = all.atmosphere().clone();
    let keep = |values: &mut Vec<f64>| *values = vec![values[1]];
    keep(&mut one.wavelengths_nm);
    keep(&mut one.solar_irradiance_w_m2_nm);
    keep(&mut one.ground_albedo);
    for medium in &mut one.media {
        keep(&mut medium.scattering_per_m);
        keep(&mut medium.absorption_per_m);
    }
    let ray = ray(70.0, 85.0);
    let alone = MonteCarlo::new(&one).radiance(&ray, None, sampling(20_000));
    let among = all.radiance(&ray, None, sampling(20_000));
    let error = alone.standard_error[0].hypot(among.standard_error[1]);
    assert!((alone.mean[0] - among.mean[1]).abs() < 4.0 * error, "{} {} {error}", alone.mean[0], among.mean[1]);
}

#[test]
fn a_ray_from_space_is_the_ray_from_where_it_enters() {
    let model = model(|_| {}, 0.3);
    let far = Ray::from_angles(400e3, 2.3, 0.8, 1.1);
    let (near, t_m) = enter_atmosphere(6.36e6, 100e3, &far).expect("it meets the atmosphere");
    assert!(t_m > 300e3, "{t_m}");
    let [from_far, from_near] = [far, near].map(|ray| model.radiance(&ray, None, sampling(64)));
    assert!((from_far.mean[3] / from_near.mean[3] - 1.0).abs() < 1e-9, "{from_far:?} {from_near:?}");
    let away = model.radiance(&Ray::from_angles(400e3, 1.0, 0.8, 1.1), None, sampling(64));
    assert!(away.mean.iter().all(|value| *value == 0.0), "a ray that misses the atmosphere is black");
}

#[test]
fn a_stop_beyond_the_atmosphere_changes_nothing_and_stops_add_up_to_the_whole() {
    let model = model(|_| {}, 0.0);
    let ray = ray(50.0, 70.0);
    let to_top = distance_to_top(6.36e6, 100e3, ray.h_m, ray.mu);
    let whole = model.radiance(&ray, None, sampling(64));
    assert_eq!(model.radiance(&ray, Some(2.0 * to_top), sampling(64)), whole, "beyond the top");
    let [short, long] = [3e3, 30e3].map(|stop_m| model.radiance(&ray, Some(stop_m), sampling(4000)));
    assert!((0..8).all(|k| 0.0 < short.mean[k] && short.mean[k] < long.mean[k]), "more air scatters more light");
    assert!((0..8).all(|k| long.single[k] < whole.single[k]), "less than the whole");
}

#[test]
fn walks_without_air_see_black_sky_and_sunlit_ground() {
    let vacuum = model(|p| (p.air_density, p.aerosol_optical_depth, p.ozone_du) = (0.0, 0.0, 0.0), 0.5);
    let sky = vacuum.radiance(&ray(40.0, 30.0), None, sampling(64));
    assert!(sky.mean.iter().all(|value| *value == 0.0), "{sky:?}");
    let ground = vacuum.radiance(&ray(40.0, 170.0), None, sampling(64));
    let want = 0.5 / PI * vacuum.atmosphere().solar_irradiance_w_m2_nm[2] * 40.0_f64.to_radians().cos();
    assert!((ground.mean[2] / want - 1.0).abs() < 1e-6, "{} {want}", ground.mean[2]);
}

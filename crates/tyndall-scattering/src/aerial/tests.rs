//! The slices against the integral, and laws of both.

use tyndall_core::spectrum::luminance_from_rec709;

use super::*;
use crate::Atmosphere;
use crate::haze::HazeParams;
use crate::orders::{OrdersQuality, radiance_by_order};
use crate::params::{AtmosphereParams, GroundParams};
use crate::single_scattering::ray_end;

fn marcher(haze: Option<HazeParams>) -> Marcher {
    let atmosphere = Atmosphere::new(&AtmosphereParams::default(), &GroundParams::default());
    let atmosphere = haze.map_or(atmosphere.clone(), |haze| atmosphere.with_haze(&haze));
    Marcher::new(atmosphere, 16).expect("eight wavelengths")
}

fn fog(visibility_km: f64) -> HazeParams {
    HazeParams { enabled: true, visibility_km, ..HazeParams::default() }
}

/// In-scatter and transmittance of the exact integral in colours.
fn exact(marcher: &Marcher, source: &SourceTable, ray: &Ray, length_m: f64) -> AerialSeen {
    let (light, transmittance) = aerial_exact(marcher, Some(source), ray, length_m);
    let depth = colour_depth(&light_on_ground(marcher, Some(source), ray.mu_sun), &transmittance);
    AerialSeen { transmittance: depth.map(|depth| (-depth).exp()), light: rec709_from_spectrum(&light) }
}

/// Largest errors of light (relative) and transmittance (absolute) over some rays, distances and suns.
fn worst_errors(marcher: &Marcher, rays: &[(f64, f64)], distances_m: &[f64], far_m: f64) -> [f64; 2] {
    let source = SourceTable::new(marcher, &OrdersQuality::preview());
    let mut worst = [0.0_f64; 2];
    for sun_deg in [30.0_f64, 75.0, 88.0] {
        let towards = |(h_m, zenith_deg): &(f64, f64)| {
            let [zenith, sun, h_m] = [zenith_deg.to_radians(), sun_deg.to_radians(), *h_m];
            [0.4, 2.2].map(|azimuth| Ray::from_angles(h_m, zenith, sun, azimuth))
        };
        for ray in rays.iter().flat_map(towards) {
            let slices = AerialSlices::new(marcher, Some(&source), &ray, far_m);
            for distance_m in distances_m {
                let (got, want) = (slices.seen(*distance_m), exact(marcher, &source, &ray, *distance_m));
                for c in 0..3 {
                    let light = (got.light[c] / want.light[c] - 1.0).abs();
                    let transmittance = (got.transmittance[c] - want.transmittance[c]).abs();
                    worst = [worst[0].max(light), worst[1].max(transmittance)];
                    assert!(
                        light < 0.03 && transmittance < 5e-3,
                        "sun {sun_deg}, {ray:?}, {distance_m} m, channel {c}: {got:?} {want:?}"
                    );
                }
            }
        }
    }
    worst
}

#[test]
fn horizontal_paths_of_clear_air_have_the_light_and_transmittance_of_the_integral() {
    let distances = [1e3, 2.7e3, 5e3, 11e3, 20e3, 37e3, 60e3];
    let worst = worst_errors(&marcher(None), &[(50.0, 90.0), (1500.0, 90.0)], &distances, 65e3);
    println!("clear air: light {:.2} %, transmittance {:.1e}", 100.0 * worst[0], worst[1]);
}

#[test]
fn rays_into_a_thin_layer_of_fog_have_the_light_and_transmittance_of_the_integral() {
    let layer = HazeParams { top_m: 200.0, scale_height_m: 30.0, ..fog(1.0) };
    // From above, from its edge and from inside; slices of a volume far deeper than the layer is high.
    let worst =
        worst_errors(&marcher(Some(layer)), &[(900.0, 97.0), (220.0, 91.0), (50.0, 88.0)], &[700.0, 3e3, 6e3], 60e3);
    println!("fog: light {:.2} %, transmittance {:.1e}", 100.0 * worst[0], worst[1]);
}

#[test]
fn fog_leaves_two_per_cent_of_a_contrast_at_its_visibility() {
    for visibility_km in [0.1, 0.8, 5.0] {
        let with = marcher(Some(HazeParams { top_m: 4000.0, ..fog(visibility_km) }));
        let ray = Ray::from_angles(2.0, std::f64::consts::FRAC_PI_2, 0.8, 1.0);
        let [seen, clear] = [&with, &marcher(None)]
            .map(|marcher| AerialSlices::new(marcher, None, &ray, 30e3).seen(1e3 * visibility_km));
        for c in 0..3 {
            let by_fog = seen.transmittance[c] / clear.transmittance[c];
            assert!((by_fog / 0.02 - 1.0).abs() < 0.01, "{visibility_km} km, channel {c}: {by_fog}");
        }
    }
}

#[test]
fn air_in_front_of_the_ground_and_the_ground_behind_it_are_what_the_sky_shows_there() {
    for marcher in [marcher(None), marcher(Some(HazeParams { top_m: 100.0, ..fog(8.0) }))] {
        let source = SourceTable::new(&marcher, &OrdersQuality::preview());
        for (h_m, zenith_deg) in [(1000.0, 93.0_f64), (300.0, 91.5), (3000.0, 100.0)] {
            let ray = Ray::from_angles(h_m, zenith_deg.to_radians(), 1.1, 0.9);
            let end = ray_end(&marcher.atmosphere, ray.h_m, ray.mu);
            let [first, beyond] = radiance_by_order(&marcher, &source, &ray, end);
            let want = rec709_from_spectrum(&std::array::from_fn(|k| first[k] + beyond[k]));
            let lit = light_on_ground(&marcher, Some(&source), ray.mu_sun);
            let albedo = &marcher.coefficients.ground_albedo;
            let ground: Spectrum = std::array::from_fn(|k| albedo[k] / std::f64::consts::PI * lit[k]);
            let seen = AerialSlices::new(&marcher, Some(&source), &ray, end.length_m).seen(end.length_m);
            let got: [f64; 3] =
                std::array::from_fn(|c| seen.light[c] + seen.transmittance[c] * rec709_from_spectrum(&ground)[c]);
            let ratio = luminance_from_rec709(got) / luminance_from_rec709(want);
            assert!((ratio - 1.0).abs() < 0.01, "{h_m} m, {zenith_deg}: {got:?} {want:?}");
        }
    }
}

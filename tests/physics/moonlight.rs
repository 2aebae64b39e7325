//! The moon as a light.

use tyndall_scattering::column_table::ColumnTable;
use tyndall_scene::Scene;
use tyndall_scene::astronomy::moon_illuminance_lux;

use crate::render::{Studio, luminance, scene};

/// A moon of a phase (deg) above a black planet, and nothing else in the sky.
fn moon(elevation: &str, phase_deg: &str, more: &[(&str, &str)]) -> Scene {
    let night = [("sun.elevation_deg", "-40"), ("stars.visible", "false"), ("stars.airglow_cd_m2", "0")];
    let moon = [("moon.position", "angles"), ("moon.azimuth_deg", "0"), ("moon.elevation_deg", elevation)];
    let phase = [("moon.phase", "angle"), ("moon.phase_deg", phase_deg)];
    scene("noon", &[&night[..], &moon, &phase, more].concat())
}

#[test]
fn the_moons_disc_holds_the_light_of_its_phase_at_every_width() {
    let mut studio = Studio::new();
    for (phase_deg, maria, allowed) in [("0", "false", 0.01), ("90", "false", 0.01), ("0", "true", 0.06)] {
        for side in [40_u32, 200] {
            let at = |disc: &str| {
                let camera =
                    [("camera.heading_deg", "0"), ("camera.pitch_deg", "40"), ("camera.field_of_view_deg", "2")];
                let sky = [("sky.orders", "single"), ("sun.refraction", "false")];
                moon("40", phase_deg, &[&camera[..], &sky, &[("moon.disc", disc), ("moon.maria", maria)]].concat())
            };
            let scene = at("true");
            let [with, without] = ["true", "false"].map(|disc| {
                let pixels = studio.radiance(&at(disc), [side, side]);
                pixels.into_iter().map(luminance).sum::<f64>()
            });
            let solid_angle = (2.0 * 1.0_f64.to_radians().tan() / f64::from(side)).powi(2);
            let phase = f64::to_radians(phase_deg.parse().expect("a number"));
            // Moonlight in the air has another colour than white light: the transmittance at 571 nm is near its mean.
            let atmosphere = scene.model();
            let columns = ColumnTable::new(&atmosphere).lookup(scene.camera.altitude_m, 40.0_f64.to_radians().sin());
            let transmittance = (-atmosphere.optical_depth(&columns, 4)).exp();
            let ratio = (with - without) * solid_angle / (moon_illuminance_lux(phase) * transmittance);
            println!("moon at phase {phase_deg}, maria {maria}, {side} px: {ratio:.4} of its light");
            assert!((ratio - 1.0).abs() < allowed + 0.01, "phase {phase_deg} maria {maria} {side} px: {ratio}");
        }
    }
}

#[test]
fn moonlit_air_and_ground_are_sunlit_ones_dimmed() {
    let mut studio = Studio::new();
    let look =
        [("camera.heading_deg", "70"), ("camera.pitch_deg", "20"), ("moon.disc", "false"), ("sun.disc", "false")];
    let by_moon = studio.radiance(&moon("30", "0", &look), [24, 24]);
    let sunny = [("sun.elevation_deg", "30"), ("sun.azimuth_deg", "0"), ("stars.visible", "false")];
    let by_sun =
        studio.radiance(&scene("noon", &[&look[..], &sunny, &[("stars.airglow_cd_m2", "0")]].concat()), [24, 24]);
    let want = moon_illuminance_lux(0.0) / tyndall_core::spectrum::solar_illuminance_lux();
    let mut worst = 0.0_f64;
    for (moon, sun) in by_moon.into_iter().zip(by_sun) {
        let ratio = luminance(moon) / luminance(sun) / want;
        worst = worst.max((ratio - 1.0).abs());
    }
    println!("moonlit picture against the sunlit one: worst {:.1} %", 100.0 * worst);
    // Moonlight is redder: the blue sky gets less of it, the ground as much.
    assert!(worst < 0.12, "{worst}");
}

/// A small desert without ripples, seen from above its crests.
const DUNES: [(&str, &str); 9] = [
    ("desert.kind", "dunes"),
    ("desert.steps", "300"),
    ("dunes.side", "128"),
    ("dunes.sand_cells", "3"),
    ("sand.ripples", "none"),
    ("sand.shine", "0"),
    ("camera.altitude_m", "8"),
    ("camera.pitch_deg", "-20"),
    ("camera.heading_deg", "70"),
];

#[test]
fn moonlit_dunes_are_sunlit_ones_dimmed_with_the_same_shadows() {
    let mut studio = Studio::new();
    let by_moon = studio.radiance(&moon("20", "0", &DUNES), [32, 32]);
    let sunny = [("sun.elevation_deg", "20"), ("sun.azimuth_deg", "0"), ("stars.visible", "false")];
    let by_sun = scene("noon", &[&DUNES[..], &sunny, &[("stars.airglow_cd_m2", "0")]].concat());
    let by_sun = studio.radiance(&by_sun, [32, 32]);
    let want = moon_illuminance_lux(0.0) / tyndall_core::spectrum::solar_illuminance_lux();
    let ratios = by_moon.into_iter().zip(by_sun).map(|(moon, sun)| luminance(moon) / luminance(sun) / want);
    let mut ratios: Vec<f64> = ratios.collect();
    ratios.sort_by(f64::total_cmp);
    let [low, middle, high] = [1, 10, 19].map(|part| ratios[ratios.len() * part / 20]);
    println!("moonlit against sunlit dunes: {low:.2} to {high:.2}, median {middle:.2}");
    // Neither sand nor air throws moonlight on sand, which is up to a third of the light in the shade.
    assert!((middle - 1.0).abs() < 0.15 && low > 0.5 && high < 1.2, "{low} to {high}, median {middle}");
}

#[test]
fn a_moon_that_is_off_or_beside_a_high_sun_changes_no_pixel_but_its_disc() {
    let mut studio = Studio::new();
    let plain = scene("noon", &[("camera.heading_deg", "90")]);
    let with = scene("noon", &[("camera.heading_deg", "90"), ("moon.position", "angles"), ("moon.azimuth_deg", "270")]);
    assert_eq!(studio.radiance(&plain, [32, 24]), studio.radiance(&with, [32, 24]), "the moon is behind the camera");
}

#[test]
fn what_frames_by_day_leave_out_of_the_night_is_lost_in_the_day() {
    let mut studio = Studio::new();
    let day = [("sun.elevation_deg", "2.1"), ("sun.azimuth_deg", "180"), ("camera.heading_deg", "0")];
    let moon = [("moon.position", "angles"), ("moon.azimuth_deg", "0"), ("moon.elevation_deg", "10")];
    // A moon in the picture lets the whole night be drawn, a moon behind the camera none of it.
    let [with, without] = ["0", "180"].map(|azimuth| {
        let turned = [day, moon].concat().into_iter().chain([("moon.azimuth_deg", azimuth)]).collect::<Vec<_>>();
        studio.radiance(&scene("noon", &turned), [96, 72])
    });
    let mut errors: Vec<f64> =
        with.iter().zip(&without).map(|(night, day)| (luminance(*day) / luminance(*night) - 1.0).abs()).collect();
    errors.sort_by(f64::total_cmp);
    let on_disc = errors.iter().filter(|error| **error > 1e-3).count();
    let worst = errors[errors.len() - 1 - on_disc];
    println!("pixels of the disc: {on_disc}; the worst of the others is off by {worst:.1e}");
    // The disc is less than a pixel wide.
    assert!((1..=9).contains(&on_disc), "{on_disc} pixels of the moon's disc");
    assert!(worst < 5e-4, "half a step of a half float: {worst:e}");
}

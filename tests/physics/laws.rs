//! Laws that every picture of a sky obeys.

use crate::render::{Studio, luminance, scene};

const SIZE: [u32; 2] = [96, 64];

fn column(pixels: &[[f32; 4]], x: u32, size: [u32; 2]) -> Vec<f64> {
    (0..size[1]).map(|y| luminance(pixels[(y * size[0] + x) as usize])).collect()
}

#[test]
fn twice_the_sunlight_is_twice_the_radiance_everywhere() {
    let mut studio = Studio::new();
    let one = studio.radiance(&scene("low-sun", &[]), SIZE);
    let two = studio.radiance(&scene("low-sun", &[("sun.brightness", "2")]), SIZE);
    for (a, b) in one.iter().zip(&two) {
        assert!((luminance(*b) / luminance(*a) - 2.0).abs() < 1e-4, "{a:?} {b:?}");
    }
}

#[test]
fn the_picture_is_its_own_mirror_image_when_the_sun_is_straight_ahead() {
    let mut studio = Studio::new();
    let ahead = [("camera.heading_deg", "30"), ("sun.azimuth_deg", "30")];
    let pixels = studio.radiance(&scene("noon", &ahead), SIZE);
    for y in 0..SIZE[1] {
        for x in 0..SIZE[0] / 2 {
            let [left, right] = [x, SIZE[0] - 1 - x].map(|x| luminance(pixels[(y * SIZE[0] + x) as usize]));
            assert!((left / right - 1.0).abs() < 2e-4, "({x}, {y}): {left} {right}");
        }
    }
}

#[test]
fn turning_sun_and_camera_together_changes_nothing() {
    let mut studio = Studio::new();
    let [a, b] = [("20", "75"), ("215", "270")].map(|(heading, azimuth)| {
        studio.radiance(&scene("low-sun", &[("camera.heading_deg", heading), ("sun.azimuth_deg", azimuth)]), SIZE)
    });
    for (a, b) in a.iter().zip(&b) {
        assert!((luminance(*b) / luminance(*a) - 1.0).abs() < 3e-4, "{a:?} {b:?}");
    }
}

#[test]
fn rolling_the_camera_by_half_a_turn_turns_the_picture_upside_down() {
    let mut studio = Studio::new();
    let upright = studio.radiance(&scene("low-sun", &[]), SIZE);
    let mut turned = studio.radiance(&scene("low-sun", &[("camera.roll_deg", "180")]), SIZE);
    turned.reverse();
    for (a, b) in upright.iter().zip(&turned) {
        assert!((luminance(*b) / luminance(*a) - 1.0).abs() < 1e-3, "{a:?} {b:?}");
    }
}

#[test]
fn without_air_the_sky_is_black_and_the_ground_has_its_lambertian_radiance() {
    let mut studio = Studio::new();
    let vacuum = [
        ("atmosphere.air_density", "0"),
        ("atmosphere.aerosol_optical_depth", "0"),
        ("atmosphere.ozone_du", "0"),
        ("ground.red", "0.3"),
        ("ground.green", "0.3"),
        ("ground.blue", "0.3"),
        ("sun.elevation_deg", "40"),
    ];
    let pixels = studio.radiance(&scene("noon", &vacuum), SIZE);
    assert!(luminance(pixels[0]) < 1e-3, "black sky: {:?}", pixels[0]);
    let want =
        0.3 / std::f64::consts::PI * tyndall_core::spectrum::solar_illuminance_lux() * 40.0_f64.to_radians().sin();
    let got = luminance(pixels[pixels.len() - 1]);
    assert!((got / want - 1.0).abs() < 1e-3, "{got} {want}");
}

#[test]
fn every_direction_of_every_preset_is_finite_and_not_negative() {
    let mut studio = Studio::new();
    for preset in tyndall_scene::presets() {
        for (pitch, altitude) in
            [("90", "2"), ("-90", "2"), ("0", "2"), ("0", "30000"), ("-20", "400000"), ("-60", "6e7")]
        {
            let look =
                [("camera.pitch_deg", pitch), ("camera.field_of_view_deg", "120"), ("camera.altitude_m", altitude)];
            for pixel in studio.radiance(&scene(preset.name, &look), SIZE) {
                assert!(pixel.iter().all(|c| c.is_finite()), "{} {look:?}: {pixel:?}", preset.name);
                assert!(luminance(pixel) >= 0.0, "{} {look:?}: {pixel:?}", preset.name);
            }
        }
    }
}

#[test]
fn the_zenith_is_no_pole_and_the_azimuth_behind_the_sun_no_seam() {
    let mut studio = Studio::new();
    let up = [("camera.pitch_deg", "90"), ("camera.field_of_view_deg", "60"), ("sun.elevation_deg", "20")];
    let pixels = studio.radiance(&scene("noon", &up), SIZE);
    for y in 1..SIZE[1] - 1 {
        for x in 1..SIZE[0] - 1 {
            let at = |x: u32, y: u32| luminance(pixels[(y * SIZE[0] + x) as usize]);
            let here = at(x, y);
            let mean = 0.25 * (at(x - 1, y) + at(x + 1, y) + at(x, y - 1) + at(x, y + 1));
            assert!((here / mean - 1.0).abs() < 2e-3, "({x}, {y}): {here} among {mean}");
        }
    }
}

#[test]
fn the_zenith_darkens_steadily_while_the_sun_sets() {
    let mut studio = Studio::new();
    let mut before = f64::MAX;
    for step in 0..=60 {
        let elevation = (3.0 - 0.15 * f64::from(step)).to_string();
        let look = [("camera.pitch_deg", "90"), ("sun.elevation_deg", elevation.as_str())];
        // A small table for each of the suns: the zenith is its last row.
        let changes = [look, [("sky.table_elevations", "32"), ("sky.table_azimuths", "16")]].concat();
        let zenith = luminance(studio.radiance(&scene("twilight", &changes), [2, 2])[0]);
        assert!(zenith < before && zenith > 0.0, "sun at {elevation}: {before} then {zenith}");
        assert!(before > 1e300 || zenith > 0.7 * before, "sun at {elevation}: {before} then {zenith}");
        before = zenith;
    }
}

#[test]
fn no_step_runs_through_the_sky_above_the_horizon() {
    let mut studio = Studio::new();
    let size = [2, 400];
    for altitude in ["2", "1000", "10000"] {
        let look = [
            ("camera.altitude_m", altitude),
            ("camera.pitch_deg", "3"),
            ("camera.field_of_view_deg", "8"),
            ("sun.disc", "false"),
        ];
        let rows = column(&studio.radiance(&scene("noon", &look), size), 0, size);
        let depth = studio.shoot(&scene("noon", &look), size).read_depth_m(studio.gpu).expect("depth");
        for y in 1..rows.len() - 1 {
            let sky = (y - 1..=y + 1).all(|y| depth[2 * y] >= 1e9);
            let second = (rows[y - 1] - 2.0 * rows[y] + rows[y + 1]).abs() / rows[y];
            // Rows of 0.02 degrees; the target of smoothness is 2 %.
            assert!(!sky || second < 0.02, "altitude {altitude} row {y}: {second}");
        }
    }
}

#[test]
fn depth_is_the_planar_distance_to_the_ground() {
    let mut studio = Studio::new();
    let down = [("camera.pitch_deg", "-90"), ("camera.altitude_m", "120"), ("camera.field_of_view_deg", "60")];
    let depth = studio.shoot(&scene("noon", &down), SIZE).read_depth_m(studio.gpu).expect("depth");
    // Looking straight down, every pixel's planar distance is the altitude; the planet falls away by 0.4 mm at the edge.
    assert!(depth.iter().all(|d| (d - 120.0).abs() < 0.02), "{:?}", &depth[..4]);
    let up = studio.shoot(&scene("noon", &[("camera.pitch_deg", "60")]), SIZE).read_depth_m(studio.gpu).expect("depth");
    assert!(up.iter().all(|d| (*d - 1e10).abs() < 1.0), "the sky is 1e10 m away");
}

//! The light from everywhere around the camera: where it comes from, and how much it is.

use glam::DVec2;
use tyndall_render::environment::cube::{panorama_direction, panorama_point_px, panorama_solid_angle};
use tyndall_render::environment::{EnvironmentOptions, GroundLight, SunLight};
use tyndall_scene::Scene;
use tyndall_scene::camera::CameraFrame;

use crate::render::{Studio, luminance, scene};

/// Small tables and one order: for the sun's disc, from which the sky is subtracted.
const COARSE: [(&str, &str); 3] =
    [("sky.orders", "single"), ("sky.table_elevations", "32"), ("sky.table_azimuths", "16")];

fn options(width_px: u32) -> EnvironmentOptions {
    EnvironmentOptions { width_px, disc: true, ground: GroundLight::True }
}

fn panorama(studio: &mut Studio, scene: &Scene, options: EnvironmentOptions) -> Vec<[f32; 4]> {
    let gpu = studio.gpu;
    let found = studio.renderer.capture_environment(gpu, scene, options);
    found.unwrap_or_else(|error| panic!("{error}")).rgba
}

/// Light of a panorama's disc (lx) and its centre, from the difference to the panorama without it.
fn disc(studio: &mut Studio, scene: &Scene, width_px: u32) -> (f64, glam::DVec3) {
    let size_px = [width_px, width_px / 2];
    let with = panorama(studio, scene, options(width_px));
    let without = panorama(studio, scene, EnvironmentOptions { disc: false, ..options(width_px) });
    let (mut light_lux, mut centre) = (0.0, glam::DVec3::ZERO);
    for (index, (on, off)) in (0..).zip(with.iter().zip(&without)) {
        let (column, row) = (index % width_px, index / width_px);
        let share = (luminance(*on) - luminance(*off)) * panorama_solid_angle(row, size_px);
        light_lux += share;
        centre += share * panorama_direction([f64::from(column) + 0.5, f64::from(row) + 0.5], size_px);
    }
    (light_lux, centre.normalize())
}

#[test]
fn the_disc_of_a_panorama_holds_the_suns_light_at_every_width_place_and_height() {
    let mut studio = Studio::new();
    let mut worst = 0.0_f64;
    for (width_px, elevation, azimuth) in [
        (512, "35", "0"),
        (512, "35.17", "0.31"),
        (512, "12.1", "90.2"),
        (512, "90", "0"),
        (1024, "35.05", "17.13"),
        (1024, "89.8", "45"),
        (2048, "60.02", "200.04"),
        (2048, "3.3", "-30.03"),
        (4096, "25.01", "271.3"),
    ] {
        let sun = [("sun.elevation_deg", elevation), ("sun.azimuth_deg", azimuth)];
        let scene = scene("noon", &[&sun[..], &COARSE].concat());
        let expected = SunLight::new(&scene).expect("valid").expect("above the horizon");
        let (light_lux, centre) = disc(&mut studio, &scene, width_px);
        let ratio = light_lux / expected.illuminance_lux();
        let away_px = (centre - expected.unit()).length() / (std::f64::consts::TAU / f64::from(width_px));
        println!("sun {elevation} deg high in {width_px} px: {ratio:.4} of its light, {away_px:.2} px away");
        worst = worst.max((ratio - 1.0).abs());
        assert!(away_px < 0.5, "{away_px} px away, {elevation} deg high in {width_px} px");
    }
    assert!(worst < 5e-3, "worst {:.2} %", 100.0 * worst);
}

/// Luminance between the centres of four pixels of a panorama; not for its left edge.
#[expect(clippy::cast_possible_truncation, reason = "pixels of the panorama")]
fn between(rgba: &[[f32; 4]], [x, y]: [f64; 2], size_px: [u32; 2]) -> f64 {
    let (column, row) = ((x - 0.5) as usize, (y - 0.5) as usize);
    let (right, down) = (x - 0.5 - column as f64, y - 0.5 - row as f64);
    let pixel = |row: usize, column: usize| luminance(rgba[row * size_px[0] as usize + column]);
    let along = |row: usize| pixel(row, column) * (1.0 - right) + pixel(row, column + 1) * right;
    along(row) * (1.0 - down) + along(row + 1) * down
}

#[test]
fn a_panorama_shows_in_each_direction_what_a_camera_sees_there() {
    let mut studio = Studio::new();
    let look = [("camera.heading_deg", "200"), ("camera.pitch_deg", "10"), ("sun.disc", "false")];
    let scene = scene("low-sun", &look);
    let size_px = [1024, 512];
    let around = panorama(&mut studio, &scene, options(size_px[0]));
    let seen_px = glam::UVec2::new(256, 192);
    let seen = studio.radiance(&scene, seen_px.to_array());
    let camera = CameraFrame::new(&scene.camera);
    for (x, y) in [(10, 10), (128, 40), (200, 120), (60, 170), (250, 185)] {
        let direction = camera.ray(DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5), seen_px);
        let ratio = between(&around, panorama_point_px(direction, size_px), size_px)
            / luminance(seen[(y * seen_px.x + x) as usize]);
        // Linear between pixels a third of a degree apart; the sky bends most near the horizon.
        assert!((ratio - 1.0).abs() < 2e-3, "pixel ({x}, {y}): {ratio}");
    }
}

#[test]
fn the_ground_right_below_a_panorama_is_that_which_a_camera_sees_there() {
    let mut studio = Studio::new();
    let hills = [("landscape.kind", "hills"), ("ground.pattern", "plain")];
    let sand = [
        ("desert.kind", "dunes"),
        ("desert.steps", "100"),
        ("dunes.side", "64"),
        ("sand.glints", "0"),
        ("sand.relief", "false"),
        ("camera.altitude_m", "20"),
    ];
    for changes in [&hills[..], &sand] {
        let down = [("camera.heading_deg", "30"), ("camera.pitch_deg", "-80"), ("camera.field_of_view_deg", "50")];
        let scene = scene("noon", &[&down[..], changes].concat());
        let (size_px, seen_px) = ([1024, 512], glam::UVec2::splat(96));
        let around = panorama(&mut studio, &scene, EnvironmentOptions { disc: false, ..options(size_px[0]) });
        let seen = studio.radiance(&scene, seen_px.to_array());
        let camera = CameraFrame::new(&scene.camera);
        let mut errors: Vec<f64> = (0..96 * 96)
            .map(|index| {
                let pixel = DVec2::new(f64::from(index % 96) + 0.5, f64::from(index / 96) + 0.5);
                let at = panorama_point_px(camera.ray(pixel, seen_px), size_px);
                // Its left edge and its last row have no four pixels around them.
                let at = [at[0].clamp(0.5, 1022.5), at[1].clamp(0.5, 510.5)];
                (between(&around, at, size_px) / luminance(seen[index as usize]) - 1.0).abs()
            })
            .collect();
        errors.sort_by(f64::total_cmp);
        let [median, p98] = [errors.len() / 2, errors.len() * 98 / 100].map(|index| errors[index]);
        println!("{}: median {:.2} %, 98th percentile {:.2} %", changes[0].0, 100.0 * median, 100.0 * p98);
        assert!(median < 0.01 && p98 < 0.05, "{}: median {median}, p98 {p98}", changes[0].0);
    }
}

#[test]
fn a_panorama_from_a_cube_is_that_drawn_pixel_by_pixel() {
    let mut studio = Studio::new();
    let place = [("sun.elevation_deg", "20"), ("sun.azimuth_deg", "40"), ("sky.orders", "single")];
    let direct = scene("noon", &place);
    // A dome so fine that its own error is below 1e-4.
    let fine = [("sky.mode", "vertex-dome"), ("sky.dome_rings", "192"), ("sky.dome_segments", "384")];
    let by_cube = scene("noon", &[&place[..], &fine].concat());
    let discless = EnvironmentOptions { disc: false, ..options(256) };
    let [direct_sky, cube_sky] = [&direct, &by_cube].map(|scene| panorama(&mut studio, scene, discless));
    let mut errors: Vec<f64> =
        direct_sky.iter().zip(&cube_sky).map(|(a, b)| (luminance(*b) / luminance(*a) - 1.0).abs()).collect();
    errors.sort_by(f64::total_cmp);
    let [median, p99] = [errors.len() / 2, errors.len() * 99 / 100].map(|index| errors[index]);
    println!("panorama from a cube: median {:.3} %, 99th percentile {:.2} %", 100.0 * median, 100.0 * p99);
    // The rest are the pixels on the horizon, which the cube smooths, and those beside the sun.
    assert!(median < 2e-3 && p99 < 0.02, "median {median}, p99 {p99}");

    let expected = SunLight::new(&direct).expect("valid").expect("above the horizon").illuminance_lux();
    let ratio = disc(&mut studio, &by_cube, 256).0 / expected;
    assert!((ratio - 1.0).abs() < 5e-3, "the disc by way of a cube has {ratio} of its light");
}

#[test]
fn a_black_ground_ends_at_the_horizon_and_leaves_the_sky_alone() {
    let mut studio = Studio::new();
    let scene = scene("noon", &COARSE);
    let whole = panorama(&mut studio, &scene, options(128));
    let black = panorama(&mut studio, &scene, EnvironmentOptions { ground: GroundLight::Black, ..options(128) });
    for (index, (whole, black)) in whole.iter().zip(&black).enumerate() {
        if index / 128 < 32 {
            assert_eq!(whole.map(f32::to_bits), black.map(f32::to_bits), "pixel {index} of the sky");
        } else {
            assert!(luminance(*whole) > 100.0 && luminance(*black) <= 0.0, "pixel {index} of the ground: {black:?}");
        }
    }
}

#[test]
fn the_exposure_of_an_environment_is_that_of_the_scenes_picture() {
    let mut studio = Studio::new();
    let scene = scene("sunset", &[("image.width_px", "320"), ("image.height_px", "180")]);
    let gpu = studio.gpu;
    let found = studio.renderer.capture_environment(gpu, &scene, options(64)).unwrap_or_else(|error| panic!("{error}"));
    studio.shoot(&scene, [320, 180]);
    let own = studio.renderer.read_ev100(gpu).expect("exposure");
    assert!((found.ev100 - own).abs() < 0.05, "{} and {own}", found.ev100);
}

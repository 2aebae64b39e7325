//! Shadows of clouds in the frame against their maps.

use tyndall_clouds::floor_shadow::{FloorLight, FloorShadow, floor_shadow, sun_slope};
use tyndall_clouds::{CloudSimulation, Edges};
use tyndall_render::View;
use tyndall_scene::Scene;

use crate::render::{Studio, luminance, scene};

const SIZE: [u32; 2] = [48, 32];

/// Black air over grey ground, looked down on from below the clouds.
const GROUND: [(&str, &str); 20] = [
    ("atmosphere.air_density", "0"),
    ("atmosphere.aerosol_optical_depth", "0"),
    ("atmosphere.ozone_du", "0"),
    ("ground.material", "colour"),
    ("ground.red", "0.3"),
    ("ground.green", "0.3"),
    ("ground.blue", "0.3"),
    ("stars.airglow_cd_m2", "0"),
    ("camera.altitude_m", "600"),
    ("camera.pitch_deg", "-55"),
    ("camera.field_of_view_deg", "70"),
    ("sun.elevation_deg", "40"),
    ("sun.azimuth_deg", "200"),
    ("clouds.kind", "automaton"),
    ("cloud_grid.cells_east", "64"),
    ("cloud_grid.cells_north", "64"),
    ("cloud_grid.cells_up", "20"),
    ("cloud_grid.warm_up_steps", "25"),
    ("cloud_vapour.cover", "0.5"),
    ("cloud_vapour.bubble_radius_m", "300"),
];

fn with(changes: &[(&str, &str)]) -> Scene {
    // Shadows of these clouds have the contrast that the tolerances are for.
    scene("noon", &[&GROUND[..], &[("cloud_matter.extinction_per_m", "0.04")], changes].concat())
}

/// Places (m) on the ground that the pixels show; flat, for the camera is low.
fn places(scene: &Scene) -> Vec<[f64; 2]> {
    let camera = View::Camera.frame(&scene.grounded().camera);
    let [width, height] = SIZE.map(f64::from);
    let place = |index: u32| {
        let [x, y] = [index % SIZE[0], index / SIZE[0]].map(|place| f64::from(place) + 0.5);
        let across = (2.0 * x / width - 1.0) * camera.tan_half_view * width / height;
        let above = (1.0 - 2.0 * y / height) * camera.tan_half_view;
        let ray = camera.forward + across * camera.right + above * camera.up;
        let point = camera.position - ray * (camera.position.z / ray.z);
        [point.x, point.y]
    };
    (0..SIZE[0] * SIZE[1]).map(place).collect()
}

/// The map of a scene's clouds and its coarser levels.
fn levels(scene: &Scene, edges: Edges) -> Vec<FloorShadow> {
    let params = scene.cloud_params().expect("clouds");
    assert_eq!(params.grid.edges, edges, "the scene that was asked for");
    let mut simulation = CloudSimulation::new(&params).expect("a simulation");
    let extinction = simulation.extinction_per_m(1.0).expect("a moment");
    let to_sun = scene.sun_direction().expect("a sun").unit().to_array();
    let transport = 1.0 - scene.clouds.mean_cosine();
    floor_shadow(&extinction, params.grid.cell_m, to_sun, transport, edges).expect("a map").levels()
}

/// A level of the map at a place (cells of the finest level).
fn at(levels: &[FloorShadow], level: usize, place: [f64; 2]) -> FloorLight {
    let level = level.min(levels.len() - 1);
    let scale = |axis: usize| levels[level].size[axis] as f64 / levels[0].size[axis] as f64;
    levels[level].at([place[0] * scale(0), place[1] * scale(1)], Edges::Wrap)
}

/// Light on ground of this albedo over what it is without clouds, where no air scatters any.
fn share(scene: &Scene, levels: &[FloorShadow], place: [f64; 2], albedo: f64) -> f64 {
    let grid = scene.cloud_params().expect("clouds").grid;
    let corner = [grid.cells_east, grid.cells_north].map(|cells| -0.5 * f64::from(cells));
    let slope = sun_slope(scene.sun_direction().expect("a sun").unit().to_array());
    let cells = |up_m: f64| [0, 1].map(|axis| (place[axis] + up_m * slope[axis]) / grid.cell_m - corner[axis]);
    let direct = at(levels, 0, cells(grid.floor_m)).direct;
    let level = (2.0 * grid.floor_m / grid.cell_m).log2();
    let [near, far] = [level.floor(), level.floor() + 1.0].map(|level| {
        #[expect(clippy::cast_possible_truncation, reason = "a few levels")]
        at(levels, level as usize, cells(0.0))
    });
    let between = |near: f32, far: f32| f64::from(near) + (level - level.floor()) * f64::from(far - near);
    let sky = between(near.sky, far.sky);
    (f64::from(direct) + between(near.diffuse, far.diffuse)) / (1.0 - albedo * (1.0 - sky))
}

#[test]
fn the_ground_below_clouds_has_the_light_of_their_map() {
    let mut studio = Studio::new();
    for changes in [&[][..], &[("sun.elevation_deg", "15"), ("camera.x_m", "1700")], &[("cloud_grid.floor_m", "2600")]]
    {
        let scene = with(changes);
        let open = studio.radiance(&with(&[changes, &[("clouds.kind", "none")]].concat()), SIZE);
        let found = studio.radiance(&scene, SIZE);
        let levels = levels(&scene, Edges::Wrap);
        let (mut darkest, mut brightest) = (1.0_f64, 0.0_f64);
        for ((found, open), place) in found.iter().zip(&open).zip(places(&scene)) {
            let (found, wanted) = (luminance(*found) / luminance(*open), share(&scene, &levels, place, 0.3));
            // Filters weigh texels in steps of 1/256, along two axes and between two levels; shadows have all contrast.
            assert!((found - wanted).abs() < 8e-3, "{changes:?} at {place:?} m: {found} for {wanted}");
            (darkest, brightest) = (darkest.min(found), brightest.max(found));
        }
        assert!(darkest < 0.6 && brightest > 0.9, "there are shadows in view: {darkest} to {brightest}");
    }
}

#[test]
fn an_empty_sky_of_clouds_leaves_pictures_as_they_are() {
    let mut studio = Studio::new();
    let none = ("cloud_vapour.cover", "0");
    let dry = ("cloud_vapour.activation", "0");
    let grid = [("cloud_grid.cells_east", "16"), ("cloud_grid.cells_north", "16"), ("cloud_grid.warm_up_steps", "3")];
    for preset in ["noon", "mountains", "moonlight"] {
        let open = studio.radiance(&scene(preset, &[]), SIZE);
        let empty = [&[("clouds.kind", "automaton"), none, dry][..], &grid].concat();
        assert_eq!(studio.radiance(&scene(preset, &empty), SIZE), open, "{preset}");
    }
}

#[test]
fn below_an_overcast_sky_ground_and_air_are_dim() {
    let mut studio = Studio::new();
    let deck = [
        ("clouds.kind", "automaton"),
        ("cloud_vapour.pattern", "sea-of-clouds"),
        ("cloud_vapour.cover", "1"),
        ("cloud_vapour.bubble_height_m", "1200"),
        ("cloud_vapour.humidity", "0.2"),
        ("cloud_vapour.activation", "0.02"),
        ("cloud_vapour.extinction", "0.04"),
        ("cloud_matter.extinction_per_m", "0.2"),
        ("cloud_grid.cells_east", "64"),
        ("cloud_grid.cells_north", "64"),
        ("cloud_grid.floor_m", "3500"),
        ("clouds.reach_km", "1"),
    ];
    // Clouds are out of reach: what is left is their shade.
    for preset in ["noon", "mountains"] {
        let below = [("camera.pitch_deg", "-50"), ("sun.elevation_deg", "40")];
        let mean = |pixels: Vec<[f32; 4]>| pixels.into_iter().map(luminance).sum::<f64>();
        let clear = mean(studio.radiance(&scene(preset, &below), SIZE));
        let dim = mean(studio.radiance(&scene(preset, &[&deck[..], &below].concat()), SIZE));
        // Clouds of an optical depth of 50 to 100 let through a tenth to a third.
        assert!((0.04..0.45).contains(&(dim / clear)), "{preset}: {dim} of {clear} cd/m^2");
    }
}

#[test]
fn the_moon_lights_clouds_as_a_sun_of_its_irradiance_would() {
    let mut studio = Studio::new();
    let void = [
        &GROUND[..3],
        &GROUND[13..],
        &[
            ("camera.altitude_m", "10"),
            ("camera.pitch_deg", "40"),
            ("ground.material", "colour"),
            ("ground.red", "0"),
            ("ground.green", "0"),
            ("ground.blue", "0"),
            ("sun.disc", "false"),
            ("moon.disc", "false"),
            ("stars.visible", "false"),
            ("stars.airglow_cd_m2", "0"),
        ],
    ]
    .concat();
    let night = [("sun.elevation_deg", "-40"), ("moon.elevation_deg", "50"), ("moon.azimuth_deg", "187")];
    let day = [("sun.elevation_deg", "50"), ("sun.azimuth_deg", "187"), ("moon.position", "none")];
    let [dark, bright] =
        [night, day].map(|light| studio.radiance(&scene("moonlight", &[&void[..], &light].concat()), SIZE));
    let sum = |pixels: &[[f32; 4]]| pixels.iter().map(|pixel| luminance(*pixel)).sum::<f64>();
    let ratio = sum(&dark) / sum(&bright);
    // A full moon gives 0.27 lx, one 25 degrees from full about half of it; the sun 133,000 lx.
    assert!((5e-7..2.5e-6).contains(&ratio), "moonlight over sunlight: {ratio}");
    for (dark, bright) in dark.iter().zip(&bright).map(|(a, b)| (luminance(*a), luminance(*b))) {
        assert!((dark / ratio - bright).abs() < 0.02 * bright + 1e-3 * sum(&[[1.0; 4]]), "{dark} for {bright}");
    }
}

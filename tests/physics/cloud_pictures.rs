//! Clouds in the frame against the reference of light in the same grid.

use tyndall_clouds::reference::{Medium, Ray, TabulatedPhase, single_scattering};
use tyndall_clouds::{CloudSimulation, Edges};
use tyndall_core::spectrum::rec709_from_spectrum_matrix;
use tyndall_render::View;
use tyndall_render::clouds::reference::CloudReference;
use tyndall_scene::Scene;

use crate::render::{Studio, luminance, scene};

const SIZE: [u32; 2] = [48, 32];

/// A small cloud before a black sky: no air, no light from the ground, the sun alone.
fn lone_clouds(changes: &[(&str, &str)]) -> Scene {
    let void = [
        ("atmosphere.air_density", "0"),
        ("atmosphere.aerosol_optical_depth", "0"),
        ("atmosphere.ozone_du", "0"),
        ("ground.material", "colour"),
        ("ground.red", "0"),
        ("ground.green", "0"),
        ("ground.blue", "0"),
        ("sun.disc", "false"),
        ("stars.visible", "false"),
        ("stars.airglow_cd_m2", "0"),
        ("camera.y_m", "-1600"),
        ("camera.heading_deg", "0"),
        ("camera.pitch_deg", "38"),
        ("camera.field_of_view_deg", "40"),
        ("clouds.kind", "automaton"),
        ("clouds.orders", "single"),
        ("clouds.detail", "0"),
        ("cloud_grid.cells_east", "32"),
        ("cloud_grid.cells_north", "32"),
        ("cloud_grid.cells_up", "20"),
        ("cloud_grid.edges", "open"),
        ("cloud_grid.warm_up_steps", "25"),
        ("cloud_vapour.cover", "0.6"),
        ("cloud_matter.extinction_per_m", "0.02"),
    ];
    scene("noon", &[&void[..], changes].concat())
}

/// Radiance in the green channel of light scattered once, pixel by pixel.
fn reference(scene: &Scene) -> Vec<f64> {
    let params = scene.cloud_params().expect("clouds");
    assert_eq!(params.grid.edges, Edges::Open, "the reference does not repeat");
    let mut simulation = CloudSimulation::new(&params).expect("a simulation");
    let medium =
        Medium::new(simulation.extinction_per_m(1.0).expect("a moment"), params.grid.cell_m).expect("a medium");
    let drawn = &scene.clouds;
    let phase = TabulatedPhase::new(|cosine| {
        let lobe = |g: f64| (1.0 - g * g) / (1.0 + g * g - 2.0 * g * cosine).powf(1.5);
        drawn.forward_weight * lobe(drawn.forward_asymmetry)
            + (1.0 - drawn.forward_weight) * lobe(drawn.backward_asymmetry)
    });
    let phase = phase.expect("a phase function");
    let solar = scene.model().coefficients().expect("eight wavelengths").solar_irradiance_w_m2_nm;
    let [_, green, _] = rec709_from_spectrum_matrix();
    let sun: f64 = green.iter().zip(solar).map(|(weight, power)| weight * power).sum();
    let camera = View::Camera.frame(&scene.grounded().camera);
    let corner = medium.extent().map(|side| -0.5 * side);
    let origin = (camera.position - glam::DVec3::new(corner[0], corner[1], params.grid.floor_m)).to_array();
    let to_sun = scene.sun_direction().expect("a sun").unit().to_array();
    let [width, height] = SIZE.map(f64::from);
    let pixel = |index: u32| {
        let [x, y] = [index % SIZE[0], index / SIZE[0]].map(|place| f64::from(place) + 0.5);
        let across = (2.0 * x / width - 1.0) * camera.tan_half_view * width / height;
        let above = (1.0 - 2.0 * y / height) * camera.tan_half_view;
        let direction = (camera.forward + across * camera.right + above * camera.up).to_array();
        sun * single_scattering(&medium, &phase, to_sun, Ray { origin, direction }, 12.5)[0]
    };
    (0..SIZE[0] * SIZE[1]).map(pixel).collect()
}

#[test]
fn light_scattered_once_in_a_cloud_is_that_of_the_reference() {
    let mut studio = Studio::new();
    for sun in [("40", "200"), ("12", "90"), ("65", "350")] {
        let scene = lone_clouds(&[("sun.elevation_deg", sun.0), ("sun.azimuth_deg", sun.1)]);
        let wanted = reference(&scene);
        let found = studio.radiance(&scene, SIZE);
        let (mut gap, mut power, mut sums) = (0.0, 0.0, [0.0; 2]);
        for (found, wanted) in found.iter().map(|pixel| f64::from(pixel[1])).zip(&wanted) {
            gap += (found - wanted).powi(2);
            power += wanted.powi(2);
            sums = [sums[0] + found, sums[1] + wanted];
        }
        let (rms, mean) = ((gap / power).sqrt(), sums[0] / sums[1]);
        assert!(power > 0.0, "there is a cloud in view of {sun:?}");
        // Light is known once a cell, steps are half a cell: 2 % of the mean, and 6 % in single pixels.
        assert!((mean - 1.0).abs() < 0.02 && rms < 0.06, "sun {sun:?}: mean {mean}, root mean square {rms}");
    }
}

#[test]
fn a_thin_cloud_has_the_light_of_random_walks_within_a_fifth_and_none_is_there_without_clouds() {
    let mut studio = Studio::new();
    let mean = |pixels: Vec<[f32; 4]>| pixels.into_iter().map(luminance).sum::<f64>() / 1536.0;
    let sun = ("sun.azimuth_deg", "180");
    let [once, often] =
        ["single", "all"].map(|orders| mean(studio.radiance(&lone_clouds(&[sun, ("clouds.orders", orders)]), SIZE)));
    let size = [("image.width_px", "48"), ("image.height_px", "32")];
    let [walks_once, walks_often] = ["single", "all"].map(|orders| {
        let scene = lone_clouds(&[&[sun, ("clouds.orders", orders)][..], &size].concat());
        let reference = CloudReference::new(&scene).expect("a scene").expect("clouds");
        (0..SIZE[1]).flat_map(|y| reference.row(y, (32, 1))).map(|pixel| pixel.radiance).sum::<f64>()
    });
    let (found, wanted) = (often / once, walks_often / walks_once);
    assert!(wanted > 1.3, "light that is scattered often matters: {wanted}");
    // Light of the second to fifth order leaves thin clouds before it has forgotten its direction.
    assert!((found / wanted - 1.0).abs() < 0.2, "all orders over one: {found}, by random walks {wanted}");
    let none = mean(studio.radiance(&lone_clouds(&[sun, ("clouds.kind", "none")]), SIZE));
    assert!(none < 1e-3 * once, "the sky is black without clouds: {none}");
}

#[test]
fn clouds_hide_what_is_behind_them_and_nothing_before_them() {
    let mut studio = Studio::new();
    // The ground below clouds, in their shadow, seen from between.
    let sea = [
        ("camera.altitude_m", "400"),
        ("camera.pitch_deg", "-30"),
        ("clouds.kind", "automaton"),
        ("cloud_grid.cells_east", "32"),
        ("cloud_grid.cells_north", "32"),
    ];
    let [far, near] = ["60", "1"]
        .map(|reach_km| studio.radiance(&scene("noon", &[&sea[..], &[("clouds.reach_km", reach_km)]].concat()), SIZE));
    assert_eq!(far, near, "clouds above the camera hide nothing below it");
}

//! Clouds of files in pictures: parallel lines of sight, a black sky, and a known cloud as other programs draw it.

use std::path::Path;

use tyndall_io::read_npy;
use tyndall_render::clouds::reference::{CloudAccuracy, CloudReference};
use tyndall_render::environment::sun_above_air;
use tyndall_render::flip::mean_flip;
use tyndall_scene::{Scene, SceneFile};
use tyndall_tests::shared_data;

use crate::render::{Studio, scene};

/// Cloud of the tests' own data.
const SMALL: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/data/small_cloud.npy");

/// Radiance over the sun's irradiance, in the green channel.
fn over_sun(studio: &mut Studio, scene: &Scene) -> Vec<f64> {
    let [_, green, _] = sun_above_air(scene).expect("a sun");
    let size_px = [scene.image.width_px, scene.image.height_px];
    studio.radiance(scene, size_px).iter().map(|pixel| f64::from(pixel[1]) / green).collect()
}

/// The scene of the known cloud; `None` without the reference data.
fn known_scene() -> Option<Scene> {
    let data = shared_data("clouds/ca_cloud_scene.npz")?;
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/reference_cloud.toml");
    let mut scene = SceneFile::load(file).expect("the scene is right").scene;
    scene.clouds.file = data.display().to_string();
    Some(scene)
}

/// The committed cloud from the south, along parallel lines of sight.
fn small(changes: &[(&str, &str)]) -> Scene {
    let fixed = [
        ("camera.projection", "orthographic"),
        ("camera.width_m", "600"),
        ("camera.y_m", "-900"),
        ("camera.altitude_m", "150"),
        ("camera.heading_deg", "0"),
        ("camera.pitch_deg", "0"),
        ("sky.kind", "black"),
        ("image.width_px", "48"),
        ("image.height_px", "24"),
        ("clouds.kind", "file"),
        ("clouds.file", SMALL),
        ("clouds.detail", "0"),
        ("cloud_matter.extinction_per_m", "0.04"),
        ("cloud_grid.cell_m", "50"),
        ("cloud_grid.floor_m", "0"),
        ("cloud_grid.edges", "open"),
    ];
    scene("noon", &[&fixed[..], changes].concat())
}

#[test]
fn the_known_cloud_is_that_of_an_independent_march_within_50_db_and_looks_the_same() {
    let Some(path) = shared_data("clouds/ref_overhead_single_g0_march.npy") else { return };
    let array = read_npy(&path).expect("reference pictures are NPY files");
    let wanted: Vec<f64> = match array.data() {
        tyndall_core::array::ArrayData::F32(values) => {
            let rows = array.shape()[0];
            (0..values.len()).map(|i| f64::from(values[i / 192 + rows * (i % 192)])).collect()
        }
        other => panic!("32-bit floats: {} others", other.len()),
    };
    let scene = known_scene().expect("its cloud is beside it");
    let found = over_sun(&mut Studio::new(), &scene);
    let peak = wanted.iter().copied().fold(0.0, f64::max);
    // Pixels with cloud: where the reference is not black.
    let squares: Vec<f64> =
        found.iter().zip(&wanted).filter(|(_, w)| **w > 1e-5).map(|(f, w)| (f - w).powi(2)).collect();
    let psnr_db = 20.0 * (peak / (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()).log10();
    let ratio = found.iter().sum::<f64>() / wanted.iter().sum::<f64>();
    // Both as linear greys, white where the reference is brightest.
    let greys = |picture: &[f64]| picture.iter().map(|value| [value / peak; 3]).collect::<Vec<_>>();
    let seen = mean_flip(&greys(&wanted), &greys(&found), 192);
    println!("single scattering in the picture: {psnr_db:.1} dB, FLIP {seen:.4}, mean ratio {ratio:.4}");
    assert!(psnr_db >= 50.0, "{psnr_db} dB");
    assert!(seen <= 0.008, "FLIP {seen}");
    assert!((ratio - 1.0).abs() < 5e-3, "mean ratio {ratio}");
}

#[test]
fn parallel_lines_of_sight_show_the_same_from_any_distance_and_nothing_but_cloud_before_a_black_sky() {
    let mut studio = Studio::new();
    let near = over_sun(&mut studio, &small(&[]));
    let far = over_sun(&mut studio, &small(&[("camera.y_m", "-2500")]));
    let total: f64 = near.iter().sum();
    assert!(total > 0.1, "there is a cloud: {total}");
    let gap: f64 = near.iter().zip(&far).map(|(a, b)| (a - b).abs()).sum();
    // Steps begin elsewhere and grow with distance.
    assert!(gap < 0.03 * total, "{gap} of {total}");
    let edge = [0, 47, 23 * 48, 24 * 48 - 1].map(|index| near[index]);
    assert!(edge.iter().all(|value| value.abs() < 1e-12), "black beside the cloud: {edge:?}");
}

#[test]
fn moving_an_orthographic_camera_by_a_pixel_moves_the_picture_by_a_pixel() {
    let mut studio = Studio::new();
    let still = ("clouds.orders", "single");
    let here = over_sun(&mut studio, &small(&[still]));
    // 600 m over 48 pixels; the jitter of samples stays with the pixels.
    let moved = over_sun(&mut studio, &small(&[still, ("camera.x_m", "12.5"), ("camera.altitude_m", "162.5")]));
    let pairs = (0..23).flat_map(|y| (0..47).map(move |x| (y * 48 + x + 1, (y + 1) * 48 + x)));
    let (mut gap, mut total) = (0.0, 0.0);
    for (before, after) in pairs {
        gap += (here[before] - moved[after]).abs();
        total += here[before];
    }
    assert!(total > 0.0 && gap < 0.03 * total, "{gap} of {total}");
}

/// Accuracy of the picture of the known cloud against random walks; `None` without the reference data.
fn accuracy(changes: &[(&str, &str)], bin: usize) -> Option<CloudAccuracy> {
    let mut scene = known_scene()?;
    for (path, value) in changes {
        scene.set_text(path, value).unwrap_or_else(|error| panic!("{error}"));
    }
    let reference = CloudReference::new(&scene).expect("a scene").expect("clouds");
    let truth: Vec<_> = (0..scene.image.height_px).flat_map(|y| reference.row(y, (64, 1))).collect();
    let picture = over_sun(&mut Studio::new(), &scene);
    CloudAccuracy::of(&picture, &truth, scene.image.width_px as usize, bin)
}

/// What the notes call oblique: light from behind and from the right, scattered strongly forward.
const OBLIQUE: [(&str, &str); 3] =
    [("sun.elevation_deg", "35"), ("sun.azimuth_deg", "135"), ("clouds.forward_asymmetry", "0.85")];

#[test]
fn the_picture_of_single_scattering_has_the_mean_of_random_walks_under_any_sun() {
    for (name, changes, bin) in [("overhead, even", &[][..], 2), ("oblique, forward", &OBLIQUE[..], 4)] {
        let size = [("image.width_px", "96"), ("image.height_px", "32")];
        let Some(found) = accuracy(&[changes, &size].concat(), bin) else { return };
        println!("{name}, once: {found:?}");
        // Pixels are cut at their centres and twice as wide as those of the known picture.
        assert!((found.mean_ratio - 1.0).abs() < 0.03 && found.correlation > 0.99, "{name}: {found:?}");
    }
}

#[test]
fn the_picture_of_all_orders_has_the_light_and_the_pattern_of_random_walks() {
    let all = ("clouds.orders", "all");
    let size = [("image.width_px", "96"), ("image.height_px", "32")];
    // What good multiple scattering keeps to: ratio of means, relative squares, correlation; the bins are as wide as there.
    let cases = [
        ("overhead, even", vec![all], 1, (0.1, 0.04, 0.95)),
        ("oblique, forward", [&OBLIQUE[..], &[all]].concat(), 2, (0.2, 0.12, 0.85)),
    ];
    for (name, changes, bin, (ratio, squares, correlation)) in cases {
        let Some(found) = accuracy(&[&changes[..], &size].concat(), bin) else { return };
        println!("{name}, all orders: {found:?}");
        assert!((found.mean_ratio - 1.0).abs() < ratio, "{name}: {found:?}");
        assert!(found.relative_square < squares && found.correlation > correlation, "{name}: {found:?}");
    }
}

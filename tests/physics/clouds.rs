//! Clouds against reference data: the field's table, and pictures of a known cloud by other programs.

use std::f64::consts::PI;

use tyndall_clouds::reference::{
    Light, Medium, PathPicture, PathSettings, Ray, TabulatedPhase, ball_medium, path_picture, single_scattering,
};
use tyndall_clouds::{Metaball, Metaballs, density_from_array, density_from_arrays};
use tyndall_core::metaball::{ball_column, ball_field, ball_field_slope};
use tyndall_io::{read_npy, read_npz};
use tyndall_tests::shared_data;

/// Pixels of the reference pictures: two per cell, looking north.
pub(crate) const SIZE_PX: [usize; 2] = [192, 64];
pub(crate) const CELLS: [f64; 3] = [96.0, 64.0, 32.0];
/// Extinction in the middle of a full ball (1/cell).
const EXTINCTION: f32 = 0.17;

#[test]
fn the_metaballs_field_is_that_of_the_published_table() {
    let Some(path) = shared_data("clouds/wyvill_field.csv") else { return };
    let text = std::fs::read_to_string(path).unwrap();
    let mut rows = 0;
    for line in text.lines().filter(|line| !line.starts_with(['#', 'a'])) {
        let numbers: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        let [a, field, slope, column] = numbers[..] else { panic!("four columns: {line}") };
        for (what, found, wanted) in
            [("field", ball_field(a), field), ("slope", ball_field_slope(a), slope), ("column", ball_column(a), column)]
        {
            assert!((found - wanted).abs() < 1e-12, "{what} at {a}: {found} {wanted}");
        }
        rows += 1;
    }
    assert!(rows > 20, "{rows} rows");
}

/// The cloud of 37,138 balls, sampled four times a cell.
fn known_cloud() -> Option<Medium> {
    let arrays = read_npz(shared_data("clouds/ca_cloud_scene.npz")?).expect("the reference cloud is an NPZ file");
    let mut q = density_from_arrays(&arrays, None).expect("one grid of the file is a density");
    q.cells_mut().iter_mut().for_each(|q| *q *= EXTINCTION);
    Some(ball_medium(&q, 2.0, 0.625, 4).expect("radius and samples are allowed"))
}

/// The balls of the known cloud, in cells.
pub(crate) fn known_balls() -> Option<Metaballs> {
    let arrays = read_npz(shared_data("clouds/ca_cloud_scene.npz")?).expect("the reference cloud is an NPZ file");
    let q = density_from_arrays(&arrays, None).expect("one grid of the file is a density");
    let [nx, ny, _] = q.size();
    let place = |index: usize| [index % nx, index / nx % ny, index / (nx * ny)].map(|cell| cell as f32 + 0.625);
    let filled = q.cells().iter().enumerate().filter(|(_, q)| **q > 0.0);
    let ball = |(index, q): (usize, &f32)| Metaball {
        centre_m: place(index),
        radius_m: 2.0,
        extinction_per_m: EXTINCTION * q,
    };
    Some(Metaballs { balls: filled.map(ball).collect() })
}

/// A reference picture as [row][column], row 0 at the top.
pub(crate) fn known_picture(name: &str) -> Option<Vec<f64>> {
    // Files have one slice where a density has a third dimension.
    let array = read_npy(shared_data(name)?).expect("reference pictures are NPY files");
    let shape = [array.shape()[1], array.shape()[0], 1];
    let flat =
        tyndall_core::array::Array::new(vec![shape[1], shape[0], 1], array.data().clone()).expect("the same numbers");
    let grid = density_from_array(name, &flat).expect("radiance is 0 and more");
    assert_eq!([shape[0], shape[1]], SIZE_PX, "size of {name}");
    Some(
        (0..SIZE_PX[1])
            .flat_map(|row| (0..SIZE_PX[0]).map(move |column| [row, column, 0]))
            .map(|c| f64::from(grid[c]))
            .collect(),
    )
}

/// The line of sight of a place in the picture (pixels from the top left).
fn northwards([x, y]: [f64; 2]) -> Ray {
    Ray { origin: [0.5 * x, -10.0, CELLS[2] - 0.5 * y], direction: [0.0, 1.0, 0.0] }
}

#[test]
fn single_scattering_in_a_known_cloud_is_that_of_an_independent_march() {
    let (Some(medium), Some(wanted)) = (known_cloud(), known_picture("clouds/ref_overhead_single_g0_march.npy")) else {
        return;
    };
    let isotropic = TabulatedPhase::new(|_| 1.0).unwrap();
    let peak = wanted.iter().copied().fold(0.0, f64::max);
    let (mut squares, mut count) = (0.0, 0.0);
    // Every 23rd pixel; the reference averages four columns of samples.
    for index in (0..wanted.len()).step_by(23) {
        let [x, y] = [index % SIZE_PX[0], index / SIZE_PX[0]].map(|place| place as f64);
        let (mut radiance, mut opacity) = (0.0, 0.0);
        for [across, down] in [[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.75, 0.75]] {
            let ray = northwards([x + across, y + down]);
            let [scattered, transmittance] = single_scattering(&medium, &isotropic, [0.0, 0.0, 1.0], ray, 0.125);
            radiance += 0.25 * scattered;
            opacity += 0.25 * (1.0 - transmittance);
        }
        if opacity > 1e-3 {
            squares += (radiance - wanted[index]).powi(2);
            count += 1.0;
        }
    }
    let psnr_db = 20.0 * (peak / f64::sqrt(squares / count)).log10();
    println!("single scattering against the march: {psnr_db:.1} dB over {count} pixels");
    assert!(psnr_db >= 48.0, "{psnr_db} dB");
}

#[test]
fn paths_of_one_order_have_the_mean_of_an_independent_monte_carlo() {
    let (Some(medium), Some(wanted)) = (known_cloud(), known_picture("clouds/ref_overhead_single_g0.npy")) else {
        return;
    };
    let isotropic = TabulatedPhase::new(|_| 1.0).unwrap();
    let light = Light { to_sun: [0.0, 0.0, 1.0], sun_irradiance: 1.0, sky_radiance: 0.0 };
    let settings = PathSettings { albedo: 1.0, max_orders: 1, samples: 8, seed: 1 };
    let picture = PathPicture { size_px: SIZE_PX, ray: &northwards };
    let pixels = path_picture(&medium, &isotropic, &light, &settings, &picture);
    let mean = pixels.iter().map(|pixel| pixel.radiance).sum::<f64>() / pixels.len() as f64;
    let error = pixels.iter().map(|pixel| pixel.error.powi(2)).sum::<f64>().sqrt() / pixels.len() as f64;
    let reference = wanted.iter().sum::<f64>() / wanted.len() as f64;
    println!("mean by paths {mean:.6} +- {error:.6}, reference {reference:.6}");
    // The reference takes a linear field between samples, too; it has noise of its own.
    assert!((mean - reference).abs() < 4.0 * error + 0.002 * reference, "{mean} +- {error}, {reference}");
    assert!(mean < 1.0 / (4.0 * PI), "no more than the sun gives");
}

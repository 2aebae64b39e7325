//! Pictures of the desert against finer ones, and shadows against a march.

use tyndall_dunes::{DesertInputs, DesertParams, DesertSimulation};
use tyndall_render::desert::bed::Bed;
use tyndall_render::desert::sun_horizon::{fineness, sun_horizon};
use tyndall_render::exposure::expected_ev100;
use tyndall_render::film::ExposedFilm;
use tyndall_scene::Scene;

use crate::render::{Studio, luminance, scene};

/// Transverse dunes without single glints, seen along the ground (0) or from above (1).
fn dunes(view: usize, changes: &[(&str, &str)]) -> Scene {
    let small = [("dunes.side", "128"), ("desert.steps", "1200"), ("sand.glints", "0"), ("film.dither", "false")];
    let camera = [
        [("camera.altitude_m", "7"), ("camera.pitch_deg", "-7")],
        [("camera.altitude_m", "45"), ("camera.pitch_deg", "-75")],
    ];
    scene("desert", &[&small[..], &camera[view], changes].concat())
}

/// Display values 0 to 255 of a picture, exposed as another one.
fn shown(scene: &Scene, metered: &[[f32; 4]], picture: &[[f32; 4]], size_px: [u32; 2]) -> Vec<[f64; 3]> {
    let guess = expected_ev100(scene.sun_direction().expect("a sun").elevation_rad);
    let film = ExposedFilm::new(&scene.film, guess, metered, size_px);
    picture.iter().map(|pixel| film.develop(*pixel, [0, 0], 255.0).map(|value| 255.0 * value)).collect()
}

/// Means over squares of `side` pixels, in linear light.
fn averaged(fine: &[[f32; 4]], size_px: [u32; 2], side: u32) -> Vec<[f32; 4]> {
    let mean = |index: u32| {
        let [x, y] = [side * (index % size_px[0]), side * (index / size_px[0])];
        let mut sum = [0.0_f64; 4];
        for part in 0..side * side {
            let [px, py] = [x + part % side, y + part / side];
            for (sum, value) in sum.iter_mut().zip(fine[(py * side * size_px[0] + px) as usize]) {
                *sum += f64::from(value);
            }
        }
        #[expect(clippy::cast_possible_truncation, reason = "radiance of a picture")]
        sum.map(|sum| (sum / f64::from(side * side)) as f32)
    };
    (0..size_px[0] * size_px[1]).map(mean).collect()
}

#[test]
fn one_sample_of_a_pixel_shows_far_ripples_as_bright_as_256() {
    let (mut studio, size_px) = (Studio::new(), [48, 32]);
    for (view, sun) in [(0, "18"), (1, "18"), (0, "40"), (1, "40")] {
        let scene = dunes(view, &[("sun.elevation_deg", sun)]);
        let found = studio.radiance(&scene, size_px);
        let wanted = averaged(&studio.radiance(&scene, size_px.map(|side| 16 * side)), size_px, 16);
        let [mean_found, mean_wanted] =
            [&found, &wanted].map(|picture| picture.iter().map(|pixel| luminance(*pixel)).sum::<f64>());
        let pictures = [&found, &wanted].map(|picture| shown(&scene, &wanted, picture, size_px));
        let gaps = pictures[0].iter().flatten().zip(pictures[1].iter().flatten()).map(|(a, b)| (a - b).abs());
        let error = gaps.sum::<f64>() / f64::from(3 * size_px[0] * size_px[1]);
        let brightness = mean_found / mean_wanted - 1.0;
        assert!(error <= 2.0, "view {view}, sun at {sun} degrees: mean error {error} of 255");
        assert!(brightness.abs() <= 0.01, "view {view}, sun at {sun} degrees: brightness off by {brightness}");
    }
}

/// Elevation (rad) of the horizon seen from a place on the sand, by marching.
fn horizon_rad(bed: &Bed, place: [f64; 2], azimuth_from_east_rad: f64, top_m: f64, lowest_rad: f64) -> f64 {
    let [height, ..] = bed.at(place[0], place[1]);
    let (sine, cosine) = azimuth_from_east_rad.sin_cos();
    let reach_m = (top_m - height) / lowest_rad.tan();
    let steps = (reach_m / (0.2 * bed.cell_m)).ceil();
    let steepest = (1..).map(f64::from).take_while(|step| *step <= steps).map(|step| {
        let away_m = 0.2 * bed.cell_m * step;
        (bed.at(place[0] + away_m * cosine, place[1] + away_m * sine)[0] - height) / away_m
    });
    steepest.fold(-1.0, f64::max).atan()
}

/// Share of the sun's disc over the sand around a place, by columns of the disc.
fn sun_share(bed: &Bed, place: [f64; 2], azimuth_from_east_rad: f64, elevation_rad: f64, top_m: f64) -> f64 {
    const RADIUS_RAD: f64 = 0.004_65;
    let columns = [-0.8, -0.4, 0.0, 0.4, 0.8_f64];
    let (mut seen, mut all) = (0.0, 0.0);
    for column in columns {
        let half = (1.0 - column * column).sqrt();
        let azimuth = azimuth_from_east_rad + column * RADIUS_RAD / elevation_rad.cos();
        let horizon = horizon_rad(bed, place, azimuth, top_m, elevation_rad - RADIUS_RAD);
        seen += ((elevation_rad - horizon) / RADIUS_RAD + half).clamp(0.0, 2.0 * half);
        all += 2.0 * half;
    }
    seen / all
}

/// Share of the sun's disc that pictures show at a place, from horizons of a grid of cells.
fn drawn_share(tangents: &[f32], side: usize, cell_m: f64, place: [f64; 2], elevation_rad: f64) -> f64 {
    let at = place.map(|at_m| at_m / cell_m + 0.5 * side as f64 - 0.5);
    let share = at.map(|at| at - at.floor());
    #[expect(clippy::cast_possible_truncation, reason = "cells are whole numbers")]
    let cell = |dx: f64, dy: f64| {
        let [x, y] = [at[0] + dx, at[1] + dy].map(|at| at.floor().rem_euclid(side as f64) as usize);
        f64::from(tangents[y * side + x])
    };
    let row = |dy: f64| cell(0.0, dy) + share[0] * (cell(1.0, dy) - cell(0.0, dy));
    let tangent = row(0.0) + share[1] * (row(1.0) - row(0.0));
    let t = (0.5 + 0.5 * (elevation_rad - tangent.atan()) / 0.006).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[test]
fn the_suns_shadow_is_that_of_a_march_over_its_disc() {
    let scene = dunes(1, &[]);
    let params = scene.dune_params().expect("dunes");
    let bed = simulated(&params, scene.desert.steps);
    let (side, top_m) = (bed.heights.size()[0], bed.highest_m());
    let fine = fineness(bed.heights.size());
    for elevation_deg in [5.0_f64, 10.0, 30.0] {
        let (elevation_rad, azimuth_rad) = (elevation_deg.to_radians(), 0.4 + 0.1 * elevation_deg);
        let to_sun = [azimuth_rad.cos(), azimuth_rad.sin()].map(|part| part * elevation_rad.cos());
        let map = sun_horizon(&bed, azimuth_rad, fine).expect("horizons");
        let (mut near, mut lit, mut hidden) = (0, 0, 0);
        let places = 3000;
        for index in 0..places {
            // Evenly spread over the field.
            let place = [0.754_877_666_246_692_7, 0.569_840_290_998_053_2]
                .map(|step| side as f64 * bed.cell_m * ((f64::from(index) * step).fract() - 0.5));
            let [_, slope_x, slope_y] = bed.at(place[0], place[1]);
            // What is turned away from the sun is dark for either.
            let faces = elevation_rad.sin() > slope_x * to_sun[0] + slope_y * to_sun[1];
            let cell_m = bed.cell_m / fine as f64;
            let found = if faces { drawn_share(&map, fine * side, cell_m, place, elevation_rad) } else { 0.0 };
            let wanted = if faces { sun_share(&bed, place, azimuth_rad, elevation_rad, top_m) } else { 0.0 };
            near += usize::from((found - wanted).abs() <= 0.1);
            lit += usize::from(wanted > 0.9);
            hidden += usize::from(faces && wanted < 0.1);
        }
        let share = near as f64 / f64::from(places);
        assert!(
            lit > 100 && (hidden > 100 || elevation_deg > 20.0),
            "{elevation_deg} degrees: {lit} lit, {hidden} not"
        );
        assert!(share >= 0.99, "sun at {elevation_deg} degrees: {share} of places within 0.1");
    }
}

/// The bed that pictures of these dunes show.
fn simulated(params: &DesertParams, steps: u32) -> Bed {
    let mut simulation = DesertSimulation::cold(params, &DesertInputs::default()).expect("dunes");
    simulation.advance(steps);
    Bed::new(&simulation).expect("a bed")
}

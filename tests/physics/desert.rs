//! Pictures of the desert against finer ones, shadows against a march, light against the CPU's, and slip faces.

use std::f64::consts::PI;

use tyndall_core::spectrum::rec709_from_spectrum;
use tyndall_dunes::{DesertInputs, DesertParams, DesertSimulation};
use tyndall_render::desert::bed::Bed;
use tyndall_render::desert::reflection::sand_backscatter;
use tyndall_render::desert::sun_horizon::{fineness, sun_horizon};
use tyndall_render::exposure::expected_ev100;
use tyndall_render::film::ExposedFilm;
use tyndall_scattering::march::Marcher;
use tyndall_scattering::orders::{OrdersQuality, SourceTable};
use tyndall_scattering::sky_light::SkyLight;
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

/// A map of square cells at a place, by the four cells around it.
fn between_cells(map: &[f32], side: usize, cell_m: f64, place: [f64; 2]) -> f64 {
    let at = place.map(|at_m| at_m / cell_m + 0.5 * side as f64 - 0.5);
    let share = at.map(|at| at - at.floor());
    #[expect(clippy::cast_possible_truncation, reason = "cells are whole numbers")]
    let cell = |dx: f64, dy: f64| {
        let [x, y] = [at[0] + dx, at[1] + dy].map(|at| at.floor().rem_euclid(side as f64) as usize);
        f64::from(map[y * side + x])
    };
    let row = |dy: f64| cell(0.0, dy) + share[0] * (cell(1.0, dy) - cell(0.0, dy));
    row(0.0) + share[1] * (row(1.0) - row(0.0))
}

/// Share of the sun's disc that pictures show at a place, from horizons of a grid of cells.
fn drawn_share(tangents: &[f32], side: usize, cell_m: f64, place: [f64; 2], elevation_rad: f64) -> f64 {
    let tangent = between_cells(tangents, side, cell_m, place);
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

/// The light of a scene's sun and sky on sand, from the CPU.
struct Light {
    sky: SkyLight,
    /// Sunlight on a surface that faces it (lx, linear Rec.709).
    sun: [f64; 3],
    to_sun: [f64; 3],
}

impl Light {
    fn of(scene: &Scene) -> Self {
        let marcher = Marcher::new(scene.model(), scene.sky.march_steps as usize).expect("eight wavelengths");
        let source = SourceTable::new(&marcher, &OrdersQuality::preview());
        let to_sun = scene.sun_direction().expect("a sun").unit().to_array();
        let sun = rec709_from_spectrum(&marcher.sun_on_ground(to_sun[2])).map(|light| light / to_sun[2]);
        Self { sky: SkyLight::new(&source, 0.0, to_sun[2]), sun, to_sun }
    }

    /// Radiance of even sand with a normal: the sun shines on it or not, and it sees a share of its sky.
    fn radiance(&self, (normal, view): ([f64; 3], [f64; 3]), sees_sun: bool, open: f64) -> [f64; 3] {
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let facing = dot(normal, self.to_sun);
        let sines = ((1.0 - normal[2].powi(2)) * (1.0 - self.to_sun[2].powi(2))).max(1e-12).sqrt();
        let azimuth = ((facing - normal[2] * self.to_sun[2]) / sines).clamp(-1.0, 1.0);
        let sky = rec709_from_spectrum(&self.sky.irradiance(normal[2], azimuth));
        let back = sand_backscatter(dot(self.to_sun, view));
        let direct = if sees_sun { facing.max(0.0) * back } else { 0.0 };
        [0, 1, 2].map(|channel| ALBEDO / PI * (self.sun[channel] * direct + open * sky[channel]))
    }
}

/// Of the sand that light is measured on.
const ALBEDO: f64 = 0.5;

/// Grey, even sand without sheen and ripples, seen from 40 m above.
fn even_sand() -> Scene {
    let sand = [("sand.red", "0.5"), ("sand.green", "0.5"), ("sand.blue", "0.5"), ("sand.roughness_deg", "0")];
    let plain = [("sand.shine", "0"), ("sand.bounce", "0"), ("sand.ripples", "none"), ("sun.elevation_deg", "14")];
    let camera = [("camera.altitude_m", "40"), ("camera.pitch_deg", "-90"), ("camera.heading_deg", "0")];
    dunes(1, &[&sand[..], &plain, &camera].concat())
}

/// Place and view of each pixel of a square picture straight down on a bed.
fn looking_down(scene: &Scene, bed: &Bed, side_px: u32) -> Vec<([f64; 2], [f64; 3])> {
    let camera = &scene.camera;
    let top_m = camera.altitude_m + bed.at(camera.x_m, camera.y_m)[0];
    let half = (0.5 * camera.field_of_view_deg).to_radians().tan();
    let plane = |at: u32| 2.0 * (f64::from(at) + 0.5) / f64::from(side_px) - 1.0;
    let seen = |pixel: u32| {
        let across = [half * plane(pixel % side_px), -half * plane(pixel / side_px)];
        let mut place = [camera.x_m, camera.y_m];
        // Slopes times the ray's own stay below 0.3, so that each round leaves less than a third of the error.
        for _ in 0..20 {
            let fall_m = top_m - bed.at(place[0], place[1])[0];
            place = [camera.x_m + fall_m * across[0], camera.y_m + fall_m * across[1]];
        }
        let length = (1.0 + across[0].powi(2) + across[1].powi(2)).sqrt();
        (place, [-across[0] / length, -across[1] / length, 1.0 / length])
    };
    (0..side_px * side_px).map(seen).collect()
}

#[test]
fn sand_in_sun_and_shade_is_as_bright_as_the_light_of_the_cpu_makes_it() {
    const SIDE_PX: u32 = 48;
    let scene = even_sand();
    let bed = simulated(&scene.dune_params().expect("dunes"), scene.desert.steps);
    let light = Light::of(&scene);
    let sun = scene.sun_direction().expect("a sun");
    let azimuth_from_east_rad = std::f64::consts::FRAC_PI_2 - sun.azimuth_rad;
    let top_m = bed.highest_m();
    let picture = Studio::new().radiance(&scene, [SIDE_PX, SIDE_PX]);
    let (mut pixels, mut worst, mut blueness) = ([0.0; 2], [0.0_f64; 2], [0.0; 2]);
    let mut off_sums = [[0.0; 3]; 2];
    for ((place, view), found) in looking_down(&scene, &bed, SIDE_PX).into_iter().zip(&picture) {
        let lowest_rad = 0.5 * sun.elevation_rad;
        let over_rad = sun.elevation_rad - horizon_rad(&bed, place, azimuth_from_east_rad, top_m, lowest_rad);
        let [_, east, north] = bed.at(place[0], place[1]);
        let length = (1.0 + east * east + north * north).sqrt();
        let normal = [-east / length, -north / length, 1.0 / length];
        let facing = normal[0] * light.to_sun[0] + normal[1] * light.to_sun[1] + normal[2] * light.to_sun[2];
        // Edges of shadows and grazing light are tested by themselves.
        let lit = match (over_rad > 0.02 && facing > 0.1, over_rad < -0.02 && facing < 0.2 || facing < -0.05) {
            (true, _) => 0,
            (_, true) => 1,
            _ => continue,
        };
        let open = between_cells(&bed.openness, 128, bed.cell_m, place).clamp(0.0, 1.0);
        let wanted = light.radiance((normal, view), lit == 0, open);
        let off = (0..3).map(|k| (f64::from(found[k]) / wanted[k] - 1.0).abs()).fold(0.0, f64::max);
        worst[lit] = worst[lit].max(off);
        off_sums[lit] = [0, 1, 2].map(|k| off_sums[lit][k] + f64::from(found[k]) / wanted[k] - 1.0);
        pixels[lit] += 1.0;
        blueness[lit] += f64::from(found[2]) / f64::from(found[0]);
    }
    let [sunny, shady] = [0, 1].map(|lit| blueness[lit] / pixels[lit]);
    println!("pixels {pixels:?}, worst {worst:?}, blue over red {sunny:.3} in the sun, {shady:.3} in the shade");
    assert!(pixels.iter().all(|count| *count > 50.0), "sun and shade are both seen: {pixels:?}");
    // Tables of the sky and 40 m of air; openness in half floats, and slopes within cells, at single pixels.
    for lit in [0, 1] {
        let mean = off_sums[lit].map(|sum: f64| sum / pixels[lit]);
        assert!(mean.iter().all(|off| off.abs() < 0.01), "off on average (0 sun, 1 shade) {lit}: {mean:?}");
        assert!(worst[lit] < 0.06, "off at worst (0 sun, 1 shade) {lit}: {}", worst[lit]);
    }
    // Under a sun at 14 degrees: its own light is yellow, that of the sky blue.
    assert!(shady > 1.8 * sunny, "blue over red {sunny} in the sun and {shady} in the shade");
}

#[test]
fn slip_faces_of_the_drawn_surface_stand_at_repose() {
    let scene = dunes(1, &[("dunes.side", "256"), ("desert.steps", "3000")]);
    let params = scene.dune_params().expect("dunes");
    let mut simulation = DesertSimulation::cold(&params, &DesertInputs::default()).expect("dunes");
    simulation.advance(scene.desert.steps);
    let (maps, bed) = (simulation.maps().expect("maps"), Bed::new(&simulation).expect("a bed"));
    let [nx, ny] = maps.size;
    let is_slip = |x: usize, y: usize| maps.slip_face[(y % ny) * nx + x % nx] != 0;
    // The middle of faces: their brink and foot are rounded by the width of a cell.
    let inner = |index: &usize| {
        let [x, y] = [index % nx + nx, index / nx + ny];
        (0..9).all(|k| is_slip(x + k % 3 - 1, y + k / 3 - 1))
    };
    let steepness = |index: usize| {
        let place = |at: usize, count: usize| bed.cell_m * (at as f64 + 0.5 - 0.5 * count as f64);
        let [_, east, north] = bed.at(place(index % nx, nx), place(index / nx, ny));
        east.hypot(north).atan().to_degrees()
    };
    let mut slopes: Vec<f64> = (0..nx * ny).filter(inner).map(steepness).collect();
    slopes.sort_by(f64::total_cmp);
    let at = |percent: usize| slopes[(slopes.len() - 1) * percent / 100];
    println!("{} cells: 5 % {:.1}, median {:.1}, 95 % {:.1} degrees", slopes.len(), at(5), at(50), at(95));
    assert!(slopes.len() > 100, "{} cells of slip faces", slopes.len());
    assert!((30.0..=34.0).contains(&at(50)), "the median is {} degrees", at(50));
    assert!(at(5) > 28.0 && at(95) <= 34.5, "5 % {}, 95 % {} degrees", at(5), at(95));
}

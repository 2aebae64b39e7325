//! Pictures of the desert by the meshes that are drawn against those of the finest, and by a camera that moves a little.
//!
//! A pixel is inside when the sand around it is one smooth surface. Outlines, where a crest ends against what is behind it,
//! are not smoothed in a picture, and are counted apart.

use tyndall_render::desert::mesh::Fineness;
use tyndall_render::exposure::expected_ev100;
use tyndall_render::film::ExposedFilm;
use tyndall_scene::Scene;

use crate::render::{Studio, scene};

const SIZE_PX: [u32; 2] = [240, 160];

/// The sand's views: along the ground, from a crest's height, and from above.
const VIEWS: [(&str, &str); 3] = [("3", "-12"), ("14", "-10"), ("45", "-75")];

/// A sun under which dunes cast no shadows, whose edges are as sharp as outlines.
const HIGH_SUN: [(&str, &str); 1] = [("sun.elevation_deg", "60")];

/// Dunes without single glints.
fn dunes(view: usize, changes: &[(&str, &str)]) -> Scene {
    let (altitude, pitch) = VIEWS[view];
    let fixed = [
        ("dunes.side", "128"),
        ("desert.steps", "1200"),
        ("sand.glints", "0"),
        ("film.dither", "false"),
        ("sky.orders", "single"),
        ("camera.altitude_m", altitude),
        ("camera.pitch_deg", pitch),
    ];
    scene("desert", &[&fixed, changes].concat())
}

/// A picture's radiance and distances.
struct Shot {
    radiance: Vec<[f32; 4]>,
    depth_m: Vec<f32>,
}

impl Shot {
    fn of(studio: &mut Studio, scene: &Scene) -> Self {
        let target = studio.shoot(scene, SIZE_PX);
        let radiance = target.read_radiance(studio.gpu).unwrap_or_else(|error| panic!("{error}"));
        let depth_m = target.read_depth_m(studio.gpu).unwrap_or_else(|error| panic!("{error}"));
        Self { radiance, depth_m }
    }

    /// Display values 0 to 255, exposed as another picture.
    fn shown(&self, scene: &Scene, metered: &Self) -> Vec<[f64; 3]> {
        let guess = expected_ev100(scene.sun_direction().expect("a sun").elevation_rad);
        let film = ExposedFilm::new(&scene.film, guess, &metered.radiance, SIZE_PX);
        self.radiance.iter().map(|pixel| film.develop(*pixel, [0, 0], 255.0).map(|value| 255.0 * value)).collect()
    }

    /// Whether the sand around a pixel is one surface. Reciprocals of distances are linear on planes; where they bend by more
    /// than a share of themselves, something ends.
    fn is_inside(&self, x: u32, y: u32) -> bool {
        let [width, height] = SIZE_PX;
        let near = |x: u32, y: u32| 1.0 / f64::from(self.depth_m[(y * width + x) as usize]);
        let bends = |[a, b, c]: [f64; 3]| (a - 2.0 * b + c).abs() > 0.01 * b;
        let in_picture = x >= 2 && y >= 2 && x + 2 < width && y + 2 < height;
        in_picture
            && (x - 1..=x + 1).all(|x| {
                (y - 1..=y + 1).all(|y| {
                    let ways =
                        [[near(x - 1, y), near(x, y), near(x + 1, y)], [near(x, y - 1), near(x, y), near(x, y + 1)]];
                    near(x, y) > 1e-6 && !ways.into_iter().any(bends)
                })
            })
    }
}

/// Differences between pictures of 0 to 255: the largest and the mean inside, where it is largest, and the share of pixels
/// inside.
#[derive(Debug)]
struct Gap {
    largest: f64,
    at: [u32; 2],
    mean: f64,
    inside: f64,
}

fn gap(scene: &Scene, shots: [&Shot; 2]) -> Gap {
    let shown = shots.map(|shot| shot.shown(scene, shots[0]));
    let (mut gap, mut count) = (Gap { largest: 0.0, at: [0, 0], mean: 0.0, inside: 0.0 }, 0.0);
    for (index, (a, b)) in (0..).zip(shown[0].iter().zip(&shown[1])) {
        let [x, y] = [index % SIZE_PX[0], index / SIZE_PX[0]];
        if !shots.iter().all(|shot| shot.is_inside(x, y)) {
            continue;
        }
        let here = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        if here > gap.largest {
            (gap.largest, gap.at) = (here, [x, y]);
        }
        gap.mean += here;
        count += 1.0;
    }
    Gap { mean: gap.mean / count, inside: count / f64::from(SIZE_PX[0] * SIZE_PX[1]), ..gap }
}

#[test]
fn the_mesh_of_pictures_shows_what_the_finest_does() {
    let mut studio = Studio::new();
    for view in 0..VIEWS.len() {
        let scene = dunes(view, &[]);
        let shots = [Fineness::Full, Fineness::Fine].map(|fineness| {
            studio.renderer.set_desert_fineness(fineness);
            Shot::of(&mut studio, &scene)
        });
        let gap = gap(&scene, [&shots[0], &shots[1]]);
        assert!(gap.inside > 0.3, "view {view}: {gap:?}");
        assert!(gap.largest <= 2.0 && gap.mean <= 0.1, "view {view}: {gap:?}");
    }
}

#[test]
fn a_camera_that_turns_by_a_tenth_of_a_pixel_changes_no_pixel_inside_sand_without_shadows_by_much() {
    let mut studio = Studio::new();
    for view in 0..VIEWS.len() {
        let scene = dunes(view, &HIGH_SUN);
        let turn_deg = 0.1 * scene.camera.field_of_view_deg / f64::from(SIZE_PX[1]);
        let camera = &scene.camera;
        for (path, angle_deg) in [("camera.heading_deg", camera.heading_deg), ("camera.pitch_deg", camera.pitch_deg)] {
            let turned = dunes(view, &[HIGH_SUN[0], (path, &(angle_deg + turn_deg).to_string())]);
            let shots = [&scene, &turned].map(|scene| Shot::of(&mut studio, scene));
            let gap = gap(&scene, [&shots[0], &shots[1]]);
            assert!(gap.inside > 0.3, "view {view}, {path}: {gap:?}");
            assert!(gap.largest <= 6.0, "view {view}, {path}: {gap:?}");
        }
    }
}

//! Clouds in pictures of everything around the camera: panoramas and cubes.

use glam::{DVec2, DVec3, UVec2};
use tyndall_render::environment::cube::panorama_point_px;
use tyndall_render::environment::{EnvironmentOptions, GroundLight};
use tyndall_render::{CubeFace, FrameTarget, View};
use tyndall_scene::Scene;
use tyndall_scene::camera::CameraFrame;

use crate::render::{Studio, config, luminance, scene};

/// Pixels along a face of a cube.
const FACE_PX: u32 = 128;

/// A field of small clouds all around, without turbulence, over a camera that looks at an edge of the cube.
fn field() -> Scene {
    let changes = [
        ("sun.disc", "false"),
        ("landscape.kind", "none"),
        ("camera.altitude_m", "300"),
        ("camera.heading_deg", "45"),
        ("camera.pitch_deg", "25"),
        ("camera.field_of_view_deg", "50"),
        ("clouds.detail", "0"),
        ("cloud_grid.cells_east", "48"),
        ("cloud_grid.cells_north", "48"),
        ("cloud_grid.cells_up", "20"),
        ("cloud_grid.warm_up_steps", "25"),
        ("cloud_vapour.cover", "0.4"),
    ];
    scene("cumulus", &changes)
}

/// Luminance of the pixels of a face.
fn face(studio: &mut Studio, scene: &Scene, face: CubeFace) -> Vec<f64> {
    let gpu = studio.gpu;
    let mut target = FrameTarget::new(gpu, [FACE_PX; 2], config()).unwrap_or_else(|error| panic!("{error}"));
    let drawn = studio.renderer.render_view(gpu, scene, View::CubeFace(face), &mut target);
    drawn.unwrap_or_else(|error| panic!("{error}"));
    target.read_radiance(gpu).unwrap_or_else(|error| panic!("{error}")).iter().map(|pixel| luminance(*pixel)).collect()
}

/// Root of the mean square of what relative differences are between neighbouring columns or rows.
fn roughness(pairs: impl Iterator<Item = [f64; 2]>) -> f64 {
    let (sum, count) = pairs.fold((0.0, 0.0), |(sum, count), [a, b]| {
        let difference: f64 = (a - b) / (0.5 * (a + b));
        (sum + difference * difference, count + 1.0)
    });
    f64::sqrt(sum / count)
}

#[test]
fn clouds_have_no_seam_where_faces_of_a_cube_meet() {
    let mut studio = Studio::new();
    let scene = field();
    let [north, east, zenith] =
        [CubeFace::PosZ, CubeFace::PosX, CubeFace::PosY].map(|name| face(&mut studio, &scene, name));
    let side = FACE_PX as usize;
    // The upper halves of north and east: sky and clouds.
    let across = |a: &[f64], x: usize, b: &[f64], y: usize| -> Vec<[f64; 2]> {
        (0..side / 2).map(|row| [a[row * side + x], b[row * side + y]]).collect()
    };
    let seam = roughness(across(&north, side - 1, &east, 0).into_iter());
    let within = roughness(
        (1..8).flat_map(|x| [across(&north, side - 1 - x, &north, side - x), across(&east, x - 1, &east, x)].concat()),
    );
    println!("neighbouring pixels differ by {within:.4} within faces and {seam:.4} over the edge from north to east");
    assert!(within > 1e-3, "there are clouds: {within}");
    // Sixty-four pairs of neighbours, each of them as far apart as within the faces: a seam would be several times that.
    assert!(seam < 1.5 * within, "a seam from north to east: {seam} over {within}");

    // The upper edge of north is the lower edge of the zenith's face.
    let below = |column: usize| north[column];
    let above = |column: usize| zenith[(side - 1) * side + column];
    let seam = roughness((0..side).map(|column| [below(column), above(column)]));
    let within = roughness(
        (0..side)
            .flat_map(|column| {
                (1..8).flat_map(move |row| [(row, column, false), (row, column, true)]).collect::<Vec<_>>()
            })
            .map(|(row, column, of_zenith)| {
                if of_zenith {
                    [zenith[(side - row) * side + column], zenith[(side - 1 - row) * side + column]]
                } else {
                    [north[(row - 1) * side + column], north[row * side + column]]
                }
            }),
    );
    println!("and by {within:.4} and {seam:.4} from north to the zenith");
    assert!(seam < 1.5 * within, "a seam from north to the zenith: {seam} over {within}");
}

/// Means over squares of 16 x 16 pixels of what a camera sees, and of the same directions in `other`.
fn squares(seen: &[[f32; 4]], size_px: UVec2, scene: &Scene, other: impl Fn(DVec3) -> f64) -> Vec<[f64; 2]> {
    const SQUARE_PX: u32 = 16;
    let camera = CameraFrame::new(&scene.camera);
    let places = (0..size_px.y / SQUARE_PX).flat_map(|y| (0..size_px.x / SQUARE_PX).map(move |x| UVec2::new(x, y)));
    places
        .map(|square| {
            let pixels = (0..SQUARE_PX * SQUARE_PX)
                .map(|index| SQUARE_PX * square + UVec2::new(index % SQUARE_PX, index / SQUARE_PX));
            let sums = pixels.fold([0.0; 2], |[own, theirs], pixel| {
                let ray = camera.ray(pixel.as_dvec2() + DVec2::splat(0.5), size_px);
                let index = (pixel.y * size_px.x + pixel.x) as usize;
                [own + luminance(seen[index]), theirs + other(ray)]
            });
            sums.map(|sum| sum / f64::from(SQUARE_PX * SQUARE_PX))
        })
        .collect()
}

/// The pixel in which a place in a picture of that many pixels lies.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "places within the picture")]
fn pixel(place_px: f64, count: u32) -> usize {
    (place_px.max(0.0) as usize).min(count as usize - 1)
}

#[test]
fn a_panorama_and_a_cube_have_the_clouds_that_a_camera_sees() {
    let mut studio = Studio::new();
    let scene = field();
    let size_px = UVec2::new(192, 128);
    let seen = studio.radiance(&scene, size_px.to_array());

    let options = EnvironmentOptions { width_px: 1024, disc: false, ground: GroundLight::True };
    let gpu = studio.gpu;
    let around = studio.renderer.capture_environment(gpu, &scene, options).unwrap_or_else(|error| panic!("{error}"));
    let panorama = |ray: DVec3| {
        let [x, y] = panorama_point_px(ray, [1024, 512]);
        luminance(around.rgba[pixel(y, 512) * 1024 + pixel(x, 1024)])
    };
    let faces = CubeFace::ALL.map(|name| face(&mut studio, &scene, name));
    let cube = |ray: DVec3| {
        let (name, [right, up]) = CubeFace::of_direction(ray);
        let index = CubeFace::ALL.iter().position(|face| *face == name).expect("one of all");
        let place = |share: f64| pixel(0.5 * (share + 1.0) * f64::from(FACE_PX), FACE_PX);
        faces[index][place(-up) * FACE_PX as usize + place(right)]
    };
    let pictures: [(&str, &dyn Fn(DVec3) -> f64); 2] = [("panorama", &panorama), ("cube", &cube)];
    for (name, other) in pictures {
        let squares = squares(&seen, size_px, &scene, other);
        let [brightest, darkest] = [f64::max, f64::min].map(|of| squares.iter().map(|pair| pair[0]).reduce(of));
        assert!(brightest > darkest.map(|least| 1.5 * least), "there are clouds: {brightest:?} {darkest:?}");
        let mean = |index: usize| squares.iter().map(|pair| pair[index]).sum::<f64>() / squares.len() as f64;
        let ratio = mean(1) / mean(0);
        let worst = squares.iter().map(|[own, theirs]| (theirs / own - 1.0).abs()).fold(0.0, f64::max);
        println!("{name}: {ratio:.4} of the camera's light, squares within {:.2} %", 100.0 * worst);
        // Pixels of the panorama and of the cube are 1.4 and 3 times as wide as the camera's: at the outline of a cloud half a
        // pixel more or less of the 16 of a square belongs to it, which is half as bright again as the sky.
        assert!((ratio - 1.0).abs() < 5e-3, "{name}: {ratio}");
        assert!(worst < 0.05, "{name}: a square is off by {worst}");
    }
}

//! Pictures are what the scene says, in every format, and the same ones every time.

use glam::{DVec2, UVec2, Vec4};
use tyndall_io::{SKY_DEPTH_M, read_exr, read_picture_header};
use tyndall_scene::camera::CameraFrame;
use tyndall_scene::{Scene, SceneFile, presets};

use crate::program::Place;

const SIZE: &str = "96x64";
const SIZE_PX: UVec2 = UVec2::new(96, 64);

fn preset(name: &str) -> Scene {
    let found = presets().into_iter().find(|preset| preset.name == name).expect("a preset");
    let mut scene = found.load().expect("it loads").scene;
    scene.set("image.width_px", SIZE_PX.x.into()).expect("in range");
    scene.set("image.height_px", SIZE_PX.y.into()).expect("in range");
    scene
}

fn rendered(output: &str, options: &[&str]) -> Place {
    let place = Place::new();
    place.run(&[&["render", "preset:noon", "-o", output, "--size", SIZE], options].concat()).succeeded();
    assert_eq!(place.files(), [output], "one file and no litter");
    place
}

/// Mean of the values of one channel over some rows.
fn mean(rgba: &[[f32; 4]], rows: std::ops::Range<usize>, channel: usize) -> f32 {
    let width = SIZE_PX.x as usize;
    let pixels = &rgba[rows.start * width..rows.end * width];
    pixels.iter().map(|pixel| pixel[channel]).sum::<f32>() / pixels.len() as f32
}

#[test]
fn an_exr_file_holds_finite_light_of_a_blue_sky_over_a_warmer_ground() {
    let place = rendered("noon.exr", &["--float"]);
    let (picture, _) = read_exr(place.path("noon.exr")).unwrap();
    assert_eq!(picture.size_px, SIZE_PX.to_array(), "as --size says");
    assert!(picture.rgba.iter().flatten().all(|value| value.is_finite() && *value >= 0.0), "light is not negative");
    let (top, bottom) = (0..16, 56..64);
    let blueness = |rows: std::ops::Range<usize>| mean(&picture.rgba, rows.clone(), 2) / mean(&picture.rgba, rows, 0);
    assert!(blueness(top.clone()) > 1.5, "the sky's blue over red is {}", blueness(top));
    assert!(blueness(bottom.clone()) < 1.2, "the ground's blue over red is {}", blueness(bottom));
    // A clear noon sky has some thousand cd/m^2.
    let luminance = mean(&picture.rgba, 0..16, 1);
    assert!((500.0..50_000.0).contains(&luminance), "{luminance} cd/m^2");
}

#[test]
fn depth_is_the_planar_distance_to_level_ground_and_far_in_the_sky() {
    let place = rendered("noon.exr", &[]);
    let (picture, _) = read_exr(place.path("noon.exr")).unwrap();
    let depth_m = picture.depth_m.expect("channel Z");
    let camera = CameraFrame::new(&preset("noon").camera);
    assert_eq!(depth_m[0].to_bits(), SKY_DEPTH_M.to_bits(), "the first pixel shows the sky");
    for row in [52, 58, 63] {
        let direction = camera.ray(DVec2::new(48.5, f64::from(row) + 0.5), SIZE_PX);
        // The earth's curvature lowers the ground 20 m away by 3e-5 m.
        let expected = camera.position.z / -direction.z * direction.dot(camera.forward);
        let found = f64::from(depth_m[row as usize * SIZE_PX.x as usize + 48]);
        assert!((found / expected - 1.0).abs() < 1e-3, "row {row}: {found} m, by the camera {expected} m");
    }
}

#[test]
fn an_exr_header_names_scene_program_primaries_and_camera() {
    let place = rendered("noon.exr", &[]);
    let scene = preset("noon");
    let (_, metadata) = read_exr(place.path("noon.exr")).unwrap();
    assert_eq!(metadata.scene_hash, scene.hash().to_string(), "the hash of the scene as rendered");
    assert_eq!(metadata.software, format!("tyndall {}", env!("CARGO_PKG_VERSION")), "program and version");
    assert_eq!(metadata.title, scene.title, "the scene's title");
    assert_eq!(metadata.latitude_deg, None, "this sun stands by angles");

    let file = std::fs::File::open(place.path("noon.exr")).unwrap();
    let header = exr::meta::MetaData::read_from_buffered(std::io::BufReader::new(file), false).unwrap();
    let primaries = header.headers[0].shared_attributes.chromaticities.expect("primaries");
    assert_eq!((primaries.red.0, primaries.red.1, primaries.white.0), (0.64, 0.33, 0.3127), "Rec.709 and D65");

    // A point 10 m ahead, by row vectors as OpenEXR multiplies: z forward.
    let camera = CameraFrame::new(&scene.camera);
    let rows = metadata.world_to_camera.as_chunks::<4>().0;
    let ahead = (camera.position + 10.0 * camera.forward).as_vec3().extend(1.0);
    let seen: Vec4 = (0..4).map(|row| ahead[row] * Vec4::from_array(rows[row])).sum();
    assert!((seen - Vec4::new(0.0, 0.0, 10.0, 1.0)).length() < 1e-4, "{seen}");
}

#[test]
fn a_sun_by_date_writes_its_place_into_the_header() {
    let place = rendered("noon.exr", &["--set", "sun.position=date", "--set", "sun.latitude_deg=-33.5"]);
    let (_, metadata) = read_exr(place.path("noon.exr")).unwrap();
    assert_eq!(metadata.latitude_deg, Some(-33.5), "the latitude");
    assert_eq!(metadata.longitude_deg, Some(0.0), "the longitude");
}

#[test]
fn half_floats_are_the_float_picture_rounded_and_clamped() {
    let (half, float) = (rendered("a.exr", &[]), rendered("a.exr", &["--float", "--compression", "piz"]));
    let (half, _) = read_exr(half.path("a.exr")).unwrap();
    let (float, _) = read_exr(float.path("a.exr")).unwrap();
    for (half, float) in half.rgba.iter().flatten().zip(float.rgba.iter().flatten()) {
        // Half an ulp of the 11 bits of a half float; 1e-7 covers its smallest denormal.
        let bound = float.min(65_504.0) * 2.0_f32.powi(-11) + 1e-7;
        assert!((half - float.min(65_504.0)).abs() <= bound, "{half} for {float}");
    }
}

#[test]
fn a_sun_brighter_than_half_floats_is_reported() {
    let options = ["render", "preset:sunset", "-o", "a.exr", "--size", "320x180"];
    let warned = Place::new().run(&options).succeeded();
    assert!(warned.stderr.contains("brighter than half floats") && warned.stderr.contains("--float"), "{warned:?}");
    let kept = Place::new().run(&[&options[..], &["--float"]].concat()).succeeded();
    assert!(!kept.stderr.contains("clamped"), "{kept:?}");
}

#[test]
fn a_png_file_holds_the_developed_picture_and_the_scenes_hash() {
    let place = rendered("noon.png", &[]);
    let header = read_picture_header(place.path("noon.png")).unwrap();
    assert_eq!(header.size_px, SIZE_PX.to_array(), "as --size says");
    assert_eq!(header.scene_hash, preset("noon").hash().to_string(), "the hash of the scene as rendered");
    let picture = image::open(place.path("noon.png")).unwrap().to_rgba8();
    assert!(picture.pixels().all(|pixel| pixel[3] == 255), "opaque");
    let brightest = picture.pixels().map(|pixel| pixel[2]).max().unwrap();
    assert!(brightest > 100, "automatic exposure fills the range, but the brightest blue is {brightest}");
}

#[test]
fn sixteen_bits_and_jpeg_show_the_same_picture_as_eight_bits() {
    let eight = image::open(rendered("a.png", &[]).path("a.png")).unwrap().to_rgb32f();
    let sixteen = image::open(rendered("a.png", &["--bits", "16"]).path("a.png")).unwrap().to_rgb32f();
    let jpeg = image::open(rendered("a.jpg", &[]).path("a.jpg")).unwrap().to_rgb32f();
    let rms = |other: &image::Rgb32FImage| tyndall_tests::picture_difference(&eight, other).rms;
    // Variances in levels of 8 bits: 1/12 of rounding and 1/6 of triangular dither, an RMS of 0.5; the rest is left to the
    // half floats of the frame behind it.
    assert!(rms(&sixteen) < 0.55 / 255.0, "{} of 16 bits", rms(&sixteen));
    // JPEG at quality 92 loses the dither and some of the horizon's edge.
    assert!(rms(&jpeg) < 3.0 / 255.0, "{} of JPEG", rms(&jpeg));
}

#[test]
fn the_same_command_twice_gives_the_same_bytes() {
    for name in ["a.png", "a.exr"] {
        assert!(rendered(name, &[]).read(name) == rendered(name, &[]).read(name), "{name} differs from run to run");
    }
}

#[test]
fn a_setting_changes_picture_and_hash() {
    let (noon, evening) = (rendered("a.png", &[]), rendered("a.png", &["--set", "sun.elevation_deg=5"]));
    let hash = |place: &Place| read_picture_header(place.path("a.png")).unwrap().scene_hash;
    assert_ne!(hash(&noon), hash(&evening), "the scene is another one");
    let [noon, evening] = [noon, evening].map(|place| image::open(place.path("a.png")).unwrap().to_rgb32f());
    let rms = tyndall_tests::picture_difference(&noon, &evening).rms;
    assert!(rms > 5.0 / 255.0, "a sun 55 degrees lower changes the picture by {rms} only");
}

#[test]
fn the_command_line_of_a_changed_scene_renders_that_scene() {
    let place = Place::new();
    let base = preset("noon");
    SceneFile::new(base.clone()).save(place.path("base.toml")).unwrap();
    let mut changed = base.clone();
    changed.set("sun.elevation_deg", 12.5).unwrap();
    changed.set_text("film.tone_map", "aces").unwrap();
    SceneFile::new(changed.clone()).save(place.path("changed.toml")).unwrap();

    let line = changed.to_command_line(&base, "base.toml".as_ref());
    let mut words: Vec<_> = line[1..].iter().map(String::as_str).collect();
    words.extend(["-o", "a.png"]);
    place.run(&words).succeeded();
    place.run(&["render", "changed.toml", "-o", "b.png"]).succeeded();
    assert!(place.read("a.png") == place.read("b.png"), "{line:?} draws another picture than the saved scene");
}

#[test]
fn every_preset_renders() {
    for scene in presets() {
        let place = Place::new();
        let name = format!("preset:{}", scene.name);
        let run = place.run(&["render", &name, "-o", "a.png", "--size", SIZE]).succeeded();
        assert!(run.stderr.contains("a.png: 96 x 64 px in "), "{}: {}", scene.name, run.stderr);
        let picture = image::open(place.path("a.png")).unwrap().to_rgb8();
        let spread = picture.iter().max().unwrap() - picture.iter().min().unwrap();
        assert!(spread > 30, "{}: all values within {spread} levels", scene.name);
    }
}

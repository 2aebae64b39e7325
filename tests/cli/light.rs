//! Files of light for other programs: what is in them, and what lies beside them.

use exr::meta::MetaData;
use glam::DVec3;
use serde_json::Value;
use tyndall_core::primaries::RgbPrimaries;
use tyndall_core::spectrum::luminance_from_rec709;
use tyndall_io::{Picture, PictureMetadata, Projection, read_exr};
use tyndall_render::CubeFace;
use tyndall_render::environment::cube::{panorama_direction, panorama_solid_angle};

use crate::program::Place;

/// Light of one order with small tables: what is tested here does not depend on more.
const QUICK: [&str; 4] = ["--set", "sky.orders=single", "--set", "sun.azimuth_deg=120"];

/// Runs `tyndall hdri preset:noon -o sky.exr --width 256` with these words; the picture, its header and the sidecar.
fn hdri(words: &[&str]) -> (Picture, PictureMetadata, Value) {
    let place = Place::new();
    place.run(&[&["hdri", "preset:noon", "-o", "sky.exr", "--width", "256"], &QUICK[..], words].concat()).succeeded();
    assert_eq!(place.files(), ["sky.exr", "sky.json"], "the file, its sidecar and no litter");
    let (picture, metadata) = read_exr(place.path("sky.exr")).expect("an EXR file");
    (picture, metadata, serde_json::from_slice(&place.read("sky.json")).expect("JSON"))
}

fn vector(value: &Value) -> DVec3 {
    let number = |index: usize| value[index].as_f64().expect("a number");
    DVec3::new(number(0), number(1), number(2))
}

/// Direction of the light of the pixels within a tenth of the brightest.
fn brightest(picture: &Picture) -> DVec3 {
    let [width_px, _] = picture.size_px;
    let most = picture.rgba.iter().map(|pixel| pixel[1]).fold(0.0, f32::max);
    let seen = (0..).zip(&picture.rgba).filter(|(_, pixel)| pixel[1] > 0.1 * most).map(|(index, pixel): (u32, _)| {
        let (column, row) = (f64::from(index % width_px), index / width_px);
        let weight = f64::from(pixel[1]) * panorama_solid_angle(row, picture.size_px);
        weight * panorama_direction([column + 0.5, f64::from(row) + 0.5], picture.size_px)
    });
    seen.sum::<DVec3>().normalize()
}

#[test]
fn an_hdri_has_its_sun_where_the_sidecar_says() {
    let (picture, metadata, sidecar) = hdri(&[]);
    assert_eq!(picture.size_px, [256, 128], "half as many rows as columns");
    assert_eq!(metadata.projection, Projection::LatLong, "equirectangular");
    assert!((metadata.white_luminance_cd_m2 - 683.0).abs() < 1e-3, "Blender's unit");
    assert_eq!(sidecar["scene_hash"], metadata.scene_hash.as_str(), "the same scene");
    assert_eq!((&sidecar["file"], &sidecar["format"]), (&"sky.exr".into(), &1.into()), "{sidecar}");
    let sun = &sidecar["sun"];
    let apart = (brightest(&picture) - vector(&sun["direction_east_north_up"])).length();
    assert!(apart < 0.5 * std::f64::consts::TAU / 256.0, "{apart} rad away, {sun}");
    assert!(sun["in_picture"] == true && sun["lamp_wanted"] == false, "{sun}");
    assert!((sun["azimuth_deg"].as_f64().unwrap() - 120.0).abs() < 1e-6, "{sun}");
}

#[test]
fn the_disc_of_an_hdri_is_the_lamp_of_the_sidecar() {
    let ((with, _, _), (without, _, sidecar)) = (hdri(&[]), hdri(&["--sun", "lamp"]));
    let mut light = DVec3::ZERO;
    for (index, (on, off)) in with.rgba.iter().zip(&without.rgba).enumerate() {
        let row = u32::try_from(index / 256).unwrap();
        let more = DVec3::from_array(std::array::from_fn(|c| f64::from(on[c]) - f64::from(off[c])));
        light += more * panorama_solid_angle(row, with.size_px);
    }
    let sun = &sidecar["sun"];
    let lamp = &sun["blender_lamp"];
    let expected = lamp["strength"].as_f64().unwrap() * vector(&lamp["color"]);
    // The target of the sun's disc: 0.5 %.
    assert!((light / expected - DVec3::ONE).abs().max_element() < 5e-3, "{light} for {expected}");
    assert!((vector(&sun["normal_irradiance"]) - expected).length() < 1e-9 * expected.length(), "{sun}");
    assert!(sun["in_picture"] == false && sun["lamp_wanted"] == true, "{sun}");
}

#[test]
fn units_differ_by_their_white_and_exposed_needs_no_stops() {
    let (blender, _, sidecar) = hdri(&["--sun", "none"]);
    for unit in ["cd/m2", "exposed"] {
        let (other, metadata, other_sidecar) = hdri(&["--sun", "none", "--units", unit]);
        let ratio = 683.0 / f64::from(metadata.white_luminance_cd_m2);
        for (a, b) in blender.rgba.iter().zip(&other.rgba) {
            let found = f64::from(b[1]) / f64::from(a[1]);
            assert!((found / ratio - 1.0).abs() < 1e-5, "{unit}: {found} for {ratio}");
        }
        let stops = |sidecar: &Value| sidecar["exposure"]["stops"].as_f64().unwrap();
        assert!((stops(&sidecar) - stops(&other_sidecar) - ratio.log2()).abs() < 1e-4, "{unit}: {other_sidecar}");
        assert!(unit != "exposed" || stops(&other_sidecar).abs() < 1e-9, "{other_sidecar}");
    }
}

#[test]
fn acescg_is_said_in_the_header_and_keeps_the_colours() {
    let ((rec709, ..), (aces, metadata, sidecar)) =
        (hdri(&["--sun", "none"]), hdri(&["--sun", "none", "--primaries", "acescg"]));
    assert_eq!(metadata.primaries, RgbPrimaries::AcesCg, "chromaticities");
    assert_eq!(sidecar["unit"]["primaries"], "acescg", "{sidecar}");
    for (a, b) in rec709.rgba.iter().zip(&aces.rgba).step_by(97) {
        let expected = RgbPrimaries::AcesCg.convert_rec709([a[0], a[1], a[2]].map(f64::from));
        assert!((f64::from(b[0]) / expected[0] - 1.0).abs() < 1e-5, "{b:?} for {expected:?}");
    }
}

#[test]
fn a_night_has_no_sun_and_a_black_ground_no_light() {
    let (picture, _, sidecar) = hdri(&["--set", "sun.elevation_deg=-8", "--ground", "black"]);
    assert!(sidecar["sun"].is_null(), "{sidecar}");
    let luminance = |pixel: &[f32; 4]| luminance_from_rec709([pixel[0], pixel[1], pixel[2]].map(f64::from));
    // Light of one order leaves the sky in the earth's shadow black, but not the side of the sun.
    assert!(picture.rgba[..256 * 60].iter().any(|pixel| luminance(pixel) > 0.0), "twilight");
    assert!(picture.rgba[256 * 65..].iter().all(|pixel| luminance(pixel) <= 0.0), "no ground");
}

#[test]
fn radiance_files_hold_the_same_light_within_a_part_in_a_hundred() {
    let place = Place::new();
    place
        .run(&[&["hdri", "preset:noon", "-o", "sky.hdr", "--width", "256", "--sun", "none"], &QUICK[..]].concat())
        .succeeded();
    let (exr, ..) = hdri(&["--sun", "none"]);
    let hdr = image::open(place.path("sky.hdr")).unwrap().to_rgb32f();
    for (exr, hdr) in exr.rgba.iter().zip(hdr.pixels()) {
        // Eight bits of the strongest channel.
        assert!((exr[2] - hdr[2]).abs() <= exr[..3].iter().fold(0.0, |a: f32, b| a.max(*b)) / 100.0, "{exr:?} {hdr:?}");
    }
}

#[test]
fn what_cannot_be_light_is_refused() {
    let refused = |words: &[&str], part: &str| {
        let place = Place::new();
        place.run(words).refused(2, part);
        assert!(place.files().is_empty(), "{words:?} left {:?}", place.files());
    };
    refused(&["hdri", "preset:noon", "-o", "sky.png"], "not light; choose .exr or .hdr");
    refused(&["hdri", "preset:noon", "-o", "sky.tif"], "must be .exr or .hdr");
    refused(&["hdri", "preset:noon", "-o", "sky.hdr", "--half"], "--half concerns EXR files only");
    refused(&["hdri", "preset:noon", "-o", "sky.exr", "--width", "333"], "even number from 4 to 32768");
    refused(&["hdri", "preset:noon", "-o", "sky.exr", "--units", "nits"], "blender, cd/m2, exposed");
    refused(&["hdri", "preset:noon", "-o", "no/sky.exr"], "the folder no does not exist");
    refused(&["cubemap", "preset:noon", "-o", "sky", "--layout", "strip"], "this layout is one file");
    refused(&["cubemap", "preset:noon", "-o", "sky.png", "--units", "blender"], "--units concerns EXR files only");
    refused(&["cubemap", "preset:noon", "-o", "sky.png", "--size", "0"], "1..=8192");
    refused(&["cubemap", "preset:noon", "-o", "no/way/sky"], "the folder no/way does not exist");
}

#[test]
fn the_faces_of_a_cube_are_pictures_of_their_cameras() {
    let place = Place::new();
    place.run(&[&["cubemap", "preset:noon", "-o", "cube", "--size", "32"], &QUICK[..]].concat()).succeeded();
    for face in CubeFace::ALL {
        let path = place.path("cube").join(format!("{}.exr", face.name()));
        let (picture, metadata) = read_exr(&path).unwrap();
        assert_eq!(picture.size_px, [32, 32], "{face:?}");
        assert!((metadata.field_of_view_rad - std::f32::consts::FRAC_PI_2).abs() < 1e-6, "{face:?}");
        let axes = face.frame(DVec3::ZERO);
        let rows = metadata.world_to_camera;
        let ahead: Vec<_> = (0..3)
            .map(|column| (0..3).map(|row| axes.forward[row] * f64::from(rows[4 * row + column])).sum::<f64>())
            .collect();
        assert!((DVec3::from_slice(&ahead) - DVec3::Z).length() < 1e-6, "{face:?}: {ahead:?}");
    }
    // The eastern face and a camera that looks east show the same.
    let look =
        ["--set", "camera.heading_deg=90", "--set", "camera.pitch_deg=0", "--set", "camera.field_of_view_deg=90"];
    let words = ["render", "preset:noon", "-o", "east.exr", "--size", "32x32"];
    place.run(&[&words[..], &look[..], &QUICK[..]].concat()).succeeded();
    let [east, face] = ["east.exr", "cube/posx.exr"].map(|name| read_exr(place.path(name)).unwrap().0);
    for (a, b) in east.rgba.iter().zip(&face.rgba) {
        assert!((a[1] - b[1]).abs() <= 2e-3 * a[1], "{a:?} {b:?}: half floats of the same light");
    }
}

#[test]
fn a_cross_is_one_picture_of_all_faces_and_empty_elsewhere() {
    let place = Place::new();
    let words = ["cubemap", "preset:noon", "-o", "cross.png", "--size", "16", "--layout", "cross-horizontal"];
    place.run(&[&words[..], &QUICK[..]].concat()).succeeded();
    let cross = image::open(place.path("cross.png")).unwrap().to_rgba8();
    assert_eq!(cross.dimensions(), (64, 48), "four by three faces");
    for (x, y, pixel) in cross.enumerate_pixels() {
        let filled = y / 16 == 1 || x / 16 == 1;
        assert_eq!(pixel[3], if filled { 255 } else { 0 }, "({x}, {y})");
    }
    // Seams: north and east meet without a step.
    for y in 16..30 {
        let (a, b) = (cross.get_pixel(31, y), cross.get_pixel(32, y));
        assert!((0..3).all(|c| a[c].abs_diff(b[c]) <= 6), "row {y}: {a:?} {b:?}");
    }
}

#[test]
fn tables_from_the_cache_give_the_bytes_of_new_ones_and_damage_is_repaired() {
    let place = Place::new();
    let words = ["hdri", "preset:low-sun", "-o", "sky.exr", "--width", "64", "--set", "sky.orders_detail=preview"];
    let cache = place.path("cache");
    let folder = [("TYNDALL_CACHE_DIR", cache.to_str().unwrap())];
    let run = |more: &[&str]| {
        place.run_with(&folder, &[&words[..], &["--adapter", "software"], more].concat()).succeeded();
        place.read("sky.exr")
    };
    let new = run(&["--no-cache"]);
    assert!(!cache.exists(), "--no-cache keeps nothing");
    assert!(run(&[]) == new, "made and kept");
    let table = std::fs::read_dir(&cache).unwrap().next().expect("a table").unwrap().path();
    let kept = std::fs::read(&table).unwrap();
    assert!(run(&[]) == new, "read");
    std::fs::write(&table, &kept[..kept.len() / 2]).unwrap();
    assert!(run(&[]) == new, "made again");
    assert!(std::fs::read(&table).unwrap() == kept, "and repaired");
}

#[test]
fn an_hdri_has_three_channels_of_floats_unless_halves_are_asked_for() {
    for (words, kind) in [(&[][..], "F32"), (&["--half", "--sun", "none"][..], "F16")] {
        let place = Place::new();
        place
            .run(&[&["hdri", "preset:noon", "-o", "sky.exr", "--width", "64"], &QUICK[..], words].concat())
            .succeeded();
        let file = std::io::BufReader::new(std::fs::File::open(place.path("sky.exr")).unwrap());
        let header = MetaData::read_from_buffered(file, false).unwrap().headers.remove(0);
        let channels: Vec<_> =
            header.channels.list.iter().map(|channel| format!("{} {:?}", channel.name, channel.sample_type)).collect();
        assert_eq!(channels, ["B", "G", "R"].map(|name| format!("{name} {kind}")), "{words:?}");
    }
}

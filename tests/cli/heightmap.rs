//! `tyndall heightmap`: sand as terrain.

use serde_json::Value;
use tyndall_io::{HeightFormat, HeightMap, HeightScale, read_height_map};

use crate::program::{Place, Run};

const SCENE: &str = "format = 1\n[desert]\nkind = \"dunes\"\nsteps = 150\n[dunes]\nside = \"64\"\ncell_m = 2.0\n";

fn place() -> Place {
    let place = Place::new();
    place.write("sand.toml", SCENE);
    place
}

fn heightmap(place: &Place, words: &[&str]) -> Run {
    place.run(&[&["heightmap", "sand.toml"], words].concat())
}

fn sidecar(place: &Place, name: &str) -> Value {
    serde_json::from_slice(&place.read(name)).expect("JSON")
}

/// A height map as its sidecar says how to read it.
fn read(place: &Place, name: &str, described: &Value) -> HeightMap {
    let number = |key: &str| described[key].as_f64().expect(key);
    #[expect(clippy::cast_possible_truncation, reason = "heights are f32")]
    let range_m = ["lowest_m", "highest_m"].map(|key| number(key) as f32);
    read_height_map(place.path(name), HeightScale { range_m, pixel_m: number("metres_per_pixel") })
        .expect("a height map")
}

#[test]
fn every_format_holds_the_same_heights_within_its_precision() {
    let place = place();
    let mut maps = Vec::new();
    for ending in ["png", "exr", "r16", "r32"] {
        let name = format!("dunes.{ending}");
        heightmap(&place, &["-o", &name]).succeeded();
        let described = sidecar(&place, "dunes.json");
        assert_eq!(
            (&described["width"], &described["metres_per_pixel"], &described["step"]),
            (&64.into(), &2.0.into(), &150.into()),
            "{described}"
        );
        maps.push((HeightFormat::of(&place.path(&name)).unwrap(), read(&place, &name, &described)));
    }
    let exact = maps[3].1.clone();
    let [low, high] = exact.range_m();
    assert!(high - low > 2.0, "there are dunes: {low} to {high} m");
    for (format, map) in &maps {
        let allowed =
            if matches!(format, HeightFormat::R32 | HeightFormat::Exr) { 0.0 } else { (high - low) / 65535.0 };
        let worst = map.heights_m.iter().zip(&exact.heights_m).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(worst <= allowed, "{format:?}: {worst} m of {allowed} m");
    }
}

#[test]
fn tiles_have_one_sample_more_than_cells_and_share_their_borders() {
    let place = place();
    heightmap(&place, &["-o", "t.r16", "--tiles", "2x4", "--maps", "sand"]).succeeded();
    let described = sidecar(&place, "t.json");
    assert_eq!(
        (&described["width"], &described["height"], &described["borders"]),
        (&33.into(), &17.into(), &"shared".into()),
        "{described}"
    );
    assert_eq!(described["layers"][0]["files"].as_array().map(Vec::len), Some(8), "two columns, four rows");
    // R16 tiles of other sides than squares are not read back, so look at the bytes: 33 samples of two bytes a row.
    let row = |x: usize, y: usize, row: usize| place.read(&format!("t_x{x}_y{y}.r16"))[66 * row..][..66].to_vec();
    for x in 0..2 {
        for y in 0..4 {
            assert_eq!(
                row(x, y, 16),
                row(x, (y + 1) % 4, 0),
                "the southern border of tile {x}, {y}, also around the field"
            );
            for line in 0..17 {
                let (west, east) = (row(x, y, line), row((x + 1) % 2, y, line));
                assert_eq!(west[64..], east[..2], "the eastern border of tile {x}, {y}, line {line}");
            }
        }
    }
    assert!(place.files().contains(&"t-sand_x1_y3.r16".to_owned()), "maps are cut too: {:?}", place.files());
    heightmap(&place, &["-o", "one.r32", "--shared-edge"]).succeeded();
    assert_eq!(read(&place, "one.r32", &sidecar(&place, "one.json")).size_px, [65, 65], "one more");
}

#[test]
fn normals_are_within_half_a_degree_of_the_differences_of_heights() {
    let place = place();
    heightmap(&place, &["-o", "d.r32", "--maps", "normal"]).succeeded();
    let heights = read(&place, "d.r32", &sidecar(&place, "d.json")).heights_m;
    let normals = image::load_from_memory(&place.read("d-normal.png")).unwrap();
    let normals = normals.as_rgb16().expect("three channels of 16 bits").clone().into_raw();
    let parts: Vec<f64> = normals.into_iter().map(|part| f64::from(part) / 32767.5 - 1.0).collect();
    let at = |x: usize, y: usize| f64::from(heights[(y % 64) * 64 + x % 64]);
    let mut worst_deg = 0.0_f64;
    for y in 0..64 {
        for x in 0..64 {
            let (dx, dy) = ((at(x + 1, y) - at(x + 63, y)) / 4.0, (at(x, y + 1) - at(x, y + 63)) / 4.0);
            let [nx, ny, nz] = [0, 1, 2].map(|part| parts[3 * ((63 - y) * 64 + x) + part]);
            let cosine = (nz - nx * dx - ny * dy) / ((1.0 + dx * dx + dy * dy) * (nx * nx + ny * ny + nz * nz)).sqrt();
            worst_deg = worst_deg.max((2.0 * (1.0 - cosine).max(0.0)).sqrt().to_degrees());
        }
    }
    assert!(worst_deg < 0.5, "{worst_deg} degrees");
}

#[test]
fn all_maps_and_the_mesh_are_written_and_described() {
    let place = place();
    heightmap(&place, &["-o", "d.glb", "--maps", "all", "--set", "dune_plants.enabled=true"]).succeeded();
    let described = sidecar(&place, "d.json");
    let layers = described["layers"].as_array().unwrap();
    let names: Vec<&str> = layers.iter().filter_map(|layer| layer["name"].as_str()).collect();
    let all = ["height", "normal", "ripples", "sand", "age", "slip-face", "lee", "sun", "sky", "plants"];
    assert_eq!(names, all, "every layer");
    for layer in layers {
        let file = layer["files"][0]["file"].as_str().expect("a file");
        assert!(place.files().contains(&file.to_owned()), "{file} is there");
    }
    assert_eq!(place.files().len(), all.len() + 2, "and nothing else but sidecar and scene: {:?}", place.files());
    assert_eq!(&place.read("d.glb")[..4], b"glTF", "a mesh");
    let age = &layers[4];
    assert!(age["unit"] == "steps" && age["range"][0] == 0.0, "some cells have moved just now: {age}");
}

#[test]
fn a_state_in_place_of_the_beginning_gives_the_same_heights() {
    let place = place();
    place.run(&["simulate", "sand.toml", "--steps", "70", "-o", "s.npz"]).succeeded();
    heightmap(&place, &["-o", "from.r32", "--state", "s.npz"]).succeeded();
    heightmap(&place, &["-o", "whole.r32"]).succeeded();
    assert!(place.read("from.r32") == place.read("whole.r32"), "150 steps either way");
    place.run(&["simulate", "sand.toml", "--steps", "160", "-o", "s.npz"]).succeeded();
    heightmap(&place, &["-o", "later.r32", "--state", "s.npz"]).succeeded();
    assert_eq!(sidecar(&place, "later.json")["step"], 160, "a state that is further is shown as it is");
}

#[test]
fn terrain_that_was_exported_is_terrain_again() {
    let place = place();
    for name in ["rock.exr", "rock.png", "rock.r32"] {
        heightmap(&place, &["-o", name]).succeeded();
        let terrain = format!("desert.terrain={name}");
        let words = ["--set", &terrain, "--set", "dunes.sand_cells=0", "--set", "desert.steps=0", "-o", "again.r32"];
        heightmap(&place, &words).succeeded();
        let described = sidecar(&place, "again.json");
        let again = read(&place, "again.r32", &described).heights_m;
        let rock = read(&place, name, &described).heights_m;
        let low = rock.iter().copied().fold(f32::MAX, f32::min);
        // A quantum of the field is 1/256 of a cell of 2 m.
        let worst = again.iter().zip(&rock).map(|(a, b)| (a - (b - low)).abs()).fold(0.0, f32::max);
        assert!(worst <= 1.01 / 256.0, "{name}: {worst} m");
    }
}

#[test]
fn what_cannot_be_written_is_refused_and_leaves_nothing() {
    let place = place();
    let refused = |words: &[&str], part: &str| heightmap(&place, words).refused(2, part);
    refused(&["-o", "a.tif"], "must be .png, .exr, .r16, .r32 or .glb");
    refused(&["-o", "nowhere/a.png"], "the folder nowhere does not exist");
    refused(&["-o", "a.png", "--tiles", "3x1"], "number of tile columns, which divides the width, = 3");
    refused(&["-o", "a.png", "--tiles", "0x1"], "at least one column");
    refused(&["-o", "a.glb", "--tiles", "2x2"], "a mesh is in one piece");
    refused(&["-o", "a.png", "--maps", "colour"], "colour");
    refused(&["-o", "a.png", "--set", "desert.kind=none"], "the scene has no desert");
    refused(&["-o", "a.png", "--state", "sand.toml"], "sand.toml: this is no NPZ file");
    assert_eq!(place.files(), ["sand.toml"], "nothing half-written");
}

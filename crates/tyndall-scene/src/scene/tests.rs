//! Laws of reaching parameters by path, and of the hash.

use super::*;
use crate::{SunPosition, ToneMap};

#[test]
fn every_default_is_allowed_and_a_new_scene_passes_its_check() {
    Scene::default().check().unwrap();
}

#[test]
fn every_parameter_is_read_and_set_by_its_path() {
    let mut scene = Scene::default();
    let paths: Vec<_> =
        scene.groups().iter().flat_map(|(group, set)| set.info().iter().map(move |info| (*group, info))).collect();
    for (group, info) in paths {
        let path = format!("{group}.{}", info.name);
        for value in [*info.range.start(), *info.range.end(), info.default] {
            scene.set(&path, value).unwrap();
            assert_eq!(scene.get(&path).unwrap().to_bits(), value.to_bits(), "{path} after it was set to {value}");
            scene.set_text(&path, &info.format(value)).unwrap();
            assert_eq!(scene.get(&path).unwrap().to_bits(), value.to_bits(), "{path} after {}", info.format(value));
        }
    }
    assert_eq!(scene, Scene::default(), "all at their defaults again");
}

#[test]
fn both_lists_of_groups_have_the_same_names_in_the_same_order() {
    let mut scene = Scene::default();
    let names = scene.groups().map(|(name, _)| name);
    assert_eq!(
        names,
        [
            "camera",
            "sun",
            "moon",
            "stars",
            "atmosphere",
            "haze",
            "ground",
            "landscape",
            "clouds",
            "cloud_grid",
            "cloud_vapour",
            "cloud_wind",
            "cloud_matter",
            "desert",
            "dunes",
            "dune_classic",
            "dune_wind",
            "dune_plants",
            "dune_rock",
            "ripples",
            "sand",
            "sky",
            "film",
            "image"
        ],
        "as in scene files"
    );
    assert_eq!(scene.groups_mut().map(|(name, _)| name), names, "mutable");
}

#[test]
fn wrong_paths_are_refused_with_the_nearest_one() {
    let mut scene = Scene::default();
    for (path, message) in [
        ("sun.elevation", "unknown parameter `sun.elevation`; did you mean `sun.elevation_deg`?"),
        ("sum.disc", "unknown group `sum`; did you mean `sun`?"),
        ("elevation_deg", "unknown group `elevation_deg`; did you mean `sun.elevation_deg`?"),
        ("film.width_px", "unknown parameter `film.width_px`; did you mean `image.width_px`?"),
        ("", "unknown group ``"),
        ("sun.", "unknown parameter `sun.`"),
    ] {
        assert_eq!(scene.get(path).unwrap_err().to_string(), message, "get {path:?}");
        assert_eq!(scene.set_text(path, "1").unwrap_err().to_string(), message, "set {path:?}");
    }
}

#[test]
fn refused_values_name_the_whole_path_and_change_nothing() {
    let mut scene = Scene::default();
    let error = scene.set("sun.elevation_deg", f64::NAN).unwrap_err();
    assert_eq!(error.to_string(), "`sun.elevation_deg` = NaN deg is outside -90 to 90 deg", "{error}");
    let error = scene.set_text("film.tone_map", "filmic").unwrap_err();
    assert_eq!(error.to_string(), r#"`film.tone_map` = "filmic" is not one of "agx", "aces", "none""#, "{error}");
    assert_eq!(scene, Scene::default(), "after two refusals");
}

#[test]
fn ozone_above_the_top_is_refused_unless_there_is_none() {
    let mut scene = Scene::default();
    scene.atmosphere.top_altitude_km = 20.0;
    assert!(matches!(scene.check(), Err(SceneError::OzoneAboveTop { .. })), "{:?}", scene.check());
    scene.atmosphere.ozone_du = 0.0;
    scene.check().unwrap();
}

#[test]
fn a_value_written_past_the_setters_is_found_by_the_check() {
    let mut scene = Scene::default();
    scene.camera.altitude_m = f64::INFINITY;
    assert_eq!(scene.check().unwrap_err().field().as_deref(), Some("camera.altitude_m"), "{:?}", scene.check());
}

#[test]
fn any_change_of_a_parameter_changes_the_hash_and_titles_do_not() {
    let base = Scene::default();
    let mut seen = std::collections::HashSet::from([base.hash()]);
    for (group, set) in base.groups() {
        for info in set.info() {
            let mut scene = base.clone();
            let other = if info.default >= *info.range.end() { *info.range.start() } else { *info.range.end() };
            scene.set(&format!("{group}.{}", info.name), other).unwrap();
            assert!(seen.insert(scene.hash()), "{group}.{} does not count", info.name);
        }
    }
    let titled = Scene { title: "T".to_owned(), description: "D".to_owned(), ..base.clone() };
    assert_eq!(titled.hash(), base.hash(), "the picture is the same");
}

#[test]
fn zero_and_minus_zero_have_one_hash() {
    let mut scene = Scene::default();
    scene.camera.x_m = -0.0;
    assert_eq!(scene.hash(), Scene::default().hash(), "equal scenes");
}

#[test]
fn the_hash_is_shown_as_hexadecimal_of_any_length() {
    let hash = Scene::default().hash();
    let long = hash.to_string();
    assert_eq!(long.len(), 64, "{long}");
    assert!(long.bytes().all(|byte| byte.is_ascii_hexdigit()), "{long}");
    assert_eq!(format!("{hash:.16}"), long[..16], "{hash:.16}");
}

#[test]
fn choices_travel_as_names_and_toggles_as_words() {
    let mut scene = Scene::default();
    scene.set_text("sun.position", "date").unwrap();
    scene.set_text("film.tone_map", "aces").unwrap();
    scene.set_text("sun.disc", "off").unwrap();
    let found = (scene.sun.position, scene.film.tone_map, scene.sun.disc);
    assert_eq!(found, (SunPosition::Date, ToneMap::Aces, false), "{found:?}");
}

#[test]
fn the_thickest_haze_ends_below_the_lowest_top_of_an_atmosphere() {
    let largest = |path: &str| *Scene::default().info(path).expect("a parameter").range.end();
    let lowest_top_m = 1e3 * *Scene::default().info("atmosphere.top_altitude_km").expect("a parameter").range.start();
    let above_m = lowest_top_m - largest("haze.top_m");
    let left = (-above_m / largest("haze.scale_height_m")).exp();
    // The light transport ends every medium there.
    assert!(left < 0.01, "{left}");
}

#[test]
fn a_visibility_beyond_that_of_pure_air_is_refused() {
    let mut scene = Scene::default();
    scene.atmosphere.aerosol_visibility_km = 300.0;
    scene.atmosphere.air_density = 2.0;
    assert!(scene.check().is_ok(), "another number says how much aerosol there is");
    scene.atmosphere.aerosol_input = AerosolInput::Visibility;
    let message = scene.check().unwrap_err().to_string();
    assert!(message.contains("aerosol_visibility_km` = 300 km") && message.contains("161 km"), "{message}");
}

#[test]
fn clouds_of_more_cells_than_a_picture_takes_are_refused_and_none_are_not() {
    let mut scene = Scene::default();
    (scene.cloud_grid.cells_east, scene.cloud_grid.cells_north) = (2048, 2048);
    assert!(scene.check().is_ok() && scene.cloud_params().is_none(), "without clouds it does not matter");
    scene.clouds.kind = CloudKind::Automaton;
    let error = scene.check().unwrap_err();
    assert!(error.to_string().contains("2048 x 2048 x 32 cells is more than 67108864"), "{error}");
    assert_eq!(error.field().as_deref(), Some("cloud_grid.cells_east"), "the first to lower");
    scene.cloud_grid.cells_east = 1024;
    assert!(scene.check().is_ok() && scene.cloud_params().is_some(), "just as many as allowed");
}

#[test]
fn an_orthographic_camera_before_a_landscape_is_refused_and_a_black_sky_has_no_air() {
    let mut scene = Scene::default();
    scene.set_text("camera.projection", "orthographic").unwrap();
    scene.check().unwrap();
    scene.set_text("landscape.kind", "hills").unwrap();
    let refused = scene.check().unwrap_err();
    assert_eq!(refused.field().as_deref(), Some("camera.projection"), "{refused}");
    let mut scene = Scene::default();
    scene.set_text("sky.kind", "black").unwrap();
    let black = scene.grounded();
    let air = &black.atmosphere;
    assert!((air.air_density + air.aerosol_optical_depth + air.ozone_du).abs() < 1e-12, "nothing that scatters");
    assert!(scene.atmosphere.air_density > 0.0, "the scene itself keeps its air");
}

#[test]
fn a_desert_where_something_else_stands_and_before_an_orthographic_camera_is_refused() {
    let mut scene = Scene::default();
    assert!(scene.dune_params().is_none(), "no desert unless it is asked for");
    scene.set_text("desert.kind", "dunes").unwrap();
    scene.check().unwrap();
    assert_eq!(scene.dune_params(), Some(DesertParams::default()), "all groups together");
    scene.set_text("landscape.kind", "hills").unwrap();
    let refused = scene.check().unwrap_err();
    assert!(refused.to_string().contains("`landscape.kind` = \"hills\" are two grounds"), "{refused}");
    assert_eq!(refused.field().as_deref(), Some("desert.kind"), "where to change it");
    scene.set_text("landscape.kind", "none").unwrap();
    scene.set_text("camera.projection", "orthographic").unwrap();
    assert_eq!(scene.check().unwrap_err().field().as_deref(), Some("camera.projection"), "one direction of view");
}

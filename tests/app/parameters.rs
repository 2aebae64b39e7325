//! Every parameter of the scene, walked through its declaration: found by role and name, set, seen, undone.

use egui::{Key, Modifiers, accesskit::Role};
use egui_kittest::kittest::Queryable as _;
use tyndall_app::input_name;
use tyndall_core::{ParamInfo, ParamKind, Scale};
use tyndall_scene::Scene;

use crate::harness::{Program, click, picture, press, quick_scene, rest, run, set_slider, start_with_scene};
use crate::preconditions::{self, Precondition};

/// Usual step: a factor on logarithmic scales, a share of the range on linear ones. Odd, so that nothing periodic (tiles
/// of the ground, turns of the compass) hides it.
const LOG_STEP: f64 = 1.7;
const LINEAR_STEP: f64 = 0.063713;

#[test]
fn every_parameter_is_tried_in_exactly_one_precondition() {
    let tried: Vec<_> = preconditions::ALL.iter().flat_map(|p| p.parameters).map(|(path, _)| *path).collect();
    let scene = Scene::default();
    let groups = scene.groups();
    let declared = groups.iter().flat_map(|(group, set)| set.info().iter().map(move |info| (*group, info.name)));
    let paths: Vec<_> = declared.map(|(group, name)| format!("{group}.{name}")).collect();
    for path in &paths {
        let times = tried.iter().filter(|tried| *tried == path).count();
        assert_eq!(times, 1, "{path} stands in preconditions.rs {times} times");
    }
    assert_eq!(tried.len(), paths.len(), "preconditions.rs names a parameter that does not exist");
}

#[test]
fn every_parameter_of_a_clear_day_changes_the_picture_and_is_undone_to_the_byte() {
    assert_eq!(walk(&preconditions::ALL[0]), Vec::<String>::new(), "nothing is wrong");
}

#[test]
fn every_parameter_of_air_and_sky_changes_the_picture_and_is_undone_to_the_byte() {
    assert_eq!(walk(&preconditions::ALL[1]), Vec::<String>::new(), "nothing is wrong");
}

#[test]
fn every_other_parameter_changes_the_picture_and_is_undone_to_the_byte() {
    let wrong: Vec<_> = preconditions::ALL[2..].iter().flat_map(walk).collect();
    assert_eq!(wrong, Vec::<String>::new(), "nothing is wrong");
}

#[test]
fn a_parameter_without_effect_is_disabled() {
    let program = start_with_scene(quick_scene());
    for (name, enabled) in [("sun: Elevation", true), ("sun: Latitude", false), ("film: EV100", false)] {
        let node = program.get_by_role_and_label(Role::Slider, name);
        assert_eq!(!egui_kittest::kittest::NodeT::accesskit_node(&node).is_disabled(), enabled, "{name}");
    }
}

#[test]
fn reset_buttons_give_the_defaults_back() {
    let mut program = start_with_scene(quick_scene());
    set_slider(&mut program, "sun: Elevation", 5.0);
    set_slider(&mut program, "sun: Azimuth", 50.0);
    click(&mut program, "Reset sun: Elevation");
    let sun = &program.state().scene().sun;
    assert!((sun.elevation_deg - 35.0).abs() < 1e-9 && (sun.azimuth_deg - 50.0).abs() < 1e-9, "one of two: {sun:?}");
    click(&mut program, "Reset group sun");
    assert_eq!(program.state().scene().sun, Scene::default().sun, "the whole group");
    set_slider(&mut program, "ground: Red", 0.9);
    press(&mut program, Modifiers::NONE, Key::R);
    assert_eq!(program.state().scene(), &Scene::default(), "everything, by Ctrl+R");
}

#[test]
fn the_search_field_leaves_what_it_finds() {
    let mut program = start_with_scene(quick_scene());
    let search = program.get_by_label("Search parameters");
    search.focus();
    search.type_text("ozone");
    program.run();
    assert!(program.query_by_role_and_label(Role::Slider, "atmosphere: Ozone altitude").is_some(), "found");
    assert!(program.query_by_role_and_label(Role::Slider, "sun: Elevation").is_none(), "left out");
}

/// What is wrong with the parameters of a precondition, all tried in one program, as undoing each must lead back anyway.
fn walk(precondition: &Precondition) -> Vec<String> {
    let mut scene = Scene::default();
    (precondition.prepare)(&mut scene);
    let mut program = start_with_scene(scene.clone());
    rest(&mut program);
    let mut wrong = Vec::new();
    for (path, value) in precondition.parameters {
        if let Err(what) = try_one(&mut program, &scene, path, *value) {
            wrong.push(format!("{}: {path}: {what}", precondition.name));
        }
    }
    wrong
}

fn try_one(program: &mut Program, scene: &Scene, path: &str, value: Option<f64>) -> Result<(), String> {
    let (group, name) = path.split_once('.').ok_or("no path")?;
    let group_names = scene.groups();
    let (_, set) = group_names.iter().find(|(known, _)| *known == group).ok_or("no such group")?;
    let index = set.position(name).map_err(|error| error.to_string())?;
    let (info, old) = (&set.info()[index], set.get(index));
    let wanted = value.unwrap_or_else(|| other_value(info, old));
    if group == "image" {
        click(program, "Export");
    }
    let (before, export_before) = (picture(program), program.state().export_size_px());

    set_by_name(program, &input_name(group, info), info, wanted);
    rest(program);
    let found = program.state().scene().get(path).map_err(|error| error.to_string())?;
    check((found - wanted).abs() <= 1e-9 * wanted.abs(), || format!("set to {wanted}, found {found}"))?;
    let (after, export_after) = (picture(program), program.state().export_size_px());
    check(after.0 == before.0, || "the picture has another size".to_owned())?;
    let changed = after.1.iter().zip(&before.1).filter(|(a, b)| a != b).count();
    if group == "image" {
        check(changed == 0 && export_before != export_after, || format!("{export_before:?} to {export_after:?}"))?;
    } else {
        check(changed > 0, || format!("{old} to {wanted} changes no pixel"))?;
    }

    press(program, Modifiers::NONE, Key::Z);
    rest(program);
    check(program.state().scene() == scene, || "undo leads to another scene".to_owned())?;
    check(picture(program) == before, || "undo leads to other bytes".to_owned())
}

/// Sets a parameter through its accessible input.
fn set_by_name(program: &mut Program, name: &str, info: &ParamInfo, value: f64) {
    match info.kind {
        ParamKind::Real | ParamKind::Integer => set_slider(program, name, value),
        ParamKind::Toggle => {
            program.get_by_role_and_label(Role::CheckBox, name).click_accesskit();
            run(program);
        }
        ParamKind::Choice(_) => {
            program.get_by_role_and_label(Role::ComboBox, name).click_accesskit();
            run(program);
            program.get_by_label(&format!("{name} = {}", info.format(value))).click_accesskit();
            run(program);
        }
    }
}

/// A value beside the old one, within the range.
fn other_value(info: &ParamInfo, old: f64) -> f64 {
    let (low, high) = (*info.range.start(), *info.range.end());
    let (up, down) = match (info.kind, info.scale) {
        (ParamKind::Toggle | ParamKind::Choice(_), _) => (old + 1.0, old - 1.0),
        (_, Scale::Log) => (old * LOG_STEP, old / LOG_STEP),
        (_, Scale::Linear) => (old + (high - low) * LINEAR_STEP, old - (high - low) * LINEAR_STEP),
    };
    let value = if up <= high { up } else { down.max(low) };
    if info.kind == ParamKind::Integer { value.round() } else { value }
}

fn check(holds: bool, what: impl FnOnce() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(what()) }
}

//! The panel of the desert: play, presets, budget, brushes, winds, and a window that never waits for a simulation.

use egui::{Event, Key, Modifiers, PointerButton, accesskit::Role, vec2};
use egui_kittest::kittest::Queryable as _;
use tyndall_scene::{DesertKind, Scene, Side};

use crate::harness::{Program, click, picture, press, quick_scene, rest, run, set_slider, start_with_scene};

/// A small field of dunes, with the panel.
fn start(change: impl FnOnce(&mut Scene)) -> Program {
    let mut scene = quick_scene();
    scene.desert.kind = DesertKind::Dunes;
    (scene.desert.steps, scene.desert.ripple_steps, scene.dunes.side) = (40, 40, Side::Cells64);
    scene.ripples.side = Side::Cells64;
    (scene.camera.altitude_m, scene.camera.pitch_deg) = (12.0, -30.0);
    change(&mut scene);
    let mut program = start_with_scene(scene);
    click(&mut program, "Desert");
    program
}

fn steps(program: &Program) -> u32 {
    program.state().scene().desert.steps
}

#[test]
fn the_desert_plays_steps_and_goes_back_to_the_start() {
    let mut program = start(|_| ());
    click(&mut program, "Desert: step");
    assert_eq!(steps(&program), 41, "one step");
    program.get_by_role_and_label(Role::Button, "Desert: play").click_accesskit();
    for _try in 0..200 {
        program.step();
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    program.get_by_role_and_label(Role::Button, "Desert: pause").click_accesskit();
    program.run_steps(3);
    let paused = steps(&program);
    assert!(paused > 43, "step {paused}");
    rest(&mut program);
    assert_eq!(steps(&program), paused, "stopped");
    press(&mut program, Modifiers::NONE, Key::Z);
    assert!(steps(&program) <= 41, "playing is undone in one step: {}", steps(&program));
    let later = picture(&program);
    click(&mut program, "Desert: back to start");
    rest(&mut program);
    assert_eq!(steps(&program), 0, "the start");
    assert!(picture(&program) != later, "level sand");
}

#[test]
fn a_kind_of_desert_is_a_click_away_and_its_budget_is_exact() {
    let mut program = start(|scene| scene.desert.kind = DesertKind::None);
    let bare = picture(&program);
    assert!(program.query_by_label_contains("There is no desert").is_some(), "said in words");
    click(&mut program, "Desert: nebkha");
    rest(&mut program);
    assert!(program.state().scene().dune_plants.enabled, "plants grow");
    assert!(picture(&program) != bare, "there is sand");
    assert!(program.query_by_label("exact").is_some(), "not a grain is lost");
    let seed = program.state().scene().dunes.seed;
    click(&mut program, "Desert: another seed");
    rest(&mut program);
    assert_ne!(program.state().scene().dunes.seed, seed, "another one");
}

#[test]
fn a_brush_digs_in_the_view_and_undo_brings_the_sand_back() {
    let mut program = start(|_| ());
    rest(&mut program);
    let before = picture(&program);
    let camera = program.state().scene().camera.clone();
    click(&mut program, "Desert: brush dig");
    set_slider(&mut program, "Desert: depth of the brush", 3.0);
    let middle = program.get_by_role_and_label(Role::Image, "Viewport").rect().center();
    drag(&mut program, middle, middle + vec2(40.0, 10.0));
    rest(&mut program);
    let strokes = program.state().scene().desert.strokes.clone();
    assert!(strokes.starts_with("40 dig 8 3 "), "kept in the scene: {strokes:?}");
    assert_eq!(program.state().scene().camera, camera, "the view has not turned");
    assert!(picture(&program) != before, "a pit");
    assert!(program.query_by_label("exact").is_some(), "the ledger has it");
    press(&mut program, Modifiers::NONE, Key::Z);
    rest(&mut program);
    assert!(program.state().scene().desert.strokes.is_empty(), "the stroke is undone");
    assert!(picture(&program) == before, "as before");
}

#[test]
fn winds_are_added_pulled_and_taken_away() {
    let mut program = start(|_| ());
    click(&mut program, "Desert: add a wind");
    assert_eq!(program.state().scene().desert.winds, "0 1; 180 1", "in the widest gap");
    program.get_by_label("Desert: wind rose").scroll_to_me();
    run(&mut program);
    let rose = program.get_by_label("Desert: wind rose").rect();
    let tip = rose.center() - vec2(0.42 * rose.width(), 0.0);
    drag(&mut program, tip, rose.center() - vec2(0.0, 0.21 * rose.width()));
    rest(&mut program);
    assert_eq!(program.state().scene().desert.winds, "0 1; 90 0.5", "to the north, half as strong");
    click(&mut program, "Desert: remove a wind");
    assert!(program.state().scene().desert.winds.is_empty(), "one wind needs no list");
}

#[test]
fn the_window_does_not_wait_for_the_sand() {
    let mut program = start(|_| ());
    rest(&mut program);
    let before = picture(&program);
    program.get_by_role_and_label(Role::Slider, "desert: Steps").set_value_accesskit(3000.0);
    program.run_steps(2);
    assert!(program.state().is_busy(), "3000 steps take longer than two frames");
    run(&mut program);
    assert!(picture(&program) != before, "the new dunes came");
}

/// Presses, moves and lets go.
fn drag(program: &mut Program, from: egui::Pos2, to: egui::Pos2) {
    let button = |pos, pressed| Event::PointerButton {
        pos,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    program.hover_at(from);
    program.step();
    program.event(button(from, true));
    program.step();
    for share in [0.3, 0.6, 0.9, 1.0] {
        program.hover_at(from + share * (to - from));
        program.step();
    }
    program.event(button(to, false));
    program.step();
}

//! The panel of the clouds: play, presets, figures, paint, bubbles, and a window that never waits for a simulation.

use egui::{Event, Key, Modifiers, PointerButton, accesskit::Role, vec2};
use egui_kittest::kittest::Queryable as _;
use tyndall_scene::{CloudKind, Scene};

use crate::harness::{Program, click, picture, press, quick_scene, rest, run, set_slider, start_with_scene};

/// A small sky of clouds, with the panel.
fn start(change: impl FnOnce(&mut Scene)) -> Program {
    let mut scene = quick_scene();
    scene.clouds.kind = CloudKind::Automaton;
    scene.camera.pitch_deg = 40.0;
    let grid = &mut scene.cloud_grid;
    (grid.cells_east, grid.cells_north, grid.cells_up, grid.warm_up_steps) = (32, 32, 16, 20);
    change(&mut scene);
    let mut program = start_with_scene(scene);
    click(&mut program, "Clouds");
    program
}

/// Clicks and shows a few frames: while clouds play the window never rests.
fn click_without_waiting(program: &mut Program, name: &str) {
    program.get_by_role_and_label(Role::Button, name).click_accesskit();
    program.run_steps(3);
}

fn time_s(program: &Program) -> f64 {
    program.state().scene().clouds.time_s
}

#[test]
fn clouds_play_step_and_go_back_to_the_start() {
    let mut program = start(|_| ());
    click(&mut program, "Clouds: step");
    assert!((time_s(&program) - 20.0).abs() < 1e-9, "one step: {} s", time_s(&program));
    click_without_waiting(&mut program, "Clouds: play");
    for _try in 0..200 {
        program.step();
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    click_without_waiting(&mut program, "Clouds: pause");
    let paused_s = time_s(&program);
    assert!(paused_s > 40.0, "{paused_s} s");
    rest(&mut program);
    assert!((time_s(&program) - paused_s).abs() < 1e-12, "stopped at {paused_s} s");
    press(&mut program, Modifiers::NONE, Key::Z);
    assert!(time_s(&program) < 20.5, "playing is undone in one step: {} s", time_s(&program));
    click(&mut program, "Clouds: back to start");
    assert!(time_s(&program).abs() < 1e-12, "{} s", time_s(&program));
}

#[test]
fn a_kind_of_sky_and_a_seed_are_a_click_away_and_the_figures_tell_of_them() {
    let mut program = start(|scene| scene.clouds.kind = CloudKind::None);
    let bare = picture(&program);
    assert!(program.query_by_label_contains("There are no clouds in this scene").is_some(), "said in words");
    click(&mut program, "Vapour: sea-of-clouds");
    rest(&mut program);
    let sea = picture(&program);
    assert!(sea != bare, "there are clouds now");
    assert!(program.query_by_label_contains("32 768, ").is_some(), "cells and balls are counted");
    assert!(program.query_by_label_contains("Humid cells: 0.").is_some(), "humidity is shown");
    let seed = program.state().scene().cloud_grid.seed;
    click(&mut program, "Clouds: another seed");
    rest(&mut program);
    assert_ne!(program.state().scene().cloud_grid.seed, seed, "another one");
    assert!(picture(&program) != sea, "another sky");
}

#[test]
fn paint_is_put_on_the_map_and_undone_in_one_step() {
    let mut program = start(|scene| {
        scene.cloud_vapour.cover = 0.0;
        scene.cloud_wind.floor_speed_m_s = 0.0;
        scene.cloud_wind.ceiling_speed_m_s = 0.0;
    });
    rest(&mut program);
    let bare = picture(&program);
    click(&mut program, "Clouds: paint vapour");
    set_slider(&mut program, "Clouds: strength of the brush", 10.0);
    set_slider(&mut program, "Clouds: radius of the brush", 2000.0);
    let map = program.get_by_label("Map of the vapour");
    map.scroll_to_me();
    run(&mut program);
    let rect = program.get_by_label("Map of the vapour").rect();
    drag(&mut program, rect.center(), rect.center() + vec2(10.0, 5.0));
    rest(&mut program);
    assert!(!program.state().scene().cloud_vapour.painted.is_empty(), "kept in the scene");
    assert!(picture(&program) != bare, "clouds where there were none");
    press(&mut program, Modifiers::NONE, Key::Z);
    rest(&mut program);
    assert!(program.state().scene().cloud_vapour.painted.is_empty(), "the stroke is undone");
    assert!(picture(&program) == bare, "as before");
}

#[test]
fn a_bubble_is_moved_by_its_handle_in_the_view() {
    let mut program = start(|scene| {
        scene.cloud_vapour.ellipsoids = "0 1500 0 300 300 400".to_owned();
        scene.cloud_wind.floor_speed_m_s = 0.0;
        scene.cloud_wind.ceiling_speed_m_s = 0.0;
        scene.cloud_grid.cells_east = 96;
        scene.cloud_grid.cells_north = 96;
    });
    click(&mut program, "Clouds: move bubbles");
    let middle = program.get_by_label("Bubble 1: middle").rect().center();
    drag(&mut program, middle, middle + vec2(40.0, 0.0));
    rest(&mut program);
    let list = program.state().scene().cloud_vapour.ellipsoids.clone();
    let east: f64 = list.split_whitespace().next().and_then(|word| word.parse().ok()).expect("a number");
    assert!(east > 100.0, "to the east: {list}");
    assert_eq!(program.state().scene().camera, start_camera(), "the view has not turned");
}

fn start_camera() -> tyndall_scene::CameraParams {
    let mut camera = quick_scene().camera;
    camera.pitch_deg = 40.0;
    camera
}

#[test]
fn the_window_does_not_wait_for_a_simulation() {
    let mut program = start(|_| ());
    rest(&mut program);
    let before = picture(&program);
    let slider = program.get_by_role_and_label(Role::Slider, "cloud_grid: Warm up steps");
    slider.set_value_accesskit(10_000.0);
    program.run_steps(2);
    assert!(program.state().is_busy(), "10000 steps take longer than two frames");
    assert!(picture(&program) == before, "the clouds before are shown meanwhile");
    run(&mut program);
    assert!(picture(&program) != before, "the new ones came");
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
    for share in [0.4, 0.8, 1.0] {
        program.hover_at(from + share * (to - from));
        program.step();
    }
    program.event(button(to, false));
    program.step();
}

//! The camera under pointer and keys.

use egui::{Event, Key, MouseWheelUnit, PointerButton, Vec2, accesskit::Role, vec2};
use egui_kittest::kittest::Queryable as _;
use tyndall_scene::CameraParams;

use crate::harness::{Program, click, picture, quick_scene, rest, start_with_scene};

fn camera(program: &Program) -> CameraParams {
    program.state().scene().camera.clone()
}

fn middle(program: &Program) -> egui::Pos2 {
    program.get_by_role_and_label(Role::Image, "Viewport").rect().center()
}

/// Drags in the viewport and returns before the button is released.
fn start_drag(program: &mut Program, button: PointerButton, way: Vec2) -> egui::Pos2 {
    let start = middle(program);
    program.hover_at(start);
    program.event(pointer(start, button, true));
    program.step();
    for share in [0.5, 1.0] {
        program.hover_at(start + way * share);
        program.step();
    }
    start + way
}

fn pointer(pos: egui::Pos2, button: PointerButton, pressed: bool) -> Event {
    Event::PointerButton { pos, button, pressed, modifiers: egui::Modifiers::NONE }
}

#[test]
fn dragging_turns_the_view_with_a_preview_and_refines_it_at_rest() {
    let mut program = start_with_scene(quick_scene());
    let (full, before) = (picture(&program).0, camera(&program));
    let end = start_drag(&mut program, PointerButton::Primary, vec2(-60.0, 20.0));
    let turned = camera(&program);
    assert!(turned.heading_deg > before.heading_deg && turned.pitch_deg > before.pitch_deg, "{turned:?}");
    assert!((turned.x_m - before.x_m).abs() < 1e-12, "the camera has not moved: {turned:?}");
    program.event(pointer(end, PointerButton::Primary, false));
    rest(&mut program);
    assert_eq!(picture(&program).0, full, "full resolution at rest");
    assert_eq!(camera(&program), turned, "letting go changes nothing");
}

#[test]
fn dragging_with_the_middle_button_orbits() {
    let mut program = start_with_scene(quick_scene());
    let before = camera(&program);
    start_drag(&mut program, PointerButton::Middle, vec2(50.0, 0.0));
    let moved = camera(&program);
    assert!((moved.x_m - before.x_m).hypot(moved.y_m - before.y_m) > 1.0, "{moved:?}");
}

#[test]
fn the_wheel_changes_the_field_of_view() {
    let mut program = start_with_scene(quick_scene());
    let centre = middle(&program);
    program.hover_at(centre);
    program.event(Event::MouseWheel {
        unit: MouseWheelUnit::Point,
        delta: vec2(0.0, 100.0),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Wheel,
        modifiers: egui::Modifiers::NONE,
    });
    program.run_steps(8);
    assert!(camera(&program).field_of_view_deg < 55.0, "{:?}", camera(&program));
}

#[test]
fn keys_fly_the_camera_while_they_are_held() {
    let mut program = start_with_scene(quick_scene());
    let centre = middle(&program);
    program.hover_at(centre);
    program.key_down(Key::E);
    program.step();
    program.step();
    program.key_up(Key::E);
    program.step();
    let risen_m = camera(&program).altitude_m;
    assert!(risen_m > 2.5, "{risen_m} m");
    program.run_steps(3);
    assert!((camera(&program).altitude_m - risen_m).abs() < 1e-12, "the key is up: {:?}", camera(&program));
}

#[test]
fn buttons_turn_the_camera_to_what_they_name() {
    let mut program = start_with_scene(quick_scene());
    for (name, heading_deg, pitch_deg) in [("East", 90.0, 10.0), ("Sun", 0.0, 35.0), ("Zenith", 0.0, 90.0)] {
        click(&mut program, name);
        let CameraParams { heading_deg: heading, pitch_deg: pitch, .. } = camera(&program);
        assert!((heading - heading_deg).abs() < 1e-9 && (pitch - pitch_deg).abs() < 1e-9, "{name}: {heading} {pitch}");
    }
}

//! Date, time and place: the dial, the calendar, places and the time-lapse.

use egui::{Event, Key, Modifiers, PointerButton, accesskit::Role, vec2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use tyndall_scene::{Scene, SunParams, SunPosition};

use crate::harness::{Program, click, picture, press, quick_scene, rest, run, start_with_scene, type_into};

const DIAL: &str = "Time of day";

/// The program with the panel, on a day of June in Greenwich.
fn start() -> Program {
    let mut program =
        start_with_scene(Scene { sun: SunParams { time_h: 12.0, ..SunParams::default() }, ..quick_scene() });
    click(&mut program, "Date and place");
    program
}

fn sun(program: &Program) -> SunParams {
    program.state().scene().sun.clone()
}

fn set_time(program: &mut Program, time_h: f64) {
    program.get_by_role_and_label(Role::Slider, DIAL).set_value_accesskit(time_h);
    run(program);
}

#[test]
fn the_dial_moves_the_sun_and_lets_it_follow_the_date() {
    let mut program = start();
    let before = picture(&program);
    assert_eq!(sun(&program).position, SunPosition::Angles, "a new scene");
    set_time(&mut program, 21.5);
    rest(&mut program);
    assert!((sun(&program).time_h - 21.5).abs() < 1e-9, "{:?}", sun(&program));
    assert_eq!(sun(&program).position, SunPosition::Date, "the date places the sun now");
    assert!(picture(&program) != before, "another light");
    press(&mut program, Modifiers::NONE, Key::Z);
    assert_eq!(sun(&program).position, SunPosition::Angles, "undone in one step");
}

#[test]
fn dragging_around_the_dial_is_dragging_the_time() {
    let mut program = start();
    let dial = program.get_by_role_and_label(Role::Slider, DIAL).rect();
    let button = |pos, pressed| Event::PointerButton {
        pos,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    let at = |share: egui::Vec2| dial.center() + 0.45 * dial.width() * share;
    program.hover_at(at(vec2(0.0, -1.0)));
    program.event(button(at(vec2(0.0, -1.0)), true));
    program.step();
    program.hover_at(at(vec2(0.7, -0.7)));
    program.step();
    program.hover_at(at(vec2(1.0, 0.0)));
    program.step();
    assert!((sun(&program).time_h - 18.0).abs() < 0.02, "to the right: {:?}", sun(&program));
    program.event(button(at(vec2(1.0, 0.0)), false));
    rest(&mut program);
    assert_eq!(sun(&program).day, 21, "the same day");
}

#[test]
fn keys_move_the_time_over_midnight_into_the_next_day() {
    let mut program = start();
    set_time(&mut program, 23.9);
    program.get_by_role_and_label(Role::Slider, DIAL).focus();
    run(&mut program);
    for (modifiers, key) in [(Modifiers::NONE, Key::ArrowRight), (Modifiers::SHIFT, Key::ArrowRight)] {
        program.key_press_modifiers(modifiers, key);
        run(&mut program);
    }
    let expected_h = 23.9 + 11.0 / 60.0 - 24.0;
    assert!((sun(&program).time_h - expected_h).abs() < 1e-6, "{:?}", sun(&program));
    assert_eq!(sun(&program).day, 22, "after midnight");
}

#[test]
fn the_lights_of_the_day_are_listed_and_can_be_gone_to() {
    let mut program = start();
    click(&mut program, "Sunset");
    // The almanac has 20:21 UT for Greenwich on 21 June.
    assert!((sun(&program).time_h - (20.0 + 21.0 / 60.0)).abs() < 0.03, "{:?}", sun(&program));
    let elevation_deg = program.state().scene().sun_direction().expect("a sun").elevation_rad.to_degrees();
    assert!((elevation_deg + 0.833).abs() < 0.01, "{elevation_deg}");
}

#[test]
fn the_calendar_steps_by_days_and_months() {
    let mut program = start();
    for (name, expected) in
        [("A day later", (6, 22)), ("A month later", (7, 22)), ("A day earlier", (7, 21)), ("A month earlier", (6, 21))]
    {
        click(&mut program, name);
        assert_eq!((sun(&program).month, sun(&program).day), expected, "{name}");
    }
}

#[test]
fn a_place_is_found_by_its_name_and_brings_its_clock() {
    let mut program = start();
    program.get_by_role_and_label(Role::ComboBox, "Place").click_accesskit();
    run(&mut program);
    type_into(&mut program, "Search places", "norway berg");
    assert!(program.query_by_label("Place: Tokyo").is_none(), "only what was searched for");
    program.get_by_label("Place: Bergen").click_accesskit();
    run(&mut program);
    let sun = sun(&program);
    assert!((sun.latitude_deg - 60.39).abs() < 1e-9 && (sun.utc_offset_h - 2.0).abs() < 1e-9, "{sun:?}");
    let place = program.get_by_role_and_label(Role::ComboBox, "Place");
    assert!(format!("{:?}", place.accesskit_node().value()).contains("Bergen"), "the place is named");
}

#[test]
fn the_time_lapse_runs_while_it_plays_and_not_longer() {
    let mut program = start();
    click_without_waiting(&mut program, "Play");
    program.run_steps(4);
    let later_h = sun(&program).time_h;
    assert!(later_h > 12.1, "{later_h} h");
    click_without_waiting(&mut program, "Pause");
    let paused_h = sun(&program).time_h;
    rest(&mut program);
    assert!((sun(&program).time_h - paused_h).abs() < 1e-12, "stopped at {paused_h} h");
}

#[test]
fn now_is_the_present_day() {
    let mut program = start();
    click(&mut program, "Now");
    let days =
        std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).expect("after 1970").as_secs() / 86_400;
    let year = 1970.0 + days as f64 / 365.2425;
    assert!((f64::from(sun(&program).year) - year).abs() < 1.1, "{:?}", sun(&program));
    assert_eq!(sun(&program).position, SunPosition::Date, "the date places the sun");
}

/// Clicks and shows two frames: while time runs the window never rests.
fn click_without_waiting(program: &mut Program, name: &str) {
    program.get_by_role_and_label(Role::Button, name).click_accesskit();
    program.run_steps(2);
}

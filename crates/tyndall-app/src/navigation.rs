//! From pointer and keys to the camera: looking around, orbiting, flying, zooming.

use egui::{Key, PointerButton, Response, Ui, Vec2};
use glam::DVec3;
use tyndall_core::ParamSet as _;
use tyndall_scene::{
    CameraParams, Scene,
    camera::{CameraFrame, look, move_local, orbit},
};

/// Change of the field of view per point of scrolling, as the exponent of a factor.
const ZOOM_PER_POINT: f64 = 0.002;

/// Turn per second by an arrow key, in fields of view.
const TURN_VIEWS_PER_S: f64 = 0.5;

/// Speed of flight at eye level, and its growth with the altitude: higher up there is farther to go.
const SPEED_M_PER_S: f64 = 10.0;
const SPEED_PER_ALTITUDE_PER_S: f64 = 0.5;

/// Factor on the speed while Shift is held.
const FAST: f64 = 10.0;

/// Distance to the point that an orbit goes around when the view does not meet the ground.
const ORBIT_DISTANCE_M: f64 = 100.0;

/// Longest step of a flight; a window that was asleep must not jump.
const MAX_STEP_S: f64 = 0.1;

/// What dragging with the first button does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub(crate) enum DragTool {
    /// Turns the camera where it stands.
    #[default]
    Look,
    /// Moves the camera around what it looks at.
    Orbit,
}

/// A view that a button gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum View {
    North,
    East,
    South,
    West,
    Sun,
    Zenith,
    Horizon,
}

impl View {
    /// Those that turn the heading.
    pub(crate) const HEADINGS: [Self; 4] = [Self::North, Self::East, Self::South, Self::West];
    /// Those that look at something.
    pub(crate) const TARGETS: [Self; 3] = [Self::Sun, Self::Zenith, Self::Horizon];

    /// Text of the button.
    pub(crate) fn label(self) -> &'static str {
        match self {
            Self::North => "North",
            Self::East => "East",
            Self::South => "South",
            Self::West => "West",
            Self::Sun => "Sun",
            Self::Zenith => "Zenith",
            Self::Horizon => "Horizon",
        }
    }

    /// Turns the camera; position and field of view stay.
    pub(crate) fn apply(self, scene: &mut Scene) {
        let sun = scene.sun_direction().ok();
        let camera = &mut scene.camera;
        match (self, sun) {
            (Self::North, _) => camera.heading_deg = 0.0,
            (Self::East, _) => camera.heading_deg = 90.0,
            (Self::South, _) => camera.heading_deg = 180.0,
            (Self::West, _) => camera.heading_deg = 270.0,
            (Self::Zenith, _) => camera.pitch_deg = 90.0,
            (Self::Horizon, _) => (camera.pitch_deg, camera.roll_deg) = (0.0, 0.0),
            (Self::Sun, Some(sun)) => {
                camera.heading_deg = sun.azimuth_rad.to_degrees();
                camera.pitch_deg = sun.elevation_rad.to_degrees();
            }
            (Self::Sun, None) => {}
        }
    }
}

/// Moves the camera as pointer and keys on the viewport say; whether a key holds it in motion.
pub(crate) fn navigate(ui: &Ui, response: &Response, camera: &mut CameraParams, tool: DragTool) -> bool {
    let deg_per_point = camera.field_of_view_deg / f64::from(response.rect.height().max(1.0));
    let drag = response.drag_delta();
    if drag != Vec2::ZERO {
        let (right_deg, up_deg) = (-f64::from(drag.x) * deg_per_point, f64::from(drag.y) * deg_per_point);
        let orbiting = response.dragged_by(PointerButton::Middle)
            || (tool == DragTool::Orbit && response.dragged_by(PointerButton::Primary));
        *camera = if orbiting {
            // The whole height of the view is half a turn.
            let orbit_deg = 180.0 / camera.field_of_view_deg;
            orbit(camera, orbit_target(camera), right_deg * orbit_deg, up_deg * orbit_deg)
        } else {
            look(camera, right_deg, up_deg)
        };
    }
    if response.contains_pointer() {
        zoom(camera, ui.input(|input| f64::from(input.smooth_scroll_delta().y)));
    }
    let keyboard_is_ours = response.has_focus() || response.dragged() || response.contains_pointer();
    keyboard_is_ours && (response.has_focus() || !ui.ctx().text_edit_focused()) && fly(ui, response, camera)
}

/// Where the view meets the ground, if near, or a point ahead.
fn orbit_target(camera: &CameraParams) -> DVec3 {
    let frame = CameraFrame::new(camera);
    let far_m = ORBIT_DISTANCE_M.max(camera.altitude_m * 2.0);
    let to_ground_m = -frame.position.z / frame.forward.z;
    let distance_m = if to_ground_m > 0.0 { to_ground_m.min(far_m) } else { far_m };
    frame.position + frame.forward * distance_m
}

/// Narrows or widens the field of view.
fn zoom(camera: &mut CameraParams, scroll_points: f64) {
    if scroll_points == 0.0 {
        return;
    }
    let wanted_deg = camera.field_of_view_deg * (-scroll_points * ZOOM_PER_POINT).exp();
    let range = camera.position("field_of_view_deg").ok().map(|index| &camera.info()[index].range);
    if let Some(range) = range {
        camera.field_of_view_deg = wanted_deg.clamp(*range.start(), *range.end());
    }
}

/// Moves and turns by keys that are held; whether any is.
fn fly(ui: &Ui, response: &Response, camera: &mut CameraParams) -> bool {
    let focused = response.has_focus();
    let (right, forward, up, turn, tilt, fast, dt_s) = ui.input(|input| {
        let axis = |plus, minus| f64::from(i8::from(input.key_down(plus)) - i8::from(input.key_down(minus)));
        let arrows = |plus, minus| if focused { axis(plus, minus) } else { 0.0 };
        let letters = |plus, minus| if input.modifiers.command { 0.0 } else { axis(plus, minus) };
        (
            letters(Key::D, Key::A),
            letters(Key::W, Key::S),
            letters(Key::E, Key::Q),
            arrows(Key::ArrowRight, Key::ArrowLeft),
            arrows(Key::ArrowUp, Key::ArrowDown),
            input.modifiers.shift,
            f64::from(input.stable_dt).min(MAX_STEP_S),
        )
    });
    let speed = (SPEED_M_PER_S + camera.altitude_m * SPEED_PER_ALTITUDE_PER_S) * if fast { FAST } else { 1.0 };
    let moves = [right, forward, up].iter().any(|axis| *axis != 0.0);
    let turns = [turn, tilt].iter().any(|axis| *axis != 0.0);
    if moves {
        *camera = move_local(camera, right * speed, forward * speed, up * speed, dt_s);
    }
    if turns {
        let turn_deg = camera.field_of_view_deg * TURN_VIEWS_PER_S * dt_s;
        *camera = look(camera, turn * turn_deg, tilt * turn_deg);
    }
    moves || turns
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_view_looks_where_its_name_says() {
        for (view, direction) in [
            (View::North, DVec3::Y),
            (View::East, DVec3::X),
            (View::South, DVec3::NEG_Y),
            (View::West, DVec3::NEG_X),
            (View::Zenith, DVec3::Z),
            (View::Horizon, DVec3::Y),
        ] {
            let mut scene = Scene::default();
            if view != View::Zenith {
                View::Horizon.apply(&mut scene);
            }
            view.apply(&mut scene);
            let forward = CameraFrame::new(&scene.camera).forward;
            assert!(forward.distance(direction) < 1e-12, "{}: {forward}", view.label());
        }
        let mut scene = Scene::default();
        View::Sun.apply(&mut scene);
        let forward = CameraFrame::new(&scene.camera).forward;
        let sun = scene.sun_direction().unwrap().unit();
        assert!(forward.distance(sun) < 1e-12, "{forward}, the sun stands at {sun}");
    }

    #[test]
    fn every_view_is_an_allowed_scene() {
        for view in View::HEADINGS.into_iter().chain(View::TARGETS) {
            let mut scene = Scene::default();
            view.apply(&mut scene);
            assert!(scene.check().is_ok(), "{}: {:?}", view.label(), scene.camera);
        }
    }

    #[test]
    fn zooming_in_and_out_ends_where_it_began_and_stays_within_the_range() {
        let mut camera = CameraParams::default();
        zoom(&mut camera, 120.0);
        assert!(camera.field_of_view_deg < 60.0, "{camera:?}");
        zoom(&mut camera, -120.0);
        assert!((camera.field_of_view_deg - 60.0).abs() < 1e-9, "{camera:?}");
        for scroll_points in [1e5, -1e5] {
            zoom(&mut camera, scroll_points);
            let scene = Scene { camera: camera.clone(), ..Scene::default() };
            assert!(scene.check().is_ok(), "{camera:?}");
        }
    }

    #[test]
    fn an_orbit_goes_around_what_the_camera_sees_of_the_ground() {
        let camera = CameraParams { altitude_m: 10.0, pitch_deg: -45.0, ..CameraParams::default() };
        let target = orbit_target(&camera);
        assert!(target.distance(DVec3::new(0.0, 10.0, 0.0)) < 1e-9, "{target}");
        let up = CameraParams { pitch_deg: 30.0, ..camera };
        assert!(orbit_target(&up).z > 10.0, "ahead, above the horizon: {}", orbit_target(&up));
    }
}

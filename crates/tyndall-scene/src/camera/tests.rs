//! Laws of the camera's axes, rays, matrices and motion.

use glam::{DVec2, DVec3, UVec2};
use proptest::prelude::*;

use super::*;

const SIZE_PX: UVec2 = UVec2::new(1280, 720);

/// Rounding of a few products of numbers near 1.
const ROUNDING: f64 = 1e-12;

fn any_camera() -> impl Strategy<Value = CameraParams> {
    let position = (-1e4..1e4, -1e4..1e4, 0.1..1e5);
    let angles = (-360.0..=360.0, -90.0..=90.0, -180.0..=180.0, 1.0..=170.0);
    (position, angles).prop_map(|((x_m, y_m, altitude_m), (heading_deg, pitch_deg, roll_deg, field_of_view_deg))| {
        let pinhole = CameraParams::default();
        CameraParams { x_m, y_m, altitude_m, heading_deg, pitch_deg, roll_deg, field_of_view_deg, ..pinhole }
    })
}

proptest! {
    #[test]
    fn the_axes_are_orthonormal_and_right_handed(camera in any_camera()) {
        let CameraFrame { right, up, forward, .. } = CameraFrame::new(&camera);
        for (a, b) in [(right, up), (up, forward), (forward, right)] {
            prop_assert!(a.dot(b).abs() < ROUNDING, "{a} is not perpendicular to {b}");
            prop_assert!((a.length() - 1.0).abs() < ROUNDING, "{a} is not of unit length");
        }
        prop_assert!((right.cross(up) + forward).length() < ROUNDING, "{camera:?} is left-handed");
    }

    #[test]
    fn a_ray_appears_in_the_point_it_was_sent_through(camera in any_camera(), x in 0.0..1280.0, y in 0.0..720.0) {
        let frame = CameraFrame::new(&camera);
        let point = DVec2::new(x, y);
        let found = frame.point_px(frame.ray(point, SIZE_PX), SIZE_PX);
        // Wide views put rays at grazing angles to the picture; narrow ones a pixel into 2e-5 rad.
        prop_assert!(found.is_some_and(|found| found.distance(point) < 1e-7), "{found:?}, expected {point}");
    }

    #[test]
    fn rays_and_matrices_agree_about_where_a_thing_is(camera in any_camera(), x in 0.0..1280.0, y in 0.0..720.0) {
        let frame = CameraFrame::new(&camera);
        let ray = frame.ray(DVec2::new(x, y), SIZE_PX);
        let clip_from_world = frame.clip_from_view(1280.0 / 720.0) * frame.view_from_world();
        let clip = clip_from_world * (frame.position + ray * 1e4).extend(1.0);
        let found = DVec2::new((clip.x / clip.w + 1.0) * 640.0, (1.0 - clip.y / clip.w) * 360.0);
        prop_assert!(found.distance(DVec2::new(x, y)) < 1e-5, "{found}, expected {x} {y}");
    }

    #[test]
    fn moving_and_turning_stay_within_the_allowed_ranges(
        camera in any_camera(), right in -1e9..1e9, forward in -1e9..1e9, up in -1e9..1e9,
    ) {
        for moved in [
            look(&camera, right, up),
            move_local(&camera, right, forward, up, 1.0),
            orbit(&camera, DVec3::new(up, right, forward), right, up),
            look(&camera, f64::NAN, f64::INFINITY),
        ] {
            let scene = crate::Scene { camera: moved, ..Default::default() };
            let checked = scene.check();
            prop_assert!(checked.is_ok(), "{checked:?}");
        }
    }

    #[test]
    fn flying_there_and_back_ends_where_it_began(camera in any_camera(), speed in 1.0..10.0) {
        let camera = CameraParams { altitude_m: 1000.0, ..camera };
        let back = move_local(&move_local(&camera, speed, speed, speed, 2.0), -speed, -speed, -speed, 2.0);
        let distance = CameraFrame::new(&back).position.distance(CameraFrame::new(&camera).position);
        prop_assert!(distance < 1e-9, "{distance} m away");
    }

    #[test]
    fn an_orbit_keeps_its_distance_and_looks_at_its_target(
        camera in any_camera(), right in -180.0..180.0, up in -20.0..20.0,
    ) {
        let camera = CameraParams { altitude_m: 3000.0, ..camera };
        let target = DVec3::new(300.0, -200.0, 2000.0);
        let frame = CameraFrame::new(&orbit(&camera, target, right, up));
        let before = CameraFrame::new(&camera).position.distance(target);
        // An orbit that would lead below the ground stops there.
        prop_assume!(frame.position.z > 0.2);
        prop_assert!((frame.position.distance(target) - before).abs() < 1e-9 * before, "{frame:?}");
        let away = frame.forward.angle_between(target - frame.position);
        // The arc cosine in the angle resolves no less.
        prop_assert!(away < 1e-7, "looks {away} rad past the target");
    }
}

#[test]
fn heading_and_pitch_follow_the_compass_and_the_horizon() {
    let forward = |heading_deg, pitch_deg| {
        CameraFrame::new(&CameraParams { heading_deg, pitch_deg, ..CameraParams::default() }).forward
    };
    for (heading_deg, pitch_deg, expected) in [
        (0.0, 0.0, DVec3::Y),
        (90.0, 0.0, DVec3::X),
        (180.0, 0.0, DVec3::NEG_Y),
        (-90.0, 0.0, DVec3::NEG_X),
        (37.0, 90.0, DVec3::Z),
        (0.0, -90.0, DVec3::NEG_Z),
    ] {
        let found = forward(heading_deg, pitch_deg);
        assert!((found - expected).length() < ROUNDING, "{heading_deg} {pitch_deg}: {found}");
    }
}

#[test]
fn a_camera_on_the_level_has_a_level_horizon() {
    let frame = CameraFrame::new(&CameraParams { heading_deg: 12.0, pitch_deg: 25.0, ..CameraParams::default() });
    assert!(frame.right.z.abs() < ROUNDING, "{}", frame.right);
    assert!(frame.up.z > 0.0, "{}", frame.up);
}

#[test]
fn a_positive_roll_lowers_the_right_side_by_its_angle() {
    let frame = CameraFrame::new(&CameraParams { pitch_deg: 0.0, roll_deg: 30.0, ..CameraParams::default() });
    assert!((frame.right.z + 0.5).abs() < ROUNDING, "{}", frame.right);
    let upside_down = CameraFrame::new(&CameraParams { pitch_deg: 0.0, roll_deg: 180.0, ..CameraParams::default() });
    assert!((upside_down.up + DVec3::Z).length() < ROUNDING, "{}", upside_down.up);
}

#[test]
fn a_roll_leaves_the_middle_of_the_picture_in_place() {
    let ray = |roll_deg| {
        let camera = CameraParams { roll_deg, ..CameraParams::default() };
        CameraFrame::new(&camera).ray(DVec2::new(640.0, 360.0), SIZE_PX)
    };
    assert!((ray(0.0) - ray(77.0)).length() < ROUNDING, "{} {}", ray(0.0), ray(77.0));
}

#[test]
fn the_field_of_view_spans_the_picture_from_bottom_to_top() {
    let frame = CameraFrame::new(&CameraParams { field_of_view_deg: 90.0, ..CameraParams::default() });
    let [top, bottom] = [0.0, 720.0].map(|y| frame.ray(DVec2::new(640.0, y), SIZE_PX));
    assert!((top.angle_between(bottom).to_degrees() - 90.0).abs() < 1e-9, "{top} {bottom}");
    assert!(top.z > bottom.z, "row 0 is the upper edge: {top} {bottom}");
}

#[test]
fn depth_is_one_at_the_near_plane_and_falls_towards_zero() {
    let clip_from_view = CameraFrame::new(&CameraParams::default()).clip_from_view(1.5);
    for distance_m in [NEAR_M, 1.0, 1e3, 1e9] {
        let clip = clip_from_view * DVec3::new(0.0, 0.0, -distance_m).extend(1.0);
        assert!((clip.z / clip.w - NEAR_M / distance_m).abs() < 1e-15, "{distance_m} m: {clip}");
    }
}

#[test]
fn nothing_behind_the_camera_is_in_the_picture() {
    let frame = CameraFrame::new(&CameraParams::default());
    assert_eq!(frame.point_px(-frame.forward, SIZE_PX), None, "straight behind");
}

#[test]
fn looking_right_in_a_picture_turned_by_ninety_degrees_changes_the_pitch() {
    let camera = CameraParams { pitch_deg: 0.0, roll_deg: 90.0, ..CameraParams::default() };
    let turned = look(&camera, 5.0, 0.0);
    let [before, after] = [&camera, &turned].map(CameraFrame::new);
    assert!((after.forward.dot(before.right) - 5.0_f64.to_radians().sin()).abs() < ROUNDING, "{turned:?}");
    assert!((turned.heading_deg).abs() < ROUNDING, "{turned:?}");
}

#[test]
fn the_pitch_stops_at_the_zenith_and_the_heading_goes_round() {
    let camera = CameraParams { heading_deg: 170.0, ..CameraParams::default() };
    let turned = look(&camera, 20.0, 500.0);
    assert_eq!((turned.heading_deg, turned.pitch_deg), (-170.0, 90.0), "{turned:?}");
}

#[test]
fn an_orthographic_camera_sees_one_direction_from_a_plane_of_its_width() {
    let camera = CameraParams {
        projection: CameraProjection::Orthographic,
        width_m: 80.0,
        x_m: 3.0,
        altitude_m: 50.0,
        pitch_deg: 0.0,
        ..CameraParams::default()
    };
    let (frame, size) = (CameraFrame::new(&camera), UVec2::new(40, 20));
    for point in [DVec2::new(0.5, 0.5), DVec2::new(20.0, 10.0), DVec2::new(39.5, 3.0)] {
        assert!((frame.ray(point, size) - DVec3::Y).length() < 1e-12, "north at {point}");
        let wanted = DVec3::new(3.0 + 2.0 * (point.x - 20.0), 0.0, 50.0 - 2.0 * (point.y - 10.0));
        assert!((frame.eye(point, size) - wanted).length() < 1e-12, "two metres a pixel at {point}");
    }
    assert_eq!(frame.point_px(DVec3::Y, size), None, "a direction is everywhere or nowhere");
    let pinhole = CameraFrame::new(&CameraParams { x_m: 3.0, ..CameraParams::default() });
    assert!((pinhole.eye(DVec2::ZERO, size) - pinhole.position).length() < 1e-12, "one point");
}

//! How a camera turns and moves. Pure functions from camera to camera; the result is always within the ranges of
//! [`CameraParams`].

use glam::DVec3;
use tyndall_core::ParamSet as _;

use super::CameraFrame;
use crate::CameraParams;

/// Turns the view to the right and up as the picture shows them, also when the camera is rolled. The pitch stops at
/// straight up and straight down.
#[must_use]
pub fn look(camera: &CameraParams, right_deg: f64, up_deg: f64) -> CameraParams {
    let (sin_roll, cos_roll) = camera.roll_deg.to_radians().sin_cos();
    let heading_deg = camera.heading_deg + right_deg * cos_roll + up_deg * sin_roll;
    let pitch_deg = camera.pitch_deg + up_deg * cos_roll - right_deg * sin_roll;
    within_ranges(CameraParams { heading_deg: wrap_deg(heading_deg), pitch_deg, ..camera.clone() })
}

/// Flies for `dt_s` seconds: to the right and forward along the camera's own axes, and upwards along the world's, so that
/// looking at the ground and rising do not cancel.
#[must_use]
pub fn move_local(
    camera: &CameraParams,
    right_m_per_s: f64,
    forward_m_per_s: f64,
    up_m_per_s: f64,
    dt_s: f64,
) -> CameraParams {
    let frame = CameraFrame::new(camera);
    let velocity = frame.right * right_m_per_s + frame.forward * forward_m_per_s + DVec3::Z * up_m_per_s;
    at(camera, frame.position + velocity * dt_s)
}

/// Moves the camera on a sphere about `target` (east, north, altitude) and makes it look there. The camera goes around
/// by `right_deg` and climbs by `up_deg`, up to 89 degrees above or below, where the heading would lose its meaning.
#[must_use]
pub fn orbit(camera: &CameraParams, target: DVec3, right_deg: f64, up_deg: f64) -> CameraParams {
    let offset = CameraFrame::new(camera).position - target;
    let climb_deg = offset.z.atan2(offset.truncate().length()).to_degrees() + up_deg;
    let climb_rad = climb_deg.clamp(-89.0, 89.0).to_radians();
    let around_rad = offset.x.atan2(offset.y) - right_deg.to_radians();
    let away = DVec3::new(around_rad.sin() * climb_rad.cos(), around_rad.cos() * climb_rad.cos(), climb_rad.sin());
    let moved = at(camera, target + away * offset.length());
    look_at(&moved, target)
}

/// Points the camera at `target`; a target in the camera itself changes nothing.
fn look_at(camera: &CameraParams, target: DVec3) -> CameraParams {
    let way = target - CameraFrame::new(camera).position;
    if way == DVec3::ZERO {
        return camera.clone();
    }
    let heading_deg = way.x.atan2(way.y).to_degrees();
    let pitch_deg = way.z.atan2(way.truncate().length()).to_degrees();
    within_ranges(CameraParams { heading_deg, pitch_deg, ..camera.clone() })
}

fn at(camera: &CameraParams, position: DVec3) -> CameraParams {
    within_ranges(CameraParams { x_m: position.x, y_m: position.y, altitude_m: position.z, ..camera.clone() })
}

/// The angle plus whole turns, from -180 to 180.
fn wrap_deg(angle_deg: f64) -> f64 {
    (angle_deg + 180.0).rem_euclid(360.0) - 180.0
}

/// Every value moved to the nearest allowed one; NaN, which has none, becomes the default.
fn within_ranges(mut camera: CameraParams) -> CameraParams {
    for (index, info) in camera.info().iter().enumerate() {
        let value = camera.get(index);
        let near = value.clamp(*info.range.start(), *info.range.end());
        camera.set_unchecked(index, if near.is_nan() { info.default } else { near });
    }
    camera
}

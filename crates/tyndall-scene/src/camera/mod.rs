//! Axes, rays and matrices of the camera.
//!
//! The world is right-handed: x east, y north, z up. View space has x to the right, y up and looks along -z, as in most
//! renderers. Clip space is wgpu's: depth 1 at [`NEAR_M`], 0 at infinity (reversed, so that floats resolve the distance).

mod motion;

use glam::{DMat4, DVec2, DVec3, DVec4, UVec2};

pub use motion::{look, move_local, orbit};

use crate::{CameraParams, CameraProjection};

/// Distance of the near plane. Nothing of a scene is closer to the camera than this, which is half of its lowest altitude.
pub const NEAR_M: f64 = 0.05;

/// Position, axes and opening of a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraFrame {
    /// East, north, altitude above the ground, in metres.
    pub position: DVec3,
    /// Unit vector to the right edge of the picture.
    pub right: DVec3,
    /// Unit vector to the upper edge of the picture.
    pub up: DVec3,
    /// Unit vector of view.
    pub forward: DVec3,
    /// Tangent of half the vertical field of view.
    pub tan_half_view: f64,
    /// Width (m) of what an orthographic picture shows; `None` for a perspective.
    pub orthographic_m: Option<f64>,
}

impl CameraFrame {
    /// The frame of a camera. Straight up and straight down are no special cases: the heading keeps its meaning there.
    #[must_use]
    pub fn new(camera: &CameraParams) -> Self {
        let (sin_heading, cos_heading) = camera.heading_deg.to_radians().sin_cos();
        let (sin_pitch, cos_pitch) = camera.pitch_deg.to_radians().sin_cos();
        let (sin_roll, cos_roll) = camera.roll_deg.to_radians().sin_cos();
        let forward = DVec3::new(sin_heading * cos_pitch, cos_heading * cos_pitch, sin_pitch);
        let level_right = DVec3::new(cos_heading, -sin_heading, 0.0);
        let level_up = level_right.cross(forward);
        Self {
            position: DVec3::new(camera.x_m, camera.y_m, camera.altitude_m),
            right: level_right * cos_roll - level_up * sin_roll,
            up: level_up * cos_roll + level_right * sin_roll,
            forward,
            tan_half_view: (camera.field_of_view_deg / 2.0).to_radians().tan(),
            orthographic_m: (camera.projection == CameraProjection::Orthographic).then_some(camera.width_m),
        }
    }

    /// Unit vector of view at a point of the picture. Points count in pixels from the upper left corner:
    /// the centre of the first pixel is (0.5, 0.5).
    #[must_use]
    pub fn ray(&self, point_px: DVec2, size_px: UVec2) -> DVec3 {
        if self.orthographic_m.is_some() {
            return self.forward;
        }
        let centred = (point_px - size_px.as_dvec2() / 2.0) * self.view_per_pixel(size_px);
        (self.forward + self.right * centred.x - self.up * centred.y).normalize()
    }

    /// Where the line of sight of a point of the picture begins (m): the camera, or its plane when it is orthographic.
    #[must_use]
    pub fn eye(&self, point_px: DVec2, size_px: UVec2) -> DVec3 {
        let metres_per_pixel = self.orthographic_m.map_or(0.0, |width_m| width_m / f64::from(size_px.x));
        let centred = (point_px - size_px.as_dvec2() / 2.0) * metres_per_pixel;
        self.position + self.right * centred.x - self.up * centred.y
    }

    /// Point of the picture in which a direction appears, the inverse of [`CameraFrame::ray`]; `None` behind the camera, and
    /// for an orthographic one, which sees one direction everywhere.
    #[must_use]
    pub fn point_px(&self, direction: DVec3, size_px: UVec2) -> Option<DVec2> {
        let depth = direction.dot(self.forward);
        let on_plane = DVec2::new(direction.dot(self.right), -direction.dot(self.up)) / depth;
        (depth > 0.0 && self.orthographic_m.is_none())
            .then(|| on_plane / self.view_per_pixel(size_px) + size_px.as_dvec2() / 2.0)
    }

    /// Width of a pixel on the plane at distance 1.
    fn view_per_pixel(&self, size_px: UVec2) -> f64 {
        2.0 * self.tan_half_view / f64::from(size_px.y)
    }

    /// World to view space; EXR headers carry it as `worldToCamera`. Multiplies columns: `view_from_world * point`.
    #[must_use]
    pub fn view_from_world(&self) -> DMat4 {
        let rows = [self.right, self.up, -self.forward].map(|axis| axis.extend(-axis.dot(self.position)));
        DMat4::from_cols(rows[0], rows[1], rows[2], DVec4::W).transpose()
    }

    /// View to clip space of a perspective, reversed and without a far plane: depth is [`NEAR_M`] / distance along the view.
    #[must_use]
    pub fn clip_from_view(&self, width_over_height: f64) -> DMat4 {
        let scale = 1.0 / self.tan_half_view;
        DMat4::from_cols(DVec4::X * (scale / width_over_height), DVec4::Y * scale, DVec4::NEG_W, DVec4::Z * NEAR_M)
    }
}

#[cfg(test)]
mod tests;

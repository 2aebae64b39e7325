//! The camera of splats.

use crate::error::{CloudError, in_range};
use crate::narrow::narrow;

/// How directions become places in the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SplatProjection {
    /// From one point, with the tangents of half the opening to the right and upwards.
    Perspective {
        /// Tangents of half the horizontal and vertical field of view.
        tan_half: [f64; 2],
    },
    /// Along parallel lines, with half the picture's width and height (m).
    Orthographic {
        /// Half of width and height (m).
        half_m: [f64; 2],
    },
}

/// A camera and its picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SplatView {
    /// Place (m): east, north, altitude.
    pub position_m: [f64; 3],
    /// Unit vectors to the right, upwards and forward in the picture.
    pub axes: [[f64; 3]; 3],
    /// The projection.
    pub projection: SplatProjection,
    /// Width and height (px).
    pub size_px: [usize; 2],
    /// Radius of the planet (m), by which what is far away sinks; infinite for a flat one.
    pub planet_radius_m: f64,
    /// Distance (m) by which clouds have faded out, from three quarters of it on; infinite for none.
    pub reach_m: f64,
}

/// Share of the reach over which clouds fade out.
const FADE: f64 = 0.25;

impl SplatView {
    /// That the picture has pixels and the camera opens.
    ///
    /// # Errors
    /// When a side is 0 or above 32,768 px, or an opening is not positive.
    pub fn check(&self) -> Result<(), CloudError> {
        for (what, side) in [("width of the picture", self.size_px[0]), ("height of the picture", self.size_px[1])] {
            in_range(what, side as f64, (1.0, 32_768.0), " px")?;
        }
        for half in self.half() {
            in_range("half the opening of the camera", half, (1e-9, 1e9), "")?;
        }
        in_range("radius of the planet", self.planet_radius_m, (1.0, f64::INFINITY), " m")?;
        in_range("reach of the clouds", self.reach_m, (1e-9, f64::INFINITY), " m")?;
        Ok(())
    }

    /// Half the opening to the right and upwards: tangents, or metres.
    pub(super) fn half(&self) -> [f64; 2] {
        match self.projection {
            SplatProjection::Perspective { tan_half } => tan_half,
            SplatProjection::Orthographic { half_m } => half_m,
        }
    }

    pub(super) fn is_perspective(&self) -> bool {
        matches!(self.projection, SplatProjection::Perspective { .. })
    }

    /// A point (m) in the camera's axes: right, up, forward. What is far away sinks with the planet's curvature.
    pub(super) fn place(&self, point_m: [f64; 3]) -> [f64; 3] {
        let mut from = [0, 1, 2].map(|axis| point_m[axis] - self.position_m[axis]);
        if self.planet_radius_m.is_finite() {
            // r^2 - R^2 is never formed: it would lose all digits of altitudes.
            let radius = self.planet_radius_m + point_m[2];
            let level2 = from[0] * from[0] + from[1] * from[1];
            from[2] -= level2 / (radius + (radius * radius - level2).max(0.0).sqrt());
        }
        self.turned(from)
    }

    /// A vector in the camera's axes.
    pub(super) fn turned(&self, vector: [f64; 3]) -> [f64; 3] {
        self.axes.map(|axis| axis[0] * vector[0] + axis[1] * vector[1] + axis[2] * vector[2])
    }

    /// Share of a cloud that is drawn at a distance (m).
    pub(super) fn fade(&self, distance_m: f64) -> f32 {
        if !self.reach_m.is_finite() {
            return 1.0;
        }
        let x = ((distance_m / self.reach_m - 1.0 + FADE) / FADE).clamp(0.0, 1.0);
        narrow(1.0 - x * x * (3.0 - 2.0 * x))
    }

    /// Radius (px) of a ball's splat at a distance (m).
    pub(super) fn radius_px(&self, radius_m: f64, distance_m: f64) -> f64 {
        let per_half = 0.5 * self.size_px[1] as f64 / self.half()[1];
        if self.is_perspective() { per_half * radius_m / distance_m.max(radius_m) } else { per_half * radius_m }
    }

    /// Width and height of a pixel in the units of [`SplatView::half`].
    pub(super) fn pixel(&self) -> [f32; 2] {
        let half = self.half();
        [0, 1].map(|axis| narrow(2.0 * half[axis] / self.size_px[axis] as f64))
    }

    /// Place of the middle of pixel 0 in the units of [`SplatView::half`]: x to the right, y upwards.
    pub(super) fn first_pixel(&self) -> [f32; 2] {
        let (half, size) = (self.half(), self.size_px);
        [narrow(half[0] * (1.0 / size[0] as f64 - 1.0)), narrow(half[1] * (1.0 - 1.0 / size[1] as f64))]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn view() -> SplatView {
        SplatView {
            position_m: [100.0, -50.0, 200.0],
            axes: [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]],
            projection: SplatProjection::Perspective { tan_half: [0.6, 0.4] },
            size_px: [60, 40],
            planet_radius_m: 6.36e6,
            reach_m: 60e3,
        }
    }

    #[test]
    fn what_is_far_away_stands_at_its_altitude_above_the_curved_ground() {
        let view = view();
        for (distance_m, altitude_m) in [(1e3, 900.0), (3e4, 2000.0), (2e5, 10_000.0)] {
            let [right, up, forward] = view.place([100.0, distance_m - 50.0, altitude_m]);
            assert!(right.abs() < 1e-6 && (forward - distance_m).abs() < 1e-6, "level distances stay");
            let radius = view.planet_radius_m;
            let found = (up + 200.0 + radius).hypot(forward) - radius;
            assert!((found - altitude_m).abs() < 1e-3, "altitude {found} for {altitude_m}");
        }
    }

    #[test]
    fn pictures_without_pixels_are_refused() {
        let text = SplatView { size_px: [60, 0], ..view() }.check().unwrap_err().to_string();
        assert_eq!(text, "height of the picture = 0 px is outside 1 to 32768 px");
        let closed = SplatView { projection: SplatProjection::Orthographic { half_m: [0.0, 1.0] }, ..view() };
        assert!(closed.check().unwrap_err().to_string().contains("opening"), "a closed camera");
    }

    #[test]
    fn clouds_fade_out_before_their_reach() {
        let view = view();
        assert!((view.fade(45e3) - 1.0).abs() < 1e-6 && view.fade(60e3) < 1e-6, "from three quarters on");
        assert!((view.fade(52_500.0) - 0.5).abs() < 1e-6, "half in the middle");
    }
}

//! Which light casts the shadows of clouds and dunes: the sun, and at night the moon.

use tyndall_scene::Scene;

use crate::RenderError;

/// Sine of the sun's elevation, 4 degrees below the horizon, under which it lights no cloud below 15 km any more.
const NIGHT_SINE: f64 = -0.07;

/// The light that casts shadows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lamp {
    /// Direction to it: east, north, up.
    pub(crate) direction: [f64; 3],
    /// Angular radius (rad) of its disc.
    pub(crate) radius_rad: f64,
    /// Whether it is the moon.
    pub(crate) is_moon: bool,
}

impl Lamp {
    /// Of a scene: the moon when the sun is far below the horizon and the moon above it.
    ///
    /// # Errors
    /// When the scene has no sun position.
    pub(crate) fn of(scene: &Scene) -> Result<Self, RenderError> {
        let sun = scene.sun_direction()?.unit();
        if sun.z < NIGHT_SINE
            && let Some(moon) = scene.moon()?.filter(|moon| moon.direction.z > 0.0)
        {
            let radius_rad = scene.moon.angular_radius_deg.to_radians();
            return Ok(Self { direction: moon.direction.to_array(), radius_rad, is_moon: true });
        }
        let radius_rad = scene.sun.angular_radius_deg.to_radians();
        Ok(Self { direction: sun.to_array(), radius_rad, is_moon: false })
    }
}

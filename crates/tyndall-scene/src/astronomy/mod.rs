//! Where moon and stars stand: time, the moon's motion, and the turn from the equator's axes to the scene's.
//!
//! Accuracy: the moon within 0.02 degrees of the full theory for years near ours, seen from the surface; stars within 0.01
//! degrees but for their own motion. Not done: nutation, aberration, the tilt of the moon's own axis and its libration.

pub mod equator;
mod moon;
pub mod moon_series;
pub mod time;

mod stars;

pub(crate) use moon::moon_state;
pub use moon::{FULL_MOON_LUX, MAGNITUDE_ZERO_LUX, MoonState, lommel_seeliger_phase, moon_illuminance_lux};
pub(crate) use stars::world_from_stars;
pub use stars::{Star, bright_stars};

//! Scenes: what a picture shows, as parameters, as a TOML file, and as the camera and the sun that follow from them.
//!
//! - [`Scene`]: the seven groups of parameters, reached by path (`sun.elevation_deg`), checked and hashed.
//! - [`params`]: camera, sun, sky, film and image; atmosphere and ground come from [`tyndall_scattering::params`].
//! - [`sun`]: direction of the sun from angles or from date, time and place.
//! - [`camera`]: axes, rays and matrices of the camera, and how it moves.

pub mod camera;
mod error;
mod hash;
mod nearest;
pub mod params;
mod scene;
pub mod sun;

pub use error::SceneError;
pub use hash::SceneHash;
pub use params::{
    CameraParams, ExposureMode, FilmParams, ImageParams, SkyMode, SkyParams, SunParams, SunPosition, ToneMap,
};
pub use scene::Scene;
pub use sun::SunDirection;
pub use tyndall_scattering::params::{AerosolPhase, AirModel, AtmosphereParams, GroundParams};

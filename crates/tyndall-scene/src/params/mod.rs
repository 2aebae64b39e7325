//! What users choose besides the atmosphere and the ground, one file per group.

mod camera;
mod film;
mod image;
mod landscape;
mod sky;
mod sun;

pub use camera::CameraParams;
pub use film::{ExposureMode, FilmParams, ToneMap};
pub use image::ImageParams;
pub use landscape::{LandscapeKind, LandscapeParams};
pub use sky::{Orders, OrdersDetail, SkyMode, SkyParams};
pub use sun::{SunParams, SunPosition};

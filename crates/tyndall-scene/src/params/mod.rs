//! What users choose besides the atmosphere and the ground, one file per group.

mod camera;
mod clouds;
mod desert;
mod film;
mod image;
mod landscape;
mod moon;
mod sand;
mod sky;
mod stars;
mod sun;

pub use camera::{CameraParams, CameraProjection};
pub use clouds::{CloudFileHolds, CloudKind, CloudMethod, CloudResolution, CloudsParams};
pub use desert::{DesertKind, DesertSceneParams};
pub use film::{ExposureMode, FilmParams, ToneMap};
pub use image::ImageParams;
pub use landscape::{LandscapeKind, LandscapeParams};
pub use moon::{MoonParams, MoonPhase, MoonPosition};
pub use sand::{RippleLook, SandParams};
pub use sky::{Orders, OrdersDetail, SkyKind, SkyMode, SkyParams};
pub use stars::StarsParams;
pub use sun::{SunParams, SunPosition};

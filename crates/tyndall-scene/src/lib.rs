//! Scenes: what a picture shows, as parameters, as a TOML file, and as the camera and the sun that follow from them.
//!
//! - [`Scene`]: the groups of parameters, reached by path (`sun.elevation_deg`), checked and hashed.
//! - [`SceneFile`]: scene files, read with exact error positions and written with the user's comments kept.
//! - [`params`]: camera, sun, sky, landscape, film and image; atmosphere, haze and ground come from [`tyndall_scattering::params`],
//!   the matter of clouds from [`tyndall_clouds::params`],
//!   sand and its winds from [`tyndall_dunes`].
//! - [`presets`]: the scenes that come with Tyndall.
//! - [`schema`] and [`markdown_table`]: the format for editors and for readers.
//! - [`sun`]: direction of the sun from angles or from date, time and place.
//! - [`landscape`]: heights of hills and mountains.
//! - [`SceneSimulation`]: what goes on in steps, with states that are taken out and put back.
//! - [`camera`]: axes, rays and matrices of the camera, and how it moves.

pub mod astronomy;
mod brief;
pub mod camera;
mod command_line;
mod docs;
mod error;
mod file;
mod files;
mod hash;
pub mod landscape;
mod nearest;
pub mod params;
mod place;
mod preset;
mod scene;
mod simulation;
pub mod sun;

pub use docs::{markdown_table, schema};
pub use error::SceneError;
pub use file::{FORMAT, MAX_BYTES, SceneFile};
pub use files::SceneFolder;
pub use hash::SceneHash;
pub use params::{
    CameraParams, CameraProjection, CloudFileHolds, CloudKind, CloudMethod, CloudResolution, CloudsParams, DesertKind,
    DesertSceneParams, ExposureMode, FilmParams, ImageParams, LandscapeKind, LandscapeParams, MoonParams, MoonPhase,
    MoonPosition, Orders, OrdersDetail, RippleLook, SandParams, SkyKind, SkyMode, SkyParams, StarsParams, SunParams,
    SunPosition, ToneMap,
};
pub use place::Place;
pub use preset::{Preset, presets};
pub use scene::Scene;
pub use simulation::{SceneSimulation, SimulationKind};
pub use sun::SunDirection;
pub use tyndall_clouds::params::{CloudGridParams, CloudMatterParams, CloudParams, CloudVapourParams, CloudWindParams};
pub use tyndall_dunes::ripples::RippleParams;
pub use tyndall_dunes::slab::{AbrasionParams, ClassicParams, DuneModel, DuneParams, VegetationParams};
pub use tyndall_dunes::wind::WindParams;
pub use tyndall_dunes::{DesertInputs, DesertParams, Edges, Side, state_step as desert_state_step};
pub use tyndall_scattering::Atmosphere;
pub use tyndall_scattering::haze::{HazeParams, VisibilityContrast};
pub use tyndall_scattering::params::{AerosolInput, AerosolPhase, AirModel, AtmosphereParams, GroundParams};

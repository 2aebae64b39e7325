//! Renders Tyndall scenes with wgpu: sky, sun, ground, landscape, clouds, exposure and tone mapping.
//!
//! [`Renderer::render`] draws a [`tyndall_scene::Scene`] into a [`FrameTarget`]; the desktop program, the command line and
//! the tests all call it. Nothing here opens windows or files.
//!
//! A frame is: tables that changed ([`sky`]) -> ground and sky into an HDR frame with reversed depth -> clouds over it -> metering ->
//! exposure, tone map and dither into the picture ([`develop`]). The HDR frame holds linear Rec.709 radiance times the
//! *pre-exposure*, so that half floats serve from noon to the end of twilight; [`FrameTarget::read_radiance`] takes it out
//! again.
//!
//! Each renderer is three types in one file: its uniform structs in `gpu_data`, the per-frame draw data that owns the bind
//! groups, and the long-lived renderer that owns the pipelines.

pub mod aerial;
pub mod clouds;
pub mod desert;
pub mod desert_inputs;
pub mod develop;
pub mod dither;
pub mod environment;
mod error;
pub mod exposure;
pub mod film;
pub mod flip;
pub mod frame;
pub mod landscape;
mod night_forms;
pub mod reference;
mod renderer;
pub mod sky;
pub mod splats;
mod target;
pub mod tone;
mod view;

pub use error::RenderError;
pub use renderer::Renderer;
pub use target::{FrameFormat, FrameTarget, PictureFormat, RendererConfig, SKY_DEPTH_M};
pub use view::{CubeFace, View};

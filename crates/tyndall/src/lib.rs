//! Simulates and renders what small particles do to light: sky, clouds, smoke, desert sand, shafts of light.
//!
//! This crate re-exports the libraries of the workspace under one name; programs that need one of them depend on it
//! alone. `tyndall_scattering` and `tyndall_scene`, for instance, have no wgpu in their dependencies.
//!
//! A scene to a picture, on any GPU or on a software adapter:
//!
//! ```no_run
//! use tyndall::prelude::*;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let mut scene = Scene::default();
//! scene.set_text("sun.elevation_deg", "4")?;
//!
//! let gpu = Gpu::open(&GpuOptions::default())?;
//! let config = RendererConfig { frame: FrameFormat::Float, ..RendererConfig::default() };
//! let mut renderer = Renderer::new(&gpu, config)?;
//! let mut target = FrameTarget::new(&gpu, [1280, 720], config)?;
//! renderer.render(&gpu, &scene, &mut target)?;
//!
//! let picture = Picture { size_px: [1280, 720], rgba: target.read_radiance(&gpu)?, depth_m: Some(target.read_depth_m(&gpu)?) };
//! write_exr("sky.exr", &picture, &PictureMetadata::default(), &ExrOptions::default())?;
//! # Ok(())
//! # }
//! ```

pub use tyndall_clouds as clouds;
pub use tyndall_core as core;
pub use tyndall_dunes as dunes;
pub use tyndall_gpu as gpu;
pub use tyndall_gpu_sim as gpu_sim;
pub use tyndall_io as io;
pub use tyndall_render as render;
pub use tyndall_scattering as scattering;
pub use tyndall_scene as scene;

/// What most programs need.
pub mod prelude {
    pub use tyndall_gpu::{Gpu, GpuOptions};
    pub use tyndall_io::{ExrOptions, Picture, PictureMetadata, write_exr, write_png8, write_png16};
    pub use tyndall_render::{FrameFormat, FrameTarget, PictureFormat, Renderer, RendererConfig};
    pub use tyndall_scene::{Scene, SceneFile};
}

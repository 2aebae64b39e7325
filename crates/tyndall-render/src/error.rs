//! What can go wrong while a frame is drawn.

use std::sync::Arc;

use tyndall_clouds::CloudError;
use tyndall_gpu::GpuError;
use tyndall_scattering::ScatteringError;
use tyndall_scene::SceneError;

/// Errors of this crate.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// Of the GPU: memory, a lost device, a wrong shader.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// Of the scene: values that do not fit together.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// Of the atmosphere.
    #[error(transparent)]
    Scattering(#[from] ScatteringError),
    /// Of the desert.
    #[error("desert: {0}")]
    Sand(#[from] tyndall_dunes::DuneError),
    /// Of the clouds: a wind too fast for its grid.
    #[error("clouds: {0}")]
    Clouds(#[from] CloudError),
    /// What an earlier frame was refused for, asked for again.
    #[error(transparent)]
    Refused(Arc<Self>),
    /// Of the clouds' file.
    #[error(transparent)]
    CloudFile(#[from] crate::clouds::file::CloudFileError),
    /// Of the files of the desert.
    #[error(transparent)]
    DesertFile(#[from] crate::desert_inputs::DesertFileError),
    /// The target was made for another renderer configuration.
    #[error("the frame target has {target:?}, the renderer draws {renderer:?}")]
    Configuration {
        /// Configuration of the target.
        target: crate::RendererConfig,
        /// Configuration of the renderer.
        renderer: crate::RendererConfig,
    },
    /// A panorama of a width that cannot be.
    #[error(
        "a panorama of {width_px} px is not possible: its width must be an even number of at least {} px",
        crate::environment::PANORAMA_WIDTH_MIN_PX
    )]
    PanoramaWidth {
        /// The width.
        width_px: u32,
    },
}

//! The airglow as a uniform. WGSL: `shaders/sky/airglow.wgsl`.

use tyndall_core::spectrum::Spectrum;
use tyndall_gpu::wgpu::BufferUsages;
use tyndall_gpu::{Buffer, Gpu};

use super::colour::with_luminance;
use crate::RenderError;

/// The shell that shines (m).
const BOTTOM_M: f32 = 85_000.0;
const TOP_M: f32 = 95_000.0;

/// Shape of the spectrum at the eight wavelengths: the green line of oxygen at 558 nm over a continuum that is nearly even,
/// after Leinert et al. 1998, figure 27.
const SHAPE: Spectrum = [0.95, 0.95, 0.9, 0.95, 1.2, 0.85, 0.75, 0.7];

/// Uniform structs of this file.
pub(super) mod gpu_data {
    /// Twin of `Airglow` in `shaders/sky/airglow.wgsl`; units and meanings there.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
    #[expect(missing_docs, reason = "documented at the WGSL twin")]
    pub struct Airglow {
        pub zenith: [f32; 8],
        pub bottom_m: f32,
        pub top_m: f32,
        pub padding0: u32,
        pub padding1: u32,
    }
}

impl gpu_data::Airglow {
    /// Of a luminance in the zenith (cd/m^2).
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "the GPU computes in f32")]
    pub fn new(luminance_cd_m2: f64) -> Self {
        let zenith = with_luminance(&SHAPE, luminance_cd_m2).map(|value| value as f32);
        Self { zenith, bottom_m: BOTTOM_M, top_m: TOP_M, padding0: 0, padding1: 0 }
    }
}

/// An empty uniform.
pub(super) fn uniform(gpu: &Gpu) -> Result<Buffer, RenderError> {
    let bytes = size_of::<gpu_data::Airglow>() as u64;
    Ok(gpu.buffer("airglow", bytes, BufferUsages::UNIFORM | BufferUsages::COPY_DST)?)
}

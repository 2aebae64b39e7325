//! Adapter choice, memory budget, pipelines from shader reflection, read-back and GPU timings for Tyndall.
//!
//! - [`Gpu`]: device and queue with a byte budget, errors as values, and a flag for a lost device.
//! - [`Texture`], [`Buffer`]: GPU memory that is counted against the budget before it is allocated.
//! - [`Shader`]: a composed and validated WGSL file; errors name the original file, line and column.
//! - [`ComputePipeline`], [`RenderPipeline`]: layouts, workgroup sizes and bindings come from the shader itself; resources
//!   are bound by the names of the WGSL variables.
//! - [`PassTimer`]: GPU time of each pass.
//! - [`layout`]: byte layouts of structs on both sides, to be compared in tests.
//!
//! # Why errors are checked so often
//! Software adapters accept allocations far beyond the memory there is and the process is killed at first touch; hence the
//! budget. After a device is lost, wgpu's calls do nothing and report nothing; hence a picture counts only if
//! [`Gpu::check`] succeeds after its read-back, which [`Gpu::read_texture`] and [`Gpu::read_buffer`] see to themselves.
//!
//! # Environment
//! - `WGPU_BACKEND`, `WGPU_DEBUG`, `WGPU_VALIDATION`: read by wgpu. Which adapter is used is decided by
//!   [`GpuOptions::adapter`] alone.
//! - `TYNDALL_FAULT=device-lost@N`: destroys the device just before the `N`-th read-back of the process (from 1), so that
//!   the behaviour after a loss can be tested from outside. Several faults are separated by commas; those of other crates
//!   are left alone.

mod adapter;
mod bindings;
mod budget;
mod compute_pipeline;
mod device;
mod error;
mod fault;
mod health;
pub mod layout;
mod readback;
mod reflect;
mod render_pipeline;
mod resource;
mod shader;
mod timer;

pub use adapter::{AdapterChoice, AdapterReport};
pub use compute_pipeline::ComputePipeline;
pub use device::{Gpu, GpuOptions};
pub use error::GpuError;
pub use render_pipeline::{RenderPipeline, RenderPipelineDesc};
pub use resource::{Buffer, Texture, TextureDesc};
pub use shader::Shader;
pub use timer::{PassTimer, PassTiming};
pub use wgpu;

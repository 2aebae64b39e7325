//! What can go wrong with an automaton on a device.

use tyndall_dunes::DuneError;
use tyndall_gpu::GpuError;

/// Refusals and failures of this crate.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GpuSimError {
    /// The device refused something, has too little memory or is lost.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// What came back is no state of the automaton.
    #[error(transparent)]
    Dune(#[from] DuneError),
    /// The classic rule has no compute form.
    #[error("the model `classic` runs on the CPU only; the compute form has the model `slab`")]
    Classic,
    /// A grid of this size cannot be bound.
    #[error(
        "a grid of {} x {} cells takes {needed_bytes} bytes; shaders of this device see at most {high_bytes} bytes of a buffer",
        size[0],
        size[1]
    )]
    TooLarge {
        /// Cells along x and y.
        size: [usize; 2],
        /// Bytes of a grid.
        needed_bytes: u64,
        /// Most bytes that can be bound.
        high_bytes: u64,
    },
}

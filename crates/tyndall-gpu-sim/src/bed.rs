//! Grids on the device.

use tyndall_dunes::Lattice;
use tyndall_gpu::wgpu::BufferUsages;
use tyndall_gpu::{Buffer, Gpu, GpuError};

use crate::GpuSimError;

/// Bytes of a cell in every grid.
const CELL_BYTES: u64 = 4;

/// Makes grids of one size.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grids<'a> {
    gpu: &'a Gpu,
    bytes: u64,
}

impl<'a> Grids<'a> {
    /// For a bed of this size, if shaders can see grids that large.
    pub(crate) fn new(gpu: &'a Gpu, lattice: Lattice) -> Result<Self, GpuSimError> {
        let bytes = lattice.cells() as u64 * CELL_BYTES;
        let high_bytes = gpu.limits().max_storage_buffer_binding_size;
        if bytes > high_bytes {
            return Err(GpuSimError::TooLarge { size: lattice.size(), needed_bytes: bytes, high_bytes });
        }
        Ok(Self { gpu, bytes })
    }

    /// A grid of zeros.
    pub(crate) fn make(&self, label: &str) -> Result<Buffer, GpuError> {
        storage(self.gpu, label, self.bytes)
    }
}

/// A buffer that shaders read and write and that can be filled and read back.
pub(crate) fn storage(gpu: &Gpu, label: &str, bytes: u64) -> Result<Buffer, GpuError> {
    gpu.buffer(label, bytes, BufferUsages::STORAGE | BufferUsages::COPY_DST | BufferUsages::COPY_SRC)
}

/// Fills a buffer.
pub(crate) fn fill<T: bytemuck::Pod>(gpu: &Gpu, buffer: &Buffer, values: &[T]) {
    gpu.queue.write_buffer(buffer, 0, bytemuck::cast_slice(values));
}

/// What a buffer holds.
pub(crate) fn read<T: bytemuck::Pod>(gpu: &Gpu, buffer: &Buffer) -> Result<Vec<T>, GpuError> {
    gpu.read_buffer(buffer).map(|bytes| bytemuck::pod_collect_to_vec(&bytes))
}

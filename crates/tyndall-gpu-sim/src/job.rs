//! Dispatches that are recorded again and again: pipeline, what it is bound to, and how many invocations it takes.

use std::sync::Arc;

use tyndall_dunes::Lattice;
use tyndall_gpu::wgpu::{self, BindGroup, BindingResource, BufferUsages, ComputePass};
use tyndall_gpu::{Buffer, ComputePipeline, Gpu, GpuError, Shader};

use crate::gpu_data::{SandPass, narrow};

/// Distance of uniforms in a buffer that holds several (bytes): every device accepts it.
pub(crate) const UNIFORM_STRIDE_BYTES: u64 = 256;

/// Uniforms of one kind in a buffer.
#[derive(Debug)]
pub(crate) struct Uniforms {
    pub(crate) buffer: Buffer,
    pub(crate) count: u32,
    /// Bytes of one.
    size: u64,
}

impl Uniforms {
    /// Room for so many.
    pub(crate) fn new<T: bytemuck::Pod>(gpu: &Gpu, label: &str, count: u32) -> Result<Self, GpuError> {
        let bytes = u64::from(count) * UNIFORM_STRIDE_BYTES;
        let buffer = gpu.buffer(label, bytes, BufferUsages::UNIFORM | BufferUsages::COPY_DST)?;
        Ok(Self { buffer, count, size: size_of::<T>() as u64 })
    }

    /// Passes of these numbers.
    pub(crate) fn of_passes(gpu: &Gpu, label: &str, passes: &[SandPass]) -> Result<Self, GpuError> {
        let uniforms = Self::new::<SandPass>(gpu, label, u32::try_from(passes.len()).unwrap_or(u32::MAX))?;
        uniforms.write(gpu, passes);
        Ok(uniforms)
    }

    /// Fills the first ones.
    pub(crate) fn write<T: bytemuck::Pod>(&self, gpu: &Gpu, values: &[T]) {
        let stride = usize::try_from(UNIFORM_STRIDE_BYTES).unwrap_or(size_of::<T>());
        let mut bytes = vec![0; values.len() * stride];
        for (slot, value) in bytes.chunks_exact_mut(stride).zip(values) {
            slot[..size_of::<T>()].copy_from_slice(bytemuck::bytes_of(value));
        }
        gpu.queue.write_buffer(&self.buffer, 0, &bytes);
    }

    /// One of them as a resource.
    pub(crate) fn binding(&self, index: u32) -> BindingResource<'_> {
        BindingResource::Buffer(wgpu::BufferBinding {
            buffer: &self.buffer,
            offset: u64::from(index) * UNIFORM_STRIDE_BYTES,
            size: std::num::NonZeroU64::new(self.size),
        })
    }
}

/// Cells that an invocation does: one on a GPU; on a processor, where starting an invocation costs more than the work on
/// a cell, as many as there are rows in a tile.
fn rows(gpu: &Gpu) -> u32 {
    if gpu.adapter().is_software { 16 } else { 1 }
}

/// Invocations that do every cell of a bed.
pub(crate) fn invocations(gpu: &Gpu, lattice: Lattice) -> [u32; 2] {
    let [nx, ny] = lattice.size().map(narrow);
    [nx, ny / rows(gpu)]
}

/// A pipeline that several jobs share.
#[derive(Clone, Debug)]
pub(crate) struct Kernel(Arc<ComputePipeline>);

impl Kernel {
    /// The entry point of a shader file.
    pub(crate) fn load(gpu: &Gpu, file: &str, entry: &str) -> Result<Self, GpuError> {
        let shader = Shader::load(gpu, file)?;
        let constants = [("SAND_ROWS", f64::from(rows(gpu)))];
        ComputePipeline::new(gpu, &shader, entry, &constants).map(|pipeline| Self(Arc::new(pipeline)))
    }

    /// Bind groups of the numbers of each step; they serve all kernels.
    pub(crate) fn bind_steps(&self, gpu: &Gpu, steps: &Uniforms) -> Result<Vec<BindGroup>, GpuError> {
        (0..steps.count).map(|slot| self.0.bind(gpu, 0, &[("sand", steps.binding(slot))])).collect()
    }

    /// A dispatch of the kernel on these buffers.
    pub(crate) fn job(
        &self,
        gpu: &Gpu,
        invocations: [u32; 2],
        buffers: &[(&str, &Buffer)],
        pass: Option<BindingResource<'_>>,
    ) -> Result<Job, GpuError> {
        let resources: Vec<_> = buffers.iter().map(|(name, buffer)| (*name, buffer.as_entire_binding())).collect();
        let pass = pass.map(|pass| self.0.bind(gpu, 2, &[("sand_pass", pass)])).transpose()?;
        let [x, y] = invocations;
        Ok(Job {
            pipeline: Arc::clone(&self.0),
            buffers: self.0.bind(gpu, 1, &resources)?,
            pass,
            invocations: [x, y, 1],
        })
    }
}

/// A dispatch ready to be recorded.
#[derive(Debug)]
pub(crate) struct Job {
    pipeline: Arc<ComputePipeline>,
    buffers: BindGroup,
    pass: Option<BindGroup>,
    invocations: [u32; 3],
}

impl Job {
    /// Records it for a step.
    pub(crate) fn record(&self, pass: &mut ComputePass<'_>, step: &BindGroup) {
        pass.set_bind_group(0, step, &[]);
        pass.set_bind_group(1, &self.buffers, &[]);
        if let Some(numbers) = &self.pass {
            pass.set_bind_group(2, numbers, &[]);
        }
        self.pipeline.dispatch(pass, self.invocations);
    }
}

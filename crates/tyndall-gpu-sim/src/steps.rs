//! Batches of steps: their numbers go to the device first, then one command buffer does them all.

use tyndall_dunes::Lattice;
use tyndall_gpu::wgpu::{self, BindGroup, ComputePass, SubmissionIndex};
use tyndall_gpu::{Gpu, GpuError};

use crate::gpu_data::Sand;
use crate::job::{Kernel, Uniforms};

/// Most steps of a submission.
const MOST_STEPS: u32 = 32;
/// Cells times steps of a submission: some 10 ms on a GPU.
const CELL_STEPS: u64 = 1 << 25;
/// The same on an adapter that is a processor: some 100 ms.
const CELL_STEPS_ON_CPU: u64 = 1 << 20;

/// Numbers of the steps of a submission, and the last submission.
#[derive(Debug)]
pub(crate) struct Steps {
    numbers: Uniforms,
    groups: Vec<BindGroup>,
    batch: u32,
    last: Option<SubmissionIndex>,
}

impl Steps {
    /// For a bed of this size; any kernel of the automaton will do.
    pub(crate) fn new(gpu: &Gpu, lattice: Lattice, kernel: &Kernel) -> Result<Self, GpuError> {
        let most = if gpu.adapter().is_software { CELL_STEPS_ON_CPU } else { CELL_STEPS };
        let fit = u32::try_from(most / lattice.cells() as u64).unwrap_or(MOST_STEPS);
        let batch = fit.clamp(1, MOST_STEPS);
        let numbers = Uniforms::new::<Sand>(gpu, "numbers of the steps", batch)?;
        let groups = kernel.bind_steps(gpu, &numbers)?;
        Ok(Self { numbers, groups, batch, last: None })
    }

    /// Starts `count` steps from `first` on; `numbers` are those of a step, `record` its dispatches. Two submissions at
    /// most are under way. Gives back the steps that were started, and what stopped them.
    pub(crate) fn run(
        &mut self,
        gpu: &Gpu,
        steps: (u32, u32),
        numbers: impl Fn(u32) -> Sand,
        record: impl Fn(u32, &mut ComputePass<'_>, &BindGroup),
    ) -> (u32, Result<(), GpuError>) {
        let (first, count) = steps;
        let mut done = 0;
        while done < count {
            let batch = self.batch.min(count - done);
            let range = (0..batch).map(|index| first.wrapping_add(done).wrapping_add(index));
            let numbers: Vec<Sand> = range.clone().map(&numbers).collect();
            let submitted = gpu.validated("steps of sand", |device| {
                self.numbers.write(gpu, &numbers);
                let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
                let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
                for (step, group) in range.zip(&self.groups) {
                    record(step, &mut pass, group);
                }
                drop(pass);
                gpu.queue.submit([encoder.finish()])
            });
            let waited = submitted.and_then(|now| self.last.replace(now).map_or(Ok(()), |before| gpu.wait(before)));
            if let Err(error) = waited {
                return (done, Err(error));
            }
            done += batch;
        }
        (done, Ok(()))
    }

    /// Waits for the last submission.
    pub(crate) fn wait(&mut self, gpu: &Gpu) -> Result<(), GpuError> {
        self.last.take().map_or(Ok(()), |last| gpu.wait(last))
    }
}

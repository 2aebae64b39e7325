//! The ripple automaton on a device. WGSL: `shaders/dunes/ripples.wgsl`.

use tyndall_dunes::ripples::{LEE_REACH_CELLS, RippleBed};
use tyndall_dunes::{Lattice, SandDevice, SandSimulation as _};
use tyndall_gpu::{Buffer, Gpu, GpuError};

use crate::GpuSimError;
use crate::bed::{Grids, fill, read};
use crate::gpu_data::{Ripples, Sand, SandPass};
use crate::job::{Job, Kernel, Uniforms, invocations};
use crate::steps::Steps;

/// A bed of ripples on a device.
#[derive(Debug)]
pub struct GpuRipples {
    gpu: Gpu,
    /// Rule, wind and seed; its heights are those of the last [`SandDevice::write`].
    host: RippleBed,
    step: u32,
    rule: Buffer,
    heights: Buffer,
    /// Copies of the bed that receive the hops of odd and even steps.
    copies: [Buffer; 2],
    shadow: Vec<Job>,
    /// Of even and odd steps.
    hops: [Job; 2],
    creeps: [Job; 2],
    steps: Steps,
}

impl GpuRipples {
    /// The bed, brought to the device.
    ///
    /// # Errors
    /// [`GpuSimError::TooLarge`] when the device cannot hold the bed, [`GpuSimError::Gpu`] when it refuses.
    pub fn new(gpu: &Gpu, bed: &RippleBed) -> Result<Self, GpuSimError> {
        let lattice = bed.lattice();
        let grids = Grids::new(gpu, lattice)?;
        let heights = grids.make("ripple heights")?;
        let copies = [grids.make("copy of even steps")?, grids.make("copy of odd steps")?];
        let lines = [grids.make("shadow lines")?, grids.make("shadow lines, last pass")?];
        let rule = gpu.uniform("ripple rule", &Ripples::from(bed.rule()))?;
        let size = invocations(gpu, lattice);
        let hop = Kernel::load(gpu, "dunes/ripples.wgsl", "ripples_hop")?;
        let creep = Kernel::load(gpu, "dunes/ripples.wgsl", "ripples_creep")?;
        let (shadow, line) = shadow_jobs(gpu, lattice, LEE_REACH_CELLS, &heights, &lines)?;
        let hops = |copy: &Buffer| {
            let buffers =
                [("ripples", &rule), ("ripples_before", &heights), ("ripples_line", line), ("ripples_landed", copy)];
            hop.job(gpu, size, &buffers, None)
        };
        let creeps = |copy: &Buffer, next: &Buffer| {
            let buffers =
                [("ripples", &rule), ("ripples_moved", copy), ("ripples_after", &heights), ("ripples_copy", next)];
            creep.job(gpu, size, &buffers, None)
        };
        let [even, odd] = &copies;
        let mut ripples = Self {
            gpu: gpu.clone(),
            host: bed.clone(),
            step: bed.steps_done(),
            shadow,
            hops: [hops(even)?, hops(odd)?],
            creeps: [creeps(even, odd)?, creeps(odd, even)?],
            steps: Steps::new(gpu, lattice, &hop)?,
            rule,
            heights,
            copies,
        };
        ripples.upload(bed);
        Ok(ripples)
    }

    /// Heights of the bed on the device: i32, quanta of 1/4096 cell over the mean, x runs fastest.
    pub fn heights(&self) -> &Buffer {
        &self.heights
    }

    /// Turns the wind for the steps to come.
    pub fn set_wind_deg(&mut self, angle_deg: f64) {
        self.host.set_wind_deg(angle_deg);
    }

    fn upload(&mut self, bed: &RippleBed) {
        for buffer in [&self.heights].into_iter().chain(&self.copies) {
            fill(&self.gpu, buffer, bed.heights());
        }
        fill(&self.gpu, &self.rule, &[Ripples::from(bed.rule())]);
        self.step = bed.steps_done();
        self.host = bed.clone();
    }
}

impl SandDevice for GpuRipples {
    type Host = RippleBed;
    type Error = GpuSimError;

    fn lattice(&self) -> Lattice {
        self.host.lattice()
    }

    fn steps_done(&self) -> u32 {
        self.step
    }

    fn run(&mut self, steps: u32) -> Result<(), GpuSimError> {
        let (host, rule) = (&self.host, *self.host.rule());
        let numbers = |step| {
            let [along_x, along_y] = host.hop_keys(step);
            Sand { fall: rule.lee_fall, ..Sand::new(host.lattice(), host.wind(), [along_x, along_y, 0, 0]) }
        };
        let (shadow, hops, creeps) = (&self.shadow, &self.hops, &self.creeps);
        let (done, result) = self.steps.run(&self.gpu, (self.step, steps), numbers, |step, pass, group| {
            let parity = (step & 1) as usize;
            if rule.saltates != 0 {
                let cast = if rule.lee_fall == 0 { &[][..] } else { shadow };
                for job in cast {
                    job.record(pass, group);
                }
                hops[parity].record(pass, group);
            }
            creeps[parity].record(pass, group);
        });
        self.step = self.step.wrapping_add(done);
        result.map_err(GpuSimError::from)
    }

    fn wait(&mut self) -> Result<(), GpuSimError> {
        Ok(self.steps.wait(&self.gpu)?)
    }

    fn read(&self) -> Result<RippleBed, GpuSimError> {
        let mut bed = self.host.clone();
        bed.set_state(&read(&self.gpu, &self.heights)?, self.step)?;
        Ok(bed)
    }

    fn write(&mut self, bed: &RippleBed) -> Result<(), GpuSimError> {
        if bed.lattice() == self.lattice() {
            self.upload(bed);
        } else {
            *self = Self::new(&self.gpu, bed)?;
        }
        Ok(())
    }
}

/// Passes of the wind's shadow over a bed, and which of the two grids has the lines in the end.
pub(crate) fn shadow_jobs<'a>(
    gpu: &Gpu,
    lattice: Lattice,
    reach_cells: i32,
    bed: &Buffer,
    lines: &'a [Buffer; 2],
) -> Result<(Vec<Job>, &'a Buffer), GpuError> {
    let kernel = Kernel::load(gpu, "dunes/shadow.wgsl", "sand_shadow")?;
    let passes = SandPass::of_shadow(reach_cells);
    let numbers = Uniforms::of_passes(gpu, "shadow passes", &passes)?;
    let mut jobs = Vec::with_capacity(passes.len());
    let (mut from, [mut to, mut other]) = (bed, lines.each_ref());
    for pass in 0..numbers.count {
        let buffers = [("sand_source", from), ("sand_line", to)];
        jobs.push(kernel.job(gpu, invocations(gpu, lattice), &buffers, Some(numbers.binding(pass)))?);
        from = to;
        (to, other) = (other, to);
    }
    Ok((jobs, other))
}

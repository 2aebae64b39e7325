//! The dune automaton on a device. WGSL: `shaders/dunes`.

use tyndall_dunes::slab::{
    DuneField, DuneModel, DuneState, PlantState, SHADOW_REACH_CELLS, SLOW_STEPS, SURROUNDINGS_CELLS,
};
use tyndall_dunes::{Edges, Lattice, Ledger, SandDevice, SandSimulation as _};
use tyndall_gpu::{Buffer, Gpu};

use crate::GpuSimError;
use crate::bed::{Grids, fill, read, storage};
use crate::gpu_data::{Dunes, Sand, SandPass, narrow};
use crate::job::{Job, Kernel, Uniforms, invocations};
use crate::ripples::shadow_jobs;
use crate::steps::Steps;

/// Words of the counts: entered, left and worn, 64 bits each.
const COUNT_WORDS: usize = 6;
/// Cells of a tile of the avalanche.
const TILE_CELLS: u64 = 16 * 16;

/// A field of dunes on a device.
#[derive(Debug)]
pub struct GpuDunes {
    gpu: Gpu,
    /// Rule, winds and all that steps do not change; the rest of it is that of the last [`SandDevice::write`].
    host: DuneField,
    step: u32,
    grids: DuneGrids,
    jobs: DuneJobs,
    steps: Steps,
}

/// What lies on the device.
#[derive(Debug)]
struct DuneGrids {
    rule: Buffer,
    heights: Buffer,
    bedrock: Buffer,
    means: Buffer,
    /// Cover, hardness and walls.
    ground: Buffer,
    /// Heights when plants were last looked at.
    heights_then: Buffer,
    /// Shadow lines; later in a step sites that look four cells far, and moves.
    lines: [Buffer; 2],
    sites: Buffer,
    /// By tile, the last pass with a move near.
    active: Buffer,
    counts: Buffer,
}

/// What a step does, in this order.
#[derive(Debug)]
struct DuneJobs {
    /// Every 16 steps.
    look_around: Vec<Job>,
    /// Every 16 steps with plants.
    grow: Job,
    shade: Vec<Job>,
    lift: Job,
    /// With open edges.
    let_in: Job,
    /// With rock that wears.
    wear: Job,
    /// Deciding and applying, pass by pass.
    slide: Vec<[Job; 2]>,
}

impl GpuDunes {
    /// The field, brought to the device.
    ///
    /// # Errors
    /// [`GpuSimError::Classic`] for the classic rule, [`GpuSimError::TooLarge`] when the device cannot hold the field,
    /// [`GpuSimError::Gpu`] when it refuses.
    pub fn new(gpu: &Gpu, field: &DuneField) -> Result<Self, GpuSimError> {
        check(field)?;
        let lattice = field.lattice();
        let grids = DuneGrids::new(gpu, field)?;
        let (jobs, lift) = DuneJobs::new(gpu, field, &grids)?;
        let steps = Steps::new(gpu, lattice, &lift)?;
        let mut dunes = Self { gpu: gpu.clone(), host: field.clone(), step: 0, grids, jobs, steps };
        dunes.upload(field);
        Ok(dunes)
    }

    /// Heights of the bed on the device: i32, quanta of 1/256 cell, x runs fastest.
    pub fn heights(&self) -> &Buffer {
        &self.grids.heights
    }

    /// Heights of what lies under the sand: i32, quanta of 1/256 cell, x runs fastest.
    pub fn bedrock(&self) -> &Buffer {
        &self.grids.bedrock
    }

    /// Sets the winds of the steps to come.
    pub fn set_winds(&mut self, winds: tyndall_dunes::wind::WindSchedule) {
        self.host.set_winds(winds);
    }

    fn upload(&mut self, field: &DuneField) {
        let (gpu, grids, state) = (&self.gpu, &self.grids, field.state());
        fill(gpu, &grids.rule, &[Dunes::from(field)]);
        fill(gpu, &grids.heights, &state.heights);
        fill(gpu, &grids.bedrock, &state.bedrock);
        fill(gpu, &grids.means, &state.means);
        fill(gpu, &grids.ground, &ground(field));
        if let Some(plants) = &state.plants {
            fill(gpu, &grids.heights_then, &plants.heights_then);
        }
        fill(gpu, &grids.counts, &[0_u32; COUNT_WORDS]);
        self.step = state.step;
        self.host = field.clone();
    }

    /// The ledger of the host and what crossed edges or wore since.
    fn ledger(&self) -> Result<Ledger, GpuSimError> {
        let words: Vec<u32> = read(&self.gpu, &self.grids.counts)?;
        let count = |place: usize| i64::from(words[place]) | i64::from(words[place + 1]) << 32;
        let (before, slab) = (self.host.ledger(), i64::from(self.host.rule().slab));
        Ok(Ledger {
            entered: before.entered + count(0) * slab,
            left: before.left + count(2) * slab,
            abraded: before.abraded + count(4),
            ..before
        })
    }
}

/// Whether the compute form has what the field does.
fn check(field: &DuneField) -> Result<(), GpuSimError> {
    if field.model() == DuneModel::Classic { Err(GpuSimError::Classic) } else { Ok(()) }
}

/// Cover, hardness and walls of each cell in one word.
fn ground(field: &DuneField) -> Vec<u32> {
    let (cover, walls) = (field.plant_cover(), field.walls());
    let hardness = field.rock().map(|rock| rock.hardness.as_slice());
    let byte = |grid: Option<&[u8]>, cell: usize| grid.map_or(0, |grid| u32::from(grid[cell]));
    let word = |cell| byte(cover, cell) | byte(hardness, cell) << 8 | byte(walls, cell) << 16;
    (0..field.lattice().cells()).map(word).collect()
}

impl DuneGrids {
    fn new(gpu: &Gpu, field: &DuneField) -> Result<Self, GpuSimError> {
        let lattice = field.lattice();
        let grids = Grids::new(gpu, lattice)?;
        Ok(Self {
            rule: gpu.uniform("dune rule", &Dunes::from(field))?,
            heights: grids.make("dune heights")?,
            bedrock: grids.make("bedrock")?,
            means: grids.make("mean heights")?,
            ground: grids.make("ground")?,
            heights_then: grids.make("heights at the last look")?,
            lines: [grids.make("shadow lines")?, grids.make("shadow lines, last pass")?],
            sites: grids.make("sites")?,
            active: storage(gpu, "active tiles", 4 * lattice.cells() as u64 / TILE_CELLS)?,
            counts: storage(gpu, "counts", 4 * COUNT_WORDS as u64)?,
        })
    }
}

impl DuneJobs {
    /// The jobs, and a kernel to bind the steps' numbers with.
    fn new(gpu: &Gpu, field: &DuneField, grids: &DuneGrids) -> Result<(Self, Kernel), GpuSimError> {
        let lattice = field.lattice();
        let size = invocations(gpu, lattice);
        let hop = [
            ("dunes", &grids.rule),
            ("dunes_sites", &grids.sites),
            ("dunes_ground", &grids.ground),
            ("dunes_bed", &grids.heights),
            ("dunes_counts", &grids.counts),
        ];
        let worn = [
            ("dunes", &grids.rule),
            ("dunes_sites", &grids.sites),
            ("dunes_ground", &grids.ground),
            ("dunes_heights", &grids.heights),
            ("dunes_rock", &grids.bedrock),
            ("dunes_counts", &grids.counts),
        ];
        let grown = [
            ("dunes", &grids.rule),
            ("dunes_heights", &grids.heights),
            ("dunes_then", &grids.heights_then),
            ("dunes_ground", &grids.ground),
        ];
        let border = [lattice.size().map(narrow).iter().sum(), 1];
        let lift = Kernel::load(gpu, "dunes/hop.wgsl", "dunes_lift")?;
        let jobs = Self {
            look_around: grids.look_around(gpu, lattice)?,
            grow: Kernel::load(gpu, "dunes/grow.wgsl", "dunes_grow")?.job(gpu, size, &grown, None)?,
            shade: grids.shade(gpu, lattice)?,
            lift: lift.job(gpu, size, &hop, None)?,
            let_in: Kernel::load(gpu, "dunes/hop.wgsl", "dunes_let_in")?.job(gpu, border, &hop, None)?,
            wear: Kernel::load(gpu, "dunes/wear.wgsl", "dunes_wear")?.job(gpu, size, &worn, None)?,
            slide: grids.slide(gpu, lattice, field.rule().slide_passes)?,
        };
        Ok((jobs, lift))
    }
}

impl DuneGrids {
    fn look_around(&self, gpu: &Gpu, lattice: Lattice) -> Result<Vec<Job>, GpuSimError> {
        let kernel = Kernel::load(gpu, "dunes/means.wgsl", "dunes_mean")?;
        let passes = SandPass::of_means(lattice, SURROUNDINGS_CELLS);
        let numbers = Uniforms::of_passes(gpu, "means", &passes)?;
        let job = |pass: usize, from, to| {
            let buffers = [("dunes_values", from), ("dunes_means", to)];
            kernel.job(gpu, passes[pass].stretches(lattice), &buffers, Some(numbers.binding(narrow(pass))))
        };
        // The first shadow line is not in use yet.
        let [rows, _] = &self.lines;
        Ok(vec![job(0, &self.heights, rows)?, job(1, rows, &self.means)?])
    }

    /// Shadow and sites.
    fn shade(&self, gpu: &Gpu, lattice: Lattice) -> Result<Vec<Job>, GpuSimError> {
        let size = invocations(gpu, lattice);
        let (mut jobs, line) = shadow_jobs(gpu, lattice, SHADOW_REACH_CELLS, &self.heights, &self.lines)?;
        // Four passes end in the second grid; the first is free again.
        let [near, _] = &self.lines;
        let classify = [
            ("dunes", &self.rule),
            ("dunes_heights", &self.heights),
            ("dunes_bedrock", &self.bedrock),
            ("dunes_means", &self.means),
            ("dunes_line", line),
            ("dunes_near", near),
        ];
        jobs.push(Kernel::load(gpu, "dunes/near.wgsl", "dunes_classify")?.job(gpu, size, &classify, None)?);
        let ahead = [("dunes_near", near), ("dunes_sites", &self.sites)];
        jobs.push(Kernel::load(gpu, "dunes/sites.wgsl", "dunes_look_ahead")?.job(gpu, size, &ahead, None)?);
        Ok(jobs)
    }

    fn slide(&self, gpu: &Gpu, lattice: Lattice, passes: u32) -> Result<Vec<[Job; 2]>, GpuSimError> {
        let size = invocations(gpu, lattice);
        let decide = Kernel::load(gpu, "dunes/slide_decide.wgsl", "dunes_slide_decide")?;
        let apply = Kernel::load(gpu, "dunes/slide_apply.wgsl", "dunes_slide_apply")?;
        let numbers: Vec<_> = (0..passes).map(SandPass::numbered).collect();
        let numbers = Uniforms::of_passes(gpu, "passes of sliding", &numbers)?;
        // Shadow lines are done with when sand slides.
        let [_, moves] = &self.lines;
        let decided = [
            ("dunes", &self.rule),
            ("dunes_heights", &self.heights),
            ("dunes_bedrock", &self.bedrock),
            ("dunes_ground", &self.ground),
            ("dunes_moves", moves),
            ("dunes_active", &self.active),
        ];
        let applied = [("dunes_moves", moves), ("dunes_active", &self.active), ("dunes_heights", &self.heights)];
        let jobs = (0..passes).map(|pass| {
            let number = || Some(numbers.binding(pass));
            Ok([decide.job(gpu, size, &decided, number())?, apply.job(gpu, size, &applied, number())?])
        });
        jobs.collect()
    }
}

impl SandDevice for GpuDunes {
    type Host = DuneField;
    type Error = GpuSimError;

    fn lattice(&self) -> Lattice {
        self.host.lattice()
    }

    fn steps_done(&self) -> u32 {
        self.step
    }

    fn run(&mut self, steps: u32) -> Result<(), GpuSimError> {
        let (host, jobs) = (&self.host, &self.jobs);
        let (has_plants, wears) = (host.plant_rule().is_some(), host.rock().is_some());
        let lets_in = host.edges() == Edges::Open && host.rule().inflow_65536 > 0;
        let numbers = |step| Sand::of_dunes(host, host.lattice(), step);
        let (done, result) = self.steps.run(&self.gpu, (self.step, steps), numbers, |step, pass, group| {
            let is_slow = step.is_multiple_of(SLOW_STEPS);
            let slow = jobs.look_around.iter().chain(has_plants.then_some(&jobs.grow)).filter(|_| is_slow);
            let moved = [Some(&jobs.lift), lets_in.then_some(&jobs.let_in), wears.then_some(&jobs.wear)];
            let quick = jobs.shade.iter().chain(moved.into_iter().flatten()).chain(jobs.slide.iter().flatten());
            slow.chain(quick).for_each(|job| job.record(pass, group));
        });
        self.step = self.step.wrapping_add(done);
        result.map_err(GpuSimError::from)
    }

    fn wait(&mut self) -> Result<(), GpuSimError> {
        Ok(self.steps.wait(&self.gpu)?)
    }

    fn read(&self) -> Result<DuneField, GpuSimError> {
        let (gpu, grids) = (&self.gpu, &self.grids);
        let plants = self.host.plant_rule().map(|_| -> Result<PlantState, GpuSimError> {
            let ground: Vec<u32> = read(gpu, &grids.ground)?;
            let cover = ground.into_iter().map(|word| word.to_le_bytes()[0]).collect();
            Ok(PlantState { cover, heights_then: read(gpu, &grids.heights_then)? })
        });
        let state = DuneState {
            step: self.step,
            heights: read(gpu, &grids.heights)?,
            bedrock: read(gpu, &grids.bedrock)?,
            means: read(gpu, &grids.means)?,
            plants: plants.transpose()?,
            ledger: self.ledger()?,
        };
        let mut field = self.host.clone();
        field.set_state(state)?;
        Ok(field)
    }

    fn write(&mut self, field: &DuneField) -> Result<(), GpuSimError> {
        check(field)?;
        let passes = |field: &DuneField| field.rule().slide_passes;
        if field.lattice() == self.lattice() && passes(field) == passes(&self.host) {
            self.upload(field);
        } else {
            *self = Self::new(&self.gpu, field)?;
        }
        Ok(())
    }
}

//! The table of diffuse light of all orders, for every sun. WGSL: `shaders/sky/orders_*.wgsl`.
//!
//! A GPU computes it itself; on a software adapter, which is the CPU, the Rust twin does the same work several times
//! faster. Either way it is made anew only for another medium, ground or quality, while the frame waits or beside the
//! frames ([`TableBuilding`]).

use std::sync::Arc;

use tyndall_core::table_store::TableStore;
use tyndall_gpu::wgpu::BufferUsages;
use tyndall_gpu::{Buffer, Gpu, Texture};
use tyndall_scattering::orders::{OrdersMethod, OrdersQuality};
use tyndall_scattering::{Atmosphere as Model, ScatteringError};

use super::building::{TableBuilding, TableProgress, Wake};
use super::gpu_data::{Atmosphere, Orders};
use super::orders_cpu::{CpuBuilder, Finished};
use super::orders_gpu::{GpuBuild, GpuBuilder};
use crate::RenderError;

/// Bytes of one spectrum in the table.
pub(super) const SPECTRUM_BYTES: usize = 32;

/// Rows of suns that a GPU adds to a table in each frame: in preview detail it takes five frames.
const ROWS_PER_FRAME: usize = 8;

/// What the table is to hold.
#[derive(Clone, Copy, Debug)]
pub struct OrdersRequest<'a> {
    /// The atmosphere and the ground.
    pub model: &'a Model,
    /// Sizes of the table; `None` for light that is scattered once.
    pub quality: Option<OrdersQuality>,
    /// Factor on the sun's light. It does not change the table.
    pub brightness: f64,
}

/// What a table follows from.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Wanted {
    /// The atmosphere under our sun.
    pub(super) atmosphere: Atmosphere,
    /// Sizes.
    pub(super) quality: OrdersQuality,
    /// Zenith cosine of the lowest sun.
    lowest_mu_sun: f32,
}

impl Wanted {
    /// From an atmosphere.
    pub(super) fn new(model: &Model, quality: OrdersQuality) -> Result<Self, ScatteringError> {
        let quality = quality.for_haze_of(model);
        let Orders { lowest_mu_sun, .. } = Orders::new(model, &quality, 1.0);
        Ok(Self { atmosphere: Atmosphere::new(model, 1.0)?, quality, lowest_mu_sun })
    }
}

/// The table, its uniform and what fills it.
#[derive(Debug)]
pub struct OrdersTable {
    pub(crate) uniform: Buffer,
    pub(crate) table: Buffer,
    building: TableBuilding,
    /// Whether the shaders make the table, or the Rust twin.
    by_shaders: bool,
    cpu: CpuBuilder,
    gpu: GpuBuilder,
    /// The table that a GPU is at.
    under_way: Option<GpuBuild>,
    holds: Option<Wanted>,
    progress: TableProgress,
    /// Counts the tables shown.
    version: u64,
}

impl OrdersTable {
    /// Pipelines and an empty table.
    ///
    /// # Errors
    /// When a shader is wrong or memory does not suffice.
    pub fn new(gpu: &Gpu) -> Result<Self, RenderError> {
        let usage = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        Ok(Self {
            uniform: gpu.buffer("orders", size_of::<Orders>() as u64, usage)?,
            table: table(gpu, SPECTRUM_BYTES)?,
            building: TableBuilding::Blocking,
            by_shaders: !gpu.adapter().is_software,
            cpu: CpuBuilder::default(),
            gpu: GpuBuilder::new(gpu)?,
            under_way: None,
            holds: None,
            progress: TableProgress::default(),
            version: 0,
        })
    }

    /// Chooses where tables of the CPU are kept between runs.
    pub fn set_store(&mut self, store: Option<Arc<dyn TableStore>>) {
        self.cpu.set_store(store);
    }

    /// Chooses when tables are made; those under way are dropped.
    pub fn set_building(&mut self, building: TableBuilding) {
        self.building = building;
        self.under_way = None;
        self.cpu.outdate();
    }

    /// Lets the shaders make the table on a software adapter too, for tests: there the Rust twin is faster.
    pub fn use_shaders(&mut self) {
        self.by_shaders = true;
    }

    /// How the table stands since the last update.
    #[must_use]
    pub fn progress(&self) -> TableProgress {
        self.progress
    }

    /// Counts the tables shown: what was made from the table is out of date when this number has changed.
    pub(super) fn version(&self) -> u64 {
        self.version
    }

    /// Brings the table up to date or closer to it; `columns` must be those of the atmosphere, filled by an earlier
    /// submission.
    ///
    /// # Errors
    /// When memory does not suffice, the device is lost, or the atmosphere does not have eight wavelengths.
    pub fn update(&mut self, gpu: &Gpu, columns: &Texture, request: &OrdersRequest<'_>) -> Result<(), RenderError> {
        let Some(quality) = request.quality else {
            (self.progress.building, self.progress.needs_frame) = (false, false);
            self.upload(gpu, request.model, &OrdersQuality::preview(), 0.0);
            return Ok(());
        };
        let wanted = Wanted::new(request.model, quality)?;
        match self.building.clone() {
            TableBuilding::Background(wake) if self.holds.is_some() => {
                self.advance(gpu, columns, (request.model, &wanted), &wake)?;
            }
            _ => self.fill(gpu, columns, request.model, &wanted)?,
        }
        self.upload_held(gpu, request, &wanted);
        Ok(())
    }

    /// Makes the table at once, unless it is there.
    fn fill(&mut self, gpu: &Gpu, columns: &Texture, model: &Model, wanted: &Wanted) -> Result<(), RenderError> {
        self.progress = TableProgress { last_ms: self.progress.last_ms, ..TableProgress::default() };
        if self.holds.as_ref() == Some(wanted) {
            return Ok(());
        }
        self.invalidate();
        if self.is_for_shaders(wanted) {
            self.fill_on_gpu(gpu, columns, model, &wanted.quality)
        } else {
            self.fill_on_cpu(gpu, model, &wanted.quality)
        }
    }

    /// Whether the shaders make this table; they do not know eight directions, which the CPU has in a moment.
    fn is_for_shaders(&self, wanted: &Wanted) -> bool {
        self.by_shaders && wanted.quality.method == OrdersMethod::Harmonics
    }

    /// Takes in what has been made meanwhile and sees to what is still missing.
    fn advance(
        &mut self,
        gpu: &Gpu,
        columns: &Texture,
        (model, wanted): (&Model, &Wanted),
        wake: &Wake,
    ) -> Result<(), RenderError> {
        if self.is_for_shaders(wanted) {
            self.advance_gpu(gpu, columns, (model, wanted))?;
        } else {
            self.under_way = None;
            if let Some(finished) = self.cpu.take() {
                self.show(gpu, finished)?;
            }
            if self.holds.as_ref() != Some(wanted) {
                self.cpu.request(model, wanted, wake);
            }
        }
        self.progress.building = self.holds.as_ref() != Some(wanted);
        self.progress.needs_frame = self.progress.building && self.under_way.is_some();
        self.progress.done = self.under_way.as_ref().map(GpuBuild::done);
        Ok(())
    }

    /// Submits some rows of the table under way, or of the one that is missing.
    fn advance_gpu(
        &mut self,
        gpu: &Gpu,
        columns: &Texture,
        (model, wanted): (&Model, &Wanted),
    ) -> Result<(), RenderError> {
        let mut build = match self.under_way.take() {
            Some(build) => build,
            None if self.holds.as_ref() == Some(wanted) => return Ok(()),
            None => GpuBuild::new(gpu, columns, model, wanted)?,
        };
        for _row in 0..ROWS_PER_FRAME {
            if build.step(gpu, &self.gpu)? {
                self.show_gpu(build);
                return Ok(());
            }
        }
        self.under_way = Some(build);
        Ok(())
    }

    /// Uploads a table of the CPU.
    fn show(&mut self, gpu: &Gpu, Finished { wanted, values, ms }: Finished) -> Result<(), RenderError> {
        self.table = table(gpu, values.len() * SPECTRUM_BYTES)?;
        gpu.queue.write_buffer(&self.table, 0, bytemuck::cast_slice(&values));
        self.hold(wanted, ms);
        Ok(())
    }

    fn show_gpu(&mut self, build: GpuBuild) {
        let wanted = build.wanted.clone();
        let (table, ms) = build.finish();
        self.table = table;
        self.hold(wanted, ms);
    }

    fn hold(&mut self, wanted: Wanted, ms: f64) {
        self.holds = Some(wanted);
        self.progress.last_ms = Some(ms);
        self.version += 1;
    }

    /// Uploads the uniform of the table that is shown: its sizes, with the coefficients of the medium of the frame.
    fn upload_held(&self, gpu: &Gpu, request: &OrdersRequest<'_>, wanted: &Wanted) {
        let held = self.holds.as_ref().unwrap_or(wanted);
        let mut uniform = Orders::new(request.model, &held.quality, request.brightness);
        uniform.lowest_mu_sun = held.lowest_mu_sun;
        gpu.queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&uniform));
    }

    /// Uploads the uniform that all passes read.
    pub fn upload(&self, gpu: &Gpu, model: &Model, quality: &OrdersQuality, brightness: f64) {
        gpu.queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&Orders::new(model, quality, brightness)));
    }

    /// Forgets what the table holds.
    pub fn invalidate(&mut self) {
        self.holds = None;
        self.under_way = None;
        self.cpu.outdate();
    }

    /// The table, for tests: two vectors per harmonic, as in `shaders/sky/orders.wgsl`.
    #[must_use]
    pub fn table(&self) -> &Buffer {
        &self.table
    }

    /// Fills the table with the Rust twin.
    ///
    /// # Errors
    /// When memory does not suffice or the atmosphere does not have eight wavelengths.
    pub fn fill_on_cpu(&mut self, gpu: &Gpu, model: &Model, quality: &OrdersQuality) -> Result<(), RenderError> {
        let finished = self.cpu.build(model, &Wanted::new(model, *quality)?)?;
        self.show(gpu, finished)
    }

    /// Fills the table with the shaders, in submissions of its own.
    ///
    /// # Errors
    /// When memory does not suffice or the device is lost.
    pub fn fill_on_gpu(
        &mut self,
        gpu: &Gpu,
        columns: &Texture,
        model: &Model,
        quality: &OrdersQuality,
    ) -> Result<(), RenderError> {
        let mut build = GpuBuild::new(gpu, columns, model, &Wanted::new(model, *quality)?)?;
        while !build.step(gpu, &self.gpu)? {}
        self.show_gpu(build);
        Ok(())
    }
}

/// An empty table.
pub(super) fn table(gpu: &Gpu, bytes: usize) -> Result<Buffer, RenderError> {
    let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC | BufferUsages::COPY_DST;
    Ok(gpu.buffer("orders table", bytes as u64, usage)?)
}

//! The table of diffuse light of all orders, for every sun. WGSL: `shaders/sky/orders_*.wgsl`.
//!
//! A GPU computes it itself; on a software adapter, which is the CPU, the Rust twin does the same work several times
//! faster. Either way it is made anew only for another medium, ground or quality.

use tyndall_gpu::wgpu::{self, BufferUsages};
use tyndall_gpu::{Buffer, ComputePipeline, Gpu, Shader, Texture};
use tyndall_scattering::Atmosphere as Model;
use tyndall_scattering::atmosphere::MEDIUM_COUNT;
use tyndall_scattering::column_table::ColumnTable;
use tyndall_scattering::march::Marcher;
use tyndall_scattering::medium::Profile;
use tyndall_scattering::orders::basis::harmonic_count;
use tyndall_scattering::orders::{OrdersQuality, SourceTable};

use super::gpu_data::{Atmosphere, Orders};
use crate::RenderError;

/// Bytes of one spectrum in the table.
const SPECTRUM_BYTES: usize = 32;

/// Suns of one submission, so that none keeps a slow device busy for long.
const SUNS_PER_SUBMISSION: u32 = 4;

/// Panels of the f64 march where the CPU makes the table.
const CPU_PANELS: usize = 8;

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

/// The table, its uniforms and the pipelines that fill it.
#[derive(Debug)]
pub struct OrdersTable {
    first: ComputePipeline,
    next: ComputePipeline,
    sum: ComputePipeline,
    tail: ComputePipeline,
    /// The atmosphere under our sun, whatever the scene's brightness.
    atmosphere: Buffer,
    pub(super) uniform: Buffer,
    pub(super) table: Buffer,
    holds: Option<(Atmosphere, OrdersQuality)>,
    /// The columns of the last atmosphere on the CPU.
    columns: Option<(Shape, ColumnTable)>,
}

/// Radius (m), altitude of the top (m) and density profiles: what columns follow from.
type Shape = (f64, f64, [Profile; MEDIUM_COUNT]);

impl OrdersTable {
    /// Pipelines and an empty table.
    ///
    /// # Errors
    /// When a shader is wrong or memory does not suffice.
    pub fn new(gpu: &Gpu) -> Result<Self, RenderError> {
        let pipeline = |name: &str, constants: &[(&str, f64)]| {
            ComputePipeline::new(gpu, &Shader::load(gpu, &format!("sky/{name}.wgsl"))?, name, constants)
        };
        let uniform =
            |label, bytes: usize| gpu.buffer(label, bytes as u64, BufferUsages::UNIFORM | BufferUsages::COPY_DST);
        Ok(Self {
            first: pipeline("orders_first", &[])?,
            next: pipeline("orders_next", &[])?,
            sum: pipeline("orders_sum", &[])?,
            tail: pipeline("orders_sum", &[("ORDERS_TAIL", 1.0)])?,
            atmosphere: uniform("atmosphere of the orders", size_of::<Atmosphere>())?,
            uniform: uniform("orders", size_of::<Orders>())?,
            table: table(gpu, SPECTRUM_BYTES)?,
            holds: None,
            columns: None,
        })
    }

    /// Brings the table up to date; `columns` must be those of the atmosphere, filled by an earlier submission.
    ///
    /// # Errors
    /// When memory does not suffice, the device is lost, or the atmosphere does not have eight wavelengths.
    pub fn update(&mut self, gpu: &Gpu, columns: &Texture, request: &OrdersRequest<'_>) -> Result<(), RenderError> {
        let (quality, brightness) =
            request.quality.map_or((OrdersQuality::preview(), 0.0), |q| (q, request.brightness));
        self.upload(gpu, request.model, &quality, brightness);
        let wanted = (Atmosphere::new(request.model, 1.0)?, quality);
        if request.quality.is_none() || self.holds == Some(wanted) {
            return Ok(());
        }
        self.holds = None;
        if gpu.adapter().is_software {
            self.fill_on_cpu(gpu, request.model, &quality)?;
        } else {
            self.fill_on_gpu(gpu, columns, request.model, &quality)?;
        }
        self.holds = Some(wanted);
        Ok(())
    }

    /// Uploads the uniform that all passes read.
    pub fn upload(&self, gpu: &Gpu, model: &Model, quality: &OrdersQuality, brightness: f64) {
        gpu.queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&Orders::new(model, quality, brightness)));
    }

    /// Forgets what the table holds.
    pub fn invalidate(&mut self) {
        self.holds = None;
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
        let marcher = self.marcher(model)?;
        let source = SourceTable::new(&marcher, quality);
        let values: Vec<[f32; 8]> =
            source.field().harmonics.iter().copied().chain(source.irradiance_beyond_first_nodes()).collect();
        self.table = table(gpu, values.len() * SPECTRUM_BYTES)?;
        gpu.queue.write_buffer(&self.table, 0, bytemuck::cast_slice(&values));
        Ok(())
    }

    /// The march of an atmosphere. Its columns do not depend on how much of each medium there is: they are kept while the
    /// profiles stay the same.
    fn marcher(&mut self, model: &Model) -> Result<Marcher, RenderError> {
        let shape = (model.planet_radius_m, model.top_altitude_m, model.media.each_ref().map(|medium| medium.profile));
        let kept = self.columns.take().filter(|(of, _)| *of == shape);
        let (_, columns) = self.columns.insert(kept.unwrap_or_else(|| (shape, ColumnTable::new(model))));
        let (atmosphere, coefficients) = (model.clone(), model.coefficients()?);
        Ok(Marcher { atmosphere, coefficients, columns: columns.clone(), panels: CPU_PANELS })
    }

    /// Fills the table with the shaders, in submissions of its own. [`OrdersTable::upload`] comes first.
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
        gpu.queue.write_buffer(&self.atmosphere, 0, bytemuck::bytes_of(&Atmosphere::new(model, 1.0)?));
        let harmonics = quality.suns() * quality.altitudes * harmonic_count(quality.degree);
        let bytes = (harmonics + quality.suns()) * SPECTRUM_BYTES;
        let (mut last, mut before) = (table(gpu, bytes)?, table(gpu, bytes)?);
        self.table = table(gpu, bytes)?;
        let suns = SunRows::new(gpu, quality)?;

        suns.submit(gpu, &self.first, &self.bindings(&[("column_table", columns.as_binding()), target(&last)]))?;
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("order 1") });
        // The irradiance of the first order has a table of its own.
        encoder.copy_buffer_to_buffer(&last, 0, &self.table, 0, (harmonics * SPECTRUM_BYTES) as u64);
        gpu.queue.submit([encoder.finish()]);
        for order in 2..=quality.orders.max(2) {
            std::mem::swap(&mut last, &mut before);
            let source = ("orders_source", before.as_entire_binding());
            suns.submit(gpu, &self.next, &self.bindings(&[source, target(&last)]))?;
            let pipeline = if order >= quality.orders { &self.tail } else { &self.sum };
            self.submit_sum(gpu, pipeline, (&before, &last), quality)?;
        }
        Ok(())
    }

    fn bindings<'a>(
        &'a self,
        more: &[(&'static str, wgpu::BindingResource<'a>)],
    ) -> Vec<(&'static str, wgpu::BindingResource<'a>)> {
        let common =
            [("atmosphere", self.atmosphere.as_entire_binding()), ("orders", self.uniform.as_entire_binding())];
        common.into_iter().chain(more.iter().cloned()).collect()
    }

    fn submit_sum(
        &self,
        gpu: &Gpu,
        pipeline: &ComputePipeline,
        (before, last): (&Buffer, &Buffer),
        quality: &OrdersQuality,
    ) -> Result<(), RenderError> {
        let resources = [
            ("orders", self.uniform.as_entire_binding()),
            ("orders_before", before.as_entire_binding()),
            ("orders_last", last.as_entire_binding()),
            ("orders_total", self.table.as_entire_binding()),
        ];
        let bindings = pipeline.bind(gpu, 0, &resources)?;
        let nodes = small(quality.suns() * (quality.altitudes + 1));
        submit(gpu, pipeline, &bindings, [nodes, 1, 1]);
        Ok(())
    }
}

/// The suns of the table in rows of [`SUNS_PER_SUBMISSION`].
struct SunRows {
    altitudes: u32,
    /// The first sun of each row, for the shaders, and the number of suns in it.
    rows: Vec<(Buffer, u32)>,
}

impl SunRows {
    fn new(gpu: &Gpu, quality: &OrdersQuality) -> Result<Self, RenderError> {
        let suns = small(quality.suns());
        let firsts = (0..suns).step_by(SUNS_PER_SUBMISSION as usize);
        let row = |first: u32| {
            let buffer = gpu.uniform("first sun", &[first, 0, 0, 0])?;
            Ok((buffer, SUNS_PER_SUBMISSION.min(suns - first)))
        };
        Ok(Self { altitudes: small(quality.altitudes), rows: firsts.map(row).collect::<Result<_, RenderError>>()? })
    }

    /// Runs a workgroup for each altitude and sun, a submission for each row.
    fn submit(
        &self,
        gpu: &Gpu,
        pipeline: &ComputePipeline,
        resources: &[(&str, wgpu::BindingResource<'_>)],
    ) -> Result<(), RenderError> {
        let threads = pipeline.workgroup_size()[0];
        for (first, count) in &self.rows {
            let mut resources = resources.to_vec();
            resources.push(("orders_first_sun", first.as_entire_binding()));
            let bindings = pipeline.bind(gpu, 0, &resources)?;
            submit(gpu, pipeline, &bindings, [self.altitudes * threads, *count, 1]);
        }
        Ok(())
    }
}

fn target(buffer: &Buffer) -> (&'static str, wgpu::BindingResource<'_>) {
    ("orders_target", buffer.as_entire_binding())
}

fn table(gpu: &Gpu, bytes: usize) -> Result<Buffer, RenderError> {
    let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC | BufferUsages::COPY_DST;
    Ok(gpu.buffer("orders table", bytes as u64, usage)?)
}

fn submit(gpu: &Gpu, pipeline: &ComputePipeline, bindings: &wgpu::BindGroup, invocations: [u32; 3]) {
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("orders") });
    let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
    pass.set_bind_group(0, bindings, &[]);
    pipeline.dispatch(&mut pass, invocations);
    drop(pass);
    gpu.queue.submit([encoder.finish()]);
}

#[expect(clippy::cast_possible_truncation, reason = "sizes of tables")]
fn small(count: usize) -> u32 {
    count as u32
}

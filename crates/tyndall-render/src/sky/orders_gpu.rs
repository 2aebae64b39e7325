//! The orders table made by the GPU in small submissions, which a caller may spread over frames.

use std::time::Instant;

use tyndall_gpu::wgpu::{self, TextureFormat, TextureUsages};
use tyndall_gpu::{Buffer, ComputePipeline, Gpu, Shader, Texture, TextureDesc};
use tyndall_scattering::Atmosphere as Model;
use tyndall_scattering::orders::OrdersQuality;
use tyndall_scattering::orders::basis::harmonic_count;

use super::gpu_data::{Atmosphere, Orders};
use super::orders::{SPECTRUM_BYTES, Wanted, table};
use crate::RenderError;

/// Suns of one submission, so that none keeps a slow device busy for long.
const SUNS_PER_SUBMISSION: u32 = 4;

/// Pipelines of the orders.
#[derive(Debug)]
pub(super) struct GpuBuilder {
    first: ComputePipeline,
    next: ComputePipeline,
    sum: ComputePipeline,
    tail: ComputePipeline,
}

impl GpuBuilder {
    pub(super) fn new(gpu: &Gpu) -> Result<Self, RenderError> {
        let pipeline = |name: &str, constants: &[(&str, f64)]| {
            ComputePipeline::new(gpu, &Shader::load(gpu, &format!("sky/{name}.wgsl"))?, name, constants)
        };
        Ok(Self {
            first: pipeline("orders_first", &[])?,
            next: pipeline("orders_next", &[])?,
            sum: pipeline("orders_sum", &[])?,
            tail: pipeline("orders_sum", &[("ORDERS_TAIL", 1.0)])?,
        })
    }
}

/// A table under way: order after order, in rows of suns.
#[derive(Debug)]
pub(super) struct GpuBuild {
    pub(super) wanted: Wanted,
    /// The atmosphere under our sun, whatever the scene's brightness.
    atmosphere: Buffer,
    uniform: Buffer,
    /// A copy: the frames that follow may be of another atmosphere.
    columns: Texture,
    last: Buffer,
    before: Buffer,
    total: Buffer,
    suns: SunRows,
    /// The order that comes next, from 1, and its row.
    order: usize,
    row: usize,
    started: Instant,
}

impl GpuBuild {
    /// Prepares a table from the columns of the same atmosphere, filled by an earlier submission.
    pub(super) fn new(gpu: &Gpu, columns: &Texture, model: &Model, wanted: &Wanted) -> Result<Self, RenderError> {
        let (quality, wanted) = (wanted.quality, wanted.clone());
        let harmonics = quality.suns() * quality.altitudes * harmonic_count(quality.degree);
        let bytes = (harmonics + quality.suns()) * SPECTRUM_BYTES;
        Ok(Self {
            wanted,
            atmosphere: gpu.uniform("atmosphere of the orders", &Atmosphere::new(model, 1.0)?)?,
            uniform: gpu.uniform("orders under way", &Orders::new(model, &quality, 1.0))?,
            columns: copy_of(gpu, columns)?,
            last: table(gpu, bytes)?,
            before: table(gpu, bytes)?,
            total: table(gpu, bytes)?,
            suns: SunRows::new(gpu, &quality)?,
            order: 1,
            row: 0,
            started: Instant::now(),
        })
    }

    /// Submits the next row; whether the table is complete.
    pub(super) fn step(&mut self, gpu: &Gpu, pipelines: &GpuBuilder) -> Result<bool, RenderError> {
        if self.row == 0 && self.order > 1 {
            std::mem::swap(&mut self.last, &mut self.before);
        }
        let target = ("orders_target", self.last.as_entire_binding());
        if self.order == 1 {
            let source = ("column_table", self.columns.as_binding());
            self.suns.submit(gpu, &pipelines.first, self.row, &self.bindings([source, target]))?;
        } else {
            let source = ("orders_source", self.before.as_entire_binding());
            self.suns.submit(gpu, &pipelines.next, self.row, &self.bindings([source, target]))?;
        }
        self.row += 1;
        if self.row < self.suns.rows.len() {
            return Ok(false);
        }
        self.end_order(gpu, pipelines)?;
        (self.row, self.order) = (0, self.order + 1);
        Ok(self.order > self.orders())
    }

    /// Share of the work that is done.
    pub(super) fn done(&self) -> f32 {
        let rows = self.suns.rows.len();
        ((self.order - 1) * rows + self.row) as f32 / (self.orders() * rows) as f32
    }

    /// The table and the time since the start (ms).
    pub(super) fn finish(self) -> (Buffer, f64) {
        (self.total, self.started.elapsed().as_secs_f64() * 1e3)
    }

    fn orders(&self) -> usize {
        self.wanted.quality.orders.max(2)
    }

    /// Adds the order that is complete to the sum, and to the last one all that follow.
    fn end_order(&self, gpu: &Gpu, pipelines: &GpuBuilder) -> Result<(), RenderError> {
        let quality = &self.wanted.quality;
        if self.order == 1 {
            let desc = wgpu::CommandEncoderDescriptor { label: Some("order 1") };
            let mut encoder = gpu.device.create_command_encoder(&desc);
            let harmonics = quality.suns() * quality.altitudes * harmonic_count(quality.degree);
            // The irradiance of the first order has a table of its own.
            encoder.copy_buffer_to_buffer(&self.last, 0, &self.total, 0, (harmonics * SPECTRUM_BYTES) as u64);
            gpu.queue.submit([encoder.finish()]);
            return Ok(());
        }
        let pipeline = if self.order >= self.orders() { &pipelines.tail } else { &pipelines.sum };
        let resources = [
            ("orders", self.uniform.as_entire_binding()),
            ("orders_before", self.before.as_entire_binding()),
            ("orders_last", self.last.as_entire_binding()),
            ("orders_total", self.total.as_entire_binding()),
        ];
        let bindings = pipeline.bind(gpu, 0, &resources)?;
        submit(gpu, pipeline, &bindings, [small(quality.suns() * (quality.altitudes + 1)), 1, 1]);
        Ok(())
    }

    fn bindings<'a>(
        &'a self,
        more: [(&'static str, wgpu::BindingResource<'a>); 2],
    ) -> Vec<(&'static str, wgpu::BindingResource<'a>)> {
        let common =
            [("atmosphere", self.atmosphere.as_entire_binding()), ("orders", self.uniform.as_entire_binding())];
        common.into_iter().chain(more).collect()
    }
}

/// The suns of the table in rows of [`SUNS_PER_SUBMISSION`].
#[derive(Debug)]
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

    /// Runs a workgroup for each altitude and sun of a row.
    fn submit(
        &self,
        gpu: &Gpu,
        pipeline: &ComputePipeline,
        row: usize,
        resources: &[(&str, wgpu::BindingResource<'_>)],
    ) -> Result<(), RenderError> {
        let (first, count) = &self.rows[row];
        let mut resources = resources.to_vec();
        resources.push(("orders_first_sun", first.as_entire_binding()));
        let bindings = pipeline.bind(gpu, 0, &resources)?;
        submit(gpu, pipeline, &bindings, [self.altitudes * pipeline.workgroup_size()[0], *count, 1]);
        Ok(())
    }
}

fn copy_of(gpu: &Gpu, columns: &Texture) -> Result<Texture, RenderError> {
    let usage = TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST;
    let desc = TextureDesc::new_2d("columns of the orders", columns.size_px(), TextureFormat::Rgba32Float, usage);
    let copy = gpu.texture(&desc)?;
    let desc = wgpu::CommandEncoderDescriptor { label: Some("columns of the orders") };
    let mut encoder = gpu.device.create_command_encoder(&desc);
    encoder.copy_texture_to_texture(columns.as_image_copy(), copy.as_image_copy(), columns.size());
    gpu.queue.submit([encoder.finish()]);
    Ok(copy)
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

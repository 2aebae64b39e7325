//! Sand in the air over crests, drawn over the frame. WGSL: `shaders/desert/blowing.wgsl`.
//!
//! Columns of air follow from bed, wind and light ([`tyndall_dunes::blowing`]) when one of them changes. Each pixel marches
//! through them; nothing is made or drawn without a wind that lifts sand.
//!
//! Not done: blowing sand does not dim the sun for the sand below it, and light is scattered once.

use tyndall_dunes::blowing::{BlownColumn, SandWind, blown_columns, light_heights_cells};
use tyndall_gpu::wgpu::{self, BufferUsages};
use tyndall_gpu::{Buffer, Gpu, PassTimer, RenderPipeline, RenderPipelineDesc, Shader, Texture};
use tyndall_scene::Scene;

use super::bed::{Bed, mip_levels};
use super::gpu_data::Blowing;
use super::streaks::streak_tile;
use super::textures::{half_levels, sampler, streak_texture};
use crate::clouds::copy_of_frame;
use crate::clouds::lamp::Lamp;
use crate::{FrameTarget, RenderError, RendererConfig};

/// Standard deviation of the logistic distribution with scale 1.
const LOGISTIC_DEVIATION: f64 = 1.813_799_364_234_217_8;

/// Scales over the mean height of a column above which there is nothing to see: 1/150 of it.
const SCALES_SEEN: f32 = 5.0;

/// What columns are made for: the bed's revision, the wind's speed and the direction to the lamp.
type ColumnsKey = (u64, f64, [f64; 3]);

/// The pipeline, and the columns of the last wind.
#[derive(Debug)]
pub(super) struct BlowingRenderer {
    pipeline: RenderPipeline,
    uniform: Buffer,
    streaks: Texture,
    sampler: wgpu::Sampler,
    columns: Option<(ColumnsKey, Option<Columns>)>,
    behind: Option<Texture>,
}

/// Columns on the GPU.
#[derive(Debug)]
struct Columns {
    texture: Texture,
    /// Level (m) that their heights count from, highest sand, lowest bed.
    levels_m: [f32; 3],
}

/// Bind groups of a frame but for that of the sand in the air.
pub(super) type Surroundings = [wgpu::BindGroup; 3];

impl BlowingRenderer {
    pub(super) fn new(gpu: &Gpu, config: RendererConfig) -> Result<Self, RenderError> {
        let pipeline = RenderPipeline::new(
            gpu,
            &Shader::load(gpu, "desert/blowing_view.wgsl")?,
            &RenderPipelineDesc {
                label: "blowing sand",
                vertex: "blowing_vertex",
                fragment: "blowing_fragment",
                targets: &[config.frame_format().into()],
                depth: None,
                primitive: wgpu::PrimitiveState::default(),
                constants: &[],
            },
        )?;
        let bytes = size_of::<Blowing>() as u64;
        Ok(Self {
            pipeline,
            uniform: gpu.buffer("blowing sand", bytes, BufferUsages::STORAGE | BufferUsages::COPY_DST)?,
            streaks: streak_texture(gpu, &streak_tile())?,
            sampler: sampler(gpu, wgpu::AddressMode::Repeat),
            columns: None,
            behind: None,
        })
    }

    /// Makes the columns of a scene with a bed of a revision; whether there is any sand in the air.
    pub(super) fn prepare(
        &mut self,
        gpu: &Gpu,
        scene: &Scene,
        (revision, bed): (u64, &Bed),
        lamp: Lamp,
    ) -> Result<bool, RenderError> {
        let wind = SandWind { toward_deg: bed.wind_toward_deg, speed_m_per_s: scene.sand.wind_m_s };
        let key = (revision, wind.speed_m_per_s, lamp.direction);
        if self.columns.as_ref().is_none_or(|(held, _)| *held != key) {
            self.columns = Some((key, columns(gpu, bed, wind, lamp.direction)?));
        }
        let Some((_, Some(columns))) = &self.columns else { return Ok(false) };
        let uniform = Blowing::new(scene, wind.toward_deg, columns.levels_m);
        gpu.queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&uniform));
        Ok(true)
    }

    /// The pipeline, to bind what it reads of others.
    pub(super) fn pipeline(&self) -> &RenderPipeline {
        &self.pipeline
    }

    /// Records the sand over what the target's frame shows.
    pub(super) fn record(
        &mut self,
        gpu: &Gpu,
        (encoder, timer): (&mut wgpu::CommandEncoder, &mut PassTimer),
        (surroundings, desert, bed_sampler): (&Surroundings, &Buffer, &wgpu::Sampler),
        target: &FrameTarget,
    ) -> Result<(), RenderError> {
        let Some((_, Some(columns))) = &self.columns else { return Ok(()) };
        let behind = copy_of_frame(gpu, &mut self.behind, target)?;
        let own = [
            ("desert", desert.as_entire_binding()),
            ("blowing_sampler", wgpu::BindingResource::Sampler(bed_sampler)),
            ("blowing", self.uniform.as_entire_binding()),
            ("blowing_columns", columns.texture.as_binding()),
            ("blowing_streaks", self.streaks.as_binding()),
            ("blowing_repeated", wgpu::BindingResource::Sampler(&self.sampler)),
            ("blowing_behind", behind.as_binding()),
            ("blowing_depth", target.depth.as_binding()),
        ];
        let own = self.pipeline.bind(gpu, 2, &own)?;
        encoder.copy_texture_to_texture(target.frame.as_image_copy(), behind.as_image_copy(), behind.size());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("blowing sand"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: target.frame.view(),
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store },
            })],
            timestamp_writes: timer.render_writes("blowing sand"),
            ..Default::default()
        });
        pass.set_pipeline(self.pipeline.raw());
        let [sky, frame, shade] = surroundings;
        for (index, group) in (0..).zip([sky, frame, &own, shade]) {
            pass.set_bind_group(index, group, &[]);
        }
        pass.draw(0..3, 0..1);
        Ok(())
    }
}

/// Columns of a wind over a bed in the light of a lamp; `None` when no sand is in the air.
#[expect(clippy::cast_possible_truncation, reason = "textures hold less than f32")]
fn columns(gpu: &Gpu, bed: &Bed, wind: SandWind, lamp: [f64; 3]) -> Result<Option<Columns>, RenderError> {
    let cover: Vec<f32> = bed.ripples.iter().map(|ripple| ripple[3]).collect();
    let sand = (&bed.heights, &cover[..]);
    let Some(columns) = blown_columns(sand, bed.cell_m, bed.edges, wind)? else { return Ok(None) };
    let [east, north, up] = lamp;
    let (toward_deg, rise) = (north.atan2(east).to_degrees(), up.max(0.0) / east.hypot(north).max(1e-3));
    let lit = light_heights_cells(&bed.heights, bed.edges, toward_deg, rise)?;
    let base_m = (bed.cell_m * bed.heights.mean_cells()) as f32;
    let cells = (columns.iter().zip(&lit).enumerate())
        .map(|(index, (column, lit))| moments(column, lit * bed.cell_m as f32, base_m, bed.inside_cell(index)));
    let (mut top_m, cell_m) = (f32::MIN, bed.cell_m as f32);
    let floor_m = cell_m * bed.heights.heights().iter().fold(f32::MAX, |low, &height| low.min(height));
    let levels: Vec<Vec<[f32; 4]>> = mip_levels(
        cells.collect(),
        bed.heights.size(),
        |moments: [f32; 5], factor| moments.map(|part| factor * part),
        |a, b| std::array::from_fn(|part| a[part] + b[part]),
    )
    .iter()
    .map(|level| level.iter().map(|cell| texel(*cell)).collect())
    .collect();
    for level in &levels {
        for [depth, height_m, scale_m, _] in level {
            top_m = if *depth > 1e-6 { top_m.max(height_m + SCALES_SEEN * scale_m) } else { top_m };
        }
    }
    let texture = half_levels(gpu, "sand in the air", bed.heights.size(), &levels)?;
    Ok(Some(Columns { texture, levels_m: [base_m, base_m + top_m, floor_m] }))
}

/// Weight of a column without sand in the mean height of several.
const LEAST_WEIGHT: f32 = 1e-6;

/// What of a column may be averaged: depth; weight, and the weight times height, its square and height of the light.
fn moments(column: &BlownColumn, lit_m: f32, base_m: f32, inside: f32) -> [f32; 5] {
    let depth = inside * column.depth;
    let weight = depth + LEAST_WEIGHT;
    let height_m = column.height_m - base_m;
    // Far below every ray, but a half float.
    let lit_m = (lit_m - base_m).max(-1000.0);
    [depth, weight * height_m, weight * (height_m * height_m + column.variance_m2), weight * lit_m, weight]
}

/// A texel of averaged moments: depth, mean height, its scale, height of the light (m).
#[expect(clippy::cast_possible_truncation, reason = "a constant")]
fn texel([depth, first, second, lit, weight]: [f32; 5]) -> [f32; 4] {
    let height_m = first / weight;
    let variance_m2 = (second / weight - height_m * height_m).max(1e-3);
    [depth, height_m, variance_m2.sqrt() / LOGISTIC_DEVIATION as f32, lit / weight]
}

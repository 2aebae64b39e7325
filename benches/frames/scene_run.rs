//! One scene at one size.

use std::collections::BTreeMap;
use std::time::Instant;

use anyhow::Result;
use cpu_time::ProcessTime;
use tyndall_benches::Samples;
use tyndall_gpu::Gpu;
use tyndall_render::sky::{TableBuilding, Wake};
use tyndall_render::{FrameTarget, Renderer, RendererConfig};
use tyndall_scene::{OrdersDetail, Scene, SunPosition};

/// Software adapters compile at the first draw; two frames are enough to be past that.
const WARM_UP_FRAMES: u16 = 2;

/// How far the sun moves between two frames: enough for every table that depends on it.
const SUN_STEP_DEG: f64 = 0.05;

/// How much the aerosol changes between two frames, as a share: enough for every table.
const AEROSOL_STEP: f64 = 0.01;

/// GPU time of each pass, by name.
pub(crate) type PassTimes = BTreeMap<&'static str, Samples>;

/// Frames of the same kind.
#[derive(Debug)]
pub(crate) struct Series {
    /// From the call until the GPU has finished.
    pub(crate) wall: Samples,
    /// Of all threads of the process, which on a software adapter is the time of the adapter too.
    pub(crate) cpu: Samples,
    /// On the GPU's own clock; a pass that not every frame has is told of where it ran.
    pub(crate) passes: PassTimes,
}

/// What was measured.
#[derive(Debug)]
pub(crate) struct SceneRun {
    /// First frame of a new renderer: pipelines, textures, tables and the driver's own compilation included.
    pub(crate) first_ms: f64,
    /// A frame of an old renderer for which every table has to be filled.
    pub(crate) first_tables_ms: f64,
    /// Nothing changes.
    pub(crate) still: Series,
    /// The sun moves, so that the tables that depend on it are filled for each frame.
    pub(crate) moving: Series,
    /// The aerosol changes in every frame, in preview detail; the frame waits for its tables.
    pub(crate) air_waiting: Series,
    /// The same while the slow table is made beside the frames, as the app does.
    pub(crate) air: Series,
}

impl SceneRun {
    pub(crate) fn measure(
        gpu: &Gpu,
        scene: &Scene,
        size_px: [u32; 2],
        (frames, only_still): (u16, bool),
    ) -> Result<Self> {
        let config = RendererConfig::default();
        let started = Instant::now();
        let mut renderer = Renderer::new(gpu, config)?;
        let mut target = FrameTarget::new(gpu, size_px, config)?;
        draw(gpu, &mut renderer, &mut target, scene)?;
        let first_ms = 1e3 * started.elapsed().as_secs_f64();

        for _ in 0..WARM_UP_FRAMES {
            draw(gpu, &mut renderer, &mut target, scene)?;
        }
        renderer.invalidate_tables();
        let first_tables_ms = draw(gpu, &mut renderer, &mut target, scene)?;
        let still = series(gpu, &mut renderer, &mut target, (0..frames).map(|_| scene.clone()))?;
        let changes = if only_still { 0 } else { frames };
        let moving = series(gpu, &mut renderer, &mut target, (0..changes).map(|frame| moved(scene, frame)))?;
        let air_waiting = series(gpu, &mut renderer, &mut target, (0..changes).map(|frame| hazed(scene, frame)))?;
        renderer.set_table_building(TableBuilding::Background(Wake::new(|| {})));
        let air = series(gpu, &mut renderer, &mut target, (0..changes).map(|frame| hazed(scene, frame)))?;
        Ok(Self { first_ms, first_tables_ms, still, moving, air_waiting, air })
    }
}

/// The scene with its sun moved towards the zenith, or down where it stands high.
fn moved(scene: &Scene, frame: u16) -> Scene {
    let mut scene = scene.clone();
    let step_deg = if scene.sun.elevation_deg > 45.0 { -SUN_STEP_DEG } else { SUN_STEP_DEG };
    scene.sun.position = SunPosition::Angles;
    scene.sun.elevation_deg += step_deg * f64::from(frame + 1);
    scene
}

/// The scene with more aerosol, as while a slider is dragged.
fn hazed(scene: &Scene, frame: u16) -> Scene {
    let mut scene = scene.clone();
    scene.sky.orders_detail = OrdersDetail::Preview;
    scene.atmosphere.aerosol_optical_depth *= 1.0 + AEROSOL_STEP * f64::from(frame + 1);
    scene
}

fn series(
    gpu: &Gpu,
    renderer: &mut Renderer,
    target: &mut FrameTarget,
    scenes: impl Iterator<Item = Scene>,
) -> Result<Series> {
    let (mut wall_ms, mut cpu_ms) = (Vec::new(), Vec::new());
    let mut passes: BTreeMap<&'static str, Vec<f64>> = BTreeMap::new();
    for scene in scenes {
        let started = ProcessTime::now();
        wall_ms.push(draw(gpu, renderer, target, &scene)?);
        cpu_ms.push(1e3 * started.elapsed().as_secs_f64());
        for timing in renderer.timings(gpu)? {
            passes.entry(timing.name).or_default().push(timing.ms);
        }
    }
    let passes = passes.into_iter().map(|(name, times_ms)| (name, times_ms.into_iter().collect())).collect();
    Ok(Series { wall: wall_ms.into_iter().collect(), cpu: cpu_ms.into_iter().collect(), passes })
}

/// Draws one frame and waits for it; milliseconds.
fn draw(gpu: &Gpu, renderer: &mut Renderer, target: &mut FrameTarget, scene: &Scene) -> Result<f64> {
    let started = Instant::now();
    let submission = renderer.render(gpu, scene, target)?;
    gpu.wait(submission)?;
    gpu.check()?;
    Ok(1e3 * started.elapsed().as_secs_f64())
}

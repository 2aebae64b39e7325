//! Sand that moves while it is watched: what a picture needs of a field, and pictures of it one after the other.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex};
use std::time::{Duration, Instant};

use anyhow::{Result, ensure};
use rayon::ThreadPoolBuilder;
use tyndall_benches::{Samples, measure};
use tyndall_dunes::presets::dune_presets;
use tyndall_dunes::{DesertInputs, DesertSimulation, Side};
use tyndall_gpu::{AdapterChoice, Gpu, GpuOptions};
use tyndall_render::desert::bed::Bed;
use tyndall_render::sky::{TableBuilding, Wake};
use tyndall_render::{FrameTarget, Renderer, RendererConfig};
use tyndall_scene::{DesertKind, Orders, Scene};

use crate::{Case, Effort};

/// Name of [`beds`].
pub(crate) const BEDS: &str = "bed of a picture, 512 x 512";
/// Name of [`pictures`].
pub(crate) const PICTURES: &str = "playing sand, 512 x 512";

/// Steps before the first picture, and from one to the next.
const FIRST_STEPS: u32 = 200;
const STEPS: u32 = 4;

/// Longest that a picture may take.
const PATIENCE: Duration = Duration::from_mins(1);

/// Barchans under a low sun.
fn barchans(effort: Effort) -> Scene {
    let mut scene = Scene::default();
    scene.desert.kind = DesertKind::Dunes;
    scene.desert.steps = FIRST_STEPS;
    if let Some(preset) = dune_presets().into_iter().find(|preset| preset.name == "barchan") {
        (scene.dunes, scene.dune_wind) = (preset.dunes, preset.winds);
    }
    scene.dunes.side = if effort.samples == 1 { Side::Cells64 } else { Side::Cells512 };
    (scene.sun.elevation_deg, scene.camera.altitude_m, scene.camera.pitch_deg) = (12.0, 30.0, -15.0);
    scene.sky.orders = Orders::Single;
    scene
}

/// On one thread, as beside the frames of a small computer.
pub(crate) fn beds(effort: Effort) -> Result<Case> {
    let params = barchans(effort).dune_params();
    let params = params.ok_or_else(|| anyhow::anyhow!("the scene has no dunes"))?;
    let mut desert = DesertSimulation::cold(&params, &DesertInputs::default())?;
    desert.advance(FIRST_STEPS);
    let count = effort.samples.min(7);
    let pool = ThreadPoolBuilder::new().num_threads(1).build()?;
    let ways = pool.install(|| {
        let exact = ("at rest, 1 thread".to_owned(), measure(count, || Bed::new(&desert)));
        let quick = ("while it plays, 1 thread".to_owned(), measure(count, || Bed::quick(&desert)));
        vec![exact, quick]
    });
    Ok(Case { name: BEDS, ways })
}

/// Time from a picture to the next as the app draws them: the steps to the next one are made beside the frame that shows the
/// last ones.
pub(crate) fn pictures(effort: Effort) -> Result<Case> {
    let gpu = Gpu::open(&GpuOptions { adapter: AdapterChoice::Software, max_memory_bytes: None })?;
    let mut renderer = Renderer::new(&gpu, RendererConfig::default())?;
    let bell = Arc::new(Bell::default());
    let rung = Arc::clone(&bell);
    renderer.set_table_building(TableBuilding::Background(Wake::new(move || rung.ring())));
    renderer.set_sand_under_way(true);
    let mut scene = barchans(effort);
    let mut ways = Vec::new();
    for size_px in [[320, 180], [640, 360], [1280, 720]] {
        let mut target = FrameTarget::new(&gpu, size_px, RendererConfig::default())?;
        let next = || {
            gpu.wait(renderer.render(&gpu, &scene, &mut target)?)?;
            ensure!(bell.wait(PATIENCE), "no sand came");
            scene.desert.steps += STEPS;
            Ok(())
        };
        let name = format!("software adapter, {} x {}", size_px[0], size_px[1]);
        ways.push((name, played(effort, next)?));
    }
    Ok(Case { name: PICTURES, ways })
}

/// Times from one picture to the next.
fn played(effort: Effort, mut next: impl FnMut() -> Result<()>) -> Result<Samples> {
    // The first pictures wait for the field and for pipelines.
    (0..if effort.samples == 1 { 1 } else { 6 }).try_for_each(|_| next())?;
    let times = (0..2 * effort.samples).map(|_| {
        let started = Instant::now();
        next().map(|()| 1e3 * started.elapsed().as_secs_f64())
    });
    times.collect()
}

/// Rung by the thread that makes sand.
#[derive(Debug, Default)]
struct Bell {
    is_rung: AtomicBool,
    lock: Mutex<()>,
    heard: Condvar,
}

impl Bell {
    fn ring(&self) {
        self.is_rung.store(true, Ordering::Release);
        self.heard.notify_all();
    }

    /// Waits until it has been rung since the last time; false when it takes too long.
    fn wait(&self, patience: Duration) -> bool {
        let started = Instant::now();
        let mut guard = self.lock.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        while !self.is_rung.swap(false, Ordering::AcqRel) {
            if started.elapsed() > patience {
                return false;
            }
            // A ring between the look and the wait is heard at the next look.
            let waited = self.heard.wait_timeout(guard, Duration::from_millis(1));
            guard = waited.unwrap_or_else(std::sync::PoisonError::into_inner).0;
        }
        true
    }
}

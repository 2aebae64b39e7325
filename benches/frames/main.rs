//! Times frames: first, still, with a moving sun and with changing air, for each preset and size, on one adapter.

mod scene_run;

use anyhow::{Context as _, Result, ensure};
use clap::Parser;
use serde_json::{Map, Value, json};
use tyndall_benches::{CommonOptions, JsonLines, Samples, is_smoke, print_line};
use tyndall_gpu::{AdapterChoice, AdapterReport, Gpu, GpuOptions};
use tyndall_scene::presets;

use scene_run::{PassTimes, SceneRun, Series};

/// Frame timings of Tyndall.
#[derive(Debug, Parser)]
#[command(name = "frames")]
struct Options {
    /// auto, software, an index or a part of the adapter's name
    #[arg(long, default_value_t)]
    adapter: AdapterChoice,
    /// Frames of each series
    #[arg(long, default_value_t = 40, value_parser = clap::value_parser!(u16).range(1..))]
    frames: u16,
    /// Size of the frames (pixels), such as 640,480; may be given several times
    #[arg(long, value_name = "W,H", value_parser = parse_size_px)]
    size: Vec<[u32; 2]>,
    /// Sets a parameter of every scene; may be given several times
    #[arg(long, value_name = "GROUP.KEY=VALUE", value_parser = parse_setting)]
    set: Vec<(String, String)>,
    /// Only frames in which nothing changes; other columns show 0
    #[arg(long)]
    still: bool,
    #[command(flatten)]
    common: CommonOptions,
}

fn main() -> Result<()> {
    let options = Options::parse();
    let smoke = is_smoke(&options.common);
    let sizes_px = match (smoke, options.size.as_slice()) {
        (true, _) => &[[32, 24]],
        (false, []) => [[640, 480], [1280, 720]].as_slice(),
        (false, sizes_px) => sizes_px,
    };
    let frames = if smoke { 1 } else { options.frames };
    let gpu = Gpu::open(&GpuOptions { adapter: options.adapter, max_memory_bytes: None })?;
    let mut json_lines = JsonLines::create(options.common.json.as_deref())?;
    print_line(&heading(gpu.adapter(), frames))?;

    let mut presets = presets();
    presets.retain(|preset| preset.name.contains(&options.common.filter));
    ensure!(!presets.is_empty(), "no preset has {:?} in its name", options.common.filter);
    if smoke {
        presets.truncate(1);
    }
    for preset in presets {
        let mut scene = preset.load()?.scene;
        for (path, text) in &options.set {
            scene.set_text(path, text)?;
        }
        for size_px in sizes_px {
            let run = SceneRun::measure(&gpu, &scene, *size_px, (frames, options.still))?;
            print_line(&row(preset.name, *size_px, &run))?;
            print_line(&passes("still", &run.still.passes))?;
            print_line(&passes("sun moves", &run.moving.passes))?;
            print_line(&passes("air changes", &run.air.passes))?;
            json_lines.write(&figures(gpu.adapter(), preset.name, *size_px, &run))?;
        }
    }
    Ok(())
}

fn parse_size_px(text: &str) -> Result<[u32; 2]> {
    let (width, height) = text.split_once(',').context("a size is width,height in pixels")?;
    Ok([width.parse()?, height.parse()?])
}

fn parse_setting(text: &str) -> Result<(String, String)> {
    let (path, value) = text.split_once('=').context("a setting is group.parameter=value")?;
    Ok((path.to_owned(), value.to_owned()))
}

fn heading(adapter: &AdapterReport, frames: u16) -> String {
    format!(
        "{adapter}, {} CPU threads; milliseconds; series of {frames} frames\n{:<14} {:>9} | {:>7} {:>7} | {:>7} {:>7} {:>7} | \
         {:>9} {:>7} | {:>11} {:>7} | {:>11} {:>7}",
        std::thread::available_parallelism().map_or(1, usize::from),
        "scene",
        "size",
        "first",
        "tables",
        "still",
        "p95",
        "CPU",
        "sun moves",
        "p95",
        "air waiting",
        "p95",
        "air changes",
        "p95"
    )
}

fn row(name: &str, [width_px, height_px]: [u32; 2], run: &SceneRun) -> String {
    let size = format!("{width_px}x{height_px}");
    let (still, moving) = (&run.still.wall, &run.moving.wall);
    let (waiting, air) = (&run.air_waiting.wall, &run.air.wall);
    format!(
        "{name:<14} {size:>9} | {:>7.1} {:>7.1} | {:>7.2} {:>7.2} {:>7.1} | {:>9.2} {:>7.2} | {:>11.2} {:>7.2} | \
         {:>11.2} {:>7.2}",
        run.first_ms,
        run.first_tables_ms,
        still.median_ms(),
        still.p95_ms(),
        run.still.cpu.median_ms(),
        moving.median_ms(),
        moving.p95_ms(),
        waiting.median_ms(),
        waiting.p95_ms(),
        air.median_ms(),
        air.p95_ms()
    )
}

fn passes(series: &str, passes: &PassTimes) -> String {
    let texts: Vec<_> = passes.iter().map(|(name, samples)| format!("{name} {:.2}", samples.median_ms())).collect();
    let texts = if texts.is_empty() { "not timed by this adapter".to_owned() } else { texts.join(", ") };
    format!("    GPU, {series}: {texts}")
}

fn figures(adapter: &AdapterReport, name: &str, size_px: [u32; 2], run: &SceneRun) -> Value {
    json!({
        "bench": "frames",
        "version": env!("CARGO_PKG_VERSION"),
        "adapter": adapter.to_string(),
        "scene": name,
        "size_px": size_px,
        "first_ms": run.first_ms,
        "first_tables_ms": run.first_tables_ms,
        "still": series(&run.still),
        "sun_moves": series(&run.moving),
        "air_waiting": series(&run.air_waiting),
        "air_changes": series(&run.air),
    })
}

fn series(series: &Series) -> Value {
    let passes: Map<String, Value> =
        series.passes.iter().map(|(name, samples)| ((*name).to_owned(), statistics(samples))).collect();
    json!({ "wall": statistics(&series.wall), "cpu": statistics(&series.cpu), "passes": passes })
}

fn statistics(samples: &Samples) -> Value {
    json!({ "median_ms": samples.median_ms(), "p95_ms": samples.p95_ms() })
}

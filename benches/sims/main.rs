//! Times the CPU side: exact integrals against tables, sand automata, and work on one thread against all; and the sand
//! automata on every adapter.

mod clouds;
mod dunes;
mod gpu_sand;
mod lookups;
mod naive_clouds;
mod playing;
mod splats;
mod tables;

use anyhow::{Result, ensure};
use clap::Parser;
use serde_json::json;
use tyndall_benches::{CommonOptions, JsonLines, Samples, is_smoke, print_line};

/// CPU timings of Tyndall's light transport and simulations.
#[derive(Debug, Parser)]
#[command(name = "sims")]
struct Options {
    #[command(flatten)]
    common: CommonOptions,
}

/// How much is measured.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Effort {
    /// Times of each row.
    pub(crate) samples: usize,
    /// Calls of each time, for exact integrals.
    pub(crate) exact_calls: usize,
    /// Calls of each time, for lookups.
    pub(crate) lookup_calls: usize,
}

/// Ways of computing the same quantity; the first is what the others are compared with.
#[derive(Debug)]
pub(crate) struct Case {
    pub(crate) name: &'static str,
    /// Name of each way, and its times.
    pub(crate) ways: Vec<(String, Samples)>,
}

/// Measures one case.
type Run = fn(Effort) -> Result<Case>;

fn main() -> Result<()> {
    let options = Options::parse();
    let effort = if is_smoke(&options.common) {
        Effort { samples: 1, exact_calls: 1, lookup_calls: 1 }
    } else {
        Effort { samples: 15, exact_calls: 50, lookup_calls: 100_000 }
    };
    let mut json_lines = JsonLines::create(options.common.json.as_deref())?;
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    print_line(&format!("{threads} CPU threads; microseconds a call, and how many times faster than the first way"))?;
    print_line(&format!("{:<34} {:<28} {:>12} {:>12} {:>9}", "", "", "median", "p95", "ratio"))?;

    let runs: [(&str, Run); 20] = [
        (lookups::COLUMNS, lookups::columns),
        (lookups::DIRECTION, lookups::direction),
        (lookups::IRRADIANCE, lookups::irradiance),
        (tables::COLUMNS, tables::columns),
        (tables::SKY_VIEW, tables::sky_view),
        (tables::IRRADIANCE, tables::irradiance),
        (clouds::RULE, clouds::rule),
        (clouds::STEP, clouds::step),
        (clouds::FRAME, clouds::frame),
        (clouds::LARGE, clouds::large),
        (splats::LARGE, splats::large),
        (splats::MANY, splats::many),
        (dunes::RIPPLES, dunes::ripples),
        (dunes::DUNES, dunes::dunes),
        (dunes::GROWN_DUNES, dunes::grown_dunes),
        (playing::BEDS, playing::beds),
        (playing::PICTURES, playing::pictures),
        (gpu_sand::RIPPLES, gpu_sand::ripples),
        (gpu_sand::DUNES, gpu_sand::dunes),
        (gpu_sand::SMALL_DUNES, gpu_sand::small_dunes),
    ];
    let mut found = false;
    for (_, run) in runs.iter().filter(|(name, _)| name.contains(&options.common.filter)) {
        found = true;
        show(&mut json_lines, &run(effort)?)?;
    }
    ensure!(found, "nothing has {:?} in its name", options.common.filter);
    Ok(())
}

fn show(json_lines: &mut JsonLines, case: &Case) -> Result<()> {
    let reference_ms = case.ways.first().map_or(f64::NAN, |(_, samples)| samples.median_ms());
    for (way, samples) in &case.ways {
        let (median_us, p95_us) = (1e3 * samples.median_ms(), 1e3 * samples.p95_ms());
        let ratio = reference_ms / samples.median_ms();
        print_line(&format!("{:<34} {way:<28} {median_us:>12.3} {p95_us:>12.3} {ratio:>9.1}", case.name))?;
        json_lines.write(&json!({
            "bench": "sims",
            "version": env!("CARGO_PKG_VERSION"),
            "case": case.name,
            "way": way,
            "median_us": median_us,
            "p95_us": p95_us,
            "ratio": ratio,
        }))?;
    }
    Ok(())
}

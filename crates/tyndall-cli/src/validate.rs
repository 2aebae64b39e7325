//! `tyndall validate`: how far the tables are from Monte-Carlo on the user's own scene.

mod clouds;

use std::fmt::Write as _;

use clap::builder::RangedU64ValueParser;
use serde_json::{Value, json};
use tyndall_scattering::validate::{BandReport, Report, Statistics, ValidateOptions, validate};
use tyndall_scene::Scene;

use crate::interrupt::Interrupt;
use crate::probe::Detail;
use crate::progress::{Progress, ProgressFormat};
use crate::scene_arguments::SceneArguments;
use crate::{Exit, Failure, output};

pub use clouds::ValidateCloudsArguments;

const EXAMPLES: &str = "\
Examples:
  tyndall validate sky preset:noon
  tyndall validate sky dusk.toml --set sun.elevation_deg=-3 --paths 65536
  tyndall validate sky dusk.toml --json --limit-median 2

Both are computed in the same directions, dense at the horizon and around the sun:
the tables of the pictures, and random walks that use no table. Errors below the
noise are the walks', not the tables'.";

/// What `tyndall validate` takes.
#[derive(Clone, Debug, clap::Args)]
pub struct ValidateArguments {
    /// What to judge.
    #[command(subcommand)]
    pub what: Validate,
}

/// What to judge.
#[derive(Clone, Debug, clap::Subcommand)]
pub enum Validate {
    /// The sky of a scene: its atmosphere, sun and camera's altitude
    Sky(ValidateSkyArguments),
    /// The clouds of a scene: its camera and sun, before a black sky
    Clouds(ValidateCloudsArguments),
}

/// What `tyndall validate sky` takes.
#[derive(Clone, Debug, clap::Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{}", Exit::table()))]
pub struct ValidateSkyArguments {
    /// What to judge.
    #[command(flatten)]
    pub scene: SceneArguments,
    /// Directions of view
    #[arg(long, value_name = "N", default_value_t = ValidateOptions::default().directions,
        value_parser = RangedU64ValueParser::<usize>::new().range(1..=10_000))]
    pub directions: usize,
    /// Random walks in each direction; four times as many halve the noise
    #[arg(long, value_name = "N", default_value_t = ValidateOptions::default().paths,
        value_parser = RangedU64ValueParser::<u32>::new().range(32..=1_000_000_000))]
    pub paths: u32,
    /// Seed of the walks; the same seed gives the same bits
    #[arg(long, value_name = "SEED", default_value_t = 1)]
    pub seed: u64,
    /// The tables to judge
    #[arg(long, value_enum, default_value_t)]
    pub detail: Detail,
    /// Print the result as one JSON object
    #[arg(long)]
    pub json: bool,
    /// Fail with exit code 5 when the median error of spectral radiance is larger (per cent)
    #[arg(long, value_name = "PERCENT", allow_negative_numbers = true, value_parser = parse_percent)]
    pub limit_median: Option<f64>,
    /// The same for the 95th percentile (per cent)
    #[arg(long, value_name = "PERCENT", allow_negative_numbers = true, value_parser = parse_percent)]
    pub limit_p95: Option<f64>,
}

fn parse_percent(text: &str) -> Result<f64, String> {
    let value = text.parse::<f64>().ok().filter(|percent| (0.0..=1e6).contains(percent));
    value.ok_or_else(|| "a number of per cent from 0 to 1000000".to_owned())
}

/// Judges.
///
/// # Errors
/// Everything that can be wrong with scene and options, and an error above its limit.
pub fn run(arguments: &ValidateArguments) -> Result<(), Failure> {
    match &arguments.what {
        Validate::Sky(arguments) => sky(arguments),
        Validate::Clouds(arguments) => clouds::run(arguments),
    }
}

fn sky(arguments: &ValidateSkyArguments) -> Result<(), Failure> {
    let scene = arguments.scene.load()?.grounded();
    let interrupt = Interrupt::listen().map_err(Failure::Signals)?;
    let report = compare(arguments, &scene, &interrupt)?;
    let text = if arguments.json { format!("{}\n", to_json(&report)) } else { to_text(arguments, &scene, &report)? };
    output::print(&text)?;
    check_limits(arguments, &report)
}

fn compare(arguments: &ValidateSkyArguments, scene: &Scene, interrupt: &Interrupt) -> Result<Report, Failure> {
    let ValidateSkyArguments { directions, paths, seed, detail, .. } = *arguments;
    let options = ValidateOptions { directions, paths, seed, quality: detail.quality() };
    let mu_sun = scene.sun_direction()?.elevation_rad.sin();
    let progress = Progress::start(ProgressFormat::Human);
    let go_on = |done: f64| progress.share("comparing", done).is_ok() && interrupt.check().is_ok();
    let report = validate(&scene.model(), (scene.camera.altitude_m, mu_sun), &options, &go_on)?;
    match report {
        Some(report) => Ok(report),
        // Nothing but a signal says no.
        None => Err(interrupt.check().err().unwrap_or_else(|| Failure::Usage("the comparison was stopped".to_owned()))),
    }
}

fn check_limits(arguments: &ValidateSkyArguments, report: &Report) -> Result<(), Failure> {
    let Statistics { median_pct, p95_pct, .. } = report.whole().spectrum;
    let limits = [("median", median_pct, arguments.limit_median), ("95th percentile", p95_pct, arguments.limit_p95)];
    for (name, found, limit) in limits {
        if let Some(limit) = limit.filter(|limit| found > *limit) {
            return Err(Failure::OverLimit(format!("the {name} of the error is {found:.2} %; {limit} % are allowed")));
        }
    }
    Ok(())
}

fn to_text(arguments: &ValidateSkyArguments, scene: &Scene, report: &Report) -> Result<String, Failure> {
    let elevation_deg = scene.sun_direction()?.elevation_rad.to_degrees();
    let mut text = format!(
        "Tables against Monte-Carlo: {}, sun {elevation_deg:.2} deg high, observer at {} m\n\
         {} directions x {} wavelengths, {} paths a direction, seed {}; errors in %\n\n",
        arguments.scene.source.display(),
        scene.camera.altitude_m,
        report.rows.len(),
        report.wavelengths_nm.len(),
        arguments.paths,
        arguments.seed,
    );
    text += "spectral radiance  directions   median    95 %   worst    bias   noise\n";
    for band in &report.bands {
        text += &line(name(band), band.directions, &band.spectrum);
    }
    text += &line("luminance", report.whole().directions, &report.whole().luminance);
    if let Some((row, k)) = report.worst() {
        // Writing to a string cannot fail.
        let (direction, pair) = (&row.direction, row.spectrum[k]);
        let _ = write!(
            text,
            "\nworst: {:+.2} % at view zenith {:.2} deg, {:.1} deg from the sun's azimuth, {} nm\n       (tables {:.4e}, \
             Monte-Carlo {:.4e} +- {:.1e} W/m2/sr/nm)\n",
            pair.error_pct(),
            direction.view_zenith.to_degrees(),
            direction.azimuth.to_degrees(),
            report.wavelengths_nm[k],
            pair.table,
            pair.reference,
            pair.standard_error,
        );
    }
    Ok(text)
}

fn name(band: &BandReport) -> &'static str {
    band.band.map_or("all", tyndall_scattering::validate::Band::name)
}

fn line(name: &str, directions: usize, statistics: &Statistics) -> String {
    let Statistics { median_pct, p95_pct, worst_pct, bias_pct, noise_pct, .. } = statistics;
    format!(
        "{name:<18} {directions:>10} {median_pct:>8.2} {p95_pct:>7.2} {worst_pct:>7.2} {bias_pct:>+7.2} {noise_pct:>7.2}\n"
    )
}

fn to_json(report: &Report) -> Value {
    let bands: Vec<Value> = report
        .bands
        .iter()
        .map(|band| {
            json!({
                "band": name(band),
                "directions": band.directions,
                "spectral_radiance": statistics(&band.spectrum),
                "luminance": statistics(&band.luminance),
            })
        })
        .collect();
    let rows: Vec<Value> = report
        .rows
        .iter()
        .map(|row| {
            json!({
                "view_zenith_deg": row.direction.view_zenith.to_degrees(),
                "azimuth_deg": row.direction.azimuth.to_degrees(),
                "band": row.direction.band.name(),
                "tables_cd_m2": row.luminance.table,
                "monte_carlo_cd_m2": row.luminance.reference,
                "standard_error_cd_m2": row.luminance.standard_error,
                "error_pct": row.luminance.error_pct(),
                "single_fraction": row.single_share,
            })
        })
        .collect();
    json!({ "wavelengths_nm": report.wavelengths_nm, "bands": bands, "rows": rows })
}

fn statistics(statistics: &Statistics) -> Value {
    let Statistics { count, median_pct, p95_pct, worst_pct, bias_pct, noise_pct } = statistics;
    json!({
        "count": count,
        "median_pct": median_pct,
        "p95_pct": p95_pct,
        "worst_pct": worst_pct,
        "bias_pct": bias_pct,
        "noise_pct": noise_pct,
    })
}

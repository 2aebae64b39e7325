//! `tyndall validate clouds`: how far the picture of a scene's clouds is from random walks through the same cells.

use std::fmt::Write as _;

use clap::builder::RangedU64ValueParser;
use serde_json::{Value, json};
use tyndall_gpu::Gpu;
use tyndall_render::clouds::comparison::{CloudComparison, CloudVerdict};
use tyndall_render::clouds::reference::CloudAccuracy;
use tyndall_render::{FrameFormat, Renderer, RendererConfig};
use tyndall_scene::{Orders, Scene};

use crate::interrupt::Interrupt;
use crate::progress::{Progress, ProgressFormat};
use crate::scene_arguments::{DeviceArguments, SceneArguments};
use crate::values::parse_size_px;
use crate::{Exit, Failure, output};

const EXAMPLES: &str = "\
Examples:
  tyndall validate clouds preset:cumulus
  tyndall validate clouds known.toml --paths 256 --bin 2 --json

Both see the scene's clouds from its camera, lit by its sun alone, before a black
sky, without turbulence and without repetition. Bins of pixels are compared, so
that the noise of the walks stays small; PSNR and FLIP (0 to 1, what people see
at 67 pixels a degree) are of single pixels and have that noise in them.";

/// What `tyndall validate clouds` takes.
#[derive(Clone, Debug, clap::Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{}", Exit::table()))]
pub struct ValidateCloudsArguments {
    /// Whose clouds.
    #[command(flatten)]
    pub scene: SceneArguments,
    /// Size of the pictures in pixels
    #[arg(long, value_name = "WxH", value_parser = parse_size_px, default_value = "192x108")]
    pub size: [u32; 2],
    /// Random walks in each pixel; four times as many halve the noise
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = RangedU64ValueParser::<u32>::new().range(1..=1_000_000))]
    pub paths: u32,
    /// Seed of the walks; the same seed gives the same bits
    #[arg(long, value_name = "SEED", default_value_t = 1)]
    pub seed: u64,
    /// Side of the bins in which pictures are compared (px)
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = RangedU64ValueParser::<usize>::new().range(1..=64))]
    pub bin: usize,
    /// Print the result as one JSON object
    #[arg(long)]
    pub json: bool,
    /// What draws the picture.
    #[command(flatten)]
    pub device: DeviceArguments,
}

/// Judges.
///
/// # Errors
/// Everything that can be wrong with scene, options and device.
pub(super) fn run(arguments: &ValidateCloudsArguments) -> Result<(), Failure> {
    let mut scene = arguments.scene.load()?;
    let interrupt = Interrupt::listen().map_err(Failure::Signals)?;
    let progress = Progress::start(ProgressFormat::Human);
    let gpu = Gpu::open(&arguments.device.options())?;
    let config = RendererConfig { frame: FrameFormat::Float, ..RendererConfig::default() };
    let mut renderer = Renderer::new(&gpu, config)?;
    let mut rows = Vec::new();
    for orders in [Orders::Single, Orders::All] {
        scene.clouds.orders = orders;
        let accuracy = compare(arguments, &scene, (&gpu, &mut renderer), (&progress, &interrupt))?;
        rows.push((orders, accuracy));
    }
    output::print(&if arguments.json { format!("{}\n", to_json(&rows)) } else { to_text(arguments, &rows) })
}

fn compare(
    arguments: &ValidateCloudsArguments,
    scene: &Scene,
    drawing: (&Gpu, &mut Renderer),
    (progress, interrupt): (&Progress, &Interrupt),
) -> Result<CloudAccuracy, Failure> {
    let ValidateCloudsArguments { size, paths, seed, bin, .. } = *arguments;
    let comparison = CloudComparison { size_px: size, paths, seed, bin };
    let mut told = Ok(());
    let mut tell = |share: f64| {
        told = progress.share("walking at random", share).and_then(|()| interrupt.check());
        told.is_ok()
    };
    let verdict = comparison.run(drawing, scene, &mut tell)?;
    told?;
    let refused = match verdict {
        CloudVerdict::Judged(accuracy) => return Ok(accuracy),
        CloudVerdict::NoClouds => "the scene has no clouds; `clouds.kind` = \"automaton\" makes some",
        CloudVerdict::NoSunlight => "clouds are judged in sunlight, and sun.brightness = 0 puts it out",
        CloudVerdict::OutOfView | CloudVerdict::Stopped => "no cloud in sunlight is in the camera's view",
    };
    Err(Failure::Usage(refused.to_owned()))
}

fn to_json(rows: &[(Orders, CloudAccuracy)]) -> Value {
    let row = |(orders, found): &(Orders, CloudAccuracy)| {
        json!({
            "orders": orders.name(),
            "mean_ratio": found.mean_ratio,
            "relative_square": found.relative_square,
            "correlation": found.correlation,
            "psnr_db": found.psnr_db,
            "flip": found.flip,
            "noise": found.noise,
        })
    };
    rows.iter().map(row).collect()
}

fn to_text(arguments: &ValidateCloudsArguments, rows: &[(Orders, CloudAccuracy)]) -> String {
    let ([width_px, height_px], bin) = (arguments.size, arguments.bin);
    let mut text = format!(
        "Clouds against random walks: {}, {width_px} x {height_px} px, {} paths a pixel, seed {}, bins of {bin} x {bin}\n\n\
         orders  mean ratio  relMSE  correlation  PSNR (dB)    FLIP  noise of the mean\n",
        arguments.scene.source.display(),
        arguments.paths,
        arguments.seed,
    );
    for (orders, found) in rows {
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "{:<7} {:>10.4} {:>7.4} {:>12.4} {:>10.1} {:>7.4} {:>18.4}",
            orders.name(),
            found.mean_ratio,
            found.relative_square,
            found.correlation,
            found.psnr_db,
            found.flip,
            found.noise
        );
    }
    text
}

//! `tyndall hdri`: the light from all around the camera as an equirectangular file, and what is to be known about it.
//!
//! Beside the file lies a sidecar of the same name in JSON: where the sun stands, the lamp that replaces its disc, the
//! unit and the exposure. Row 0 is the zenith, the centre is east, columns go on to the south: as Blender maps a world
//! whose x is east and y north.

mod sidecar;
mod write;

use std::path::{Path, PathBuf};

use serde_json::json;
use tyndall_gpu::wgpu::DeviceType;
use tyndall_gpu::{Gpu, GpuError};
use tyndall_io::atomic::check_writable;
use tyndall_render::environment::{Environment, EnvironmentOptions, PANORAMA_WIDTH_MIN_PX};
use tyndall_render::{FrameFormat, FrameTarget, Renderer, RendererConfig};
use tyndall_scene::Scene;

use crate::interrupt::Interrupt;
use crate::light::{GroundName, PrimariesName, SunName, UnitName, convert_pixels};
use crate::progress::{Progress, ProgressFormat, Stage};
use crate::render::frame::twice;
use crate::scene_arguments::{DeviceArguments, SceneArguments};
use crate::{Exit, Failure};

use sidecar::Sidecar;
use write::HdriFormat;

const EXAMPLES: &str = "\
Examples:
  tyndall hdri preset:noon -o sky.exr
  tyndall hdri dusk.toml -o dusk.exr --width 4096 --sun lamp --ground black
  tyndall hdri dusk.toml -o dusk.exr --units cd/m2 --primaries acescg
  tyndall hdri preset:sunset -o sky.hdr --units exposed --sun none

In Blender: World > Surface > Background > Color > Environment Texture, and
the file; x is east, y north. Lower Render > Film > Exposure by the stops in
the sidecar. With --sun lamp add a Sun of the sidecar's rotation, strength,
color and angle.";

/// Widest panorama: twice the largest texture of common devices.
const WIDTH_MAX_PX: u32 = 32_768;

/// Draws with 32-bit floats: the sun's disc exceeds half floats.
const CONFIG: RendererConfig =
    RendererConfig { frame: FrameFormat::Float, picture: tyndall_render::PictureFormat::Eight };

/// What `tyndall hdri` takes.
#[derive(Clone, Debug, clap::Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{}", Exit::table()))]
pub struct HdriArguments {
    /// What to draw.
    #[command(flatten)]
    pub scene: SceneArguments,
    /// File of light, .exr or .hdr; the sidecar has the same name with the ending .json
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// Columns, an even number; half as many rows
    #[arg(long, value_name = "PIXELS", default_value_t = 2048, value_parser = parse_width_px)]
    pub width: u32,
    /// Unit of the numbers in the file
    #[arg(long, value_enum, value_name = "UNIT", default_value_t = UnitName::Blender)]
    pub units: UnitName,
    /// What becomes of the sun's disc
    #[arg(long, value_enum, value_name = "SUN", default_value_t = SunName::Disc)]
    pub sun: SunName,
    /// What lies below the horizon
    #[arg(long, value_enum, value_name = "GROUND", default_value_t = GroundName::True)]
    pub ground: GroundName,
    /// EXR with 16-bit floats: half the size, values above 65,504 are clamped
    #[arg(long)]
    pub half: bool,
    /// Primaries of the colours
    #[arg(long, value_enum, value_name = "SPACE", default_value_t = PrimariesName::Rec709)]
    pub primaries: PrimariesName,
    /// What draws it.
    #[command(flatten)]
    pub device: DeviceArguments,
    /// How to report progress
    #[arg(long, value_name = "READER", value_enum, default_value_t)]
    pub progress: ProgressFormat,
}

impl HdriArguments {
    fn options(&self) -> EnvironmentOptions {
        EnvironmentOptions { width_px: self.width, disc: self.sun == SunName::Disc, ground: self.ground.into() }
    }

    fn sidecar_path(&self) -> PathBuf {
        self.output.with_extension("json")
    }
}

/// An even number of columns.
fn parse_width_px(text: &str) -> Result<u32, String> {
    let width = text.trim().parse::<u32>().ok().filter(|width| width.is_multiple_of(2));
    width.filter(|width| (PANORAMA_WIDTH_MIN_PX..=WIDTH_MAX_PX).contains(width)).ok_or_else(|| {
        format!("a width is an even number from {PANORAMA_WIDTH_MIN_PX} to {WIDTH_MAX_PX} px, such as 2048")
    })
}

/// Writes the light and its sidecar.
///
/// # Errors
/// Everything that can be wrong with scene, options, device and file.
pub fn run(arguments: &HdriArguments) -> Result<(), Failure> {
    let mut progress = Progress::start(arguments.progress);
    let written = hdri(arguments, &mut progress);
    if let Err(failure) = &written {
        progress.fail(failure);
    }
    written
}

fn hdri(arguments: &HdriArguments, progress: &mut Progress) -> Result<(), Failure> {
    let format = HdriFormat::for_file(&arguments.output, arguments.half)?;
    let scene = arguments.scene.load()?;
    let sidecar_path = arguments.sidecar_path();
    check_writable(&arguments.output)?;
    check_writable(&sidecar_path)?;
    let interrupt = Interrupt::listen().map_err(Failure::Signals)?;
    let (mut light, adapter) = twice(
        || capture(arguments, &scene, progress, &interrupt),
        |failure| {
            progress.warn(&format!("{failure}; trying once more"));
        },
    )?;

    progress.stage(Stage::File)?;
    interrupt.check()?;
    let unit = arguments.units.at(light.ev100);
    let sidecar = Sidecar { arguments, scene: &scene, light: &light, unit }.to_json();
    convert_pixels(&mut light.rgba, unit, arguments.primaries.into());
    let written = write::write(arguments, format, (&scene, light, unit), &adapter, &interrupt)?;
    write::write_text(&sidecar_path, &format!("{sidecar:#}\n"))?;
    if written.clamped_pixels > 0 {
        let percent = 100.0 * written.clamped_luminance_share;
        progress.warn(&format!(
            "{} pixels are brighter than half floats can say and were clamped, {percent:.2} % of the light; without \
             --half it is kept, and --sun lamp gives it to a lamp",
            written.clamped_pixels
        ));
    }
    report(arguments, (&sidecar_path, sidecar), written.bytes, &adapter, progress)
}

/// Draws the panorama; also says on which adapter.
fn capture(
    arguments: &HdriArguments,
    scene: &Scene,
    progress: &Progress,
    interrupt: &Interrupt,
) -> Result<(Environment, String), Failure> {
    let stage = |stage: Stage| interrupt.check().and_then(|()| progress.stage(stage));
    stage(Stage::Device)?;
    let gpu = Gpu::open(&arguments.device.options())?;
    check_budget(&gpu, arguments.options().size_px()?)?;
    stage(Stage::Pipelines)?;
    let mut renderer = Renderer::new(&gpu, CONFIG)?;
    renderer.set_table_store(arguments.device.cache.store());
    stage(Stage::Frame)?;
    let light = renderer.capture_environment(&gpu, scene, arguments.options())?;
    gpu.check()?;
    Ok((light, gpu.adapter().name.clone()))
}

/// Refuses a panorama that does not fit into the memory budget.
fn check_budget(gpu: &Gpu, size_px: [u32; 2]) -> Result<(), GpuError> {
    let copies = match gpu.adapter().device_type {
        DeviceType::Cpu | DeviceType::IntegratedGpu => 3,
        DeviceType::DiscreteGpu | DeviceType::VirtualGpu | DeviceType::Other => 1,
    };
    let read_back = 16 * copies * u64::from(size_px[0]) * u64::from(size_px[1]);
    let needed_bytes = FrameTarget::bytes(size_px, CONFIG).saturating_add(read_back);
    let budget_bytes = gpu.max_memory_bytes();
    let free_bytes = budget_bytes.saturating_sub(gpu.used_memory_bytes());
    if needed_bytes <= free_bytes {
        return Ok(());
    }
    let what = format!("a panorama of {} x {} pixels", size_px[0], size_px[1]);
    Err(GpuError::OverBudget { what, needed_bytes, free_bytes, budget_bytes })
}

fn report(
    arguments: &HdriArguments,
    (sidecar_path, sidecar): (&Path, serde_json::Value),
    bytes: u64,
    adapter: &str,
    progress: &mut Progress,
) -> Result<(), Failure> {
    let (file, seconds) = (arguments.output.display(), progress.seconds());
    let [width_px, height_px] = arguments.options().size_px()?;
    let stops = sidecar["exposure"]["stops"].as_f64().unwrap_or(0.0);
    let sentence = format!(
        "{file} and {}: {width_px} x {height_px} px in {seconds:.1} s on {adapter}; exposure {stops:+.1} stops",
        sidecar_path.display()
    );
    let facts = json!({
        "file": file.to_string(),
        "sidecar_file": sidecar_path.display().to_string(),
        "seconds": seconds,
        "bytes": bytes,
        "adapter": adapter,
        "sidecar": sidecar,
    });
    progress.finish(&sentence, facts)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_are_even_numbers_that_a_picture_can_have() {
        for (text, width_px) in [("4", 4), ("2048", 2048), (" 32768 ", 32_768)] {
            assert_eq!(parse_width_px(text), Ok(width_px), "{text}");
        }
        for text in ["", "0", "2", "3", "2049", "32770", "-4", "1e3", "nan"] {
            assert!(parse_width_px(text).is_err_and(|sentence| sentence.contains("even number from 4")), "{text:?}");
        }
    }
}

//! `tyndall render`: from a scene to a picture file.
//!
//! Whatever can be refused is refused before the graphics device is opened: options, scene, settings, sizes, the place of
//! the file. Then the frame is drawn, on a second device if the first one is lost, and the file appears complete or not at
//! all. The same command on the same adapter gives the same bytes.

pub(crate) mod format;
pub(crate) mod frame;
mod frames;
pub(crate) mod header;
mod job;
pub(crate) mod memory;
mod reference;
mod sequence;
mod session;
pub(crate) mod source;
pub(crate) mod write;

use std::path::PathBuf;

use serde_json::json;
use tyndall_gpu::PassTiming;
use tyndall_io::atomic::check_writable;
use tyndall_scene::Scene;

use crate::interrupt::Interrupt;
use crate::progress::{Progress, ProgressFormat, Stage};
use crate::scene_arguments::{DeviceArguments, SceneArguments};
use crate::simulate::StartArguments;
use crate::values::parse_size_px;
use crate::{Exit, Failure};

pub use format::{Bits, CompressionName, FormatArguments, OutputFormat};
pub use frames::{FrameRange, Pace, frame_path, parse_frames, parse_rate, parse_sand_speed, scene_of_frame};
use job::Job;
use write::Written;

const EXAMPLES: &str = "\
Examples:
  tyndall render preset:noon -o noon.png
  tyndall render dusk.toml -o dusk.exr --size 3840x2160 --float
  tyndall render dusk.toml -o d.png --set sun.elevation_deg=2 --set film.tone_map=aces
  tyndall render dusk.toml -o d.exr --adapter software --max-memory 4G
  tyndall render dusk.toml -o truth.png --reference --paths 256 --size 320x180
  tyndall render clouds.toml -o clouds.npy --unit-sun
  tyndall render preset:cumulus -o 'sky-####.png' --frames 0-239 --fps 24 --speed 60
  tyndall render preset:barchans -o 'sand-####.png' --frames 0-239 --sand-speed 48
  tyndall render preset:barchans --state later.npz -o later.png

Units are in the names of the parameters (altitude_m, elevation_deg);
`tyndall params` lists them all. EXR holds the light of the scene, linear
Rec.709 in cd/m2, with depth in metres as Z; NPY the same light as an array
of rows, columns and three channels (red, green, blue; not luminance, which is
0.2126 R + 0.7152 G + 0.0722 B) in 32-bit floats. Compare one channel of it with
a grey picture of another program: a[:, :, 1], in 1/sr after --unit-sun. PNG and
JPEG hold the developed picture in sRGB.";

/// What `tyndall render` takes.
#[derive(Clone, Debug, clap::Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{}", Exit::table()))]
pub struct RenderArguments {
    /// What to draw.
    #[command(flatten)]
    pub scene: SceneArguments,
    /// Picture file; its ending decides the format: .png, .exr, .npy, .jpg
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// Size of the picture in pixels, in place of the scene's
    #[arg(long, value_name = "WxH", value_parser = parse_size_px)]
    pub size: Option<[u32; 2]>,
    /// Compute sky, ground and clouds by Monte-Carlo on the CPU, without tables and GPU: slow, for comparison
    #[arg(long)]
    pub reference: bool,
    /// Random walks a pixel of a reference picture; four times as many halve the noise
    #[arg(long, value_name = "N", default_value_t = 64, requires = "reference",
        value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub paths: u32,
    /// Seed of the walks; the same seed gives the same bits
    #[arg(long, value_name = "SEED", default_value_t = 1, requires = "reference")]
    pub seed: u64,
    /// Draw an animation: frames by number, as 1-48 or 0-240x10; `#` in the file's name is where the number goes
    #[arg(long, value_name = "RANGE", value_parser = parse_frames, conflicts_with = "reference")]
    pub frames: Option<FrameRange>,
    /// Frames in a second of the animation
    #[arg(long, value_name = "N", default_value_t = 24.0, value_parser = parse_rate, requires = "frames")]
    pub fps: f64,
    /// Seconds that pass for the scene's clouds in a second of the animation
    #[arg(long, value_name = "N", default_value_t = 60.0, value_parser = parse_rate, requires = "frames")]
    pub speed: f64,
    /// Steps that the wind makes on the scene's sand in a second of the animation; 30 unless given, and 0 in a scene with
    /// clouds, for which a step of the sand, some days, is a long time
    #[arg(long, value_name = "N", value_parser = parse_sand_speed, requires = "frames")]
    pub sand_speed: Option<f64>,
    /// Leave frames alone that are there already, whole and of the same scene
    #[arg(long, requires = "frames")]
    pub resume: bool,
    /// Where the simulation begins.
    #[command(flatten)]
    pub start: StartArguments,
    /// What draws it.
    #[command(flatten)]
    pub device: DeviceArguments,
    /// How to report progress
    #[arg(long, value_name = "READER", value_enum, default_value_t)]
    pub progress: ProgressFormat,
    /// Light over the sun's irradiance above the air, channel by channel, in place of cd/m2: what renderers give under a sun
    /// of irradiance 1; for EXR and NPY files
    #[arg(long, conflicts_with = "frames")]
    pub unit_sun: bool,
    /// How to store the picture.
    #[command(flatten)]
    pub format: FormatArguments,
}

/// Renders.
///
/// # Errors
/// Everything that can be wrong with scene, options, device and file.
pub fn run(arguments: &RenderArguments) -> Result<(), Failure> {
    let mut progress = Progress::start(arguments.progress);
    let rendered = render(arguments, &mut progress);
    if let Err(failure) = &rendered {
        progress.fail(failure);
    }
    rendered
}

fn render(arguments: &RenderArguments, progress: &mut Progress) -> Result<(), Failure> {
    let format = arguments.format.for_file(&arguments.output)?;
    let scene = scene_of(arguments)?;
    if let Some(range) = arguments.frames {
        return sequence::run(arguments, (range, &scene), format, progress);
    }
    let unit = unit_of(arguments, format, &scene)?;
    check_writable(&arguments.output)?;
    let interrupt = Interrupt::listen().map_err(Failure::Signals)?;
    let state = arguments.start.load(&scene, None, progress)?;
    let (state, scene) = (state.as_ref(), arguments.start.advanced(&scene, state.as_ref())?);
    arguments.start.check(&scene, state)?;
    let mut frame = if arguments.reference {
        reference::frame(&scene, format, (arguments.paths, arguments.seed), &interrupt, progress)?
    } else {
        let options = arguments.device.options();
        let cache = arguments.device.cache;
        let job = Job { scene: &scene, format, options: &options, cache, state, interrupt: &interrupt, progress };
        job.run().map_err(|failure| arguments.start.blame(failure))?
    };

    if let (Some(unit), frame::Pixels::Light(picture)) = (unit, &mut frame.pixels) {
        picture.rgba.iter_mut().for_each(|pixel| unit.iter().zip(pixel).for_each(|(unit, value)| *value /= unit));
    }
    progress.stage(Stage::File)?;
    interrupt.check()?;
    let metadata = header::metadata(&scene, state, &frame);
    let written = write::write(&arguments.output, &frame, format, &metadata, &interrupt)?;
    report(arguments, &scene, &frame, written, progress)
}

/// The scene with everything that the command line changes in it.
fn scene_of(arguments: &RenderArguments) -> Result<Scene, Failure> {
    let mut scene = arguments.scene.load()?;
    if let Some([width_px, height_px]) = arguments.size {
        scene.set("image.width_px", width_px.into())?;
        scene.set("image.height_px", height_px.into())?;
    }
    scene.check()?;
    Ok(scene)
}

/// What the picture's light is divided by: the sun's irradiance above the air (lx) in each channel.
fn unit_of(arguments: &RenderArguments, format: OutputFormat, scene: &Scene) -> Result<Option<[f32; 3]>, Failure> {
    if !arguments.unit_sun {
        return Ok(None);
    }
    if !matches!(format, OutputFormat::Exr(..) | OutputFormat::Npy) {
        let file = arguments.output.display();
        return Err(Failure::Usage(format!("--unit-sun concerns EXR and NPY files only, and {file} is none")));
    }
    let sun = tyndall_render::environment::sun_above_air(scene)?;
    if sun.iter().any(|channel| *channel <= 0.0) {
        return Err(Failure::Usage("--unit-sun needs a sun, and sun.brightness = 0 puts it out".to_owned()));
    }
    #[expect(clippy::cast_possible_truncation, reason = "pictures are f32")]
    Ok(Some(sun.map(|channel| channel as f32)))
}

fn report(
    arguments: &RenderArguments,
    scene: &Scene,
    frame: &frame::Frame,
    written: Written,
    progress: &mut Progress,
) -> Result<(), Failure> {
    if written.clamped_pixels > 0 {
        let (count, percent) = (written.clamped_pixels, 100.0 * written.clamped_luminance_share);
        progress.warn(&format!(
            "{count} pixels are brighter than half floats can say and were clamped, {percent:.2} % of the picture's \
             light; --float keeps it"
        ));
    }
    let (file, [width_px, height_px]) = (arguments.output.display(), frame.size_px);
    let seconds = progress.seconds();
    let sentence = format!("{file}: {width_px} x {height_px} px in {seconds:.1} s on {}", frame.adapter);
    progress.finish(
        &sentence,
        json!({
            "file": file.to_string(),
            "seconds": seconds,
            "bytes": written.bytes,
            "size_px": frame.size_px,
            "scene_hash": scene.hash().to_string(),
            "adapter": frame.adapter,
            "exposure_ev100": frame.ev100,
            "clamped_pixels": written.clamped_pixels,
            "clamped_luminance_share": written.clamped_luminance_share,
            "passes_ms": passes(&frame.passes),
        }),
    )
}

fn passes(timings: &[PassTiming]) -> serde_json::Map<String, serde_json::Value> {
    timings.iter().map(|timing| (timing.name.to_owned(), json!(timing.ms))).collect()
}

#[cfg(test)]
mod tests {
    use clap::Parser as _;

    use super::*;
    use crate::{Arguments, Subcommand};

    fn arguments(words: &[&str]) -> RenderArguments {
        let line = [&["tyndall", "render", "preset:noon", "-o", "noon.png"], words].concat();
        match Arguments::try_parse_from(line).unwrap().subcommand {
            Subcommand::Render(arguments) => arguments,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn settings_and_size_change_the_scene_and_nothing_else() {
        let plain = scene_of(&arguments(&[])).unwrap();
        let changed =
            scene_of(&arguments(&["--size", "64x32", "--set", "sun.elevation_deg=-3", "--set", "sun.disc=off"]));
        let differences = changed.unwrap().differences(&plain);
        let expected = ["sun.elevation_deg=-3.0", "sun.disc=false", "image.width_px=64", "image.height_px=32"];
        assert_eq!(differences, expected, "in the order of the groups");
    }

    #[test]
    fn the_last_of_two_settings_of_one_parameter_counts() {
        let scene = scene_of(&arguments(&["--set", "sun.elevation_deg=1", "--set", "sun.elevation_deg=2"])).unwrap();
        assert!((scene.sun.elevation_deg - 2.0).abs() < 1e-12, "{}", scene.sun.elevation_deg);
    }

    #[test]
    fn wrong_settings_are_refused_with_name_range_or_nearest_name() {
        for (words, part) in [
            (["--set", "sun.elevaton_deg=1"], "did you mean `sun.elevation_deg`?"),
            (["--set", "sun.elevation_deg=91"], "-90 to 90 deg"),
            (["--set", "sun.elevation_deg=nan"], "-90 to 90 deg"),
            (["--set", "film.tone_map=vivid"], "\"agx\""),
            (["--size", "60000x60000"], "`image.width_px` = 60000 px is outside 1 to 16384 px"),
            (["--size", "0x10"], "`image.width_px` = 0 px"),
        ] {
            let failure = scene_of(&arguments(&words)).expect_err("refused");
            assert!(failure.to_string().contains(part), "{words:?}: {failure}");
            assert_eq!(failure.exit(), Exit::Usage, "{words:?}");
        }
    }

    #[test]
    fn settings_that_do_not_fit_together_are_refused() {
        let words = ["--set", "atmosphere.top_altitude_km=20", "--set", "atmosphere.ozone_altitude_km=25"];
        let failure = scene_of(&arguments(&words)).expect_err("the ozone is above the atmosphere");
        assert!(failure.to_string().contains("lower the ozone"), "{failure}");
    }
}

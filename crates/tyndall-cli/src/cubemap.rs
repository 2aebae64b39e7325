//! `tyndall cubemap`: what is all around the camera as the six faces of a cube.
//!
//! Faces lie and are named as in cube textures of Direct3D, Vulkan and OpenGL: x east, y up, z north, each face seen from
//! inside. All are developed with one exposure, that of the scene's own picture.

mod layout;
mod write;

use std::path::{Path, PathBuf};

use serde_json::json;
use tyndall_core::ParamSet as _;
use tyndall_gpu::Gpu;
use tyndall_io::atomic::check_writable;
use tyndall_render::{CubeFace, FrameTarget, Renderer, View};
use tyndall_scene::{ExposureMode, Scene};

use crate::interrupt::Interrupt;
use crate::light::{GroundName, SunName, UnitName, convert_pixels};
use crate::progress::{Progress, ProgressFormat, Stage};
use crate::render::frame::{Pixels, config, read, twice, wait};
use crate::render::memory::check_budget;
use crate::render::{FormatArguments, OutputFormat};
use crate::scene_arguments::{DeviceArguments, SceneArguments};
use crate::{Exit, Failure};

pub use layout::Layout;

const EXAMPLES: &str = "\
Examples:
  tyndall cubemap preset:noon -o sky/                    six EXR files in a folder
  tyndall cubemap preset:noon -o sky.png --size 1024     sky_posx.png and so on
  tyndall cubemap dusk.toml -o sky.exr --layout cross-horizontal --float

Faces: posx east, negx west, posy zenith, negy nadir, posz north, negz south,
as Direct3D, Vulkan and OpenGL sample a cube with x east, y up, z north;
worlds in which -z is north look up (x, y, -z).";

/// Longest side of a face.
const SIZE_MAX_PX: u32 = 8192;

/// What `tyndall cubemap` takes.
#[derive(Clone, Debug, clap::Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{}", Exit::table()))]
pub struct CubemapArguments {
    /// What to draw.
    #[command(flatten)]
    pub scene: SceneArguments,
    /// A folder for six EXR files, which is made if need be; or a file, .exr, .png or .jpg
    #[arg(short, long, value_name = "PLACE")]
    pub output: PathBuf,
    /// How the faces lie
    #[arg(long, value_enum, value_name = "LAYOUT", default_value_t = Layout::Faces)]
    pub layout: Layout,
    /// Side of a face in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 512, value_parser = clap::value_parser!(u32).range(1..=i64::from(SIZE_MAX_PX)))]
    pub size: u32,
    /// Unit of the numbers in EXR files; cd/m2 unless given
    #[arg(long, value_enum, value_name = "UNIT")]
    pub units: Option<UnitName>,
    /// What becomes of the sun's disc
    #[arg(long, value_enum, value_name = "SUN", default_value_t = SunName::Disc)]
    pub sun: SunName,
    /// What lies below the horizon
    #[arg(long, value_enum, value_name = "GROUND", default_value_t = GroundName::True)]
    pub ground: GroundName,
    /// What draws it.
    #[command(flatten)]
    pub device: DeviceArguments,
    /// How to report progress
    #[arg(long, value_name = "READER", value_enum, default_value_t)]
    pub progress: ProgressFormat,
    /// How to store the pictures.
    #[command(flatten)]
    pub format: FormatArguments,
}

/// Where the files go and what they become.
struct Plan {
    format: OutputFormat,
    /// One path, or one for each face.
    paths: Vec<PathBuf>,
    /// A folder that is to be made for them.
    new_folder: Option<PathBuf>,
}

impl Plan {
    /// Refuses places that cannot be written, before anything is drawn.
    fn check_writable(&self) -> Result<(), Failure> {
        let places = self.new_folder.as_ref().map_or(&self.paths[..], std::slice::from_ref);
        Ok(places.iter().try_for_each(check_writable)?)
    }

    /// Makes the folder when there is something to put into it.
    fn make_folder(&self) -> Result<(), Failure> {
        let Some(folder) = &self.new_folder else { return Ok(()) };
        Ok(std::fs::create_dir(folder).map_err(|error| tyndall_io::IoError::from_write(folder, error))?)
    }
}

/// The faces in the computer's own memory, in the order of [`CubeFace::ALL`].
struct Cube {
    faces: Vec<Pixels>,
    adapter: String,
    ev100: f64,
}

/// Writes the faces.
///
/// # Errors
/// Everything that can be wrong with scene, options, device and files.
pub fn run(arguments: &CubemapArguments) -> Result<(), Failure> {
    let mut progress = Progress::start(arguments.progress);
    let written = cubemap(arguments, &mut progress);
    if let Err(failure) = &written {
        progress.fail(failure);
    }
    written
}

fn cubemap(arguments: &CubemapArguments, progress: &mut Progress) -> Result<(), Failure> {
    let mut scene = arguments.scene.load()?;
    scene.sun.disc &= arguments.sun == SunName::Disc;
    let plan = plan(arguments)?;
    plan.check_writable()?;
    let interrupt = Interrupt::listen().map_err(Failure::Signals)?;
    let cube = twice(
        || draw(arguments, &scene, plan.format, progress, &interrupt),
        |failure| progress.warn(&format!("{failure}; trying once more")),
    )?;
    progress.stage(Stage::File)?;
    plan.make_folder()?;
    let adapter = cube.adapter.clone();
    let bytes = write::write(arguments, &scene, cube, &plan, (progress, &interrupt))?;
    let seconds = progress.seconds();
    let files: Vec<_> = plan.paths.iter().map(|path| path.display().to_string()).collect();
    let sentence = format!("{}: faces of {} px in {seconds:.1} s on {adapter}", files.join(", "), arguments.size);
    let facts = json!({
        "files": files, "seconds": seconds, "bytes": bytes, "face_px": arguments.size,
        "scene_hash": scene.hash().to_string(), "adapter": adapter,
    });
    progress.finish(&sentence, facts)
}

/// Paths and format.
fn plan(arguments: &CubemapArguments) -> Result<Plan, Failure> {
    let output = &arguments.output;
    let is_folder = output.is_dir() || output.extension().is_none();
    if is_folder && arguments.layout != Layout::Faces {
        let sentence = "this layout is one file; its name must end in .exr, .png, .jpg or .jpeg";
        return Err(Failure::Usage(format!("cannot write {}: {sentence}", output.display())));
    }
    let named = |path: &Path, stem: &str, ending: &str| -> Vec<PathBuf> {
        CubeFace::ALL.iter().map(|face| path.join(format!("{stem}{}.{ending}", face.name()))).collect()
    };
    let (format, paths) = if is_folder {
        let format = arguments.format.for_file(&output.join("face.exr"))?;
        (format, named(output, "", "exr"))
    } else {
        let format = arguments.format.for_file(output)?;
        let text = |part: Option<&std::ffi::OsStr>| part.unwrap_or_default().to_string_lossy().into_owned();
        let (stem, ending) = (text(output.file_stem()), text(output.extension()));
        match arguments.layout {
            Layout::Faces => (format, named(output.parent().unwrap_or(Path::new("")), &format!("{stem}_"), &ending)),
            _ => (format, vec![output.clone()]),
        }
    };
    if arguments.units.is_some() && !matches!(format, OutputFormat::Exr(..)) {
        let file = output.display();
        return Err(Failure::Usage(format!("--units concerns EXR files only, and {file} is none")));
    }
    let new_folder = (is_folder && !output.is_dir()).then(|| output.clone());
    Ok(Plan { format, paths, new_folder })
}

fn draw(
    arguments: &CubemapArguments,
    scene: &Scene,
    format: OutputFormat,
    progress: &Progress,
    interrupt: &Interrupt,
) -> Result<Cube, Failure> {
    let stage = |stage: Stage| interrupt.check().and_then(|()| progress.stage(stage));
    stage(Stage::Device)?;
    let gpu = Gpu::open(&arguments.device.options())?;
    let (config, size_px) = (config(format), [arguments.size; 2]);
    check_budget(&gpu, size_px, format, config)?;
    stage(Stage::Pipelines)?;
    let mut renderer = Renderer::new(&gpu, config)?;
    renderer.set_table_store(arguments.device.cache.store());
    let mut target = FrameTarget::new(&gpu, size_px, config)?;
    stage(Stage::Frame)?;
    let ev100 = renderer.meter_scene(&gpu, scene)?;
    let scene = exposed(scene, ev100);
    let mut faces = Vec::with_capacity(6);
    for face in CubeFace::ALL {
        let submission = renderer.render_view(&gpu, &scene, View::CubeFace(face), &mut target)?;
        wait(&gpu, &submission, interrupt)?;
        let mut pixels = read(&gpu, &target, format)?;
        if arguments.ground == GroundName::Black {
            blacken(&mut pixels, &target.read_depth_m(&gpu)?);
        }
        if let Pixels::Light(picture) = &mut pixels {
            let unit = arguments.units.unwrap_or(UnitName::CandelaPerSquareMetre).at(ev100);
            convert_pixels(&mut picture.rgba, unit, tyndall_core::primaries::RgbPrimaries::Rec709);
        }
        faces.push(pixels);
    }
    gpu.check()?;
    Ok(Cube { faces, adapter: gpu.adapter().name.clone(), ev100 })
}

/// The scene with the exposure of its own picture for all faces.
fn exposed(scene: &Scene, ev100: f64) -> Scene {
    let mut scene = scene.clone();
    scene.film.exposure = ExposureMode::Manual;
    // What was metered includes the compensation; a night darker than the range stays as dark as it is in pictures.
    scene.film.compensation_ev = 0.0;
    let range = scene.film.info().iter().find(|info| info.name == "ev100").map(|info| info.range.clone());
    scene.film.ev100 = range.map_or(ev100, |range| ev100.clamp(*range.start(), *range.end()));
    scene
}

/// Makes everything black that stands before the sky.
fn blacken(pixels: &mut Pixels, depth_m: &[f32]) {
    fn each<T>(pixels: &mut [T], depth_m: &[f32], black: impl Fn() -> T) {
        for (pixel, depth_m) in pixels.iter_mut().zip(depth_m) {
            if *depth_m < tyndall_render::SKY_DEPTH_M {
                *pixel = black();
            }
        }
    }
    match pixels {
        Pixels::Eight(rgba) => each(rgba, depth_m, || [0, 0, 0, u8::MAX]),
        Pixels::Sixteen(rgba) => each(rgba, depth_m, || [0, 0, 0, u16::MAX]),
        Pixels::Light(picture) => each(&mut picture.rgba, depth_m, || [0.0, 0.0, 0.0, 1.0]),
    }
}

//! `tyndall heightmap`: the sand of a scene as terrain for other programs.
//!
//! Heights in metres as PNG, EXR, R16 or R32, whole or in tiles that share their borders, or as a mesh; beside it maps of
//! normals, ripples, sand and age, and a JSON file with everything that the numbers do not say.

mod layers;
mod sidecar;
mod write;

use std::path::{Path, PathBuf};

use serde_json::json;
use tyndall_dunes::{DesertSimulation, DesertSource};
use tyndall_io::atomic::{check_writable, write_atomically};
use tyndall_io::{Destination, HeightFormat, IoError};
use tyndall_render::desert_inputs::desert_inputs;
use tyndall_scene::{Scene, SceneError, SimulationKind};

use crate::interrupt::Interrupt;
use crate::progress::{Progress, ProgressFormat, Stage};
use crate::scene_arguments::SceneArguments;
use crate::simulate::StartArguments;
use crate::{Exit, Failure};
pub use layers::MapName;
use write::Writer;

const EXAMPLES: &str = "\
Examples:
  tyndall heightmap preset:barchans -o dunes.png --maps normal,ripples,sand
  tyndall heightmap preset:barchans --state later.npz -o dunes.exr
  tyndall heightmap dunes.toml -o tile.r16 --tiles 4x4 --maps all
  tyndall heightmap dunes.toml -o dunes.glb

PNG and R16 spread the range of heights over 0 to 65535, EXR and R32 hold metres;
rows begin in the north. Beside each file lies a .json with metres per pixel,
range, and the list of files. Maps are NAME-normal.png and so on.";

/// What `tyndall heightmap` takes.
#[derive(Clone, Debug, clap::Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{}", Exit::table()))]
pub struct HeightmapArguments {
    /// Whose sand; `desert.steps` says how long the wind has blown.
    #[command(flatten)]
    pub scene: SceneArguments,
    /// File; its ending decides what it is: .png (16 bits), .exr, .r16, .r32, or .glb for a mesh
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// Maps to write beside the heights: any of the names, separated by commas, or all
    #[arg(long, value_name = "NAMES", value_enum, value_delimiter = ',')]
    pub maps: Vec<MapName>,
    /// Cut into columns x rows of tiles that share their border samples; `_x0_y0` is the north-western one
    #[arg(long, value_name = "NxM", value_parser = parse_tiles)]
    pub tiles: Option<[usize; 2]>,
    /// One sample more along each side, 513 for 512 cells, as some engines want; tiles always have it
    #[arg(long, conflicts_with = "tiles")]
    pub shared_edge: bool,
    /// Where the simulation begins.
    #[command(flatten)]
    pub start: StartArguments,
    /// How to report progress
    #[arg(long, value_name = "READER", value_enum, default_value_t)]
    pub progress: ProgressFormat,
}

/// What the heights are written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    Map(HeightFormat),
    Mesh,
}

/// Exports.
///
/// # Errors
/// Everything that can be wrong with scene, state and files.
pub fn run(arguments: &HeightmapArguments) -> Result<(), Failure> {
    let mut progress = Progress::start(arguments.progress);
    let done = export(arguments, &mut progress);
    if let Err(failure) = &done {
        progress.fail(failure);
    }
    done
}

fn export(arguments: &HeightmapArguments, progress: &mut Progress) -> Result<(), Failure> {
    let form = Form::of(arguments)?;
    let scene = arguments.scene.load()?;
    let none = || Failure::Usage("the scene has no desert; `desert.kind` = \"dunes\" makes one".to_owned());
    let params = scene.dune_params().ok_or_else(none)?;
    check_writable(&arguments.output)?;
    let interrupt = Interrupt::listen().map_err(Failure::Signals)?;
    let state = arguments.start.load(&scene, Some(SimulationKind::Desert), progress)?;
    let scene = arguments.start.advanced(&scene, state.as_ref())?;
    let inputs = desert_inputs(&scene)?;
    let mut source = DesertSource::default();
    source.start_from(state);
    let names = MapName::wanted(&arguments.maps);
    if names.contains(&MapName::Age) {
        source.keep_ages();
    }
    let steps = scene.desert.steps;
    let told = std::cell::Cell::new(0);
    let is_stopped = |made: u32| {
        if made >= told.get() {
            told.set(made + (steps / 100).max(1));
            // A reader that is gone is noticed when the result is told.
            let _ = progress.share("simulating", f64::from(made) / f64::from(steps.max(1)));
        }
        interrupt.check().is_err()
    };
    let made = source.at_unless(&params, &inputs, steps, &is_stopped);
    let made = made.map_err(|error| arguments.start.blame(SceneError::Sand(error).into()))?;
    interrupt.check()?;
    let desert = made.ok_or_else(none)?;
    progress.stage(Stage::File)?;
    let files = write(arguments, (form, &names), (&scene, desert), &interrupt)?;
    report(arguments, desert, &files, progress)
}

/// Writes all files; gives back their names, the sidecar last.
fn write(
    arguments: &HeightmapArguments,
    (form, names): (Form, &[MapName]),
    (scene, desert): (&Scene, &DesertSimulation),
    interrupt: &Interrupt,
) -> Result<Vec<PathBuf>, Failure> {
    let layers = layers::make(scene, desert, names)?;
    let writer = Writer { arguments, form, desert, interrupt };
    let mut files = Vec::new();
    let mut entries = Vec::new();
    for layer in &layers {
        let written = writer.write(layer, &layers)?;
        entries.push(sidecar::entry(layer, &written));
        files.extend(written.into_iter().map(|tile| tile.path));
    }
    let text = serde_json::to_string_pretty(&sidecar::whole(&writer, scene, &entries)).unwrap_or_default() + "\n";
    let path = arguments.output.with_extension("json");
    let destination = Destination::new(&path).cancelled_by(interrupt.flag());
    let done = write_atomically(destination, |file| std::io::Write::write_all(file, text.as_bytes()));
    finished(done, interrupt)?;
    files.push(path);
    Ok(files)
}

/// What came of a file, where Ctrl-C is a signal and no failure of the disk.
fn finished(done: Result<(), IoError>, interrupt: &Interrupt) -> Result<(), Failure> {
    match done {
        Err(IoError::Cancelled { path }) => {
            interrupt.check()?;
            Err(IoError::Cancelled { path }.into())
        }
        other => Ok(other?),
    }
}

impl Form {
    /// What ending and options ask for.
    fn of(arguments: &HeightmapArguments) -> Result<Self, Failure> {
        let path = &arguments.output;
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
        let refused = |sentence: &str| Failure::Usage(format!("cannot write {}: {sentence}", path.display()));
        let form = match ending.as_deref() {
            Some("glb") => Self::Mesh,
            Some("png" | "exr" | "r16" | "r32") => Self::Map(HeightFormat::of(Path::new(path))?),
            _ => {
                return Err(refused("the file's ending decides its format and must be .png, .exr, .r16, .r32 or .glb"));
            }
        };
        if form == Self::Mesh && arguments.tiles.is_some() {
            return Err(refused("--tiles cuts maps; a mesh is in one piece"));
        }
        Ok(form)
    }
}

/// Columns and rows of tiles from a text like `4x4`.
fn parse_tiles(text: &str) -> Result<[usize; 2], String> {
    let [columns, rows] = crate::values::parse_size_px(text)
        .map_err(|_no_size| "tiles are columns x rows, such as 4x4".to_owned())?
        .map(|count| count as usize);
    if columns == 0 || rows == 0 {
        Err("there is at least one column and one row of tiles".to_owned())
    } else {
        Ok([columns, rows])
    }
}

fn report(
    arguments: &HeightmapArguments,
    desert: &DesertSimulation,
    files: &[PathBuf],
    progress: &mut Progress,
) -> Result<(), Failure> {
    let (file, seconds) = (arguments.output.display().to_string(), progress.seconds());
    let (step, hash) = (desert.step_count(), format!("{:#018x}", desert.hash()));
    let names: Vec<_> = files.iter().map(|path| path.display().to_string()).collect();
    let sentence =
        format!("{file}: desert after step {step}, {}; {} files in {seconds:.1} s", desert.summary(), files.len());
    progress.finish(
        &sentence,
        json!({ "file": file, "files": names, "step": step, "hash": hash, "height_range_m": desert.height_range_m(),
                "seconds": seconds }),
    )
}

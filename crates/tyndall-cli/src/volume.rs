//! `tyndall volume`: the clouds of a scene as data for other programs.
//!
//! A grid of extinction as VDB or NPZ, or the metaballs that add up to it as CSV or JSON. Places are metres east and north of the
//! scene's origin, and altitudes; extinction is per metre, so that a program that takes densities as extinction draws the same cloud.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use tyndall_clouds::{CloudMatter, Metaballs};
use tyndall_core::array::{Array, ArrayData, NamedArrays};
use tyndall_io::atomic::{check_writable, write_atomically};
use tyndall_io::{Destination, IoError, VdbGrid, VdbOptions, VdbPacking, write_npz, write_vdb};
use tyndall_render::clouds::source::{CloudSource, CloudSourceRequest};
use tyndall_scene::SimulationKind;

use crate::interrupt::Interrupt;
use crate::progress::{Progress, ProgressFormat, Stage};
use crate::scene_arguments::SceneArguments;
use crate::simulate::StartArguments;
use crate::values::format_bytes;
use crate::{Exit, Failure};

const EXAMPLES: &str = "\
Examples:
  tyndall volume preset:cumulus -o cloud.vdb --half
  tyndall volume preset:cumulus --set clouds.time_s=600 -o later.npz
  tyndall volume preset:cumulus -o balls.csv

VDB: one grid `density`, a fog volume with extinction in 1/m, z up, in metres.
NPZ: `density` [x, y, z] in 1/m, `cell_m` and `low_corner_m`; as clouds.file it
wants cloud_matter.extinction_per_m=1, and the cells of cloud_grid.
CSV, JSON: a ball a line, with its place, radius and extinction in the middle.";

/// What `tyndall volume` takes.
#[derive(Clone, Debug, clap::Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{}", Exit::table()))]
pub struct VolumeArguments {
    /// Whose clouds.
    #[command(flatten)]
    pub scene: SceneArguments,
    /// File; its ending decides what it holds: .vdb and .npz the grid, .csv and .json the metaballs
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// Where the simulation begins.
    #[command(flatten)]
    pub start: StartArguments,
    /// VDB with 16-bit floats: half the size, three digits
    #[arg(long)]
    pub half: bool,
    /// VDB with deflated blocks: smaller, and slower to read
    #[arg(long)]
    pub zip: bool,
    /// How to report progress
    #[arg(long, value_name = "READER", value_enum, default_value_t)]
    pub progress: ProgressFormat,
}

/// What the file holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum VolumeFormat {
    Vdb(VdbOptions),
    Npz,
    Csv,
    Json,
}

/// Exports.
///
/// # Errors
/// Everything that can be wrong with scene, state and file.
pub fn run(arguments: &VolumeArguments) -> Result<(), Failure> {
    let mut progress = Progress::start(arguments.progress);
    let done = export(arguments, &mut progress);
    if let Err(failure) = &done {
        progress.fail(failure);
    }
    done
}

fn export(arguments: &VolumeArguments, progress: &mut Progress) -> Result<(), Failure> {
    let format = VolumeFormat::of(arguments)?;
    let scene = arguments.scene.load()?;
    let request = CloudSourceRequest::of(&scene).ok_or_else(|| {
        Failure::Usage("the scene has no clouds; `clouds.kind` = \"automaton\" makes some".to_owned())
    })?;
    check_writable(&arguments.output)?;
    let interrupt = Interrupt::listen().map_err(Failure::Signals)?;
    let mut source = CloudSource::default();
    source.start_from(arguments.start.load(&scene, Some(SimulationKind::Clouds), progress)?);
    progress.share("simulating", 0.0)?;
    let is_stopped = || interrupt.check().is_err();
    let matter = loop {
        let made = source.matter_unless(&request, &is_stopped);
        interrupt.check()?;
        if let Some(matter) = made.map_err(|error| arguments.start.blame(error.into()))? {
            break matter;
        }
    };
    progress.stage(Stage::File)?;
    let destination = Destination::new(&arguments.output).cancelled_by(interrupt.flag());
    let facts = match write(destination, format, &matter) {
        Err(IoError::Cancelled { path }) => {
            interrupt.check()?;
            return Err(IoError::Cancelled { path }.into());
        }
        other => other?,
    };
    report(arguments, &matter, facts, progress)
}

impl VolumeFormat {
    /// What the ending and the options ask for.
    fn of(arguments: &VolumeArguments) -> Result<Self, Failure> {
        let path = &arguments.output;
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
        let packing = if arguments.zip { VdbPacking::Zip } else { VdbPacking::Plain };
        let format = match ending.as_deref() {
            Some("vdb") => Self::Vdb(VdbOptions { half: arguments.half, packing }),
            Some("npz") => Self::Npz,
            Some("csv") => Self::Csv,
            Some("json") => Self::Json,
            _ => {
                let sentence = "the file's ending decides its format and must be .vdb, .npz, .csv or .json";
                return Err(Failure::Usage(format!("cannot write {}: {sentence}", path.display())));
            }
        };
        for (option, given) in [("--half", arguments.half), ("--zip", arguments.zip)] {
            if given && !matches!(format, Self::Vdb(_)) {
                let file = path.display();
                return Err(Failure::Usage(format!("{option} concerns VDB files only, and {file} is none")));
            }
        }
        Ok(format)
    }
}

/// Writes the file, and says what is in it.
fn write(destination: Destination<'_>, format: VolumeFormat, matter: &CloudMatter) -> Result<Value, IoError> {
    match format {
        VolumeFormat::Vdb(options) => {
            let CloudMatter { extinction_per_m, cell_m, low_corner_m, .. } = matter;
            let grid =
                VdbGrid { name: "density", values: extinction_per_m, cell_m: *cell_m, low_corner_m: *low_corner_m };
            let report = write_vdb(destination, &[grid], options)?;
            Ok(json!({ "active_cells": report.active_cells, "blocks": report.blocks }))
        }
        VolumeFormat::Npz => {
            write_npz(destination, &arrays(matter))?;
            Ok(json!({ "active_cells": active_cells(matter) }))
        }
        VolumeFormat::Csv => write_balls(destination, &matter.balls(), Metaballs::to_csv),
        VolumeFormat::Json => write_balls(destination, &matter.balls(), Metaballs::to_json),
    }
}

fn write_balls(
    destination: Destination<'_>,
    balls: &Metaballs,
    text: fn(&Metaballs) -> String,
) -> Result<Value, IoError> {
    let text = text(balls);
    write_atomically(destination, |file| std::io::Write::write_all(file, text.as_bytes()))?;
    Ok(json!({ "balls": balls.balls.len() }))
}

/// The grid as arrays.
fn arrays(matter: &CloudMatter) -> NamedArrays {
    let grid = &matter.extinction_per_m;
    let corner = matter.low_corner_m.to_vec();
    let entries = [
        ("density", Array::new(grid.size().to_vec(), ArrayData::F32(grid.cells().to_vec()))),
        ("cell_m", Array::new(vec![], ArrayData::F64(vec![matter.cell_m]))),
        ("low_corner_m", Array::new(vec![3], ArrayData::F64(corner))),
    ];
    entries.into_iter().filter_map(|(name, array)| array.map(|array| (name.to_owned(), array))).collect()
}

fn active_cells(matter: &CloudMatter) -> usize {
    matter.extinction_per_m.cells().iter().filter(|value| **value > 0.0).count()
}

fn report(
    arguments: &VolumeArguments,
    matter: &CloudMatter,
    facts: Value,
    progress: &mut Progress,
) -> Result<(), Failure> {
    let path: &Path = &arguments.output;
    let bytes = std::fs::metadata(path).map_or(0, |found| found.len());
    let [nx, ny, nz] = matter.extinction_per_m.size();
    let what = match facts["balls"].as_u64() {
        Some(balls) => format!("{balls} metaballs"),
        None => format!("{nx} x {ny} x {nz} cells of {} m, {} with cloud", matter.cell_m, facts["active_cells"]),
    };
    let (file, seconds) = (path.display().to_string(), progress.seconds());
    let sentence = format!("{file}: {what}, {} in {seconds:.1} s", format_bytes(bytes));
    let mut event = facts;
    event["file"] = json!(file);
    event["bytes"] = json!(bytes);
    event["cells"] = json!([nx, ny, nz]);
    event["cell_m"] = json!(matter.cell_m);
    event["low_corner_m"] = json!(matter.low_corner_m);
    event["seconds"] = json!(seconds);
    progress.finish(&sentence, event)
}

//! The command line program `tyndall`: renders scene files without a window.
//!
//! One module per subcommand: [`render`], [`hdri`], [`cubemap`], [`probe`], [`simulate`], [`volume`], [`heightmap`], [`validate`],
//! [`params`], [`schema`], [`presets`], [`doctor`]. What they share: [`exit`] (the
//! codes that scripts and render farms go by), [`failure`] (which error ends with which code, and the one sentence that the
//! user reads), [`scene_arguments`] (scene and device), [`values`] (what options take), [`interrupt`] (Ctrl-C and termination) and [`progress`].
//!
//! Results go to stdout; progress, warnings and errors to stderr, so that pipes stay clean. With `--progress json` stdout
//! carries one JSON object a line.

mod arguments;
pub mod cache;
pub mod cubemap;
pub mod doctor;
pub mod exit;
pub mod failure;
pub mod hdri;
pub mod heightmap;
pub mod interrupt;
pub mod light;
mod log;
mod output;
pub mod params;
pub mod presets;
pub mod probe;
pub mod progress;
pub mod render;
pub mod scene_arguments;
pub mod schema;
pub mod simulate;
pub mod validate;
pub mod values;
pub mod volume;

use std::ffi::OsString;
use std::process::ExitCode;

use clap::Parser as _;

pub use arguments::{Arguments, Subcommand};
pub use exit::Exit;
pub use failure::Failure;

/// Runs the program with these arguments, the first of which is its own name.
#[must_use]
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(refusal) => {
            // Help and version come this way too. Without a terminal to print to, nothing is left to be done.
            let _ = refusal.print();
            return if refusal.use_stderr() { Exit::Usage.into() } else { Exit::Success.into() };
        }
    };
    log::start(arguments.verbose);
    match dispatch(&arguments.subcommand) {
        Ok(()) => Exit::Success.into(),
        Err(failure) => {
            output::warn(&failure.report());
            failure.exit().into()
        }
    }
}

fn dispatch(subcommand: &Subcommand) -> Result<(), Failure> {
    match subcommand {
        Subcommand::Render(arguments) => render::run(arguments),
        Subcommand::Hdri(arguments) => hdri::run(arguments),
        Subcommand::Cubemap(arguments) => cubemap::run(arguments),
        Subcommand::Probe(arguments) => probe::run(arguments),
        Subcommand::Simulate(arguments) => simulate::run(arguments),
        Subcommand::Volume(arguments) => volume::run(arguments),
        Subcommand::Heightmap(arguments) => heightmap::run(arguments),
        Subcommand::Validate(arguments) => validate::run(arguments),
        Subcommand::Params(arguments) => params::run(arguments),
        Subcommand::Schema => schema::run(),
        Subcommand::Presets(arguments) => presets::run(arguments),
        Subcommand::Doctor(arguments) => doctor::run(*arguments),
    }
}

//! `tyndall probe`: values of the simulation at places and in directions of the user's choice, as tables of numbers.

mod directions;
mod sky;
mod table;

pub use sky::{Detail, SkyProbeArguments};

use crate::Failure;

/// What `tyndall probe` takes.
#[derive(Clone, Debug, clap::Args)]
pub struct ProbeArguments {
    /// What to probe.
    #[command(subcommand)]
    pub what: Probe,
}

/// What to probe.
#[derive(Clone, Debug, clap::Subcommand)]
pub enum Probe {
    /// Spectral radiance of the sky in a list of directions, as CSV
    Sky(SkyProbeArguments),
}

/// Probes.
///
/// # Errors
/// Everything that can be wrong with files and options.
pub fn run(arguments: &ProbeArguments) -> Result<(), Failure> {
    match &arguments.what {
        Probe::Sky(arguments) => sky::run(arguments),
    }
}

//! The command line as a whole.

use clap::{ArgAction, Parser};

use crate::Exit;
use crate::cubemap::CubemapArguments;
use crate::doctor::DoctorArguments;
use crate::hdri::HdriArguments;
use crate::heightmap::HeightmapArguments;
use crate::params::ParamsArguments;
use crate::presets::PresetsArguments;
use crate::probe::ProbeArguments;
use crate::render::RenderArguments;
use crate::simulate::SimulateArguments;
use crate::validate::ValidateArguments;
use crate::volume::VolumeArguments;

const ABOUT: &str = "Renders skies from scene files, without a window and without a GPU if need be.";

const EXAMPLES: &str = "\
Examples:
  tyndall render preset:noon -o noon.png
  tyndall presets sunset > evening.toml
  tyndall render evening.toml -o evening.exr --size 1920x1080 --set sun.elevation_deg=2.5
  tyndall hdri preset:noon -o sky.exr --sun lamp
  tyndall simulate preset:cumulus --steps 200 -o state.npz
  tyndall volume preset:cumulus -o cloud.vdb
  tyndall heightmap dunes.toml -o dunes.png --maps normal,sand
  tyndall validate sky preset:noon
  tyndall params sun
  tyndall doctor";

/// What the program takes.
#[derive(Clone, Debug, Parser)]
#[command(name = "tyndall", version, about = ABOUT, after_help = format!("{EXAMPLES}\n\n{}", Exit::table()))]
#[command(max_term_width = 100, disable_help_subcommand = true)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub subcommand: Subcommand,
    /// Say on stderr what happens; twice for every detail
    #[arg(short, long, global = true, action = ArgAction::Count)]
    pub verbose: u8,
}

/// What to do.
#[derive(Clone, Debug, clap::Subcommand)]
pub enum Subcommand {
    /// Render a scene to a PNG, EXR or JPEG file
    Render(RenderArguments),
    /// Write the light from all around as an equirectangular EXR, with the sun beside it for a lamp
    Hdri(HdriArguments),
    /// Write what is all around as the six faces of a cube, in files of their own or in one
    Cubemap(CubemapArguments),
    /// Compute values at points and directions of your choice
    Probe(ProbeArguments),
    /// Make steps of what a scene simulates, and write its state
    Simulate(SimulateArguments),
    /// Write the clouds of a scene as a VDB or NPZ grid, or as a list of metaballs
    Volume(VolumeArguments),
    /// Write the sand of a scene as terrain: height map, normals, ripples, masks, tiles, or a mesh
    Heightmap(HeightmapArguments),
    /// Tell how far the tables are from Monte-Carlo, in per cent, on your own scene
    Validate(ValidateArguments),
    /// List the parameters of scenes: default, unit, range, what each does
    Params(ParamsArguments),
    /// Print the JSON schema of scene files, for editors
    Schema,
    /// List the scenes that come with Tyndall, or print one
    Presets(PresetsArguments),
    /// Look at this computer: adapters, limits, memory, missing packages
    Doctor(DoctorArguments),
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    use super::*;

    #[test]
    fn the_declaration_of_the_command_line_is_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn every_option_of_every_subcommand_has_a_help_text() {
        for command in Arguments::command().get_subcommands() {
            assert!(command.get_about().is_some(), "{} says what it does", command.get_name());
            for argument in command.get_arguments() {
                assert!(argument.get_help().is_some(), "{} {}", command.get_name(), argument.get_id());
            }
        }
    }
}

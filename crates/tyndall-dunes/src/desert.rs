//! A desert from parameters: the field of dunes with its winds, plants and rock put together, and its state for files.

mod ages;
mod params;
mod simulation;
mod state;

pub use params::DesertParams;
pub use simulation::DesertSimulation;
pub use state::state_step;

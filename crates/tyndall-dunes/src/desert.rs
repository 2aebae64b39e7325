//! A desert from parameters: the field of dunes with its winds, plants and rock put together, and its state for files.

mod ages;
pub mod by_hand;
mod inputs;
mod params;
mod simulation;
mod source;
mod state;
mod stepper;

pub use inputs::DesertInputs;
pub use params::DesertParams;
pub use simulation::DesertSimulation;
pub use source::DesertSource;
pub use state::state_step;
pub use stepper::{DuneStepper, SteppedBy};

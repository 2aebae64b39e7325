//! Clouds that form, drift and vanish: section 3.2 of the paper, without any GPU.
//!
//! - [`Automaton`]: humidity, activation and cloud of every cell, 32 heights in one word; [`dobashi2000`] is the same cell by
//!   cell, for comparison.
//! - [`ProbabilityLayer`]: where vapour is supplied and where cloud vanishes, as a stack of layers.
//! - [`wind`]: a profile over height that moves everything by exact fractions of cells.
//! - [`CloudDensity`]: the weighted mean over space and time, between steps too; [`ball_density`]: equation (3) on a grid.
//! - [`sun_depth`]: the light volume, how much cloud lies between each cell and the sun.
//!
//! x is east, y north, z the height; lengths are cells of the grid and times are steps, where nothing else is said.

pub mod automaton;
pub mod ball_lattice;
pub mod bit_field;
mod density;
pub mod dobashi2000;
mod edges;
mod error;
mod fields;
pub mod grid_size;
mod narrow;
mod probability;
mod probability_planes;
mod shift;
pub mod smoothing;
mod sun_depth;
mod transition;
pub mod wind;

pub use automaton::{Automaton, AutomatonConfig};
pub use ball_lattice::{ball_density, ball_density_into};
pub use bit_field::BitField;
pub use density::CloudDensity;
pub use edges::Edges;
pub use error::CloudError;
pub use fields::CloudFields;
pub use probability::{Probabilities, ProbabilityLayer, ProbabilityRow};
pub use smoothing::SmoothingWindow;
pub use sun_depth::{sun_depth, sun_depth_into};
pub use wind::{Wind, WindKnot, WindProfile};

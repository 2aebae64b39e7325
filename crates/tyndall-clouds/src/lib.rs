//! Clouds that form, drift and vanish: section 3.2 of the paper, without any GPU.
//!
//! - [`CloudSimulation`]: everything together, from [`CloudParams`]; [`VapourPattern::preset`] for five kinds of sky.
//! - [`Automaton`]: humidity, activation and cloud of every cell, 32 heights in one word; [`dobashi2000`] is the same cell by
//!   cell, for comparison.
//! - [`ProbabilityLayer`]: where vapour is supplied and where cloud vanishes, as a stack of layers:
//!   [`HumidEllipsoids`], [`Terrain`], [`HeatSource`] and those of your own.
//! - [`wind`]: a profile over height that moves everything by exact fractions of cells.
//! - [`CloudDensity`]: the weighted mean over space and time, between steps too; [`ball_density`]: equation (3) on a grid.
//! - [`ball_grid`]: the same of any list of balls.
//! - [`sun_depth`]: the light volume, how much cloud lies between each cell and the sun.
//! - [`mod@cloud_light`]: the light in every cell, what was scattered often included, for renderers that march.
//! - [`turbulence`]: billows finer than a cell that keep the mean density.
//! - [`CloudMatter`]: what all of this hands to renderers: a grid of extinction with its place, and its balls.
//! - [`mod@floor_shadow`]: what clouds leave of the light of sun and sky on its way to the ground.
//! - [`Metaballs`]: lists of balls for splatting and for other programs.
//! - [`splats`]: the paper's rendering of such lists: a sun pass, and billboards from back to front.
//! - [`mod@reference`]: single scattering by marching and all orders by Monte Carlo, to judge renderers by.
//!
//! x is east, y north, z the height; lengths are cells of the grid and times are steps, where nothing else is said.

pub mod automaton;
pub mod ball_grid;
mod ball_json;
pub mod ball_lattice;
pub mod bit_field;
pub mod cloud_light;
mod density;
mod diffusion;
pub mod dobashi2000;
mod edges;
pub mod ellipsoid_list;
mod ellipsoids;
mod error;
mod fields;
pub mod floor_shadow;
mod fnv;
pub mod grid_size;
pub mod matter;
mod metaballs;
mod narrow;
pub mod painted_map;
mod painted_vapour;
pub mod params;
mod probability;
mod probability_planes;
pub mod reference;
mod shift;
mod simulation;
pub mod smoothing;
pub mod splats;
mod state;
pub mod statistics;
mod steepening;
mod sun_depth;
mod supply_layers;
mod transition;
pub mod turbulence;
pub mod vapour;
pub mod wind;

pub use automaton::{Automaton, AutomatonConfig};
pub use ball_grid::BallGrid;
pub use ball_lattice::{ball_density, ball_density_into};
pub use bit_field::BitField;
pub use cloud_light::{CloudLight, cloud_light, sunlight_scattered_often};
pub use density::CloudDensity;
pub use edges::Edges;
pub use ellipsoids::{Ellipsoid, EllipsoidSupply, HumidEllipsoids};
pub use error::CloudError;
pub use fields::CloudFields;
pub use floor_shadow::{FloorShadow, floor_shadow};
pub use matter::CloudMatter;
pub use metaballs::{Metaball, Metaballs};
pub use painted_map::PaintedMap;
pub use painted_vapour::{PaintedRange, PaintedVapour};
pub use params::{CloudGridParams, CloudMatterParams, CloudParams, VapourPattern};
pub use probability::{LayerMotion, Probabilities, ProbabilityLayer, ProbabilityRow};
pub use simulation::CloudSimulation;
pub use smoothing::SmoothingWindow;
pub use state::{density_from_array, density_from_arrays, state_step};
pub use statistics::CloudStatistics;
pub use steepening::{deep_extinction_per_m, steepened};
pub use sun_depth::{sun_depth, sun_depth_into};
pub use supply_layers::{HeatSource, Terrain, TerrainLift};
pub use turbulence::{BILLOWS_LEVELS, BILLOWS_SIDE, Billows};
pub use wind::{Wind, WindKnot, WindProfile};

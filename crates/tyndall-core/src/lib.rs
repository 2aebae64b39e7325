//! What every Tyndall crate stands on: parameters declared once, counter-based random numbers, grids and spectra.
//!
//! - [`mod@params`]: the [`params!`] and [`choices!`] macros; one declaration feeds struct, default, range check, scene file,
//!   command line, sliders, tooltips and documentation.
//! - [`rng`]: Philox4x32-10, a random number as a pure function of (seed, step, cell), and a cheap hash keyed by it.
//! - [`grid`]: dense 2-D and 3-D arrays with a documented index order and linear interpolation.
//! - [`mod@array`]: named arrays, which carry a simulation's state to and from files.
//! - [`metaball`]: the field of the balls that clouds and smoke are made of, its columns and its mass.
//! - [`primaries`]: colour spaces of linear RGB in files.
//! - [`spectrum`]: the eight wavelengths of all light transport and their map to linear Rec.709.
//! - [`table_store`]: where slow tables may be kept between runs.
//! - [`units`]: conversions at the edges of the program; inside it everything is metres, seconds, radians, kelvin.

pub mod array;
pub mod grid;
pub mod metaball;
pub mod observer;
pub mod params;
pub mod primaries;
pub mod rng;
pub mod spectrum;
pub mod table_store;
pub mod units;

pub use params::{ParamError, ParamInfo, ParamKind, ParamSet, Scale, TextInfo};

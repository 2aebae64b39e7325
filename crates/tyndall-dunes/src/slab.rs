//! Fields of dunes: the slab model (default) and the rule of Onoue and Nishita 2000.
//!
//! Lengths are in cells. A step casts the wind's shadow, moves slabs, and lets what is too steep slide; every 16 steps
//! it looks at the surroundings' mean height, which speeds up the wind, and at the plants. Everything that is decided is
//! decided in 32-bit integers, from the state before the step and random words that depend on (seed, step, cell) alone.

mod avalanche;
mod field;
mod onoue_nishita2000;
mod params;
mod plants;
mod rock;
mod rule;
mod state;
mod streams;
mod surface;
mod surroundings;
mod transport;

pub use field::DuneField;
pub use onoue_nishita2000::ClassicRule;
pub use params::{AbrasionParams, ClassicParams, DuneModel, DuneParams, VegetationParams};
pub use plants::PlantRule;
pub use rock::Rock;
pub use rule::{
    CATCH_REACH_CELLS, DUNE_QUANTA_PER_CELL, DuneRule, MAX_HEIGHT_CELLS, MAX_HOPS, SHADOW_REACH_CELLS, SLOW_STEPS,
};
pub use state::{DuneState, PlantState};
pub use streams::DuneKeys;
pub use surroundings::SURROUNDINGS_CELLS;

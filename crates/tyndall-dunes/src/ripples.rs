//! Wind ripples: the automaton of Nishimori and Ouchi 1993 in exact integers, and its linear theory.
//!
//! Lengths are in cells. The bed is periodic and the wind blows along +x; [`RippleBed::set_wind_deg`] turns it. Heights
//! of the rule have no scale of their own (late slopes are about 3): rescale them to a ratio of wavelength to height of 15
//! to 20 before shading.
//!
//! What sets the size of real ripples is the mechanics of grains hitting the bed more than the length of their hops;
//! the rule gives their look and their laws, not their size.

mod any_direction;
mod bed;
pub mod linear_theory;
mod nishimori_ouchi1993;
mod params;
mod rule;
pub mod split_bed;

pub use bed::RippleBed;
pub(crate) use nishimori_ouchi1993::creep;
pub use params::RippleParams;
pub use rule::{CREEP_BITS, LEE_REACH_CELLS, MAX_HOP_CELLS, MAX_RELIEF, RIPPLE_QUANTA_PER_CELL, RippleRule};

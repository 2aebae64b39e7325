//! Dunes and wind ripples that form under the wind, after section 5 of Nishita & Dobashi and beyond it.
//!
//! - [`ripples`]: the ripple automaton of Nishimori and Ouchi 1993, and its linear theory.
//! - [`measure`]: wavelength, slopes, crests, separate heaps.
//! - [`slab`]: fields of dunes from slabs of sand; also the rule of Onoue and Nishita 2000.
//! - [`wind`], [`wind_rose`], [`crest_theory`]: winds that take turns, also from measurements, and the crests to expect.
//! - [`DesertParams`], [`DesertSimulation`], [`DesertSource`]: all of that put together as a scene has it, with states for files.
//! - [`presets`]: deserts to start from.
//! - [`shadow`], [`horizon`]: where the wind and where the sun does not reach.
//! - [`smooth`]: the surface of even slopes and creases that slabs stand for.
//! - [`blowing`]: sand in the air over crests.
//! - [`blur`], [`openness`], [`sunlight`]: a bed as light sees it.
//! - [`brush`], [`terrain`], [`export`]: sand by hand, bedrock from outside, maps and tiles for other programs.
//!
//! Every decision is made in 32-bit integers on random words that are pure functions of (seed, step, cell), so a seed
//! gives the same desert on any number of threads, on every system, and in a shader that follows the same lines. Mass is
//! kept to the quantum. Lengths are in cells, x points east, y north, angles are anticlockwise from +x and say where the
//! wind blows to.

#![expect(clippy::inline_always, reason = "vector instructions chosen at run time reach only what is inlined")]
#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    reason = "integers are the matter of this crate: sides are below 2^13, beds below 2^26 cells, and parameters are checked against ranges that keep every product within 32 bits"
)]

pub mod blowing;
pub mod blur;
pub mod brush;
pub mod crest_theory;
mod deposits;
mod desert;
pub mod direction;
pub mod edges;
mod error;
pub mod export;
pub mod hash;
pub mod horizon;
pub mod lattice;
mod ledger;
pub mod measure;
pub mod openness;
pub mod presets;
pub mod ripples;
pub mod shadow;
mod side;
mod simulation;
pub mod slab;
pub mod smooth;
pub mod sunlight;
pub mod terrain;
pub mod wind;
pub mod wind_rose;

pub use desert::by_hand;
pub use desert::{DesertInputs, DesertParams, DesertSimulation, DesertSource, DuneStepper, SteppedBy, state_step};
pub use edges::Edges;
pub use error::DuneError;
pub use lattice::Lattice;
pub use ledger::Ledger;
pub use side::Side;
pub use simulation::{SandDevice, SandSimulation, StateHash};

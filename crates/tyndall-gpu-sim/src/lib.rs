//! The sand automata of [`tyndall_dunes`] as compute shaders, bit for bit equal to the CPU.
//!
//! - [`GpuRipples`]: ripples of Nishimori and Ouchi 1993 under a wind in any direction.
//! - [`GpuDunes`]: the slab model with all that the CPU has: shadow, speed-up, lee, plants, walls, rock that wears, open
//!   edges with their ledger. The classic rule of Onoue and Nishita 2000 stays on the CPU and is refused here.
//!
//! - [`GpuStepper`]: the steps of a scene's dunes for [`DesertSource`](tyndall_dunes::DesertSource).
//!
//! The first two are made from an automaton in main memory, run, and read back into one, on which everything else is asked: mass,
//! hash, slopes, export ([`SandDevice`](tyndall_dunes::SandDevice)). Renderers bind `heights` straight away.
//!
//! ```no_run
//! use tyndall_dunes::slab::{DuneField, DuneParams};
//! use tyndall_dunes::{SandDevice as _, SandSimulation as _};
//! use tyndall_gpu::{Gpu, GpuOptions};
//! use tyndall_gpu_sim::GpuDunes;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let field = DuneField::new(&DuneParams::default())?;
//! let gpu = Gpu::open(&GpuOptions::default())?;
//! let mut dunes = GpuDunes::new(&gpu, &field)?;
//! dunes.run(1000)?;
//! assert_eq!(dunes.read()?.mass_quanta(), field.mass_quanta());
//! # Ok(())
//! # }
//! ```
//!
//! # Why the bits are equal
//! All state and all decisions are 32-bit integers, random words are pure functions of (seed, step, cell), what decides
//! does not change while it decides, and where several cells give to one the sums are atomic and commute. Where the CPU
//! stops early because nothing more would happen, the shaders go on without changing anything.
//!
//! # Cost
//! No step waits for the CPU: the numbers of a batch of steps go over before it starts. On an adapter that is a processor
//! itself the CPU form is many times faster; use it there.

mod bed;
mod dunes;
mod error;
pub mod gpu_data;
mod job;
mod ripples;
mod stepper;
mod steps;

pub use dunes::GpuDunes;
pub use error::GpuSimError;
pub use ripples::GpuRipples;
pub use stepper::GpuStepper;

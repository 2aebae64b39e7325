//! All orders of scattering.
//!
//! What the sun lights is seen directly (order 1, [`crate::single_scattering`]); what that light lights, and so on without
//! end, makes half of the light at a noon horizon and nearly all of it in the earth's shadow. The light of the higher
//! orders changes slowly with direction, so that a few spherical harmonics hold it: a table over altitude and sun of the
//! harmonics of the diffuse radiance ([`Field`]), from which an order follows from the one before. It covers every sun:
//! only another medium or ground needs a new one.
//!
//! Accuracy against Monte-Carlo: tests of this crate. Cost: one to three seconds of one core at [`OrdersQuality::best`].
//! For comparison the table can hold what Nishita et al. 1996 knew of it ([`OrdersMethod::Nishita1996`]).
//!
//! Not done: polarisation, and refraction. WGSL: `shaders/sky/orders_*.wgsl`.

pub mod basis;
mod build;
pub mod directions;
pub mod field;
pub mod media;
pub mod moments;
mod nishita1996;
pub mod nodes;
mod path;
mod quality;
mod source;
#[cfg(test)]
mod tests;

pub use field::Field;
pub use quality::{OrdersMethod, OrdersQuality};
pub use source::{SourceTable, diffuse_radiance, diffuse_scattered, radiance_by_order};

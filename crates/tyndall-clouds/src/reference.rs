//! Light in a grid of extinction, computed slowly and without tricks: what renderers are judged against.
//!
//! [`single_scattering`] marches along the ray and from every step to the sun. [`path_radiance`] follows paths by delta
//! tracking, with every order of scattering, any phase function and any albedo, under a sun and an even sky; it has noise
//! and no bias. Lengths are in a unit of the caller's choice, that of extinction's inverse.

mod medium;
mod monte_carlo;
mod phase;
mod picture;
mod ray;
mod single;
mod vector;

pub use medium::{Medium, ball_medium};
pub use monte_carlo::{Light, PathExit, PathResult, PathSample, PathSettings, path_radiance, path_sample};
pub use phase::TabulatedPhase;
pub use picture::{PathPicture, path_picture};
pub use ray::Ray;
pub use single::single_scattering;

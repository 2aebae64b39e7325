//! Light scattering in planetary atmospheres.
//!
//! Two layers, both in f64 and without any GPU. The *reference* integrates equations (1) and (2) of Nishita & Dobashi as
//! they stand, slowly: [`optical_length`] and [`single_scattering`]. The *tables* are what renderers use:
//! [`column_table`], [`sky_view_table`] and [`irradiance_table`], filled by the quadrature of [`march`], each tested
//! against the reference at and between its nodes. The WGSL under `shaders/sky` computes the same tables with the same
//! function names.
//!
//! Geometry everywhere: altitude above sea level, `mu` = cosine of the zenith angle of the view direction, `mu_sun` =
//! the same of the sun, `nu` = cosine between the two. Wavelengths are those of the [`atmosphere::Atmosphere`]; the
//! product uses the eight of [`tyndall_core::spectrum`].
//!
//! [`aerial`] has the air in front of things, [`sky_light`] the light on them.
//!
//! Light scattered more than once is the business of [`orders`]: one table for all suns, marched like the others.
//!
//! The sky's light travels straight; [`refraction`] says where the sun, the moon and the stars appear.
//!
//! [`monte_carlo`] computes the same light by random walks, slowly and without any table, to judge everything else.
//!
//! [`validate`] puts the two beside each other.
//!
//! Not done here: polarisation.

pub mod aerial;
pub mod aerosol;
pub mod air;
pub mod atmosphere;
pub mod atmosphere_file;
pub mod column_table;
pub mod dome;
mod error;
pub mod geometry;
pub mod ground;
pub mod haze;
mod haze_breaks;
pub mod irradiance_table;
pub mod layer_column;
pub mod march;
mod march_path;
pub mod medium;
pub mod monte_carlo;
pub mod optical_length;
pub mod orders;
pub mod ozone;
pub mod params;
pub mod phase;
pub mod quadrature;
pub mod refraction;
pub mod single_scattering;
pub mod sky_diffuse_table;
pub mod sky_light;
pub mod sky_view_map;
pub mod sky_view_table;
pub mod sun_disc;
pub mod table_sky;
mod texel;
pub mod validate;

pub use atmosphere::Atmosphere;
pub use error::ScatteringError;

//! Light scattering in planetary atmospheres.

pub mod params;

//! The scattering media as the orders need them.

use super::basis::MAX_DEGREE;
use super::field::Light;
use super::moments::phase_moments;
use crate::Atmosphere;
use crate::atmosphere::{SCATTERER_COUNT, SCATTERERS};

/// Scattering coefficients and moments of the phase functions of the media that scatter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScatteringMedia {
    /// Scattering coefficient at density 1 (1/m).
    pub scattering_per_m: [Light; SCATTERER_COUNT],
    /// Legendre moments of the phase function.
    pub moments: [[f32; MAX_DEGREE + 1]; SCATTERER_COUNT],
}

impl ScatteringMedia {
    /// Of an atmosphere at the eight wavelengths; more wavelengths are left out, missing ones do not scatter.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "tables are f32")]
    pub fn new(atmosphere: &Atmosphere) -> Self {
        let medium = |index: usize| &atmosphere.media[index];
        let scattering = |index: usize, k: usize| medium(index).scattering_per_m.get(k).copied().unwrap_or(0.0) as f32;
        Self {
            scattering_per_m: SCATTERERS.map(|index| std::array::from_fn(|k| scattering(index, k))),
            moments: SCATTERERS.map(|index| phase_moments(medium(index).phase).map(|chi| chi as f32)),
        }
    }
}

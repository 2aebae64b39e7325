//! Table of the light of the sky on horizontal ground, over the height of the sun.
//!
//! `E(mu_sun)` = integral over the upper hemisphere of L cos(theta), at sea level, at the eight wavelengths. Nodes lie
//! quadratically dense around the horizon. WGSL: `shaders/sky/irradiance_table.wgsl`.

use std::f64::consts::PI;

use rayon::prelude::*;
use tyndall_core::spectrum::{Spectrum, WAVELENGTH_COUNT};

use crate::geometry::Ray;
use crate::march::Marcher;

/// Nodes of the table.
pub const IRRADIANCE_TABLE_SIZE: usize = 64;

/// Lowest sun of the table: zenith cosine, 17 degrees below the horizon.
pub const LOWEST_MU_SUN: f64 = -0.3;

/// Share of the nodes that lies below the horizon.
const TWILIGHT_SHARE: f64 = 0.25;

/// Zenith angles and azimuths of the hemisphere quadrature.
const ZENITHS: usize = 16;
const AZIMUTHS: usize = 16;

/// Irradiance of the sky (W/m^2/nm) on horizontal ground at sea level.
#[derive(Clone, Debug)]
pub struct IrradianceTable {
    nodes: Vec<Spectrum>,
}

impl IrradianceTable {
    /// Fills the table: 64 suns times 256 directions.
    #[must_use]
    pub fn new(marcher: &Marcher) -> Self {
        let unit = |index: usize| index as f64 / (IRRADIANCE_TABLE_SIZE - 1) as f64;
        let node = |index: usize| sky_irradiance(marcher, irradiance_map_inverse(unit(index)));
        Self { nodes: (0..IRRADIANCE_TABLE_SIZE).into_par_iter().map(node).collect() }
    }

    /// Irradiance for a sun of zenith cosine `mu_sun`; the lowest node's below [`LOWEST_MU_SUN`].
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "the map gives 0 to 1")]
    pub fn lookup(&self, mu_sun: f64) -> Spectrum {
        let position = irradiance_map(mu_sun) * (IRRADIANCE_TABLE_SIZE - 1) as f64;
        let first = (position as usize).min(IRRADIANCE_TABLE_SIZE - 2);
        let fraction = position - first as f64;
        std::array::from_fn(|i| self.nodes[first][i] * (1.0 - fraction) + self.nodes[first + 1][i] * fraction)
    }

    /// The stored nodes.
    #[must_use]
    pub fn nodes(&self) -> &[Spectrum] {
        &self.nodes
    }
}

/// Place in the table, 0 to 1, of a sun.
#[must_use]
pub fn irradiance_map(mu_sun: f64) -> f64 {
    if mu_sun < 0.0 {
        TWILIGHT_SHARE * (1.0 - (mu_sun / LOWEST_MU_SUN).min(1.0).sqrt())
    } else {
        TWILIGHT_SHARE + (1.0 - TWILIGHT_SHARE) * mu_sun.min(1.0).sqrt()
    }
}

/// Sun of a place in the table; the inverse of [`irradiance_map`].
#[must_use]
pub fn irradiance_map_inverse(unit: f64) -> f64 {
    if unit < TWILIGHT_SHARE {
        LOWEST_MU_SUN * (1.0 - unit / TWILIGHT_SHARE).powi(2)
    } else {
        ((unit - TWILIGHT_SHARE) / (1.0 - TWILIGHT_SHARE)).powi(2)
    }
}

/// Irradiance of the sky (W/m^2/nm) on horizontal ground at sea level, by midpoints in sin^2 of the elevation (so that
/// equal steps are equal shares of a uniform sky's irradiance) and in half the azimuths.
#[must_use]
pub fn sky_irradiance(marcher: &Marcher, mu_sun: f64) -> Spectrum {
    let mut irradiance = [0.0; WAVELENGTH_COUNT];
    for zenith in 0..ZENITHS {
        // Squared once more: the horizon is bright, and dense nodes there halve the error.
        let edge = |i: usize| (i as f64 / ZENITHS as f64).powi(2);
        let (low, high) = (edge(zenith), edge(zenith + 1));
        let mu = (0.5 * (low + high)).sqrt();
        for azimuth in 0..AZIMUTHS {
            let angle = PI * (azimuth as f64 + 0.5) / AZIMUTHS as f64;
            let nu = mu * mu_sun + ((1.0 - mu * mu) * (1.0 - mu_sun * mu_sun)).max(0.0).sqrt() * angle.cos();
            let ray = Ray { h_m: 0.0, mu, mu_sun, nu: nu.clamp(-1.0, 1.0) };
            let parts = marcher.scattered_parts(&ray);
            let phases = marcher.atmosphere.phases(ray.nu);
            let weight = PI * (high - low) / AZIMUTHS as f64;
            for (phase, part) in phases.into_iter().zip(&parts) {
                for (sum, value) in irradiance.iter_mut().zip(part) {
                    *sum += weight * phase * value;
                }
            }
        }
    }
    irradiance
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Atmosphere;
    use crate::params::{AtmosphereParams, GroundParams};

    fn marcher() -> Marcher {
        Marcher::new(Atmosphere::new(&AtmosphereParams::default(), &GroundParams::default()), 8).unwrap()
    }

    #[test]
    fn the_map_and_its_inverse_are_inverse() {
        for unit in [0.0, 0.1, 0.25, 0.3, 0.77, 1.0] {
            let back = irradiance_map(irradiance_map_inverse(unit));
            assert!((back - unit).abs() < 1e-12, "{unit} {back}");
        }
    }

    #[test]
    fn the_table_equals_the_integral_between_its_nodes() {
        let marcher = marcher();
        let table = IrradianceTable::new(&marcher);
        for mu_sun in [-0.02, 0.003, 0.031, 0.2, 0.51, 0.87] {
            let (got, want) = (table.lookup(mu_sun), sky_irradiance(&marcher, mu_sun));
            for (k, (got, want)) in got.iter().zip(want).enumerate() {
                // Below the horizon the light falls by e in a degree: linear interpolation costs a little more.
                let allowed = if mu_sun < 0.0 { 0.02 } else { 0.005 };
                assert!((got / want - 1.0).abs() < allowed, "{mu_sun} wavelength {k}: {got} {want}");
            }
        }
    }

    #[test]
    fn skylight_is_no_more_than_the_light_that_the_air_takes_from_the_sun() {
        let marcher = marcher();
        for mu_sun in [0.1_f64, 0.5, 1.0] {
            let sky = sky_irradiance(&marcher, mu_sun);
            let columns = marcher.columns.lookup(0.0, mu_sun);
            let direct = marcher.coefficients.transmittance(&columns);
            for k in 0..WAVELENGTH_COUNT {
                let lost = marcher.coefficients.solar_irradiance_w_m2_nm[k] * mu_sun * (1.0 - direct[k]);
                assert!(sky[k] > 0.0 && sky[k] < lost, "{mu_sun} wavelength {k}: {} of {lost}", sky[k]);
            }
        }
    }
}

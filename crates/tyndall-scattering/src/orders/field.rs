//! Diffuse light over altitudes and suns, as harmonics of the radiance.

use super::basis::{MAX_DEGREE, MAX_HARMONICS, harmonic_count, harmonic_index};
use super::nodes::{Nodes, Place};

/// One value per wavelength, in the precision of the tables.
pub type Light = [f32; tyndall_core::spectrum::WAVELENGTH_COUNT];

/// No light.
pub const DARK: Light = [0.0; tyndall_core::spectrum::WAVELENGTH_COUNT];

/// Adds a multiple of some light.
pub fn add_scaled(sum: &mut Light, light: &Light, factor: f32) {
    for (sum, value) in sum.iter_mut().zip(light) {
        *sum += factor * value;
    }
}

/// Harmonics of the radiance at every node, and the sky's irradiance on the ground for every sun.
#[derive(Clone, Debug)]
pub struct Field {
    /// Where the values belong.
    pub nodes: Nodes,
    /// Degree of the harmonics.
    pub degree: usize,
    /// Radiance times harmonic, integrated over the sphere (W/m^2/nm): sun, then altitude, then harmonic (fastest).
    pub harmonics: Vec<Light>,
    /// Downward irradiance at the ground, without direct sunlight (W/m^2/nm), one per sun.
    pub irradiance: Vec<Light>,
}

impl Field {
    /// A field without light.
    #[must_use]
    pub fn dark(nodes: Nodes, degree: usize) -> Self {
        let count = nodes.sun_count() * nodes.altitude_count() * harmonic_count(degree);
        Self { nodes, degree, harmonics: vec![DARK; count], irradiance: vec![DARK; nodes.sun_count()] }
    }

    /// The harmonics of a node.
    #[must_use]
    pub fn at(&self, sun: usize, altitude: usize) -> &[Light] {
        let count = harmonic_count(self.degree);
        let first = (sun * self.nodes.altitude_count() + altitude) * count;
        &self.harmonics[first..first + count]
    }

    /// The sky's irradiance on the ground for a sun between the nodes.
    #[must_use]
    pub fn irradiance_at(&self, mu_sun: f64) -> Light {
        let Place { index, fraction } = self.nodes.sun_place(mu_sun);
        mix(&self.irradiance[index], &self.irradiance[index + 1], fraction)
    }

    /// Light scattered at a place of a ray for sun node `sun`, in terms of the azimuth: the sum over m of cos(m phi) times
    /// the result is the sum over media of `weights` times `chi_l` `J_lm` `Y_lm`.
    #[must_use]
    pub fn scattered(&self, place: &ScatteringPlace, sun: usize) -> [Light; MAX_DEGREE + 1] {
        let Place { index, fraction } = place.altitude;
        let (below, above) = (self.at(sun, index), self.at(sun, index + 1));
        let (to_below, to_above) = weights(fraction);
        let mut sums = [DARK; MAX_DEGREE + 1];
        for l in 0..=self.degree {
            for (m, sum) in sums.iter_mut().enumerate().take(l + 1) {
                let k = harmonic_index(l, m);
                let (low, high) = (place.zenith[k] * to_below, place.zenith[k] * to_above);
                for (i, sum) in sum.iter_mut().enumerate() {
                    *sum += place.weights[l][i] * (low * below[k][i] + high * above[k][i]);
                }
            }
        }
        sums
    }
}

/// What a place on a ray does to the light around it.
#[derive(Clone, Debug)]
pub struct ScatteringPlace {
    /// Its altitude among the nodes.
    pub altitude: Place,
    /// The parts of the harmonics for the zenith angle of the ray there.
    pub zenith: [f32; MAX_HARMONICS],
    /// For each degree the sum over media of `chi_l` and of what one unit of mean light adds to the ray's radiance.
    pub weights: [Light; MAX_DEGREE + 1],
}

/// Linear interpolation.
#[must_use]
pub fn mix(a: &Light, b: &Light, fraction: f64) -> Light {
    let (to_a, to_b) = weights(fraction);
    std::array::from_fn(|i| to_a * a[i] + to_b * b[i])
}

#[expect(clippy::cast_possible_truncation, reason = "tables are f32")]
fn weights(fraction: f64) -> (f32, f32) {
    ((1.0 - fraction) as f32, fraction as f32)
}

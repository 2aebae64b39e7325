//! Aerial perspective along one ray: the light that the air adds up to any distance, and what it takes away.
//!
//! Exact: [`aerial_exact`]; table of 64 slices that grow with the distance: [`AerialSlices::new`]; lookup between them:
//! [`AerialSlices::seen`]. A slice has four pieces in which the altitude counts as linear: the column of every medium is then
//! exact, however thin a layer of fog is, and light is taken at the centre of the piece's extinction. WGSL:
//! `shaders/aerial`, which holds a volume of such rays in linear Rec.709.

use tyndall_core::spectrum::{Spectrum, WAVELENGTH_COUNT, rec709_from_spectrum};

use crate::atmosphere::{AEROSOL, AIR, HAZE, MEDIUM_COUNT, OZONE, SCATTERER_COUNT, SCATTERERS};
use crate::geometry::{Ray, altitude_along, horizon_mu, mu_along};
use crate::irradiance_table::sky_irradiance;
use crate::march::Marcher;
use crate::medium::Profile;
use crate::optical_length::{Columns, columns_along};
use crate::orders::{SourceTable, diffuse_scattered};
use crate::single_scattering::{RayEnd, scattered_parts};

/// Slices of a ray; slice k ends at ((k + 1) / 64)^2 of its length.
pub const AERIAL_SLICES: usize = 64;

/// Pieces of a slice.
const PIECES: usize = 4;

/// Air in front of a point: linear Rec.709.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AerialSeen {
    /// Transmittance in red, green and blue, for the light that level ground reflects.
    pub transmittance: [f64; 3],
    /// Light that the air adds (cd/m^2).
    pub light: [f64; 3],
}

/// Spectral radiance (W/m^2/sr/nm) that the air adds over `length_m` of a ray, by direct quadrature, and its transmittance.
#[must_use]
pub fn aerial_exact(marcher: &Marcher, source: Option<&SourceTable>, ray: &Ray, length_m: f64) -> (Spectrum, Spectrum) {
    let parts = scattered_parts(&marcher.atmosphere, ray, length_m);
    let phases = marcher.atmosphere.phases(ray.nu);
    let end = RayEnd { length_m, on_ground: false };
    let diffuse = source.map(|source| diffuse_scattered(marcher, source, ray, end)).unwrap_or_default();
    let light = std::array::from_fn(|k| {
        diffuse[k] + parts.iter().zip(phases).map(|(part, phase)| phase * part[k]).sum::<f64>()
    });
    let columns = columns_along(&marcher.atmosphere, ray.h_m, ray.mu, length_m);
    (light, marcher.coefficients.transmittance(&columns))
}

/// Light and transmittance at the ends of the slices of one ray.
#[derive(Clone, Debug)]
pub struct AerialSlices {
    far_m: f64,
    /// Light of the air and of all orders, and of aerosol and haze before their phase functions (cd/m^2).
    light: Vec<[[f64; 3]; SCATTERER_COUNT]>,
    /// Optical depth in the three colours.
    depth: Vec<[f64; 3]>,
    phases: [f64; SCATTERER_COUNT],
}

impl AerialSlices {
    /// Slices of a ray up to `far_m`; without a source table light counts that was scattered once.
    #[must_use]
    pub fn new(marcher: &Marcher, source: Option<&SourceTable>, ray: &Ray, far_m: f64) -> Self {
        let distance = |slice: usize| far_m * (slice as f64 / AERIAL_SLICES as f64).powi(2);
        let on_ground = light_on_ground(marcher, source, ray.mu_sun);
        let mut slices =
            Self { far_m, light: Vec::new(), depth: Vec::new(), phases: marcher.atmosphere.phases(ray.nu) };
        let (mut columns, mut sums) = ([0.0; MEDIUM_COUNT], [[0.0; 3]; SCATTERER_COUNT]);
        for slice in 0..AERIAL_SLICES {
            let added = slice_light(marcher, source, ray, (distance(slice), distance(slice + 1)), &mut columns);
            for (sum, added) in sums.iter_mut().zip(added) {
                let added = rec709_from_spectrum(&added);
                *sum = std::array::from_fn(|c| sum[c] + added[c]);
            }
            slices.light.push(sums);
            slices.depth.push(colour_depth(&on_ground, &marcher.coefficients.transmittance(&columns)));
        }
        slices
    }

    /// The stored slices: light of the air and all orders, of aerosol and haze before their phase functions (cd/m^2), and
    /// optical depth.
    pub fn texels(&self) -> impl Iterator<Item = (&[[f64; 3]; SCATTERER_COUNT], &[f64; 3])> {
        self.light.iter().zip(&self.depth)
    }

    /// Air in front of a point at a distance (m).
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "0 to the number of slices")]
    pub fn seen(&self, distance_m: f64) -> AerialSeen {
        let share = (distance_m / self.far_m).clamp(0.0, 1.0).sqrt() * AERIAL_SLICES as f64;
        let slice = (share as usize).min(AERIAL_SLICES - 1);
        let edge = |slice: usize| self.far_m * (slice as f64 / AERIAL_SLICES as f64).powi(2);
        let within = ((distance_m - edge(slice)) / (edge(slice + 1) - edge(slice))).clamp(0.0, 1.0);
        let (before, depth_before) =
            slice.checked_sub(1).map_or(([0.0; 3], [0.0; 3]), |last| (self.radiance(last), self.depth[last]));
        let (behind, depth_behind) = (self.radiance(slice), self.depth[slice]);
        let mut seen = AerialSeen { transmittance: [0.0; 3], light: [0.0; 3] };
        for c in 0..3 {
            let depth = (depth_behind[c] - depth_before[c]).max(0.0);
            let reached = if depth < 1e-3 { within } else { (-within * depth).exp_m1() / (-depth).exp_m1() };
            seen.light[c] = before[c] + reached * (behind[c] - before[c]);
            seen.transmittance[c] = (-depth_before[c] - within * depth).exp();
        }
        seen
    }

    /// Light (cd/m^2) up to the end of a slice.
    fn radiance(&self, slice: usize) -> [f64; 3] {
        let [air, aerosol, haze] = &self.light[slice];
        std::array::from_fn(|c| air[c] + self.phases[1] * aerosol[c] + self.phases[2] * haze[c])
    }
}

/// Light of sun and sky on level ground (W/m^2/nm), which transmittances in colour are weighted by.
fn light_on_ground(marcher: &Marcher, source: Option<&SourceTable>, mu_sun: f64) -> Spectrum {
    let sun = marcher.sun_on_ground(mu_sun);
    let sky = source.map_or_else(|| sky_irradiance(marcher, mu_sun), |source| source.irradiance(mu_sun));
    // By night any light will do.
    std::array::from_fn(|k| sun[k] + sky[k] + 1e-9 * marcher.coefficients.solar_irradiance_w_m2_nm[k])
}

/// Optical depth in the three colours of what dims this light.
fn colour_depth(light: &Spectrum, transmittance: &Spectrum) -> [f64; 3] {
    let dimmed = rec709_from_spectrum(&std::array::from_fn(|k| light[k] * transmittance[k]));
    let whole = rec709_from_spectrum(light);
    std::array::from_fn(|c| -(dimmed[c].max(1e-30) / whole[c].max(1e-30)).ln())
}

/// What a slice adds (W/m^2/sr/nm; aerosol and haze before their phase functions); `columns` (m) grow by its own.
fn slice_light(
    marcher: &Marcher,
    source: Option<&SourceTable>,
    ray: &Ray,
    (from_m, to_m): (f64, f64),
    columns: &mut Columns,
) -> [Spectrum; SCATTERER_COUNT] {
    let coefficients = &marcher.coefficients;
    let at = |share: f64| from_m + (to_m - from_m) * share;
    let mut sums = [[0.0; WAVELENGTH_COUNT]; SCATTERER_COUNT];
    // Diffuse light changes slowly: once a slice.
    let around = source.map(|source| diffuse(marcher, source, ray, at(0.5))).unwrap_or_default();
    for i in 0..PIECES {
        let share = |i: usize| i as f64 / PIECES as f64;
        let (own, centre_m) = piece(marcher, ray, at(share(i)), at(share(i + 1)));
        let view = coefficients.transmittance(columns);
        let sun = sunlight(marcher, ray, centre_m);
        for k in 0..WAVELENGTH_COUNT {
            let depth: f64 = (0..MEDIUM_COUNT).map(|m| coefficients.extinction_per_m[m][k] * own[m]).sum();
            let seen = view[k] * if depth < 1e-6 { 1.0 } else { -(-depth).exp_m1() / depth };
            for (index, medium) in SCATTERERS.into_iter().enumerate() {
                let single = seen * sun[k] * coefficients.source_w_m3_nm[index][k] * own[medium];
                let scattering = marcher.atmosphere.media[medium].scattering_per_m[k];
                sums[0][k] += seen * around[index][k] * scattering * own[medium];
                sums[index][k] += single * if index == 0 { marcher.atmosphere.phases(ray.nu)[0] } else { 1.0 };
            }
        }
        *columns = std::array::from_fn(|m| columns[m] + own[m]);
    }
    sums
}

/// Columns (m) of a piece, and the distance (m) of the centre of its extinction.
fn piece(marcher: &Marcher, ray: &Ray, from_m: f64, to_m: f64) -> (Columns, f64) {
    let atmosphere = &marcher.atmosphere;
    let [a, b] = [from_m, to_m].map(|t_m| altitude_along(atmosphere.planet_radius_m, ray.h_m, ray.mu, t_m).max(0.0));
    let columns = [AIR, AEROSOL, OZONE, HAZE]
        .map(|medium| mean_density(&atmosphere.media[medium].profile, a, b) * (to_m - from_m));
    let extinction = |altitude_m: f64| -> f64 {
        [AIR, AEROSOL, HAZE]
            .map(|m| marcher.coefficients.extinction_per_m[m][4] * atmosphere.media[m].profile.density(altitude_m))
            .iter()
            .sum()
    };
    let ends = (extinction(a), extinction(b));
    let sum = ends.0 + ends.1;
    let share = if sum > 1e-29 { (ends.0 + 2.0 * ends.1) / (3.0 * sum) } else { 0.5 };
    (columns, from_m + share * (to_m - from_m))
}

/// Mean density between two altitudes (m) at which a ray passes all between them evenly.
fn mean_density(profile: &Profile, a: f64, b: f64) -> f64 {
    match *profile {
        Profile::Exponential { scale_height_m } => mean_exponential(a, b, scale_height_m),
        Profile::Layer { top_m, scale_height_m } => {
            let (low, high) = (a.min(b), a.max(b));
            if high <= top_m {
                1.0
            } else if low >= top_m {
                mean_exponential(low - top_m, high - top_m, scale_height_m)
            } else {
                let above = mean_exponential(0.0, high - top_m, scale_height_m) * (high - top_m);
                (top_m - low + above) / (high - low)
            }
        }
        _ => profile.density(0.5 * (a + b)),
    }
}

/// Mean of exp(-h / H) between two altitudes.
fn mean_exponential(a: f64, b: f64, scale_height_m: f64) -> f64 {
    let rise = (b - a) / scale_height_m;
    if rise.abs() < 1e-3 {
        (-0.5 * (a + b) / scale_height_m).exp()
    } else {
        (-a / scale_height_m).exp() * -(-rise).exp_m1() / rise
    }
}

/// Transmittance from a point of a ray to the sun; nothing in the planet's shadow.
fn sunlight(marcher: &Marcher, ray: &Ray, t_m: f64) -> Spectrum {
    let radius_m = marcher.atmosphere.planet_radius_m;
    let top_m = marcher.atmosphere.top_altitude_m;
    let altitude_m = altitude_along(radius_m, ray.h_m, ray.mu, t_m).clamp(0.0, top_m);
    let mu_sun = mu_along(radius_m, ray.h_m, ray.mu_sun, ray.nu, t_m, altitude_m);
    if mu_sun < horizon_mu(radius_m, altitude_m) {
        return [0.0; WAVELENGTH_COUNT];
    }
    marcher.coefficients.transmittance(&marcher.columns.lookup(altitude_m, mu_sun))
}

/// Mean light of all orders around a point of a ray, weighted by each medium's phase function (W/m^2/sr/nm).
fn diffuse(marcher: &Marcher, source: &SourceTable, ray: &Ray, t_m: f64) -> [Spectrum; SCATTERER_COUNT] {
    let radius_m = marcher.atmosphere.planet_radius_m;
    let altitude_m = altitude_along(radius_m, ray.h_m, ray.mu, t_m).clamp(0.0, marcher.atmosphere.top_altitude_m);
    let along = |mu_other: f64, nu: f64| mu_along(radius_m, ray.h_m, mu_other, nu, t_m, altitude_m);
    source.scattered_at(altitude_m, (along(ray.mu, 1.0), along(ray.mu_sun, ray.nu)), ray.nu)
}

#[cfg(test)]
mod tests;

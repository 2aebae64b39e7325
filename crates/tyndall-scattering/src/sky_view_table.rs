//! Table of the sky for one observer altitude and one sun: directions to radiance.
//!
//! What the paper calls the look-up table of the sky's intensity distribution. Rows run from the nadir over the horizon
//! to the zenith, a quarter below and the rest above, quadratically dense at the horizon, which no interpolation crosses; columns
//! run over the azimuth from the sun, 0 to pi, the other half being its mirror image. A texel holds linear Rec.709 of
//! light scattered by air, aerosol and haze *before* their phase functions, which are multiplied per pixel, so that the
//! aureole is sharp at any size of the table. Light of higher orders has a table of its own, [`crate::sky_diffuse_table`].
//! The sun's disc and the ground are not in it.
//!
//! Exact: [`crate::single_scattering`]; table: [`SkyViewTable::new`]; lookup: [`SkyViewTable::lookup`].
//! WGSL: `shaders/sky/sky_view_*`.

use rayon::prelude::*;
use tyndall_core::grid::Grid2;
use tyndall_core::spectrum::rec709_from_spectrum;

use crate::atmosphere::SCATTERER_COUNT;
use crate::geometry::Ray;
use crate::march::Marcher;
use crate::orders::SourceTable;
use crate::sky_diffuse_table::SkyDiffuseTable;
use crate::sky_view_map::{ROWS_PER_ROW_BELOW, horizon_elevation, row_length_m, sky_view_map, sky_view_map_inverse};

/// Linear Rec.709 (cd/m^2 sr) by each scatterer, before the phase functions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkyTexel(pub [[f64; 3]; SCATTERER_COUNT]);

impl std::ops::Add for SkyTexel {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(std::array::from_fn(|part| std::array::from_fn(|i| self.0[part][i] + other.0[part][i])))
    }
}

impl std::ops::Mul<f64> for SkyTexel {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self(self.0.map(|part| part.map(|value| value * factor)))
    }
}

/// The sky of one observer and one sun.
#[derive(Clone, Debug)]
pub struct SkyViewTable {
    horizon_elevation: f64,
    /// Above the horizon: azimuths x rows, row 0 at the horizon.
    above: Grid2<SkyTexel>,
    /// Below the horizon: azimuths x rows, row 0 at the horizon.
    below: Grid2<SkyTexel>,
    /// Light of the higher orders, where it counts.
    diffuse: Option<SkyDiffuseTable>,
}

impl SkyViewTable {
    /// Fills the table for an observer at `h_m` (inside the atmosphere) and a sun of zenith cosine `mu_sun`; `size` =
    /// [azimuths, rows], rows a multiple of 4.
    #[must_use]
    pub fn new(marcher: &Marcher, h_m: f64, mu_sun: f64, size: [usize; 2]) -> Self {
        let horizon_elevation = horizon_elevation(marcher.atmosphere.planet_radius_m, h_m);
        let rows_below = size[1] / ROWS_PER_ROW_BELOW;
        let texel = |x: usize, y: usize, part: [usize; 2], above: bool| {
            let unit = [x as f64 / (part[0] - 1) as f64, y as f64 / (part[1] - 1) as f64];
            let (elevation, azimuth) = sky_view_map_inverse(horizon_elevation, above, unit);
            let (mu, sine) = (elevation.sin(), elevation.cos());
            let nu = mu * mu_sun + sine * (1.0 - mu_sun * mu_sun).max(0.0).sqrt() * azimuth.cos();
            let ray = Ray { h_m, mu, mu_sun, nu: nu.clamp(-1.0, 1.0) };
            let parts = marcher.scattered_parts_to(&ray, row_length_m(&marcher.atmosphere, &ray, above));
            SkyTexel(parts.map(|part| rec709_from_spectrum(&part)))
        };
        let fill = |rows: usize, above: bool| {
            let part = [size[0], rows];
            let cells =
                (0..size[0] * rows).into_par_iter().map(|i| texel(i % size[0], i / size[0], part, above)).collect();
            Grid2::from_cells(part, cells).expect("one texel per cell")
        };
        Self {
            horizon_elevation,
            above: fill(size[1] - rows_below, true),
            below: fill(rows_below, false),
            diffuse: None,
        }
    }

    /// The same table with the light of all orders; `diffuse_size` = [azimuths, rows] of the part that changes slowly,
    /// rows a multiple of 4.
    #[must_use]
    pub fn with_orders(
        self,
        (marcher, source): (&Marcher, &SourceTable),
        (h_m, mu_sun): (f64, f64),
        diffuse_size: [usize; 2],
    ) -> Self {
        Self { diffuse: Some(SkyDiffuseTable::new(marcher, source, (h_m, mu_sun), diffuse_size)), ..self }
    }

    /// The parts in a direction: elevation above the horizontal and azimuth from the sun (rad).
    #[must_use]
    pub fn lookup(&self, elevation: f64, azimuth: f64) -> SkyTexel {
        let above = elevation >= self.horizon_elevation;
        let part = if above { &self.above } else { &self.below };
        let unit = sky_view_map(self.horizon_elevation, elevation, azimuth);
        let centre = |axis: usize| {
            let count = part.size()[axis] as f64;
            (unit[axis] * (count - 1.0) + 0.5) / count
        };
        part.sample([centre(0), centre(1)])
    }

    /// Radiance (cd/m^2) in a direction, phase functions included.
    #[must_use]
    pub fn radiance(&self, marcher: &Marcher, elevation: f64, azimuth: f64, nu: f64) -> [f64; 3] {
        let SkyTexel(parts) = self.lookup(elevation, azimuth);
        let mut radiance = self.diffuse.as_ref().map_or([0.0; 3], |table| table.lookup(elevation, azimuth));
        for (phase, part) in marcher.atmosphere.phases(nu).into_iter().zip(parts) {
            for (sum, value) in radiance.iter_mut().zip(part) {
                *sum += phase * value;
            }
        }
        radiance
    }

    /// Texels below the horizon from the nadir up, then above it up to the zenith: the rows of the GPU's texture.
    pub fn texels(&self) -> impl Iterator<Item = &SkyTexel> {
        let columns = self.below.size()[0];
        self.below.cells().chunks(columns).rev().flatten().chain(self.above.cells())
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;
    use crate::Atmosphere;
    use crate::atmosphere::AIR;
    use crate::params::{AtmosphereParams, GroundParams};
    use crate::single_scattering::single_scattering;

    fn marcher(panels: usize) -> Marcher {
        let black = GroundParams { red: 0.0, green: 0.0, blue: 0.0, ..GroundParams::default() };
        Marcher::new(Atmosphere::new(&AtmosphereParams::default(), &black), panels).unwrap()
    }

    /// Directions on no texel's centre, from the zenith to half a degree above the horizon.
    fn directions() -> impl Iterator<Item = (f64, f64)> {
        let zeniths = [0.3, 20.7, 45.2, 61.1, 75.3, 82.1, 85.7, 88.1, 89.0, 89.5];
        zeniths.into_iter().flat_map(|zenith: f64| [3.1, 41.3, 97.9, 171.7].map(|azimuth: f64| (zenith, azimuth)))
    }

    const SUN_ZENITHS_DEG: [f64; 7] = [0.0, 30.0, 60.0, 75.0, 85.0, 88.0, 90.0];
    const EYE_M: f64 = 2.0;

    #[test]
    fn the_march_equals_the_exact_integral_within_three_per_mille() {
        let marcher = marcher(8);
        let mut worst = 0.0_f64;
        for sun_zenith in SUN_ZENITHS_DEG {
            for (zenith, azimuth) in directions() {
                let [view, sun, azimuth] = [zenith, sun_zenith, azimuth].map(f64::to_radians);
                let ray = Ray::from_angles(EYE_M, view, sun, azimuth);
                let parts = marcher.scattered_parts(&ray);
                let phases = marcher.atmosphere.phases(ray.nu);
                let exact = single_scattering(&marcher.atmosphere, &ray);
                // Relative to the direction's strongest wavelength: at the horizon of a setting sun violet is 1e-7 of red.
                let strongest = exact.iter().copied().fold(0.0, f64::max);
                for (k, exact) in exact.into_iter().enumerate() {
                    let got: f64 = phases.iter().zip(&parts).map(|(phase, part)| phase * part[k]).sum();
                    let error = (got - exact).abs() / strongest;
                    assert!(error < 3e-3, "sun {sun_zenith} view {zenith} wavelength {k}: {error:.1e}");
                    worst = worst.max(error);
                }
            }
        }
        println!("march against exact integral: worst {worst:.1e}");
    }

    #[test]
    fn the_table_equals_the_exact_integral_within_half_a_per_cent() {
        let marcher = marcher(8);
        let mut worst = 0.0_f64;
        for sun_zenith in SUN_ZENITHS_DEG {
            let mu_sun = sun_zenith.to_radians().cos();
            let table = SkyViewTable::new(&marcher, EYE_M, mu_sun, [96, 320]);
            let exact: Vec<_> = directions()
                .map(|(zenith, azimuth)| {
                    let [view, sun, azimuth] = [zenith, sun_zenith, azimuth].map(f64::to_radians);
                    let ray = Ray::from_angles(EYE_M, view, sun, azimuth);
                    let spectrum = single_scattering(&marcher.atmosphere, &ray).try_into().expect("eight wavelengths");
                    (view, azimuth, ray.nu, rec709_from_spectrum(&spectrum))
                })
                .collect();
            let brightest = exact.iter().flat_map(|(.., rgb)| rgb).fold(0.0_f64, |a, b| a.max(*b));
            for (view, azimuth, nu, want) in exact {
                let got = table.radiance(&marcher, FRAC_PI_2 - view, azimuth, nu);
                // Relative to the pixel's largest channel; in the earth's shadow, where the radiance falls by decades
                // within a degree, to a hundredth of the brightest direction.
                let scale = want.iter().fold(0.01 * brightest, |a, b| a.max(b.abs()));
                let error = got.iter().zip(want).map(|(g, w)| (g - w).abs() / scale).fold(0.0, f64::max);
                assert!(error < 5e-3, "sun {sun_zenith} view {}: {error:.1e}", view.to_degrees());
                worst = worst.max(error);
            }
        }
        println!("sky table against exact integral: worst {worst:.1e}");
    }

    #[test]
    fn the_table_of_a_high_observer_holds_the_air_in_front_of_the_ground_too() {
        let marcher = marcher(8);
        let (h_m, mu_sun) = (10e3, 0.5_f64);
        let table = SkyViewTable::new(&marcher, h_m, mu_sun, [96, 320]);
        for (zenith, azimuth) in [(179.0, 0.4), (150.3, 1.3), (120.7, 2.0), (100.1, 0.2), (94.0, 2.9), (91.1, 1.7)] {
            let view = f64::to_radians(zenith);
            let ray = Ray::from_angles(h_m, view, mu_sun.acos(), azimuth);
            let exact = single_scattering(&marcher.atmosphere, &ray).try_into().expect("eight wavelengths");
            let got = table.radiance(&marcher, FRAC_PI_2 - view, azimuth, ray.nu);
            for (got, want) in got.into_iter().zip(rec709_from_spectrum(&exact)) {
                assert!((got / want - 1.0).abs() < 5e-3, "view {zenith}: {got} {want}");
            }
        }
    }

    #[test]
    fn the_sky_is_continuous_across_the_edges_of_the_shadow_for_every_sun() {
        let marcher = marcher(8);
        for sun in 0..40 {
            let sun_zenith = (84.0 + 0.37 * f64::from(sun)).to_radians();
            let at = |elevation: f64| {
                let ray = Ray::from_angles(EYE_M, FRAC_PI_2 - elevation, sun_zenith, 2.5);
                marcher.scattered_parts(&ray)[AIR][5]
            };
            let (mut before, step) = (at(0.01), 0.002);
            for i in 1..200 {
                let here = at(0.01 + step * f64::from(i));
                assert!(here.is_finite() && here >= 0.0, "{here}");
                let jump = (here - before).abs();
                assert!(jump <= 0.25 * here.max(before) + 1e-3, "sun {sun_zenith} row {i}: {before} {here}");
                before = here;
            }
        }
    }
}

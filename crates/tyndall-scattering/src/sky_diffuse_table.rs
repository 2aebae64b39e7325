//! The part of the sky's table that was scattered more than once.
//!
//! Same map as [`crate::sky_view_table`]; a texel holds the radiance itself, as linear Rec.709 (cd/m^2), without a phase
//! function: this light has no aureole, so that a third of the columns and a quarter of the rows hold it.
//!
//! Exact: [`crate::orders::diffuse_scattered`]; table: [`SkyDiffuseTable::new`]; lookup: [`SkyDiffuseTable::lookup`].
//! WGSL: `shaders/sky/sky_view_diffuse.wgsl`.

use rayon::prelude::*;
use tyndall_core::grid::Grid2;
use tyndall_core::spectrum::rec709_from_spectrum;

use crate::geometry::Ray;
use crate::march::Marcher;
use crate::orders::{SourceTable, diffuse_scattered};
use crate::single_scattering::RayEnd;
use crate::sky_view_map::{ROWS_PER_ROW_BELOW, horizon_elevation, row_length_m, sky_view_map, sky_view_map_inverse};
use crate::texel::Texel;

/// Light of higher orders for one observer and one sun.
#[derive(Clone, Debug)]
pub struct SkyDiffuseTable {
    horizon_elevation: f64,
    /// Linear Rec.709 (cd/m^2) above the horizon: azimuths x rows, row 0 at the horizon.
    above: Grid2<Texel<3>>,
    /// The same below the horizon.
    below: Grid2<Texel<3>>,
}

impl SkyDiffuseTable {
    /// Fills the table for an observer at `h_m` (inside the atmosphere) and a sun of zenith cosine `mu_sun`; `size` =
    /// [azimuths, rows], rows a multiple of 4.
    #[must_use]
    pub fn new(
        marcher: &Marcher,
        source: &SourceTable,
        (h_m, mu_sun): (f64, f64),
        [azimuths, rows]: [usize; 2],
    ) -> Self {
        let horizon_elevation = horizon_elevation(marcher.atmosphere.planet_radius_m, h_m);
        let rows_below = rows / ROWS_PER_ROW_BELOW;
        let texel = |unit: [f64; 2], above: bool| {
            let (elevation, azimuth) = sky_view_map_inverse(horizon_elevation, above, unit);
            let (mu, sine) = (elevation.sin(), elevation.cos());
            let nu = mu * mu_sun + sine * (1.0 - mu_sun * mu_sun).max(0.0).sqrt() * azimuth.cos();
            let ray = Ray { h_m, mu, mu_sun, nu: nu.clamp(-1.0, 1.0) };
            let end = RayEnd { length_m: row_length_m(&marcher.atmosphere, &ray, above), on_ground: false };
            Texel(rec709_from_spectrum(&diffuse_scattered(marcher, source, &ray, end)))
        };
        let fill = |rows: usize, above: bool| {
            let unit = |i: usize, count: usize| i as f64 / (count - 1) as f64;
            let at = |i: usize| texel([unit(i % azimuths, azimuths), unit(i / azimuths, rows)], above);
            let cells = (0..azimuths * rows).into_par_iter().map(at).collect();
            Grid2::from_cells([azimuths, rows], cells).expect("one texel per cell")
        };
        Self { horizon_elevation, above: fill(rows - rows_below, true), below: fill(rows_below, false) }
    }

    /// Radiance (cd/m^2) in a direction: elevation above the horizontal and azimuth from the sun (rad).
    #[must_use]
    pub fn lookup(&self, elevation: f64, azimuth: f64) -> [f64; 3] {
        let part = if elevation >= self.horizon_elevation { &self.above } else { &self.below };
        let unit = sky_view_map(self.horizon_elevation, elevation, azimuth);
        let centre = |axis: usize| {
            let count = part.size()[axis] as f64;
            (unit[axis] * (count - 1.0) + 0.5) / count
        };
        part.sample([centre(0), centre(1)]).0
    }

    /// Texels below the horizon from the nadir up, then above it up to the zenith: the rows of the GPU's texture.
    pub fn texels(&self) -> impl Iterator<Item = [f64; 3]> {
        let columns = self.below.size()[0];
        self.below.cells().chunks(columns).rev().flatten().chain(self.above.cells()).map(|texel| texel.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    use crate::Atmosphere;
    use crate::orders::{OrdersQuality, diffuse_radiance};
    use crate::params::{AtmosphereParams, GroundParams};
    use crate::single_scattering::single_scattering;
    use crate::sky_view_table::SkyViewTable;

    const EYE_M: f64 = 2.0;

    fn sky() -> (Marcher, SourceTable) {
        let atmosphere = Atmosphere::new(&AtmosphereParams::default(), &GroundParams::default());
        let marcher = Marcher::new(atmosphere, 8).expect("eight wavelengths");
        let source = SourceTable::new(&marcher, &OrdersQuality::preview());
        (marcher, source)
    }

    #[test]
    fn the_diffuse_table_equals_its_integral_between_texels_within_half_a_per_cent() {
        let (marcher, source) = sky();
        let mut worst = 0.0_f64;
        for sun_zenith in [20.0_f64, 70.0, 88.0, 93.0, 97.0] {
            let mu_sun = sun_zenith.to_radians().cos();
            let table = SkyDiffuseTable::new(&marcher, &source, (EYE_M, mu_sun), [32, 80]);
            for view in [1.3_f64, 33.0, 61.0, 78.0, 85.5, 88.7, 89.6] {
                for azimuth in [0.05, 0.9, 1.7, 3.0] {
                    let ray = Ray::from_angles(EYE_M, view.to_radians(), sun_zenith.to_radians(), azimuth);
                    let end = RayEnd { length_m: row_length_m(&marcher.atmosphere, &ray, true), on_ground: false };
                    let want = rec709_from_spectrum(&diffuse_scattered(&marcher, &source, &ray, end));
                    let got = table.lookup(FRAC_PI_2 - view.to_radians(), azimuth);
                    let brightest = want.iter().copied().fold(0.0, f64::max);
                    let error = got.iter().zip(want).map(|(g, w)| (g - w).abs() / brightest).fold(0.0, f64::max);
                    assert!(error < 5e-3, "sun {sun_zenith} view {view} azimuth {azimuth}: {error:.1e}");
                    worst = worst.max(error);
                }
            }
        }
        println!("diffuse table between texels: worst {worst:.1e}");
    }

    #[test]
    fn the_sky_with_all_orders_is_single_scattering_plus_diffuse_light() {
        let (marcher, source) = sky();
        let (sun_zenith, view, azimuth) = (60.0_f64.to_radians(), 80.0_f64.to_radians(), 1.0);
        let single = SkyViewTable::new(&marcher, EYE_M, sun_zenith.cos(), [96, 320]);
        let table = single.clone().with_orders((&marcher, &source), (EYE_M, sun_zenith.cos()), [32, 80]);
        let ray = Ray::from_angles(EYE_M, view, sun_zenith, azimuth);
        let first = single_scattering(&marcher.atmosphere, &ray);
        let more = diffuse_radiance(&marcher, &source, &ray);
        let want = rec709_from_spectrum(&std::array::from_fn(|k| first[k] + more[k]));
        let got = table.radiance(&marcher, FRAC_PI_2 - view, azimuth, ray.nu);
        let once = single.radiance(&marcher, FRAC_PI_2 - view, azimuth, ray.nu);
        for c in 0..3 {
            assert!((got[c] / want[c] - 1.0).abs() < 5e-3, "channel {c}: {} {}", got[c], want[c]);
            // Near the horizon half of the light has been scattered more than once.
            assert!(got[c] > 1.5 * once[c], "channel {c}: {} {}", got[c], once[c]);
        }
    }
}

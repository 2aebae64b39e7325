//! Table of the columns from any altitude in any direction to the top of the atmosphere.
//!
//! Wavelength-free, as in Nishita et al. 1993: one table serves every wavelength and every position of the sun. The map is
//! that of Bruneton and Neyret 2008: x runs with the distance to the top, so that it is dense at the horizon; y runs with
//! the distance to the horizon, so that it is dense at the ground. Columns of air and aerosol are stored as
//! ln (column / density at the observer), Chapman's function, which varies slowly where the column itself falls by e each
//! scale height; ozone as it is. Haze has a closed form ([`crate::layer_column`]) and no place in the table.
//!
//! Exact: [`crate::optical_length::columns_to_top`]; table: [`ColumnTable::new`]; lookup: [`ColumnTable::lookup`]. WGSL: `shaders/sky/column_*`.

use rayon::prelude::*;
use tyndall_core::grid::Grid2;

use crate::Atmosphere;
use crate::atmosphere::{AEROSOL, AIR, OZONE};
use crate::geometry::{distance_to_top, horizon_mu};
use crate::layer_column::HazeLayer;
use crate::medium::Profile;
use crate::optical_length::{Columns, clear_columns_to_top};
use crate::texel::Texel;

/// Texels of the table: distances, altitudes.
pub const COLUMN_TABLE_SIZE: [usize; 2] = [256, 128];

/// Columns smaller than this (m) are stored as this, so that the logarithm stays finite.
const SMALLEST_COLUMN_M: f64 = 1e-300;

/// Columns of all media to the top of the atmosphere.
#[derive(Clone, Debug)]
pub struct ColumnTable {
    planet_radius_m: f64,
    top_altitude_m: f64,
    /// Density profiles of air and aerosol.
    profiles: [Profile; 2],
    /// ln (air / density), ln (aerosol / density), ozone.
    cells: Grid2<Texel<STORED_COUNT>>,
    haze: Option<HazeLayer>,
}

/// Media in the table: air, aerosol, ozone.
const STORED_COUNT: usize = 3;

impl ColumnTable {
    /// Fills the table, about 33,000 quadratures of three media.
    #[must_use]
    pub fn new(atmosphere: &Atmosphere) -> Self {
        let (planet_radius_m, top_altitude_m) = (atmosphere.planet_radius_m, atmosphere.top_altitude_m);
        let profiles = [AIR, AEROSOL].map(|medium| atmosphere.media[medium].profile);
        let texel = |index: usize| {
            let (x, y) = (index % COLUMN_TABLE_SIZE[0], index / COLUMN_TABLE_SIZE[0]);
            let unit = |i: usize, axis: usize| i as f64 / (COLUMN_TABLE_SIZE[axis] - 1) as f64;
            let (h_m, mu) = column_map_inverse(planet_radius_m, top_altitude_m, [unit(x, 0), unit(y, 1)]);
            let columns = clear_columns_to_top(atmosphere, h_m, mu);
            let relative =
                |profile: &Profile, column_m: f64| column_m.max(SMALLEST_COLUMN_M).ln() - profile.ln_density(h_m);
            let [air, aerosol] = &profiles;
            Texel([relative(air, columns[AIR]), relative(aerosol, columns[AEROSOL]), columns[OZONE]])
        };
        let texels = (0..COLUMN_TABLE_SIZE[0] * COLUMN_TABLE_SIZE[1]).into_par_iter().map(texel).collect();
        let cells = Grid2::from_cells(COLUMN_TABLE_SIZE, texels).expect("one texel per cell");
        let table = Self { planet_radius_m, top_altitude_m, profiles, cells, haze: None };
        table.with_haze_of(atmosphere)
    }

    /// The same table with the haze of another atmosphere, whose other media have the profiles of this one's.
    #[must_use]
    pub fn with_haze_of(self, atmosphere: &Atmosphere) -> Self {
        Self { haze: atmosphere.haze_layer(), ..self }
    }

    /// Columns (m) from altitude `h_m` (0 to the top) in a direction above the horizon.
    #[must_use]
    pub fn lookup(&self, h_m: f64, mu: f64) -> Columns {
        let [x, y] = column_map(self.planet_radius_m, self.top_altitude_m, h_m, mu);
        let (x0, fx) = texel_below(x, COLUMN_TABLE_SIZE[0]);
        let (y0, fy) = texel_below(y, COLUMN_TABLE_SIZE[1]);
        let along = |y: usize| self.cells[[x0, y]] * (1.0 - fx) + self.cells[[x0 + 1, y]] * fx;
        let Texel([air, aerosol, ozone]) = along(y0) * (1.0 - fy) + along(y0 + 1) * fy;
        let column = |relative: f64, profile: &Profile| (relative + profile.ln_density(h_m)).exp();
        let haze = self.haze.map_or(0.0, |layer| layer.column(h_m, mu));
        [column(air, &self.profiles[0]), column(aerosol, &self.profiles[1]), ozone, haze]
    }

    /// The haze, if there is some.
    #[must_use]
    pub fn haze(&self) -> Option<&HazeLayer> {
        self.haze.as_ref()
    }

    /// The stored texels (ln of air and of aerosol over the density at the texel's altitude, ozone), x fastest.
    pub fn texels(&self) -> impl Iterator<Item = [f64; STORED_COUNT]> {
        self.cells.cells().iter().map(|texel| texel.0)
    }
}

/// The texel below a coordinate of 0 to 1, never the last, and the distance from it in texels.
#[expect(clippy::cast_possible_truncation, reason = "0 to 1 times the texel count")]
fn texel_below(unit: f64, count: usize) -> (usize, f64) {
    let position = unit * (count - 1) as f64;
    let below = (position as usize).min(count - 2);
    (below, position - below as f64)
}

/// Place in the table, 0 to 1 on each axis from the first texel's centre to the last's, of an altitude and a direction.
#[must_use]
pub fn column_map(radius_m: f64, top_m: f64, h_m: f64, mu: f64) -> [f64; 2] {
    let rho = (h_m * (2.0 * radius_m + h_m)).sqrt();
    let rho_top = (top_m * (2.0 * radius_m + top_m)).sqrt();
    let distance_m = distance_to_top(radius_m, top_m, h_m, mu);
    let (shortest_m, longest_m) = (top_m - h_m, rho + rho_top);
    [((distance_m - shortest_m) / (longest_m - shortest_m)).clamp(0.0, 1.0), rho / rho_top]
}

/// Altitude (m) and zenith cosine of a place in the table; the inverse of [`column_map`].
#[must_use]
pub fn column_map_inverse(radius_m: f64, top_m: f64, unit: [f64; 2]) -> (f64, f64) {
    let rho_top = (top_m * (2.0 * radius_m + top_m)).sqrt();
    let rho = unit[1] * rho_top;
    // r = sqrt(R^2 + rho^2), h = r - R without cancellation.
    let h_m = rho * rho / (radius_m + radius_m.hypot(rho));
    let (shortest_m, longest_m) = (top_m - h_m, rho + rho_top);
    let distance_m = shortest_m + unit[0] * (longest_m - shortest_m);
    if distance_m <= 0.0 {
        return (h_m, 1.0);
    }
    let q = (top_m - h_m) * (2.0 * radius_m + top_m + h_m);
    let mu = (q - distance_m * distance_m) / (2.0 * (radius_m + h_m) * distance_m);
    (h_m, mu.clamp(horizon_mu(radius_m, h_m), 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optical_length::columns_to_top;
    use crate::params::{AtmosphereParams, GroundParams};

    #[test]
    fn the_map_and_its_inverse_are_inverse() {
        let (radius, top) = (6.36e6, 1e5);
        for y in 0..=20 {
            for x in 0..=20 {
                let unit = [f64::from(x) / 20.0, f64::from(y) / 20.0];
                let (h, mu) = column_map_inverse(radius, top, unit);
                let back = column_map(radius, top, h, mu);
                // At the top all directions have distance 0 or more; its first texel is a single point.
                let near = (back[0] - unit[0]).abs() < 1e-6 && (back[1] - unit[1]).abs() < 1e-6;
                assert!(near, "{unit:?} {back:?}");
            }
        }
    }

    #[test]
    fn the_ends_of_the_map_are_zenith_and_horizon() {
        let (radius, top) = (1e6, 5e5);
        for h in [0.0, 1e3, 2e5] {
            assert!(column_map(radius, top, h, 1.0)[0].abs() < 1e-12, "zenith at {h}");
            let horizon = column_map(radius, top, h, horizon_mu(radius, h))[0];
            assert!((horizon - 1.0).abs() < 1e-9, "horizon at {h}: {horizon}");
        }
    }

    #[test]
    fn transmittance_from_the_table_equals_the_exact_one_at_and_between_texels() {
        let atmosphere = Atmosphere::new(&AtmosphereParams::default(), &GroundParams::default());
        let table = ColumnTable::new(&atmosphere);
        let coefficients = atmosphere.coefficients().unwrap();
        let mut errors: Vec<f64> = (0..4000_u32)
            .map(|i| {
                let u = |k: u32| f64::from(tyndall_core::rng::CellRng::new(5).uniform(k, u64::from(i), 0));
                let (h, mu) = column_map_inverse(6.36e6, 1e5, [u(0), u(1)]);
                let exact = coefficients.transmittance(&columns_to_top(&atmosphere, h, mu));
                let got = coefficients.transmittance(&table.lookup(h, mu));
                exact.iter().zip(got).map(|(e, g)| (e - g).abs()).fold(0.0, f64::max)
            })
            .collect();
        errors.sort_by(f64::total_cmp);
        let (p99, worst) = (errors[3960], errors[3999]);
        println!("column table: transmittance error p99 {p99:.1e}, worst {worst:.1e}");
        // Absolute, of a transmittance between 0 and 1; the worst are rays that graze the edge of the ozone layer.
        assert!(p99 < 5e-4 && worst < 5e-3, "p99 {p99:.1e}, worst {worst:.1e}");
    }
}

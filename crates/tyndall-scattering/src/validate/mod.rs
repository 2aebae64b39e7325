//! The error meter: the tables' sky against Monte-Carlo, in per cent, for any atmosphere, sun and observer.
//!
//! A fixed set of directions ([`directions`]) is computed both ways: by [`TableSky`], the arithmetic of the pictures, and by
//! [`MonteCarlo`], which shares no table with it. The report tells errors by band of the sky, and the Monte-Carlo's own
//! noise, below which an error says nothing. Interpolation over the directions of a picture (0.2 %) is not in it.

pub mod directions;
mod statistics;

use tyndall_core::observer::ColourWeights;

use crate::geometry::Ray;
use crate::monte_carlo::{BATCHES, Estimate, MonteCarlo, Sampling};
use crate::orders::OrdersQuality;
use crate::table_sky::{SkyRadiance, TableSky};
use crate::{Atmosphere, ScatteringError};

pub use directions::{Band, Direction};
pub use statistics::{Pair, Statistics};

/// Share of the progress that building the tables is.
const TABLES_SHARE: f64 = 0.1;

/// How thoroughly to look.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ValidateOptions {
    /// Directions of view, 1 to 10,000.
    pub directions: usize,
    /// Random walks in each direction, 32 to 10^9; the noise falls with their root.
    pub paths: u32,
    /// Seed of the walks.
    pub seed: u64,
    /// The tables to judge.
    pub quality: OrdersQuality,
}

impl Default for ValidateOptions {
    fn default() -> Self {
        Self { directions: 60, paths: 8192, seed: 1, quality: OrdersQuality::best() }
    }
}

impl ValidateOptions {
    /// Directions that can be asked for.
    pub const DIRECTIONS: std::ops::RangeInclusive<usize> = 1..=10_000;
    /// Walks that can be asked for.
    pub const PATHS: std::ops::RangeInclusive<u32> = BATCHES..=1_000_000_000;

    fn check(&self) -> Result<(), ScatteringError> {
        let refuse = |what, value: f64, range: [f64; 2]| Err(ScatteringError::Count { what, value, range });
        let (directions, paths) = (Self::DIRECTIONS, Self::PATHS);
        if !directions.contains(&self.directions) {
            return refuse(
                "directions",
                self.directions as f64,
                [*directions.start() as f64, *directions.end() as f64],
            );
        }
        if !paths.contains(&self.paths) {
            return refuse("paths", f64::from(self.paths), [f64::from(*paths.start()), f64::from(*paths.end())]);
        }
        Ok(())
    }
}

/// One direction, both ways.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The direction.
    pub direction: Direction,
    /// Luminance (cd/m^2); the standard error is an upper bound.
    pub luminance: Pair,
    /// Spectral radiance (W/m^2/sr/nm), one pair per wavelength.
    pub spectrum: Vec<Pair>,
    /// Share of the luminance that was scattered once.
    pub single_share: f64,
}

/// Errors of a part of the sky.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BandReport {
    /// Which part; all of it if none.
    pub band: Option<Band>,
    /// Directions in it.
    pub directions: usize,
    /// Errors of spectral radiance, all wavelengths.
    pub spectrum: Statistics,
    /// Errors of luminance.
    pub luminance: Statistics,
}

/// The outcome of a comparison.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Wavelengths (nm).
    pub wavelengths_nm: Vec<f64>,
    /// All directions.
    pub rows: Vec<Row>,
    /// The whole set first, then each band that has directions.
    pub bands: Vec<BandReport>,
}

impl Report {
    fn new(wavelengths_nm: &[f64], rows: Vec<Row>) -> Self {
        let of = |band: Option<Band>| {
            let rows: Vec<&Row> =
                rows.iter().filter(|row| band.is_none_or(|band| row.direction.band == band)).collect();
            let spectrum: Vec<Pair> = rows.iter().flat_map(|row| row.spectrum.iter().copied()).collect();
            let luminance: Vec<Pair> = rows.iter().map(|row| row.luminance).collect();
            let (spectrum, luminance) = (Statistics::new(&spectrum), Statistics::new(&luminance));
            BandReport { band, directions: rows.len(), spectrum, luminance }
        };
        let bands = std::iter::once(None).chain(Band::ALL.map(Some)).map(of).filter(|band| band.directions > 0);
        let bands = bands.collect();
        Self { wavelengths_nm: wavelengths_nm.to_vec(), rows, bands }
    }

    /// Errors over all directions.
    #[must_use]
    pub fn whole(&self) -> BandReport {
        let none =
            BandReport { band: None, directions: 0, spectrum: Statistics::default(), luminance: Statistics::default() };
        self.bands.first().copied().unwrap_or(none)
    }

    /// The row and wavelength (index) of the largest error of spectral radiance.
    #[must_use]
    pub fn worst(&self) -> Option<(&Row, usize)> {
        let all = self.rows.iter().flat_map(|row| (0..row.spectrum.len()).map(move |k| (row, k)));
        all.max_by(|a, b| {
            let [a, b] = [a, b].map(|(row, k)| row.spectrum[*k].error_pct().abs());
            a.total_cmp(&b)
        })
    }
}

/// Compares both ways for an observer at altitude `h_m` (m) under a sun of zenith cosine `mu_sun`. `progress` is told the
/// share that is done and says whether to go on; `None` when it said no.
///
/// # Errors
/// When an option is out of range, or the atmosphere has no wavelength.
pub fn validate(
    atmosphere: &Atmosphere,
    (h_m, mu_sun): (f64, f64),
    options: &ValidateOptions,
    progress: &(dyn Fn(f64) -> bool + Sync),
) -> Result<Option<Report>, ScatteringError> {
    options.check()?;
    if !progress(0.0) {
        return Ok(None);
    }
    let tables = TableSky::new(atmosphere, &options.quality)?;
    let model = MonteCarlo::new(atmosphere);
    let colour = ColourWeights::new(&atmosphere.wavelengths_nm);
    let directions = directions::directions(atmosphere, h_m, mu_sun, options.directions);
    let mut rows = Vec::with_capacity(directions.len());
    for (index, direction) in (0..).zip(directions) {
        if !progress(TABLES_SHARE + (1.0 - TABLES_SHARE) * rows.len() as f64 / options.directions as f64) {
            return Ok(None);
        }
        let ray = Ray::from_angles(h_m, direction.view_zenith, mu_sun.acos(), direction.azimuth);
        let sampling = Sampling { paths: options.paths, seed: options.seed, direction: index };
        rows.push(row(direction, &tables.radiance(&ray, None), &model.radiance(&ray, None, sampling), &colour));
    }
    Ok(Some(Report::new(&atmosphere.wavelengths_nm, rows)))
}

fn row(direction: Direction, table: &SkyRadiance, reference: &Estimate, colour: &ColourWeights) -> Row {
    let luminance = |spectrum: &[f64]| colour.xyz(spectrum)[1];
    let pairs = table.all.iter().zip(&reference.mean).zip(&reference.standard_error);
    let spectrum = pairs
        .map(|((table, reference), standard_error)| Pair {
            table: *table,
            reference: *reference,
            standard_error: *standard_error,
        })
        .collect();
    let whole = luminance(&reference.mean);
    Row {
        direction,
        luminance: Pair {
            table: luminance(&table.all),
            reference: whole,
            standard_error: luminance(&reference.standard_error).abs(),
        },
        spectrum,
        single_share: if whole > 0.0 { luminance(&reference.single) / whole } else { 0.0 },
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use super::*;
    use crate::params::{AtmosphereParams, GroundParams};

    fn atmosphere() -> Atmosphere {
        Atmosphere::new(&AtmosphereParams::default(), &GroundParams::default())
    }

    fn options() -> ValidateOptions {
        let quality = OrdersQuality { altitudes: 12, suns_above: 12, suns_below: 12, ..OrdersQuality::preview() };
        ValidateOptions { directions: 20, paths: 512, quality, ..ValidateOptions::default() }
    }

    #[test]
    fn the_tables_of_a_clear_day_pass_the_meter() {
        let report =
            validate(&atmosphere(), (2.0, 0.5), &options(), &|_| true).expect("options").expect("not cancelled");
        let whole = report.whole();
        assert_eq!(whole.directions, 20, "all directions");
        // The walks' own noise at 512 paths is two per cent, these small tables are off by two more.
        assert!(whole.spectrum.median_pct < 2.0 + whole.spectrum.noise_pct, "{whole:?}");
        assert!(whole.luminance.bias_pct.abs() < 4.0, "{whole:?}");
        let (row, k) = report.worst().expect("there are rows");
        assert!((row.spectrum[k].error_pct().abs() - whole.spectrum.worst_pct).abs() < 1e-12, "{row:?}");
    }

    #[test]
    fn the_first_order_alone_misses_much_of_a_horizon() {
        let report =
            validate(&atmosphere(), (2.0, 0.5), &options(), &|_| true).expect("options").expect("not cancelled");
        let horizon = report.rows.iter().filter(|row| row.direction.band == Band::Horizon);
        assert!(horizon.clone().count() > 3 && horizon.clone().all(|row| row.single_share < 0.8), "{report:?}");
    }

    #[test]
    fn progress_rises_and_a_refusal_stops_the_work() {
        let seen = Mutex::new(Vec::new());
        let watch = |done: f64| {
            let mut seen = seen.lock().expect("no panic elsewhere");
            seen.push(done);
            seen.len() < 6
        };
        let report = validate(&atmosphere(), (2.0, 0.5), &options(), &watch).expect("options");
        assert!(report.is_none(), "cancelled");
        let seen = seen.into_inner().expect("no panic elsewhere");
        assert!(seen.len() == 6 && seen.is_sorted() && seen[5] < 0.5, "{seen:?}");
    }

    #[test]
    fn impossible_options_are_refused_with_the_range() {
        let message = |options: ValidateOptions| {
            validate(&atmosphere(), (2.0, 0.5), &options, &|_| true).expect_err("refused").to_string()
        };
        assert_eq!(message(ValidateOptions { directions: 0, ..options() }), "0 directions: 1 to 10000 are possible");
        assert_eq!(message(ValidateOptions { paths: 3, ..options() }), "3 paths: 32 to 1000000000 are possible");
    }
}

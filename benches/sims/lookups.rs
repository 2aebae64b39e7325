//! One value: by the exact integral, by the fast quadrature, by the table.

use anyhow::Result;
use tyndall_benches::measure;
use tyndall_scattering::Atmosphere;
use tyndall_scattering::geometry::Ray;
use tyndall_scattering::irradiance_table::{IrradianceTable, sky_irradiance};
use tyndall_scattering::march::Marcher;
use tyndall_scattering::optical_length::columns_to_top;
use tyndall_scattering::single_scattering::single_scattering;
use tyndall_scattering::sky_view_table::SkyViewTable;
use tyndall_scene::{Scene, SkyParams};

use crate::{Case, Effort};

/// Name of [`columns`].
pub(crate) const COLUMNS: &str = "columns of air, one direction";
/// Name of [`direction`].
pub(crate) const DIRECTION: &str = "sky radiance, one direction";
/// Name of [`irradiance`].
pub(crate) const IRRADIANCE: &str = "sky irradiance, one sun";

/// Eye of a person.
const H_M: f64 = 2.0;
/// A sun 30 degrees high.
const MU_SUN: f64 = 0.5;

/// The default atmosphere, marched with as many panels as the default scene's steps have (four nodes a panel).
pub(crate) fn marcher() -> Result<Marcher> {
    let Scene { atmosphere, ground, sky, .. } = Scene::default();
    Ok(Marcher::new(Atmosphere::new(&atmosphere, &ground), sky.march_steps as usize / 4)?)
}

/// Columns and rows of the default sky table.
pub(crate) fn sky_view_size() -> [usize; 2] {
    let sky = SkyParams::default();
    [sky.table_azimuths as usize, sky.table_elevations as usize]
}

/// The `call`-th of a set of directions: zenith angle and azimuth from the sun, over the sky's dome.
fn angles(call: usize) -> (f64, f64) {
    // Two irrational steps fill the dome evenly, for any number of calls.
    let fraction = |step: f64| (0.5 + step * call as f64).fract();
    (1.55 * fraction(0.754_877_666_246_7), std::f64::consts::PI * fraction(0.569_840_290_998_0))
}

pub(crate) fn columns(effort: Effort) -> Result<Case> {
    let marcher = marcher()?;
    let total = |calls: usize, one: &dyn Fn(f64) -> f64| (0..calls).map(|call| one(angles(call).0.cos())).sum::<f64>();
    let exact = |mu: f64| columns_to_top(&marcher.atmosphere, H_M, mu)[0];
    let lookup = |mu: f64| marcher.columns.lookup(H_M, mu)[0];
    Ok(Case {
        name: COLUMNS,
        ways: vec![
            timed("exact integral", effort.samples, effort.exact_calls, |calls| total(calls, &exact)),
            timed("table lookup", effort.samples, effort.lookup_calls, |calls| total(calls, &lookup)),
        ],
    })
}

pub(crate) fn direction(effort: Effort) -> Result<Case> {
    let marcher = marcher()?;
    let sky = SkyViewTable::new(&marcher, H_M, MU_SUN, sky_view_size());
    let ray = |call: usize| {
        let (zenith, azimuth) = angles(call);
        Ray::from_angles(H_M, zenith, MU_SUN.acos(), azimuth)
    };
    let exact = |call: usize| single_scattering(&marcher.atmosphere, &ray(call))[0];
    let marched = |call: usize| marcher.scattered_parts(&ray(call))[0][0];
    let lookup = |call: usize| {
        let (zenith, azimuth) = angles(call);
        sky.radiance(&marcher, std::f64::consts::FRAC_PI_2 - zenith, azimuth, ray(call).nu)[0]
    };
    let total = |calls: usize, one: &dyn Fn(usize) -> f64| (0..calls).map(one).sum::<f64>();
    Ok(Case {
        name: DIRECTION,
        ways: vec![
            timed("exact double integral", effort.samples, effort.exact_calls, |calls| total(calls, &exact)),
            timed("march over column table", effort.samples, 20 * effort.exact_calls, |calls| total(calls, &marched)),
            timed("sky-view table lookup", effort.samples, effort.lookup_calls, |calls| total(calls, &lookup)),
        ],
    })
}

pub(crate) fn irradiance(effort: Effort) -> Result<Case> {
    let marcher = marcher()?;
    let table = IrradianceTable::new(&marcher);
    let total = |calls: usize, one: &dyn Fn(f64) -> f64| (0..calls).map(|call| one(angles(call).0.cos())).sum::<f64>();
    let exact = |mu_sun: f64| sky_irradiance(&marcher, mu_sun)[0];
    let lookup = |mu_sun: f64| table.lookup(mu_sun)[0];
    Ok(Case {
        name: IRRADIANCE,
        ways: vec![
            timed("march over the hemisphere", effort.samples, 1, |calls| total(calls, &exact)),
            timed("table lookup", effort.samples, effort.lookup_calls, |calls| total(calls, &lookup)),
        ],
    })
}

fn timed(way: &str, samples: usize, calls: usize, work: impl Fn(usize) -> f64) -> (String, tyndall_benches::Samples) {
    (way.to_owned(), measure(samples, || work(std::hint::black_box(calls))).per_call(calls))
}

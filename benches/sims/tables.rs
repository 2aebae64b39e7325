//! Filling the tables, on one thread and on all.

use anyhow::Result;
use rayon::ThreadPoolBuilder;
use tyndall_benches::measure;
use tyndall_scattering::column_table::ColumnTable;
use tyndall_scattering::irradiance_table::IrradianceTable;
use tyndall_scattering::sky_view_table::SkyViewTable;

use crate::lookups::{marcher, sky_view_size};
use crate::{Case, Effort};

/// Name of [`columns`].
pub(crate) const COLUMNS: &str = "filling the column table";
/// Name of [`sky_view`].
pub(crate) const SKY_VIEW: &str = "filling the sky-view table";
/// Name of [`irradiance`].
pub(crate) const IRRADIANCE: &str = "filling the irradiance table";

pub(crate) fn columns(effort: Effort) -> Result<Case> {
    let marcher = marcher()?;
    on_threads(COLUMNS, effort, || ColumnTable::new(&marcher.atmosphere))
}

pub(crate) fn sky_view(effort: Effort) -> Result<Case> {
    let marcher = marcher()?;
    on_threads(SKY_VIEW, effort, || SkyViewTable::new(&marcher, 2.0, 0.5, sky_view_size()))
}

pub(crate) fn irradiance(effort: Effort) -> Result<Case> {
    let marcher = marcher()?;
    on_threads(IRRADIANCE, effort, || IrradianceTable::new(&marcher))
}

fn on_threads<T: Send>(name: &'static str, effort: Effort, fill: impl Fn() -> T + Sync) -> Result<Case> {
    let all = std::thread::available_parallelism().map_or(1, usize::from);
    // Tables take tens of milliseconds; a few samples show their spread.
    let samples = effort.samples.min(7);
    let ways = [1, all].map(|threads| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build()?;
        let way = if threads == 1 { "1 thread".to_owned() } else { format!("{threads} threads") };
        anyhow::Ok((way, pool.install(|| measure(samples, &fill))))
    });
    Ok(Case { name, ways: ways.into_iter().collect::<Result<_>>()? })
}

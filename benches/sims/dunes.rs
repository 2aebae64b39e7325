//! Steps of the sand automata: the plain form against the fused one, one thread against all.

use anyhow::Result;
use rayon::ThreadPoolBuilder;
use tyndall_benches::{Samples, measure};
use tyndall_dunes::ripples::{RippleBed, RippleParams};
use tyndall_dunes::slab::{DuneField, DuneParams};
use tyndall_dunes::{SandSimulation, Side};

use crate::{Case, Effort};

/// Name of [`ripples`].
pub(crate) const RIPPLES: &str = "ripple step, 1024 x 1024";
/// Name of [`dunes`].
pub(crate) const DUNES: &str = "dune step, 1024 x 1024, lift 1";
/// Name of [`grown_dunes`].
pub(crate) const GROWN_DUNES: &str = "dune step, 512 x 512, after 1000";

/// The bed of a smoke run is small.
fn side(effort: Effort, side: Side) -> Side {
    if effort.samples == 1 { Side::Cells64 } else { side }
}

pub(crate) fn ripples(effort: Effort) -> Result<Case> {
    let params = RippleParams { side: side(effort, Side::Cells1024), ..RippleParams::default() };
    let bed = RippleBed::new(&params)?;
    let mut turned = bed.clone();
    // A wind a hair off the rows takes the form for any direction.
    turned.set_wind_deg(0.01);
    let mut ways = vec![one_way("any direction, 1 thread", 1, effort, &turned)?];
    ways.extend(on_threads(effort, &bed)?);
    Ok(Case { name: RIPPLES, ways })
}

pub(crate) fn dunes(effort: Effort) -> Result<Case> {
    let params = DuneParams { side: side(effort, Side::Cells1024), lift: 1.0, ..DuneParams::default() };
    Ok(Case { name: DUNES, ways: on_threads(effort, &DuneField::new(&params)?)? })
}

pub(crate) fn grown_dunes(effort: Effort) -> Result<Case> {
    let mut field = DuneField::new(&DuneParams { side: side(effort, Side::Cells512), ..DuneParams::default() })?;
    field.run(if effort.samples == 1 { 1 } else { 1000 });
    Ok(Case { name: GROWN_DUNES, ways: on_threads(effort, &field)? })
}

fn on_threads<S: SandSimulation + Clone + Send + Sync>(effort: Effort, start: &S) -> Result<Vec<(String, Samples)>> {
    let all = std::thread::available_parallelism().map_or(1, usize::from);
    let name = |threads| if threads == 1 { "1 thread".to_owned() } else { format!("{threads} threads") };
    [1, all].into_iter().map(|threads| one_way(&name(threads), threads, effort, start)).collect()
}

/// Times of one step each, from the same start on.
fn one_way<S: SandSimulation + Clone + Send>(
    name: &str,
    threads: usize,
    effort: Effort,
    start: &S,
) -> Result<(String, Samples)> {
    let mut simulation = start.clone();
    let pool = ThreadPoolBuilder::new().num_threads(threads).build()?;
    let samples = pool.install(|| measure(effort.samples, || simulation.step()));
    Ok((name.to_owned(), samples))
}

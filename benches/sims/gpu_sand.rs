//! Steps of the sand automata on every adapter of the system against the CPU form on all its threads.

use anyhow::Result;
use tyndall_benches::{Samples, measure};
use tyndall_dunes::ripples::{RippleBed, RippleParams};
use tyndall_dunes::slab::{DuneField, DuneParams};
use tyndall_dunes::{SandDevice, SandSimulation, Side};
use tyndall_gpu::{AdapterChoice, Gpu, GpuOptions};
use tyndall_gpu_sim::{GpuDunes, GpuRipples, GpuSimError};

use crate::{Case, Effort};

/// Name of [`ripples`].
pub(crate) const RIPPLES: &str = "ripple step by adapter, 2048 x 2048";
/// Name of [`dunes`].
pub(crate) const DUNES: &str = "dune step by adapter, 2048 x 2048";
/// Name of [`small_dunes`].
pub(crate) const SMALL_DUNES: &str = "dune step by adapter, 256 x 256";

/// The bed of a smoke run is small.
fn side(effort: Effort, side: Side) -> Side {
    if effort.samples == 1 { Side::Cells64 } else { side }
}

pub(crate) fn ripples(effort: Effort) -> Result<Case> {
    let bed = RippleBed::new(&RippleParams { side: side(effort, Side::Cells2048), ..RippleParams::default() })?;
    Ok(Case { name: RIPPLES, ways: by_adapter(effort, &bed, GpuRipples::new)? })
}

pub(crate) fn dunes(effort: Effort) -> Result<Case> {
    dunes_of(effort, DUNES, Side::Cells2048)
}

pub(crate) fn small_dunes(effort: Effort) -> Result<Case> {
    dunes_of(effort, SMALL_DUNES, Side::Cells256)
}

fn dunes_of(effort: Effort, name: &'static str, cells: Side) -> Result<Case> {
    let field = DuneField::new(&DuneParams { side: side(effort, cells), ..DuneParams::default() })?;
    Ok(Case { name, ways: by_adapter(effort, &field, GpuDunes::new)? })
}

/// Times of a step on the CPU and on each adapter, all from the same start on.
fn by_adapter<S, D>(
    effort: Effort,
    start: &S,
    open: impl Fn(&Gpu, &S) -> Result<D, GpuSimError>,
) -> Result<Vec<(String, Samples)>>
where
    S: SandSimulation + Clone,
    D: SandDevice<Host = S, Error = GpuSimError>,
{
    let mut host = start.clone();
    // The looks at the surroundings come every 16 steps, so as many are timed together.
    let together = if effort.samples == 1 { 1 } else { 16 };
    let on_cpu = measure(effort.samples.min(5), || host.run(together)).per_call(together as usize);
    let mut ways = vec![("CPU, all threads".to_owned(), on_cpu)];
    for (index, report) in Gpu::adapters().into_iter().enumerate() {
        let gpu = Gpu::open(&GpuOptions { adapter: AdapterChoice::Index(index), max_memory_bytes: None })?;
        let mut device = open(&gpu, start)?;
        // A software adapter takes a second for a step of the largest bed.
        let (samples, together) = if report.is_software { (1, together.min(4)) } else { (effort.samples, together) };
        let mut failed = None;
        let times = measure(samples, || {
            failed = device.run(together).and_then(|()| device.wait()).err().or(failed.take());
        });
        failed.map_or(Ok(()), Err)?;
        ways.push((report.name, times.per_call(together as usize)));
    }
    Ok(ways)
}

//! Moves the bits of a field with the wind.

use rayon::prelude::*;

use crate::bit_field::{BitField, GUARD, layer_mask, row_stride};
use crate::edges::Edges;
use crate::probability_planes::{DrawHashes, draw_word};
use crate::wind::{Shift, ShiftPlan};

/// Rows that a task moves.
const ROWS_PER_TASK: usize = 64;

/// Air that comes in where the wind leaves cells empty.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Inflow<'a> {
    /// Share of set bits, in 2^-16.
    pub(crate) quantised: u32,
    pub(crate) hashes: &'a DrawHashes,
}

/// What is needed to move a row.
struct RowMove<'a> {
    source: &'a BitField,
    layer: usize,
    y: usize,
    edges: Edges,
    inflow: Option<Inflow<'a>>,
}

/// Fills `target` with the moved bits of `source`; new cells are 0 or drawn from the inflow.
pub(crate) fn shift_field(
    source: &BitField,
    target: &mut BitField,
    plan: &ShiftPlan,
    edges: Edges,
    inflow: Option<Inflow<'_>>,
) {
    let [nx, ny, nz] = source.size();
    let stride = row_stride(nx);
    for layer in 0..source.layer_count() {
        let shifts = plan.layer(layer);
        let valid = layer_mask(nz, layer);
        let bands = target.rows_mut(layer).par_chunks_mut(stride * ROWS_PER_TASK);
        bands.enumerate().for_each(|(band, rows)| {
            for (row, words) in rows.chunks_exact_mut(stride).enumerate() {
                let y = (band * ROWS_PER_TASK + row).min(ny - 1);
                let words = &mut words[GUARD..GUARD + nx];
                shift_row(&RowMove { source, layer, y, edges, inflow }, shifts, valid, words);
            }
        });
    }
}

fn shift_row(job: &RowMove<'_>, shifts: &[Shift], valid: u32, words: &mut [u32]) {
    words.fill(0);
    for shift in shifts {
        let mask = shift.mask & valid;
        let [dx, dy] = shift.cells;
        match source_row(job, dy) {
            Some(from) => shift_words(job, from, dx, mask, words),
            None => fill_inflow(job, 0, mask, words),
        }
    }
}

/// The row that moves to the job's row; none when it lies outside an open grid.
fn source_row<'a>(job: &RowMove<'a>, dy: i64) -> Option<&'a [u32]> {
    let ny = job.source.size()[1];
    let y = wrapped(job.y, dy, ny);
    let outside = unwrapped(job.y, dy, ny).is_none();
    (job.edges == Edges::Wrap || !outside).then(|| job.source.row(job.layer, y))
}

/// Index less shift, modulo the count.
fn wrapped(index: usize, shift: i64, count: usize) -> usize {
    let (index, count) = (i64::try_from(index).unwrap_or(0), i64::try_from(count).unwrap_or(1));
    usize::try_from((index - shift).rem_euclid(count)).unwrap_or(0)
}

/// Index less shift, when within the count.
fn unwrapped(index: usize, shift: i64, count: usize) -> Option<usize> {
    let source = i64::try_from(index).ok()? - shift;
    usize::try_from(source).ok().filter(|&source| source < count)
}

/// Adds the masked words of a row, moved by `dx`.
fn shift_words(job: &RowMove<'_>, from: &[u32], dx: i64, mask: u32, words: &mut [u32]) {
    let nx = words.len();
    let distance = usize::try_from(dx.unsigned_abs()).unwrap_or(nx).min(nx);
    let kept = nx - distance;
    let (target, source, first_new) = if dx >= 0 { (distance, 0, 0) } else { (0, distance, kept) };
    for (word, moved) in words[target..target + kept].iter_mut().zip(&from[source..source + kept]) {
        *word |= moved & mask;
    }
    let new = &mut words[first_new..first_new + distance];
    if job.edges == Edges::Open {
        fill_inflow(job, first_new, mask, new);
        return;
    }
    for (x, word) in new.iter_mut().enumerate() {
        *word |= from[wrapped(first_new + x, dx, nx)] & mask;
    }
}

/// New air in the columns from `first` on.
fn fill_inflow(job: &RowMove<'_>, first: usize, mask: u32, words: &mut [u32]) {
    let Some(inflow) = job.inflow else { return };
    let [nx, ny, _] = job.source.size();
    let row = (job.layer * ny + job.y) * nx + first;
    for (x, word) in words.iter_mut().enumerate() {
        // Columns are numbered by 32 bits; the size of grids is limited accordingly.
        let column = u32::try_from(row + x).unwrap_or(u32::MAX);
        *word |= draw_word(inflow.quantised, inflow.hashes, column) & mask;
    }
}

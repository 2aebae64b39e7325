//! One step of the ripple rule along +x: Nishimori and Ouchi, Phys. Rev. Lett. 71, 1993; section 5.1 of the paper.
//!
//! Every cell loses a layer q, the cell at x + L gains it, L = L0 + b h; then creep spreads 1/6 of the height difference
//! to each side and 1/12 to each corner, times D. All cells at once, integers only, mass kept to the quantum.
//!
//! The step is fused: a window of three rows is saltated and then creeps, so each height is read and written once. Rows
//! are independent in saltation (the wind blows along them). Arrivals are counted by comparing a row of one-byte hops
//! with every length that occurs in it, which compilers turn into 16 to 64 lanes; creep computes each pair of neighbours
//! once, as a flux that truncates towards zero, which is odd, so both ends agree.
//!
//! Departures from the printed rule: the fraction of L is a probability (rounding leaves nearly flat beds dead), a cell
//! lifts nothing in the lee of a crest or when less than a layer of sand is left.

use super::rule::{CREEP_BITS, LEE_REACH_CELLS, MAX_HOP_CELLS, RippleRule};
use crate::hash::cell_word;

/// Hop of a cell that lifts nothing.
const RESTS: u8 = u8::MAX;
/// Cells left of the first in the row of hops: the longest hop.
const HALO: usize = MAX_HOP_CELLS as usize;
/// Cells left of the first in rows of shadow lines: the shadow's reach.
const REACH: usize = LEE_REACH_CELLS as usize;
/// Cells whose arrivals are counted together.
const LANES: usize = 64;

/// Rows in the making, reused from step to step.
#[derive(Clone, Debug)]
pub(super) struct Scratch {
    /// Random words of a row, one for four cells.
    words: Vec<u32>,
    /// Hops of a row behind a halo.
    hops: Vec<u8>,
    /// Shadow lines of a row and a copy, both behind a halo.
    shadow: [Vec<i32>; 2],
    /// Three saltated rows, each with one cell of halo at either end.
    rows: [Vec<i32>; 3],
    /// Fluxes of creep: to the right, upwards, up and right, up and left; a cell of halo at either end.
    fluxes: [Vec<i32>; 4],
    /// What the row loses to the row below it.
    lost: Vec<i32>,
}

impl Scratch {
    /// For rows of `nx` cells.
    pub(super) fn new(nx: usize) -> Self {
        let padded = || vec![0; nx + 2];
        Self {
            words: vec![0; nx / 4],
            hops: vec![0; nx + HALO],
            shadow: [vec![0; REACH + nx], vec![0; REACH + nx]],
            rows: [padded(), padded(), padded()],
            fluxes: [padded(), padded(), padded(), padded()],
            lost: vec![0; nx],
        }
    }
}

/// Steps the rows from `first_row` on that `out` has room for; `heights` is the whole bed, `key` that of the step.
pub(super) fn step_rows(
    rule: &RippleRule,
    key: u32,
    heights: &[i32],
    first_row: usize,
    out: &mut [i32],
    scratch: &mut Scratch,
) {
    let task = Task { rule, key, heights, first_row, out, scratch };
    pulp::Arch::new().dispatch(task);
}

/// The arguments of [`step_rows`], for the widest vector instructions that this computer has.
struct Task<'a> {
    rule: &'a RippleRule,
    key: u32,
    heights: &'a [i32],
    first_row: usize,
    out: &'a mut [i32],
    scratch: &'a mut Scratch,
}

// Vector instructions reach only what is inlined, hence the attribute on every helper of this file.
impl pulp::NullaryFnOnce for Task<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Self { rule, key, heights, first_row, out, scratch } = self;
        let nx = scratch.lost.len();
        let ny = heights.len() / nx;
        saltate_row(rule, key, (first_row + ny - 1) % ny, heights, 0, scratch);
        saltate_row(rule, key, first_row, heights, 1, scratch);
        creep_fluxes(rule, 0, 1, scratch);
        lost_to_row_below(scratch);
        for (index, out) in out.chunks_exact_mut(nx).enumerate() {
            let (here, above) = ((index + 1) % 3, (index + 2) % 3);
            saltate_row(rule, key, (first_row + index + 1) % ny, heights, above, scratch);
            creep_fluxes(rule, here, above, scratch);
            apply_fluxes(here, scratch, out);
            lost_to_row_below(scratch);
        }
    }
}

/// Saltation of one row into `scratch.rows[slot]`.
#[inline(always)]
fn saltate_row(rule: &RippleRule, key: u32, row: usize, heights: &[i32], slot: usize, scratch: &mut Scratch) {
    let nx = scratch.lost.len();
    let heights = &heights[row * nx..][..nx];
    let out = &mut scratch.rows[slot];
    if rule.saltates == 0 {
        out[1..=nx].copy_from_slice(heights);
    } else {
        let [shortest, longest] = hop_lengths(rule, key, row, heights, &mut scratch.words, &mut scratch.hops);
        rest_in_lee(rule, heights, &mut scratch.shadow, &mut scratch.hops[HALO..]);
        for index in 0..HALO {
            // A narrow row goes round several times; nx is a power of two.
            scratch.hops[HALO - 1 - index] = scratch.hops[HALO + ((nx - 1 - index % nx) & (nx - 1))];
        }
        move_layers(rule.layer, [shortest, longest], heights, &scratch.hops, &mut out[1..=nx]);
    }
    (out[0], out[nx + 1]) = (out[nx], out[1]);
}

/// Hops of a row into `hops` behind the halo; gives back the shortest and the longest.
#[inline(always)]
fn hop_lengths(
    rule: &RippleRule,
    key: u32,
    row: usize,
    heights: &[i32],
    words: &mut [u32],
    hops: &mut [u8],
) -> [u8; 2] {
    let first = (row * words.len()) as u32;
    let keep = if rule.dither == 0 { 0 } else { u32::MAX };
    for (index, word) in words.iter_mut().enumerate() {
        *word = cell_word(key, first + index as u32) & keep;
    }
    let hops = &mut hops[HALO..];
    for (bytes, word) in hops.chunks_exact_mut(4).zip(words.iter()) {
        bytes.copy_from_slice(&word.to_le_bytes());
    }
    let (mut shortest, mut longest) = (RESTS, 0);
    for (hop, &height) in hops.iter_mut().zip(heights) {
        let cells = ((rule.hop_length_256(height) + i32::from(*hop)) >> 8) as u8;
        shortest = shortest.min(cells);
        longest = longest.max(cells);
        *hop = if height - rule.bedrock >= rule.layer { cells } else { RESTS };
    }
    [shortest, longest]
}

/// Marks as resting the cells that lie below the line from an upwind crest.
#[inline(always)]
fn rest_in_lee(rule: &RippleRule, heights: &[i32], shadow: &mut [Vec<i32>; 2], hops: &mut [u8]) {
    if rule.lee_fall == 0 {
        return;
    }
    let [line, copy] = shadow;
    let (nx, fall) = (heights.len(), rule.lee_fall);
    // Taps 1 to 4, then four times that, then twice: a reach of 32 cells.
    copy[REACH..].copy_from_slice(heights);
    highest_of([1, 2, 3, 4], fall, copy, line);
    highest_of([0, 4, 8, 12], fall, line, copy);
    highest_of([0, 16, 0, 16], fall, copy, line);
    for ((hop, &line), &height) in hops[..nx].iter_mut().zip(&line[REACH..]).zip(heights) {
        *hop = if line > height { RESTS } else { *hop };
    }
}

/// For each cell the greatest of four upwind cells of `row`, each less its distance times `fall`. Rows lie behind a halo.
#[inline(always)]
fn highest_of(distances: [usize; 4], fall: i32, row: &mut [i32], out: &mut [i32]) {
    let nx = row.len() - REACH;
    for index in 0..REACH {
        row[REACH - 1 - index] = row[REACH + ((nx - 1 - index % nx) & (nx - 1))];
    }
    let [a, b, c, d] = distances.map(|distance| &row[REACH - distance..][..nx]);
    let [fall_a, fall_b, fall_c, fall_d] = distances.map(|distance| distance as i32 * fall);
    for ((((out, a), b), c), d) in out[REACH..].iter_mut().zip(a).zip(b).zip(c).zip(d) {
        *out = (a - fall_a).max(b - fall_b).max(c - fall_c).max(d - fall_d);
    }
}

/// Moves one layer from every cell that hops to where its hop ends.
#[inline(always)]
fn move_layers(layer: i32, [shortest, longest]: [u8; 2], heights: &[i32], hops: &[u8], out: &mut [i32]) {
    let lanes = LANES.min(heights.len());
    let blocks = heights.chunks_exact(lanes).zip(out.chunks_exact_mut(lanes));
    for (block, (heights, out)) in blocks.enumerate() {
        let first = HALO + block * lanes;
        let mut balance = [0_u8; LANES];
        for length in shortest..=longest {
            let starts = &hops[first - usize::from(length)..][..lanes];
            for (count, &hop) in balance.iter_mut().zip(starts) {
                *count += u8::from(hop == length);
            }
        }
        let own = &hops[first..][..lanes];
        for (((out, &height), &count), &hop) in out.iter_mut().zip(heights).zip(&balance).zip(own) {
            *out = height + layer * (i32::from(count) - i32::from(hop != RESTS));
        }
    }
}

/// Creep within row `here` and between it and the row `above`.
#[inline(always)]
fn creep_fluxes(rule: &RippleRule, here: usize, above: usize, scratch: &mut Scratch) {
    let nx = scratch.lost.len();
    let [right, up, up_right, up_left] = &mut scratch.fluxes;
    let (here, above) = (&scratch.rows[here], &scratch.rows[above]);
    fluxes_to(&here[1..=nx], &here[2..], rule.creep_side, rule.creep_limit, right);
    fluxes_to(&here[1..=nx], &above[1..=nx], rule.creep_side, rule.creep_limit, up);
    fluxes_to(&here[1..=nx], &above[2..], rule.creep_corner, rule.creep_limit, up_right);
    fluxes_to(&here[1..=nx], &above[..nx], rule.creep_corner, rule.creep_limit, up_left);
}

/// What each cell of `here` gains from its neighbour in `there`.
#[inline(always)]
fn fluxes_to(here: &[i32], there: &[i32], share: i32, limit: i32, out: &mut [i32]) {
    let nx = here.len();
    for ((out, &here), &there) in out[1..=nx].iter_mut().zip(here).zip(there) {
        *out = creep(there - here, share, limit);
    }
    (out[0], out[nx + 1]) = (out[nx], out[1]);
}

/// Flux to a cell from a neighbour that stands higher by `difference`.
#[inline(always)]
pub(crate) fn creep(difference: i32, share: i32, limit: i32) -> i32 {
    let product = difference.clamp(-limit, limit) * share;
    // Division by a power of two that truncates towards zero, as "/" does in WGSL.
    (product + ((product >> 31) & ((1 << CREEP_BITS) - 1))) >> CREEP_BITS
}

/// Adds the fluxes to row `here`.
#[inline(always)]
fn apply_fluxes(here: usize, scratch: &Scratch, out: &mut [i32]) {
    let nx = out.len();
    let [right, up, up_right, up_left] = &scratch.fluxes;
    let (right_in, right_out, up) = (&right[1..=nx], &right[..nx], &up[1..=nx]);
    let (up_right, up_left) = (&up_right[1..=nx], &up_left[1..=nx]);
    let (here, lost) = (&scratch.rows[here][1..=nx], &scratch.lost[..nx]);
    for x in 0..nx {
        let gained = right_in[x] - right_out[x] + up[x] + up_right[x] + up_left[x];
        out[x] = here[x] + gained - lost[x];
    }
}

/// Keeps what the upper row of the fluxes gave to the lower one.
#[inline(always)]
fn lost_to_row_below(scratch: &mut Scratch) {
    let nx = scratch.lost.len();
    let [_, up, up_right, up_left] = &scratch.fluxes;
    let (up, up_right, up_left) = (&up[1..=nx], &up_right[..nx], &up_left[2..]);
    for (((lost, up), up_right), up_left) in scratch.lost.iter_mut().zip(up).zip(up_right).zip(up_left) {
        *lost = up + up_right + up_left;
    }
}

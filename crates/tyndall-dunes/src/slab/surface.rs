//! What the wind meets at each cell: bare ground, sand, or lee; and how far downwind the next lee begins.

use rayon::prelude::*;

use super::rule::CATCH_REACH_CELLS;
use crate::direction::Direction;
use crate::edges::Edges;
use crate::lattice::Lattice;

/// A slab of sand or more lies here.
pub(super) const SAND: u8 = 1;
/// The wind does not reach the bed.
pub(super) const LEE: u8 = 2;
/// No lee within reach.
const NO_LEE: u8 = u8::MAX;
/// The same in [`Surface::sites`].
pub(super) const SITE_NO_LEE: u8 = u8::MAX >> SITE_BITS;
/// Bits of a site below its distance to the lee.
pub(super) const SITE_BITS: u32 = 2;

/// Kinds of cells and distances to the lee.
#[derive(Clone, Debug)]
pub(super) struct Surface {
    /// [`SAND`], [`LEE`], both or neither.
    pub(super) kinds: Vec<u8>,
    /// Kind, and from bit [`SITE_BITS`] on the distance downwind to the first lee cell (cells) or [`SITE_NO_LEE`]: one
    /// look a hop, at one byte.
    pub(super) sites: Vec<u8>,
    near: Vec<u8>,
    far: Vec<u8>,
}

/// One of the taps of the scan for a lee.
#[derive(Clone, Copy)]
struct Tap {
    offset: [i32; 2],
    distance: u8,
}

impl Surface {
    pub(super) fn new(lattice: Lattice) -> Self {
        let cells = || vec![0; lattice.cells()];
        Self { kinds: cells(), sites: cells(), near: cells(), far: cells() }
    }

    /// Sorts the cells; `line` are the heights of the shadow lines.
    pub(super) fn classify(&mut self, heights: &[i32], bedrock: &[i32], line: &[i32], slab: i32) {
        let chunk = 1 << 14;
        let work = self.kinds.par_chunks_mut(chunk).zip(heights.par_chunks(chunk));
        work.zip(bedrock.par_chunks(chunk)).zip(line.par_chunks(chunk)).for_each(|(((kinds, heights), rock), line)| {
            pulp::Arch::new().dispatch(Classify { kinds, heights, rock, line, slab });
        });
    }

    /// Measures the distance to the lee from every cell, in two passes of four taps.
    pub(super) fn find_lee(&mut self, lattice: Lattice, wind: Direction, edges: Edges) {
        let taps = |step: i32, first: i32| {
            [0, 1, 2, 3]
                .map(|tap| (tap + first) * step)
                .map(|far| Tap { offset: wind.offset(far), distance: far as u8 })
        };
        let lee = |kind: u8| if kind & LEE == 0 { NO_LEE } else { 0 };
        nearest(lattice, edges, taps(1, 1), &self.kinds, &mut self.near, lee);
        nearest(lattice, edges, taps(CATCH_REACH_CELLS / 4, 0), &self.near, &mut self.far, |distance| distance);
        for ((site, &kind), &distance) in self.sites.iter_mut().zip(&self.kinds).zip(&self.far) {
            *site = kind | (distance.min(SITE_NO_LEE) << SITE_BITS);
        }
    }
}

struct Classify<'a> {
    kinds: &'a mut [u8],
    heights: &'a [i32],
    rock: &'a [i32],
    line: &'a [i32],
    slab: i32,
}

impl pulp::NullaryFnOnce for Classify<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let cells = self.kinds.iter_mut().zip(self.heights).zip(self.rock).zip(self.line);
        for (((kind, &height), &rock), &line) in cells {
            let sand = u8::from(height - rock >= self.slab) * SAND;
            *kind = sand | (u8::from(line > height) * LEE);
        }
    }
}

/// For each cell the least of the taps' distances plus that found there.
fn nearest<F: Fn(u8) -> u8 + Copy + Sync>(
    lattice: Lattice,
    edges: Edges,
    taps: [Tap; 4],
    source: &[u8],
    out: &mut [u8],
    found: F,
) {
    let nx = lattice.nx();
    let rows = (lattice.ny() / 16).max(8);
    out.par_chunks_mut(rows * nx).enumerate().for_each(|(band, out)| {
        pulp::Arch::new().dispatch(Nearest { lattice, edges, taps, source, first_row: band * rows, out, found });
    });
}

struct Nearest<'a, F> {
    lattice: Lattice,
    edges: Edges,
    taps: [Tap; 4],
    source: &'a [u8],
    first_row: usize,
    out: &'a mut [u8],
    found: F,
}

impl<F: Fn(u8) -> u8 + Copy> pulp::NullaryFnOnce for Nearest<'_, F> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let (nx, ny) = (self.lattice.nx(), self.lattice.ny());
        let periodic = self.edges == Edges::Periodic;
        for (row, out) in self.out.chunks_exact_mut(nx).enumerate() {
            out.fill(NO_LEE);
            for tap in self.taps {
                let from = (self.first_row + row) as i32 + tap.offset[1];
                if periodic || (0..ny as i32).contains(&from) {
                    let source = &self.source[self.lattice.index(0, from)..][..nx];
                    lower_row(out, source, tap, periodic, self.found);
                }
            }
        }
    }
}

/// Lowers a row to a tap's distance where that is less.
#[inline(always)]
fn lower_row<F: Fn(u8) -> u8 + Copy>(out: &mut [u8], source: &[u8], tap: Tap, periodic: bool, found: F) {
    let nx = out.len();
    let shift = (tap.offset[0] as usize) & (nx - 1);
    let (wrapped, inside) = source.split_at(shift);
    let (out_inside, out_wrapped) = out.split_at_mut(nx - shift);
    if periodic || tap.offset[0] >= 0 {
        lower(out_inside, inside, tap.distance, found);
    }
    if periodic || tap.offset[0] < 0 {
        lower(out_wrapped, wrapped, tap.distance, found);
    }
}

#[inline(always)]
fn lower<F: Fn(u8) -> u8>(out: &mut [u8], source: &[u8], distance: u8, found: F) {
    for (out, &source) in out.iter_mut().zip(source) {
        *out = (*out).min(found(source).saturating_add(distance));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hash::cell_word;

    #[test]
    fn the_distance_to_the_lee_is_that_of_a_walk_downwind() {
        let lattice = Lattice::new([64, 32]).unwrap();
        let mut surface = Surface::new(lattice);
        for (kind, cell) in surface.kinds.iter_mut().zip(0..) {
            *kind = if cell_word(5, cell) >> 28 == 0 { LEE } else { SAND };
        }
        for (wind_deg, edges) in
            [(0.0, Edges::Periodic), (90.0, Edges::Open), (180.0, Edges::Open), (270.0, Edges::Periodic)]
        {
            let wind = Direction::from_degrees(wind_deg);
            surface.find_lee(lattice, wind, edges);
            for index in 0..lattice.cells() {
                let [x, y] = lattice.position(index).map(|part| part as i32);
                let lee_at = |far: i32| {
                    let [dx, dy] = wind.offset(far);
                    let inside = (0..64).contains(&(x + dx)) && (0..32).contains(&(y + dy));
                    (inside || edges == Edges::Periodic) && surface.kinds[lattice.index(x + dx, y + dy)] & LEE != 0
                };
                let expected = (1..=16).find(|&far| lee_at(far)).map_or(SITE_NO_LEE, |far| far as u8);
                assert_eq!(
                    surface.sites[index] >> SITE_BITS,
                    expected,
                    "({x}, {y}), wind at {wind_deg} deg, {edges:?}"
                );
            }
        }
    }
}

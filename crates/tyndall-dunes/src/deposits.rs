//! Sand that lands anywhere on the bed, added up by many threads with the same result for any number of them.
//!
//! The bed is cut into bands of rows. A band's thread adds what stays in the band straight away and notes the rest in a
//! list for each other band; then each band takes its lists. Integer sums do not depend on the order.

use std::ops::Range;

use rayon::prelude::*;

use crate::lattice::Lattice;

/// Most bands of a bed: lists are kept for every pair.
const MAX_BANDS: usize = 32;
/// Fewest rows of a band.
const MIN_ROWS: usize = 16;

/// Bands of a bed and their lists.
#[derive(Clone, Debug)]
pub(crate) struct Bands {
    lattice: Lattice,
    rows: usize,
    lists: Vec<Vec<Vec<(u32, i32)>>>,
    counts: Vec<Crossings>,
}

/// Sand that crossed the edges of the bed (quanta).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Crossings {
    pub(crate) entered: i64,
    pub(crate) left: i64,
}

/// Where the thread of a band puts sand.
#[derive(Debug)]
pub(crate) struct Sink<'a> {
    first: usize,
    own: &'a mut [i32],
    lists: &'a mut [Vec<(u32, i32)>],
    crossings: &'a mut Crossings,
}

impl Sink<'_> {
    /// Adds `amount` to the cell.
    #[inline(always)]
    pub(crate) fn add(&mut self, index: usize, amount: i32) {
        if let Some(cell) = self.own.get_mut(index.wrapping_sub(self.first)) {
            *cell += amount;
        } else {
            self.lists[index / self.own.len()].push((index as u32, amount));
        }
    }

    /// Notes that `amount` came in over an edge.
    pub(crate) fn enter(&mut self, amount: i32) {
        self.crossings.entered += i64::from(amount);
    }

    /// Notes that `amount` left over an edge.
    pub(crate) fn leave(&mut self, amount: i32) {
        self.crossings.left += i64::from(amount);
    }
}

impl Bands {
    pub(crate) fn new(lattice: Lattice) -> Self {
        // Both are powers of two, so the bands are equal.
        let rows = (lattice.ny() / MAX_BANDS).max(MIN_ROWS).min(lattice.ny());
        let count = lattice.ny() / rows;
        Self { lattice, rows, lists: vec![vec![Vec::new(); count]; count], counts: vec![Crossings::default(); count] }
    }

    /// Cells of a band.
    pub(crate) fn cells(&self) -> usize {
        self.rows * self.lattice.nx()
    }

    /// What crossed the edges in the last [`Bands::collect`].
    pub(crate) fn crossings(&self) -> Crossings {
        let sum = |field: fn(&Crossings) -> i64| self.counts.iter().map(field).sum();
        Crossings { entered: sum(|count| count.entered), left: sum(|count| count.left) }
    }

    /// Sets `change` to zero, runs `work(rows, sink)` for every band, and delivers what went to other bands.
    pub(crate) fn collect(&mut self, change: &mut [i32], work: impl Fn(Range<usize>, &mut Sink<'_>) + Sync) {
        let (rows, cells) = (self.rows, self.cells());
        change.par_chunks_mut(cells).zip(&mut self.lists).zip(&mut self.counts).enumerate().for_each(
            |(band, ((own, lists), crossings))| {
                *crossings = Crossings::default();
                own.fill(0);
                lists.iter_mut().for_each(Vec::clear);
                work(band * rows..(band + 1) * rows, &mut Sink { first: band * cells, own, lists, crossings });
            },
        );
        let lists = &self.lists;
        change.par_chunks_mut(cells).enumerate().for_each(|(band, own)| {
            for &(index, amount) in lists.iter().flat_map(|from| &from[band]) {
                own[index as usize - band * cells] += amount;
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sand_arrives_wherever_it_is_sent() {
        let lattice = Lattice::new([16, 64]).unwrap();
        let mut bands = Bands::new(lattice);
        let mut change = vec![7; lattice.cells()];
        bands.collect(&mut change, |rows, sink| {
            for index in rows.start * 16..rows.end * 16 {
                sink.add((index * 5 + 3) % 1024, 2);
                sink.add(index, -1);
            }
        });
        assert!(change.iter().all(|&value| value == 1), "5 is odd, so every cell is met once: {change:?}");
    }
}

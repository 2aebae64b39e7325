//! Sand that slides where a slope is steeper than repose.
//!
//! In each pass every cell that stands too high over one of its eight neighbours sends a share of the excess to the
//! steepest one. Decisions read heights only, moves are made after all decisions, so the order is of no account. Sliding
//! starts above one angle and aims at a smaller one, as in real sand; this also ends it in few passes. Only stretches
//! of 16 cells that changed in the last pass, or border on one that did, are looked at again; a pass without them gives
//! the same bits.

use rayon::prelude::*;

use super::plants::Plants;
use crate::edges::Edges;
use crate::hash::cell_word;
use crate::lattice::{Lattice, MIN_SIDE};

/// Cells that are looked at together; a side has a whole number of stretches.
const STRETCH: usize = MIN_SIDE;
/// The neighbours: four at the sides, four at the corners.
const NEIGHBOURS: [[i32; 2]; 8] = [[1, 0], [-1, 0], [0, 1], [0, -1], [1, 1], [-1, -1], [1, -1], [-1, 1]];
/// Relative weights of a height difference to a side and to a corner: 1 and 1 / sqrt 2, times 181.
const STEEPNESS: [i32; 2] = [181, 128];

/// Sand on its way from one cell to a neighbour.
#[derive(Clone, Copy, Debug)]
struct Move {
    from: u32,
    neighbour: u8,
    amount: i32,
}

/// Moves decided in a band of rows.
#[derive(Clone, Debug, Default)]
struct Moves {
    /// Those that concern this band alone.
    inner: Vec<Move>,
    /// Those that change or touch the rows of the next band on either side.
    border: Vec<Move>,
}

impl Moves {
    fn is_empty(&self) -> bool {
        self.inner.is_empty() && self.border.is_empty()
    }
}

/// The bed that slides.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slope<'a> {
    pub(super) bedrock: &'a [i32],
    pub(super) plants: Option<&'a Plants>,
    /// Largest stable differences to side and corner (quanta).
    pub(super) repose: [i32; 2],
    /// Differences at which sliding ends (quanta).
    pub(super) rest: [i32; 2],
    pub(super) edges: Edges,
}

/// Sliding, with the memory it needs.
#[derive(Clone, Debug)]
pub(super) struct Avalanche {
    lattice: Lattice,
    rows: usize,
    dirty: Vec<u8>,
    moves: Vec<Moves>,
}

impl Avalanche {
    pub(super) fn new(lattice: Lattice) -> Self {
        let rows = (lattice.ny() / 16).max(MIN_SIDE);
        let moves = vec![Moves::default(); lattice.ny() / rows];
        Self { lattice, rows, dirty: vec![1; lattice.cells() / STRETCH], moves }
    }

    /// Slides until nothing moves or `passes` are done, with the tie-breaking words of `key`; gives back the passes made.
    pub(super) fn slide(&mut self, heights: &mut [i32], slope: &Slope<'_>, key: u32, passes: u32) -> u32 {
        self.dirty.fill(1);
        for pass in 0..passes {
            self.decide(heights, slope, key.wrapping_add(pass));
            if self.moves.iter().all(Moves::is_empty) {
                return pass;
            }
            self.apply(heights, slope.edges);
        }
        passes
    }

    fn decide(&mut self, heights: &[i32], slope: &Slope<'_>, key: u32) {
        let (lattice, rows) = (self.lattice, self.rows);
        let flags = self.dirty.par_chunks(rows * lattice.nx() / STRETCH);
        self.moves.par_iter_mut().zip(flags).enumerate().for_each(|(band, (moves, dirty))| {
            moves.inner.clear();
            moves.border.clear();
            pulp::Arch::new().dispatch(Decide {
                lattice,
                heights,
                slope,
                key,
                first_row: band * rows,
                rows,
                dirty,
                moves,
            });
        });
    }

    fn apply(&mut self, heights: &mut [i32], edges: Edges) {
        let (lattice, rows) = (self.lattice, self.rows);
        let (cells, bands, moves) = (rows * lattice.nx(), self.moves.len(), &self.moves);
        let work = heights.par_chunks_mut(cells).zip(self.dirty.par_chunks_mut(cells / STRETCH)).enumerate();
        work.for_each(|(band, (own, dirty))| {
            dirty.fill(0);
            let mut target = Target { lattice, edges, first: band * cells, own, dirty };
            moves[band].inner.iter().chain(&moves[band].border).for_each(|each| target.make(*each));
            let (below, above) = ((band + bands - 1) % bands, (band + 1) % bands);
            if below != band {
                moves[below].border.iter().for_each(|each| target.make(*each));
            }
            if above != band && above != below {
                moves[above].border.iter().for_each(|each| target.make(*each));
            }
        });
    }
}

/// Index of a cell: the next one round, or at an open edge the nearest inside.
#[inline(always)]
fn cell_at(lattice: Lattice, edges: Edges, x: i32, y: i32) -> usize {
    let [nx, ny] = lattice.size().map(|side| side as i32);
    match edges {
        Edges::Periodic => lattice.index(x, y),
        Edges::Open => lattice.index(x.clamp(0, nx - 1), y.clamp(0, ny - 1)),
    }
}

/// A band that receives moves: what lies outside it is left to other bands.
struct Target<'a> {
    lattice: Lattice,
    edges: Edges,
    first: usize,
    own: &'a mut [i32],
    dirty: &'a mut [u8],
}

impl Target<'_> {
    #[inline(always)]
    fn make(&mut self, each: Move) {
        let [x, y] = self.lattice.position(each.from as usize).map(|part| part as i32);
        let [dx, dy] = NEIGHBOURS[usize::from(each.neighbour)];
        let to = cell_at(self.lattice, self.edges, x + dx, y + dy);
        for (index, amount) in [(each.from as usize, -each.amount), (to, each.amount)] {
            if let Some(height) = self.own.get_mut(index.wrapping_sub(self.first)) {
                *height += amount;
            }
        }
        let (left, right) = (x + dx.min(0) - 1, x + dx.max(0) + 1);
        for row in y + dy.min(0) - 1..=y + dy.max(0) + 1 {
            for x in [left, right] {
                let stretch = self.lattice.index(x, row).wrapping_sub(self.first) / STRETCH;
                if let Some(flag) = self.dirty.get_mut(stretch) {
                    *flag = 1;
                }
            }
        }
    }
}

/// Decisions of one band, for the widest vector instructions that this computer has.
struct Decide<'a> {
    lattice: Lattice,
    heights: &'a [i32],
    slope: &'a Slope<'a>,
    key: u32,
    first_row: usize,
    rows: usize,
    dirty: &'a [u8],
    moves: &'a mut Moves,
}

impl pulp::NullaryFnOnce for Decide<'_> {
    type Output = ();

    #[inline(always)]
    fn call(mut self) {
        let first = self.first_row * self.lattice.nx();
        for (index, &dirty) in self.dirty.iter().enumerate() {
            if dirty != 0 {
                self.look_at(first + index * STRETCH);
            }
        }
    }
}

impl Decide<'_> {
    #[inline(always)]
    fn at(&self, x: i32, y: i32) -> usize {
        cell_at(self.lattice, self.slope.edges, x, y)
    }

    /// Decides for the cells of one stretch.
    #[inline(always)]
    fn look_at(&mut self, start: usize) {
        let [x, y] = self.lattice.position(start).map(|part| part as i32);
        let [below, here, above] = [y - 1, y, y + 1].map(|y| &self.heights[self.at(x, y)..][..STRETCH]);
        // Each row with one cell more at either end: here, and the lower of the rows below and above.
        let (mut middle, mut beside) = ([0; STRETCH + 2], [0; STRETCH + 2]);
        for k in 0..STRETCH {
            middle[k + 1] = here[k];
            beside[k + 1] = below[k].min(above[k]);
        }
        for (slot, x) in [(0, x - 1), (STRETCH + 1, x + STRETCH as i32)] {
            middle[slot] = self.heights[self.at(x, y)];
            beside[slot] = self.heights[self.at(x, y - 1)].min(self.heights[self.at(x, y + 1)]);
        }
        let [side, corner] = self.slope.repose;
        let mut over = [0; STRETCH];
        for k in 0..STRETCH {
            let sides = beside[k + 1].min(middle[k]).min(middle[k + 2]);
            let corners = beside[k].min(beside[k + 2]);
            over[k] = (middle[k + 1] - sides - side).max(middle[k + 1] - corners - corner);
        }
        if over.iter().copied().fold(i32::MIN, i32::max) > 0 {
            for (offset, _) in over.iter().enumerate().filter(|(_, over)| **over > 0) {
                self.send(start + offset);
            }
        }
    }

    /// Notes what a cell sends to its steepest neighbour.
    fn send(&mut self, index: usize) {
        let sand = self.heights[index] - self.slope.bedrock[index];
        if sand <= 0 {
            return;
        }
        let [x, y] = self.lattice.position(index).map(|part| part as i32);
        let turn = cell_word(self.key, index as u32) as usize;
        let (mut steepest, mut best) = (0, None);
        for k in 0..NEIGHBOURS.len() {
            let neighbour = (k + turn) % NEIGHBOURS.len();
            let [dx, dy] = NEIGHBOURS[neighbour];
            let corner = neighbour / 4;
            let difference = self.heights[index] - self.heights[self.at(x + dx, y + dy)];
            let steepness = difference * STEEPNESS[corner];
            if steepness > steepest && difference > self.limit(self.slope.repose[corner], corner, index) {
                (steepest, best) = (steepness, Some((neighbour, difference)));
            }
        }
        let Some((neighbour, difference)) = best else { return };
        let excess = difference - self.limit(self.slope.rest[neighbour / 4], neighbour / 4, index);
        // Half of the excess would make the pair rest; less leaves room for what other cells send there.
        let amount = ((3 * excess + 7) >> 3).clamp(1, sand);
        let row = y as usize - self.first_row;
        let inner = row >= 2 && row + 2 < self.rows;
        let list = if inner { &mut self.moves.inner } else { &mut self.moves.border };
        list.push(Move { from: index as u32, neighbour: neighbour as u8, amount });
    }

    /// A difference raised by plants on the cell.
    #[inline(always)]
    fn limit(&self, bare: i32, corner: usize, index: usize) -> i32 {
        self.slope.plants.map_or(bare, |plants| plants.raise(bare, corner, index))
    }
}

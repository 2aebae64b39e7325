//! Slabs that the wind lifts, and where each of them comes down.
//!
//! After Werner 1995: a slab hops downwind until it sticks, with a chance that is higher on sand than on bare ground,
//! and always in the lee. Lifting needs wind (Momiji et al. 2000). Added here: a hop that crosses the edge of a lee
//! ends at that edge, as grains fall out of the air where the wind leaves the bed. Without this, slabs spread
//! over the whole lee, slip faces stay below repose, and a speed-up that flattens windward slopes flattens them as well.

use super::plants::Plants;
use super::rule::CATCH_REACH_CELLS;
use super::rule::{DuneRule, MAX_HOPS};
use super::surface::{LEE, SAND, SITE_BITS, SITE_NO_LEE, Surface};
use crate::deposits::{Bands, Sink};
use crate::direction::Direction;
use crate::edges::Edges;
use crate::hash::{cell_word, next_word};
use crate::lattice::Lattice;

/// Everything that decides about slabs in one step; nothing of it changes during the step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wind<'a> {
    pub(super) rule: &'a DuneRule,
    pub(super) lattice: Lattice,
    pub(super) edges: Edges,
    pub(super) direction: Direction,
    /// Offset of a lee that begins so many cells downwind.
    pub(super) to_lee: [[i32; 2]; CATCH_REACH_CELLS as usize + 1],
    pub(super) heights: &'a [i32],
    /// Mean heights of the surroundings.
    pub(super) means: &'a [i32],
    pub(super) surface: &'a Surface,
    pub(super) plants: Option<&'a Plants>,
    /// Cells that no slab enters.
    pub(super) walls: Option<&'a [u8]>,
    /// Key of lifted slabs.
    pub(super) key: u32,
    /// Key of slabs that come in over open edges.
    pub(super) inflow_key: u32,
}

/// Lifts and lands slabs; `change` receives the change of every height.
pub(super) fn move_slabs(wind: &Wind<'_>, bands: &mut Bands, change: &mut [i32]) {
    bands.collect(change, |rows, sink| {
        let mut lifted = Vec::with_capacity(wind.lattice.nx());
        let mut words = vec![0; wind.lattice.nx()];
        for row in rows {
            wind.lift_row(row, &mut words, &mut lifted);
            for &(index, word) in &lifted {
                sink.add(index as usize, -wind.rule.slab);
                wind.land(index as usize, word, sink);
            }
            wind.let_in(row, sink);
        }
    });
}

impl Wind<'_> {
    /// Cells of a row that lose a slab, with their random words.
    fn lift_row(&self, row: usize, words: &mut [u32], lifted: &mut Vec<(u32, u32)>) {
        let first = row * words.len();
        pulp::Arch::new().dispatch(Words { key: self.key, first: first as u32, row: words });
        lifted.clear();
        let kinds = &self.surface.kinds[first..][..words.len()];
        match self.plants {
            None => {
                let cells = (first as u32..).zip(kinds).zip(&*words);
                let gusty = cells.filter(|((_, kind), word)| **kind == SAND && **word & 0xFF < self.rule.lift_256);
                lifted.extend(gusty.map(|((index, _), word)| (index, *word)));
            }
            Some(plants) => {
                let cells = (first as u32..).zip(kinds).zip(&*words).zip(&plants.cover[first..]);
                let gusty = cells.filter(|(((_, kind), word), cover)| {
                    **kind == SAND && **word & 0xFF < (self.rule.lift_256 * (256 - u32::from(**cover))) >> 8
                });
                lifted.extend(gusty.map(|(((index, _), word), _)| (index, *word)));
            }
        }
    }

    /// Slabs that come in over the open upwind edges of a row.
    fn let_in(&self, row: usize, sink: &mut Sink<'_>) {
        if self.edges == Edges::Periodic || self.rule.inflow_65536 == 0 {
            return;
        }
        let [nx, ny] = self.lattice.size();
        let upwind_row = if self.direction.y > 0 { 0 } else { ny - 1 };
        let upwind_column = if self.direction.x > 0 { 0 } else { nx - 1 };
        let whole_row = self.direction.y != 0 && row == upwind_row;
        for x in 0..nx {
            if whole_row || (self.direction.x != 0 && x == upwind_column) {
                let index = row * nx + x;
                let word = cell_word(self.inflow_key, index as u32);
                if word & 0xFFFF < self.rule.inflow_65536 {
                    sink.enter(self.rule.slab);
                    self.land(index, word, sink);
                }
            }
        }
    }

    /// Lets a slab from `start` hop until it sticks or leaves.
    #[inline(always)]
    fn land(&self, start: usize, mut word: u32, sink: &mut Sink<'_>) {
        let length = self.rule.hop_length_256(self.heights[start] - self.means[start]);
        let stride = self.direction.stride(length);
        let [mut x, mut y] = self.lattice.position(start).map(|part| part as i32);
        let mut index = start;
        for hop in 1..=MAX_HOPS {
            word = next_word(word);
            let dither = [(word & 0xFF) as i32, ((word >> 8) & 0xFF) as i32];
            let to_lee = self.surface.sites[index] >> SITE_BITS;
            let caught = to_lee != SITE_NO_LEE && (i32::from(to_lee) << 8) <= length + dither[0];
            let [dx, dy] = if caught { self.to_lee[usize::from(to_lee)] } else { stride.dithered(dither) };
            (x, y) = (x + dx, y + dy);
            if self.leaves(x, y) {
                sink.leave(self.rule.slab);
                return;
            }
            let next = self.lattice.index(x, y);
            if self.walls.is_some_and(|walls| walls[next] != 0) {
                break;
            }
            index = next;
            if hop == MAX_HOPS || word >> 20 < self.drop_chance(index) {
                break;
            }
        }
        sink.add(index, self.rule.slab);
    }

    /// Whether sand that goes to a cell leaves the bed.
    #[inline(always)]
    pub(super) fn leaves(&self, x: i32, y: i32) -> bool {
        self.edges == Edges::Open && self.lattice.is_outside(x, y)
    }

    /// Height of a cell: of the one across, or of the nearest at an open edge.
    #[inline(always)]
    pub(super) fn height_at(&self, x: i32, y: i32) -> i32 {
        let [nx, ny] = self.lattice.size().map(|side| side as i32);
        self.heights[match self.edges {
            Edges::Periodic => self.lattice.index(x, y),
            Edges::Open => self.lattice.index(x.clamp(0, nx - 1), y.clamp(0, ny - 1)),
        }]
    }

    /// Chance to stick (1/4096), more under plants.
    #[inline(always)]
    fn drop_chance(&self, index: usize) -> u32 {
        let kind = self.surface.sites[index];
        if kind & LEE != 0 {
            return 4096;
        }
        let chance = if kind & SAND != 0 { self.rule.drop_on_sand_4096 } else { self.rule.drop_on_bare_4096 };
        self.plants.map_or(chance, |plants| chance + (((4096 - chance) * u32::from(plants.cover[index])) >> 8))
    }
}

/// The random words of a row, for the widest vector instructions that this computer has.
struct Words<'a> {
    key: u32,
    first: u32,
    row: &'a mut [u32],
}

impl pulp::NullaryFnOnce for Words<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for (word, cell) in self.row.iter_mut().zip(self.first..) {
            *word = cell_word(self.key, cell);
        }
    }
}

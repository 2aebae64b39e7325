//! The tree 5-4-3 of the active cells of a dense grid, in the order of the file.

use std::io::{self, Write};

use tyndall_core::grid::Grid3;

use super::encode::{self, Encoder};

/// Cells along a side of a block at the bottom, of one in the middle, and of one below the root.
const SIDES: [usize; 3] = [8, 128, 4096];
/// Blocks along a side of their parent (as powers of 2): of the middle ones, and of those below the root.
const LOG2_MIDDLE: u32 = 4;
const LOG2_TOP: u32 = 5;
/// Cells of a block at the bottom.
const LEAF_CELLS: usize = 512;

/// Which cells of a block of 8 x 8 x 8 are above 0; z runs fastest, x slowest.
#[derive(Clone, Copy, Debug)]
struct Leaf {
    origin: [usize; 3],
    mask: [u64; LEAF_CELLS / 64],
}

/// A block of blocks, with each child's number in it.
#[derive(Clone, Debug)]
struct Branch<C> {
    origin: [usize; 3],
    children: Vec<(usize, C)>,
}

/// The active cells of a grid.
#[derive(Clone, Debug)]
pub(super) struct Tree {
    tops: Vec<Branch<Branch<Leaf>>>,
}

impl Tree {
    pub(super) fn of(values: &Grid3<f32>) -> Self {
        let whole = |_: [usize; 3]| 0;
        let tops = children(values.size(), ([0; 3], usize::MAX), SIDES[2], whole, |origin| top(values, origin));
        Self { tops: tops.into_iter().map(|(_, top)| top).collect() }
    }

    fn leaves(&self) -> impl Iterator<Item = &Leaf> {
        let middles = self.tops.iter().flat_map(|top| &top.children);
        middles.flat_map(|(_, middle)| &middle.children).map(|(_, leaf)| leaf)
    }

    /// Blocks of 512 cells.
    pub(super) fn leaf_count(&self) -> u64 {
        self.leaves().count() as u64
    }

    /// Cells above 0.
    pub(super) fn active_cells(&self) -> u64 {
        self.leaves().flat_map(|leaf| leaf.mask).map(|word| u64::from(word.count_ones())).sum()
    }

    /// The least box that holds all active cells, both corners inclusive.
    pub(super) fn bounds(&self) -> Option<[[usize; 3]; 2]> {
        let cells = self.leaves().flat_map(Leaf::active);
        cells.fold(None, |bounds, cell| {
            let [low, high] = bounds.unwrap_or([cell; 2]);
            let pick =
                |of: fn(usize, usize) -> usize, corner: [usize; 3]| [0, 1, 2].map(|axis| of(corner[axis], cell[axis]));
            Some([pick(usize::min, low), pick(usize::max, high)])
        })
    }

    /// Which blocks there are; of internal blocks no value is active.
    pub(super) fn write_topology(&self, file: &mut impl Write, encoder: &Encoder) -> io::Result<()> {
        // One buffer a leaf, the background, no tiles below the root.
        encode::word(file, 1)?;
        file.write_all(&0.0_f32.to_le_bytes())?;
        encode::word(file, 0)?;
        encode::word(file, u32::try_from(self.tops.len()).map_err(io::Error::other)?)?;
        for top in &self.tops {
            encode::place(file, top.origin)?;
            write_branch(file, top, LOG2_TOP, encoder)?;
            for (_, middle) in &top.children {
                write_branch(file, middle, LOG2_MIDDLE, encoder)?;
                middle.children.iter().try_for_each(|(_, leaf)| encode::mask(file, &leaf.mask))?;
            }
        }
        Ok(())
    }

    /// The active values, block by block.
    pub(super) fn write_values(&self, file: &mut impl Write, values: &Grid3<f32>, encoder: &Encoder) -> io::Result<()> {
        let mut active = Vec::with_capacity(LEAF_CELLS);
        for leaf in self.leaves() {
            active.clear();
            active.extend(leaf.active().map(|cell| values[cell]));
            encode::mask(file, &leaf.mask)?;
            encoder.write_active(file, &active)?;
        }
        Ok(())
    }
}

impl Leaf {
    /// The active cells in the order of the file.
    fn active(&self) -> impl Iterator<Item = [usize; 3]> + use<'_> {
        let on = (0..LEAF_CELLS).filter(|place| (self.mask[place / 64] >> (place % 64)) & 1 == 1);
        on.map(|place| {
            let [x, y, z] = self.origin;
            [x + (place >> 6), y + ((place >> 3) & 7), z + (place & 7)]
        })
    }
}

/// The block below the root at `origin`; none without an active cell.
fn top(values: &Grid3<f32>, origin: [usize; 3]) -> Option<Branch<Branch<Leaf>>> {
    let number = |place: [usize; 3]| number(place, SIDES[1], LOG2_TOP);
    let children = children(values.size(), (origin, SIDES[2]), SIDES[1], number, |origin| middle(values, origin));
    (!children.is_empty()).then_some(Branch { origin, children })
}

fn middle(values: &Grid3<f32>, origin: [usize; 3]) -> Option<Branch<Leaf>> {
    let number = |place: [usize; 3]| number(place, SIDES[0], LOG2_MIDDLE);
    let children = children(values.size(), (origin, SIDES[1]), SIDES[0], number, |origin| leaf(values, origin));
    (!children.is_empty()).then_some(Branch { origin, children })
}

fn leaf(values: &Grid3<f32>, origin: [usize; 3]) -> Option<Leaf> {
    let size = values.size();
    let mut mask = [0_u64; LEAF_CELLS / 64];
    let span = |axis: usize| 0..SIDES[0].min(size[axis] - origin[axis]);
    for z in span(2) {
        for y in span(1) {
            for x in span(0) {
                let on = values[[origin[0] + x, origin[1] + y, origin[2] + z]] > 0.0;
                // A word holds one x.
                mask[x] |= u64::from(on) << ((y << 3) | z);
            }
        }
    }
    (mask != [0; LEAF_CELLS / 64]).then_some(Leaf { origin, mask })
}

/// Number of the child at a place relative to its parent.
fn number(place: [usize; 3], side: usize, log2: u32) -> usize {
    let [x, y, z] = place.map(|offset| offset / side);
    (((x << log2) | y) << log2) | z
}

/// The children, of `side` cells each, that a parent has within the grid: z fastest, x slowest.
fn children<C>(
    size: [usize; 3],
    (origin, extent): ([usize; 3], usize),
    side: usize,
    number: impl Fn([usize; 3]) -> usize,
    child: impl Fn([usize; 3]) -> Option<C>,
) -> Vec<(usize, C)> {
    let along = |axis: usize| (origin[axis]..size[axis].min(origin[axis].saturating_add(extent))).step_by(side);
    let places = along(0).flat_map(|x| along(1).flat_map(move |y| along(2).map(move |z| [x, y, z])));
    let relative = |place: [usize; 3]| [0, 1, 2].map(|axis| place[axis] - origin[axis]);
    places.filter_map(|place| child(place).map(|child| (number(relative(place)), child))).collect()
}

/// Which children a branch has, and its own values: none is active.
fn write_branch<C>(file: &mut impl Write, branch: &Branch<C>, log2: u32, encoder: &Encoder) -> io::Result<()> {
    let count = 1_usize << (3 * log2);
    let mut mask = vec![0_u64; count / 64];
    for (number, _) in &branch.children {
        mask[number / 64] |= 1 << (number % 64);
    }
    encode::mask(file, &mask)?;
    mask.fill(0);
    encode::mask(file, &mask)?;
    encoder.write_inactive(file, count)
}

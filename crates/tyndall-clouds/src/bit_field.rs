//! One bit per cell: 32 heights of a column in one word.
//!
//! Heights 32 l to 32 l + 31 of all columns form layer l, an array of words with x fastest; bit k of a word is height
//! 32 l + k. Of five layouts that were timed this one is the fastest (57 against 39 thousand million cells a second for
//! bits along x): neighbours in x and y are whole words at a fixed distance, neighbours in height are shifts within a
//! word, and a shader can do the same. Each row has two guard words at both ends and each layer two guard rows, so that
//! no neighbour needs a test; rows are padded to whole groups of sixteen columns.

use crate::grid_size::cells;

/// Guard words at each end of a row, and guard rows at each end of a layer: the reach of the rule.
pub(crate) const GUARD: usize = 2;

/// Columns that are worked on together; the rows' length is padded to a multiple.
pub(crate) const LANES: usize = 16;

/// One word of each of [`LANES`] columns.
pub(crate) type Lanes = [u32; LANES];

/// Heights of a word.
pub const HEIGHTS_PER_LAYER: usize = 32;

/// A bit per cell of an nx x ny x nz grid.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BitField {
    size: [usize; 3],
    layers: Vec<Vec<u32>>,
}

impl BitField {
    /// All bits 0; `size` = [nx, ny, nz] cells.
    #[must_use]
    pub fn new(size: [usize; 3]) -> Self {
        let words = row_stride(size[0]) * (size[1] + 2 * GUARD);
        Self { size, layers: vec![vec![0; words]; size[2].div_ceil(HEIGHTS_PER_LAYER)] }
    }

    /// [nx, ny, nz].
    #[must_use]
    pub fn size(&self) -> [usize; 3] {
        self.size
    }

    /// Whether the bit of cell (x, y, z) is set.
    #[must_use]
    pub fn get(&self, [x, y, z]: [usize; 3]) -> bool {
        (self.row(z / HEIGHTS_PER_LAYER, y)[x] >> (z % HEIGHTS_PER_LAYER)) & 1 == 1
    }

    /// Sets or clears the bit of cell (x, y, z).
    pub fn set(&mut self, [x, y, z]: [usize; 3], value: bool) {
        let bit = 1 << (z % HEIGHTS_PER_LAYER);
        let word = &mut self.row_mut(z / HEIGHTS_PER_LAYER, y)[x];
        *word = if value { *word | bit } else { *word & !bit };
    }

    /// Sets each bit to `value(x, y, z)`.
    pub fn fill_with(&mut self, mut value: impl FnMut([usize; 3]) -> bool) {
        for cell in cells(self.size) {
            self.set(cell, value(cell));
        }
    }

    /// Number of set bits.
    #[must_use]
    pub fn count(&self) -> u64 {
        self.words().map(|word| u64::from(word.count_ones())).sum()
    }

    /// Number of layers of 32 heights.
    #[must_use]
    pub fn layer_count(&self) -> usize {
        self.layers.len()
    }

    /// The nx words of row `y` in a layer.
    #[must_use]
    pub fn row(&self, layer: usize, y: usize) -> &[u32] {
        let start = self.row_start(y);
        &self.layers[layer][start..start + self.size[0]]
    }

    /// The nx words of row `y` in a layer, to be changed; bits above the grid's height must stay 0.
    pub(crate) fn row_mut(&mut self, layer: usize, y: usize) -> &mut [u32] {
        let start = self.row_start(y);
        &mut self.layers[layer][start..start + self.size[0]]
    }

    /// Whole rows of a layer, guard words included, from row 0 to the last; each is [`row_stride`] words long and begins
    /// with [`GUARD`] guard words.
    pub(crate) fn rows_mut(&mut self, layer: usize) -> &mut [u32] {
        let stride = row_stride(self.size[0]);
        &mut self.layers[layer][GUARD * stride..(GUARD + self.size[1]) * stride]
    }

    /// Row `y` + `dy` with its guard words, `dy` from -2 to 2: word x of the grid is at x + [`GUARD`].
    pub(crate) fn guarded_row(&self, layer: usize, y: usize, dy: isize) -> &[u32] {
        let stride = row_stride(self.size[0]);
        let start = (y + GUARD).saturating_add_signed(dy) * stride;
        &self.layers[layer][start..start + self.size[0] + 2 * GUARD]
    }

    /// Copies the opposite edges into the guards, as in a world that repeats.
    pub(crate) fn wrap_guards(&mut self) {
        let [nx, ny, _] = self.size;
        let stride = row_stride(nx);
        for layer in &mut self.layers {
            for row in layer.chunks_exact_mut(stride).skip(GUARD).take(ny) {
                for guard in 0..GUARD {
                    row[guard] = row[GUARD + (nx - GUARD % nx + guard) % nx];
                    row[GUARD + nx + guard] = row[GUARD + guard % nx];
                }
            }
            for guard in 0..GUARD {
                let before = GUARD + (ny - GUARD % ny + guard) % ny;
                layer.copy_within(before * stride..(before + 1) * stride, guard * stride);
                let after = GUARD + guard % ny;
                layer.copy_within(after * stride..(after + 1) * stride, (GUARD + ny + guard) * stride);
            }
        }
    }

    /// All words of the grid, without guards.
    fn words(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.layers.len()).flat_map(move |layer| (0..self.size[1]).flat_map(move |y| self.row(layer, y))).copied()
    }

    fn row_start(&self, y: usize) -> usize {
        (y + GUARD) * row_stride(self.size[0]) + GUARD
    }
}

/// Words of a row with guards and padding.
pub(crate) fn row_stride(nx: usize) -> usize {
    nx.next_multiple_of(LANES) + 2 * GUARD
}

/// The bits of a layer that lie within `nz` heights.
pub(crate) fn layer_mask(nz: usize, layer: usize) -> u32 {
    let heights = nz - layer * HEIGHTS_PER_LAYER;
    if heights >= HEIGHTS_PER_LAYER { u32::MAX } else { (1 << heights) - 1 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_bit_is_stored_alone_in_grids_of_any_size() {
        for size in [[1, 1, 1], [17, 3, 33], [5, 7, 64], [16, 2, 100]] {
            let mut field = BitField::new(size);
            let wanted = |[x, y, z]: [usize; 3]| (7 * x + 5 * y + 3 * z) % 4 == 1;
            field.fill_with(wanted);
            for cell in cells(size) {
                assert_eq!(field.get(cell), wanted(cell), "{cell:?} of {size:?}");
            }
            let count = cells(size).filter(|cell| wanted(*cell)).count() as u64;
            assert_eq!(field.count(), count, "{size:?}");
        }
    }

    #[test]
    fn wrapped_guards_repeat_the_grid_even_when_it_is_narrower_than_they_are() {
        for size in [[1, 1, 8], [3, 2, 8], [20, 5, 40]] {
            let mut field = BitField::new(size);
            field.fill_with(|[x, y, z]| (x + 2 * y + 3 * z) % 3 == 0);
            field.wrap_guards();
            for dy in 0..=4 {
                let row = field.guarded_row(0, 0, dy - 2);
                for (x, &found) in row.iter().enumerate() {
                    // 600 is a multiple of every side in the list.
                    let place = |position: usize, count: usize| (position + 20 * 5 * 6 - 2) % count;
                    let wanted = field.row(0, place(dy.cast_unsigned(), size[1]))[place(x, size[0])];
                    assert_eq!(found, wanted, "word ({x}, {dy}) of {size:?}");
                }
            }
        }
    }
}

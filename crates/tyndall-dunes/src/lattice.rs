//! The periodic lattice of cells: sides are powers of two, x runs fastest.

use crate::DuneError;

/// Smallest side.
pub const MIN_SIDE: usize = 16;
/// Largest side.
pub const MAX_SIDE: usize = 8192;

/// Size of a bed and its index arithmetic; cell (x, y) has index `y * nx + x`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lattice {
    log2: [u32; 2],
}

impl Lattice {
    /// A lattice of `size` = [nx, ny] cells.
    ///
    /// # Errors
    /// [`DuneError::Side`] when a side is no power of two from [`MIN_SIDE`] to [`MAX_SIDE`].
    pub fn new(size: [usize; 2]) -> Result<Self, DuneError> {
        for (axis, cells) in ['x', 'y'].into_iter().zip(size) {
            if !cells.is_power_of_two() || !(MIN_SIDE..=MAX_SIDE).contains(&cells) {
                return Err(DuneError::Side { axis, cells, low: MIN_SIDE, high: MAX_SIDE });
            }
        }
        Ok(Self { log2: size.map(usize::ilog2) })
    }

    /// [nx, ny].
    #[must_use]
    pub fn size(self) -> [usize; 2] {
        self.log2.map(|bits| 1 << bits)
    }

    /// Cells along x.
    #[inline(always)]
    #[must_use]
    pub fn nx(self) -> usize {
        1 << self.log2[0]
    }

    /// Cells along y.
    #[inline(always)]
    #[must_use]
    pub fn ny(self) -> usize {
        1 << self.log2[1]
    }

    /// Number of cells.
    #[must_use]
    pub fn cells(self) -> usize {
        self.nx() * self.ny()
    }

    /// Index of the cell, both coordinates wrapped.
    #[inline(always)]
    #[must_use]
    pub fn index(self, x: i32, y: i32) -> usize {
        let [mask_x, mask_y] = [self.nx() - 1, self.ny() - 1];
        ((y as usize & mask_y) << self.log2[0]) | (x as usize & mask_x)
    }

    /// Whether the coordinates are beyond an edge.
    #[inline(always)]
    #[must_use]
    pub fn is_outside(self, x: i32, y: i32) -> bool {
        x < 0 || y < 0 || x >= self.nx() as i32 || y >= self.ny() as i32
    }

    /// Column and row of an index.
    #[inline(always)]
    #[must_use]
    pub fn position(self, index: usize) -> [usize; 2] {
        [index & (self.nx() - 1), index >> self.log2[0]]
    }

    /// Checks that a grid has a value for every cell.
    pub(crate) fn check_grid(self, what: &'static str, found: usize) -> Result<(), DuneError> {
        if found == self.cells() { Ok(()) } else { Err(DuneError::GridSize { what, found, size: self.size() }) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_wrap_around_both_sides() {
        let lattice = Lattice::new([32, 16]).unwrap();
        assert_eq!(lattice.index(-1, 0), 31, "left of the first column is the last");
        assert_eq!(lattice.index(32, -1), 15 * 32, "above the first row is the last");
        assert_eq!(lattice.position(lattice.index(5, 7)), [5, 7], "back and forth");
    }

    #[test]
    fn sides_that_cannot_wrap_by_a_mask_are_refused() {
        let message = Lattice::new([64, 100]).unwrap_err().to_string();
        assert_eq!(message, "the y side has 100 cells; powers of two from 16 to 8192 are allowed", "names the side");
        assert!(Lattice::new([8, 64]).is_err() && Lattice::new([16384, 64]).is_err(), "too small, too large");
    }
}

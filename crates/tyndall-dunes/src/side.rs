//! Sides of square beds that users choose from.

use tyndall_core::choices;

choices! {
    /// Cells along each side of a square bed: powers of two, so that indices wrap by a mask.
    pub enum Side {
        /// 64 cells.
        Cells64 = "64",
        /// 128 cells.
        Cells128 = "128",
        /// 256 cells.
        Cells256 = "256",
        /// 512 cells.
        Cells512 = "512",
        /// 1024 cells.
        Cells1024 = "1024",
        /// 2048 cells.
        Cells2048 = "2048",
        /// 4096 cells.
        Cells4096 = "4096",
    }
}

impl Side {
    /// The number of cells.
    #[must_use]
    pub fn cells(self) -> usize {
        64 << (self as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_the_numbers_of_cells() {
        for side in Side::ALL {
            assert_eq!(side.name(), side.cells().to_string(), "{side:?}");
        }
    }
}

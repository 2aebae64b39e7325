//! Dense arrays in two and three dimensions.
//!
//! x runs fastest: cell (x, y, z) lies at index `(z * ny + y) * nx + x`. Samples stand at cell centres, that is at
//! (x + 0.5) / nx of the extent.

use std::ops::{Add, Index, IndexMut, Mul};

/// A 2-D array; x runs fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid2<T> {
    size: [usize; 2],
    cells: Vec<T>,
}

/// A 3-D array; x runs fastest, z slowest.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid3<T> {
    size: [usize; 3],
    cells: Vec<T>,
}

impl<T: Clone> Grid2<T> {
    /// All cells equal to `value`; `size` = [nx, ny].
    #[must_use]
    pub fn filled(size: [usize; 2], value: T) -> Self {
        Self { size, cells: vec![value; size[0] * size[1]] }
    }
}

impl<T> Grid2<T> {
    /// From the cells in index order, or `None` when their number is not nx * ny.
    #[must_use]
    pub fn from_cells(size: [usize; 2], cells: Vec<T>) -> Option<Self> {
        (cells.len() == size[0] * size[1]).then_some(Self { size, cells })
    }

    /// Cell (x, y) by cell: `value(x, y)`.
    pub fn from_fn(size: [usize; 2], mut value: impl FnMut(usize, usize) -> T) -> Self {
        let cells = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y))).map(|(x, y)| value(x, y)).collect();
        Self { size, cells }
    }

    /// [nx, ny].
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// All cells in index order.
    #[must_use]
    pub fn cells(&self) -> &[T] {
        &self.cells
    }

    /// All cells in index order, to be changed.
    pub fn cells_mut(&mut self) -> &mut [T] {
        &mut self.cells
    }
}

impl<T> Index<[usize; 2]> for Grid2<T> {
    type Output = T;

    fn index(&self, [x, y]: [usize; 2]) -> &T {
        &self.cells[y * self.size[0] + x]
    }
}

impl<T> IndexMut<[usize; 2]> for Grid2<T> {
    fn index_mut(&mut self, [x, y]: [usize; 2]) -> &mut T {
        &mut self.cells[y * self.size[0] + x]
    }
}

impl<T> Grid2<T>
where
    T: Copy + Add<Output = T> + Mul<f64, Output = T>,
{
    /// Bilinear interpolation at `u`, each from 0 to 1 across the extent; constant beyond the outer cell centres.
    #[must_use]
    pub fn sample(&self, u: [f64; 2]) -> T {
        let [(x0, x1, fx), (y0, y1, fy)] = [0, 1].map(|axis| neighbours(u[axis], self.size[axis]));
        let row = |y: usize| self[[x0, y]] * (1.0 - fx) + self[[x1, y]] * fx;
        row(y0) * (1.0 - fy) + row(y1) * fy
    }
}

impl<T: Clone> Grid3<T> {
    /// All cells equal to `value`; `size` = [nx, ny, nz].
    #[must_use]
    pub fn filled(size: [usize; 3], value: T) -> Self {
        Self { size, cells: vec![value; size.iter().product()] }
    }
}

impl<T> Grid3<T> {
    /// From the cells in index order, or `None` when their number is not nx * ny * nz.
    #[must_use]
    pub fn from_cells(size: [usize; 3], cells: Vec<T>) -> Option<Self> {
        (cells.len() == size.iter().product::<usize>()).then_some(Self { size, cells })
    }

    /// [nx, ny, nz].
    #[must_use]
    pub fn size(&self) -> [usize; 3] {
        self.size
    }

    /// All cells in index order.
    #[must_use]
    pub fn cells(&self) -> &[T] {
        &self.cells
    }

    /// All cells in index order, to be changed.
    pub fn cells_mut(&mut self) -> &mut [T] {
        &mut self.cells
    }

    fn index_of(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.size[1] + y) * self.size[0] + x
    }
}

impl<T> Index<[usize; 3]> for Grid3<T> {
    type Output = T;

    fn index(&self, cell: [usize; 3]) -> &T {
        &self.cells[self.index_of(cell)]
    }
}

impl<T> IndexMut<[usize; 3]> for Grid3<T> {
    fn index_mut(&mut self, cell: [usize; 3]) -> &mut T {
        let index = self.index_of(cell);
        &mut self.cells[index]
    }
}

impl<T> Grid3<T>
where
    T: Copy + Add<Output = T> + Mul<f64, Output = T>,
{
    /// Trilinear interpolation at `u`, each from 0 to 1 across the extent; constant beyond the outer cell centres.
    #[must_use]
    pub fn sample(&self, u: [f64; 3]) -> T {
        let [(x0, x1, fx), (y0, y1, fy), (z0, z1, fz)] = [0, 1, 2].map(|axis| neighbours(u[axis], self.size[axis]));
        let row = |y: usize, z: usize| self[[x0, y, z]] * (1.0 - fx) + self[[x1, y, z]] * fx;
        let slice = |z: usize| row(y0, z) * (1.0 - fy) + row(y1, z) * fy;
        slice(z0) * (1.0 - fz) + slice(z1) * fz
    }
}

/// The two cells around coordinate `u` (0 to 1) of an axis, and the weight of the second.
#[expect(clippy::cast_possible_truncation, reason = "clamped to the axis before the cast")]
fn neighbours(u: f64, count: usize) -> (usize, usize, f64) {
    let last = (count - 1) as f64;
    let position = (u * count as f64 - 0.5).clamp(0.0, last);
    let first = (position as usize).min(count - 1);
    (first, (first + 1).min(count - 1), position - first as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bilinear_interpolation_is_exact_for_a_plane() {
        let grid = Grid2::from_fn([5, 4], |x, y| 2.0 * (x as f64 + 0.5) / 5.0 - 3.0 * (y as f64 + 0.5) / 4.0);
        for (u, v) in [(0.1, 0.125), (0.33, 0.71), (0.9, 0.875)] {
            assert!((grid.sample([u, v]) - (2.0 * u - 3.0 * v)).abs() < 1e-12, "({u}, {v})");
        }
    }

    #[test]
    fn trilinear_interpolation_hits_every_centre_and_is_constant_outside() {
        let size = [3, 4, 5];
        let cells = (0..60).map(f64::from).collect();
        let grid = Grid3::from_cells(size, cells).unwrap();
        for z in 0..5 {
            for y in 0..4 {
                for x in 0..3 {
                    let u = [(x as f64 + 0.5) / 3.0, (y as f64 + 0.5) / 4.0, (z as f64 + 0.5) / 5.0];
                    assert!((grid.sample(u) - grid[[x, y, z]]).abs() < 1e-12, "({x}, {y}, {z})");
                }
            }
        }
        assert!((grid.sample([-1.0, -1.0, -1.0]) - grid[[0, 0, 0]]).abs() < 1e-12, "low corner");
        assert!((grid.sample([2.0, 2.0, 2.0]) - grid[[2, 3, 4]]).abs() < 1e-12, "high corner");
    }

    #[test]
    fn a_wrong_number_of_cells_is_refused() {
        assert!(Grid2::from_cells([2, 2], vec![0.0; 3]).is_none(), "three cells are not four");
        assert!(Grid3::from_cells([2, 2, 2], vec![0.0; 9]).is_none(), "nine cells are not eight");
    }
}

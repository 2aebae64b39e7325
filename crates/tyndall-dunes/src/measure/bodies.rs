//! Separate heaps of sand.

use super::HeightGrid;

/// Heaps on a bed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bodies {
    /// Heaps that are large enough.
    pub count: usize,
    /// Share of cells whose sand is thinner than a tenth of a cell.
    pub bare_share: f64,
}

/// Sand thinner than this leaves ground bare (cells).
const BARE_CELLS: f64 = 0.1;

/// Counts the connected heaps of more than `min_area` cells that stand higher than `above_cells`.
#[must_use]
pub fn bodies(grid: &HeightGrid, above_cells: f64, min_area: usize) -> Bodies {
    let [nx, ny] = grid.size();
    let mut open: Vec<bool> = grid.heights().iter().map(|&height| f64::from(height) > above_cells).collect();
    let bare = grid.heights().iter().filter(|&&height| f64::from(height) < BARE_CELLS).count();
    let (mut count, mut front) = (0, Vec::new());
    for start in 0..open.len() {
        let mut area = 0;
        front.push(start);
        while let Some(index) = front.pop() {
            if !std::mem::take(&mut open[index]) {
                continue;
            }
            area += 1;
            let (x, y) = (index % nx, index / nx);
            let (left, right) = ((x + nx - 1) % nx, (x + 1) % nx);
            let (down, up) = ((y + ny - 1) % ny, (y + 1) % ny);
            front.extend([y * nx + left, y * nx + right, down * nx + x, up * nx + x]);
        }
        count += usize::from(area > min_area);
    }
    Bodies { count, bare_share: bare as f64 / grid.heights().len() as f64 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_heap_across_the_edge_is_one_heap() {
        let inside = |i: usize| (i % 32 < 4 || i % 32 >= 28) && (8..16).contains(&(i / 32));
        let grid = HeightGrid::new([32, 32], (0..1024).map(|i| if inside(i) { 3.0 } else { 0.0 }).collect()).unwrap();
        let found = bodies(&grid, 2.0, 50);
        assert_eq!(found.count, 1, "64 cells in one piece");
        assert!((found.bare_share - 960.0 / 1024.0).abs() < 1e-12, "{found:?}");
        assert_eq!(bodies(&grid, 2.0, 64).count, 0, "not more than 64 cells");
    }
}

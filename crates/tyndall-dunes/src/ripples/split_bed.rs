//! The ripple rule in f64 with hops split over two cells: the form that linear theory describes, for tests.
//!
//! A layer whose hop ends between two cells is shared by them in proportion. No random numbers, no rounding: slow, and
//! only as exact in mass as f64. Periodic; the wind blows along +x.

use super::linear_theory::LinearRule;

/// A bed of [`LinearRule`]; heights in cells.
#[derive(Clone, Debug)]
pub struct SplitBed {
    rule: LinearRule,
    nx: usize,
    heights: Vec<f64>,
}

impl SplitBed {
    /// A bed of rows of `nx` cells; `heights` (cells) hold whole rows, x runs fastest.
    #[must_use]
    pub fn new(rule: LinearRule, nx: usize, heights: Vec<f64>) -> Self {
        Self { rule, nx: nx.max(1), heights }
    }

    /// Heights (cells).
    #[must_use]
    pub fn heights(&self) -> &[f64] {
        &self.heights
    }

    /// One step.
    pub fn step(&mut self) {
        self.saltate();
        self.creep();
    }

    fn saltate(&mut self) {
        let (nx, layer) = (self.nx, self.rule.layer_cells);
        let mut moved = self.heights.clone();
        for (index, &height) in self.heights.iter().enumerate() {
            let row = index / nx * nx;
            let hop = (self.rule.hop_cells + self.rule.hop_per_height * height).max(0.0);
            let (whole, share) = (hop.floor(), hop.fract());
            let first = (index - row + whole as usize) % nx;
            moved[index] -= layer;
            moved[row + first] += layer * (1.0 - share);
            moved[row + (first + 1) % nx] += layer * share;
        }
        self.heights = moved;
    }

    fn creep(&mut self) {
        let (nx, ny) = (self.nx, self.heights.len() / self.nx);
        let at = |x: usize, y: usize| self.heights[y % ny * nx + x % nx];
        let crept = (0..self.heights.len()).map(|index| {
            let (x, y) = (index % nx, index / nx);
            let (left, right, down, up) = (x + nx - 1, x + 1, y + ny - 1, y + 1);
            let sides = at(left, y) + at(right, y) + at(x, down) + at(x, up);
            let corners = at(left, down) + at(right, down) + at(left, up) + at(right, up);
            at(x, y) + self.rule.creep * (sides / 6.0 + corners / 12.0 - at(x, y))
        });
        self.heights = crept.collect();
    }
}

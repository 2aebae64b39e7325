//! A grid of cells of one width, and what light meets between two of them.

use rayon::prelude::*;

/// Resistance between two clear cells with cloud all around: light crosses narrow gaps slanted, from wall to wall.
const GAP_RESISTANCE: f32 = 1.6;
/// Resistance between clear cells with no cloud near: little, but not so little that steps stay small.
const LEAST_RESISTANCE: f32 = 0.05;
/// Resistance between cloud and clear air or the dark.
const SURFACE_RESISTANCE: f32 = 2.13;

/// A grid of one width.
pub(super) struct Level {
    pub(super) size: [usize; 3],
    /// Optical thickness of each cell.
    pub(super) thickness: Vec<f32>,
    /// Share of clear air.
    pub(super) clear: Vec<f32>,
    /// Share of cloud in the wider surroundings.
    pub(super) crowd: Vec<f32>,
    /// Light that starts in each cell (per area of its side).
    pub(super) source: Vec<f32>,
}

/// What a cell does to light.
#[derive(Clone, Copy)]
pub(super) struct Cell {
    thickness: f32,
    clear: f32,
    crowd: f32,
}

impl Level {
    pub(super) fn cell(&self, index: usize) -> Cell {
        Cell { thickness: self.thickness[index], clear: self.clear[index], crowd: self.crowd[index] }
    }

    /// Cells of twice the width: the mean thickness times two, the sum of the light over four sides.
    pub(super) fn coarser(&self) -> Self {
        let size = self.size;
        let coarse = size.map(|cells| cells.div_ceil(2));
        let sum = |values: &[f32], place: usize, weight: f32| {
            let low = [place % coarse[0], place / coarse[0] % coarse[1], place / (coarse[0] * coarse[1])];
            let low = low.map(|index| 2 * index);
            let mut sum = 0.0;
            for z in low[2]..(low[2] + 2).min(size[2]) {
                for y in low[1]..(low[1] + 2).min(size[1]) {
                    let row = (z * size[1] + y) * size[0];
                    sum += values[row + low[0]..row + (low[0] + 2).min(size[0])].iter().sum::<f32>();
                }
            }
            sum * weight
        };
        let cells = coarse.iter().product::<usize>();
        let summed =
            |values: &[f32], weight: f32| (0..cells).into_par_iter().map(|place| sum(values, place, weight)).collect();
        Self {
            size: coarse,
            thickness: summed(&self.thickness, 0.25),
            clear: summed(&self.clear, 0.125),
            crowd: Vec::new(),
            source: summed(&self.source, 0.25),
        }
    }
}

/// Difference of fluence over flux across a face, to another cell or out of the grid.
pub(super) fn resistance(cell: Cell, other: Option<Cell>) -> f32 {
    let Some(other) = other else {
        return (1.5 * cell.thickness + SURFACE_RESISTANCE * (1.0 - cell.clear)).max(LEAST_RESISTANCE);
    };
    let surface = SURFACE_RESISTANCE * (cell.clear - other.clear).abs();
    let gap = 0.5 * GAP_RESISTANCE * (cell.crowd + other.crowd);
    (1.5 * (cell.thickness + other.thickness) + surface).max(gap).max(LEAST_RESISTANCE)
}

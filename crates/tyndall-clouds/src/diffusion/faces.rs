//! What flows through the faces of cells, known before the first step: a step is then seven products a cell.

use rayon::prelude::*;
use tyndall_core::grid::Grid3;

use super::level::{Level, resistance};
use crate::edges::Edges;

/// Share of a step that is taken; all of it would let neighbouring cells swing.
const STEP_SHARE: f32 = 0.85;
/// Fewest rows that a thread takes at once.
const FEWEST_ROWS: usize = 32;

/// The balance of every cell of a grid with its neighbours.
pub(super) struct Faces {
    size: [usize; 3],
    /// Conductance from each cell to the next one east, north and up, round to the first where the grid is wrapped; 0 where
    /// none follows.
    next: [Vec<f32>; 3],
    /// Share of a step over the conductances of all six faces.
    share: Vec<f32>,
    /// The same times the light that starts in the cell.
    source: Vec<f32>,
}

impl Faces {
    pub(super) fn new(level: &Level, edges: Edges) -> Self {
        let wraps = [edges == Edges::Wrap, edges == Edges::Wrap, false];
        let next = [0, 1, 2].map(|axis| {
            let conductance = |index: usize| {
                let other = follower(level.size, index, axis, wraps[axis])?;
                Some(1.0 / resistance(level.cell(index), Some(level.cell(other))))
            };
            (0..level.source.len()).into_par_iter().map(|index| conductance(index).unwrap_or(0.0)).collect::<Vec<f32>>()
        });
        let loss = |index: usize| -> f32 {
            let outside = 1.0 / resistance(level.cell(index), None);
            let faces = (0..3).map(|axis| {
                let after = follower(level.size, index, axis, wraps[axis]).map_or(outside, |_| next[axis][index]);
                let before = leader(level.size, index, axis, wraps[axis]);
                after + before.map_or(outside, |before| next[axis][before])
            });
            faces.sum()
        };
        let share: Vec<f32> = (0..level.source.len()).into_par_iter().map(|index| STEP_SHARE / loss(index)).collect();
        let source = share.par_iter().zip(&level.source).map(|(share, source)| share * source).collect();
        Self { size: level.size, next, share, source }
    }

    /// Jacobi steps towards the balance of every cell.
    pub(super) fn relax(&self, fluence: &mut Grid3<f32>, steps: usize) {
        let mut after = fluence.clone();
        for _ in 0..steps {
            let before = fluence.cells();
            let rows = after.cells_mut().par_chunks_exact_mut(self.size[0]).with_min_len(FEWEST_ROWS);
            rows.enumerate().for_each(|(row, cells)| self.relax_row(before, row, cells));
            std::mem::swap(fluence, &mut after);
        }
    }

    fn relax_row(&self, before: &[f32], row: usize, cells: &mut [f32]) {
        let [nx, ny, nz] = self.size;
        let (y, z) = (row % ny, row / ny);
        // Beyond the last row lies the first, and nothing flows there unless the grid is wrapped.
        let (south, north) = (z * ny + (y + ny - 1) % ny, z * ny + (y + 1) % ny);
        let (below, above) = ((z + nz - 1) % nz * ny + y, (z + 1) % nz * ny + y);
        let line = |row: usize| row * nx..(row + 1) * nx;
        let [_, to_north, to_above] = &self.next;
        let lines =
            [(south, to_north, south), (north, to_north, row), (below, to_above, below), (above, to_above, row)];
        let [south, north, below, above] =
            lines.map(|(light, through, face)| before[line(light)].iter().zip(&through[line(face)]));
        for ((((cell, south), north), below), above) in cells.iter_mut().zip(south).zip(north).zip(below).zip(above) {
            *cell = south.0 * south.1 + north.0 * north.1 + (below.0 * below.1 + above.0 * above.1);
        }
        let (own, to_east) = (&before[line(row)], &self.next[0][line(row)]);
        add_products(&mut cells[..nx - 1], &own[1..], to_east);
        add_products(&mut cells[1..], own, to_east);
        cells[0] += own[nx - 1] * to_east[nx - 1];
        cells[nx - 1] += own[0] * to_east[nx - 1];
        let balance = own.iter().zip(&self.share[line(row)]).zip(&self.source[line(row)]);
        for (cell, ((own, share), source)) in cells.iter_mut().zip(balance) {
            *cell = (1.0 - STEP_SHARE) * own + share * *cell + source;
        }
    }
}

fn add_products(sums: &mut [f32], a: &[f32], b: &[f32]) {
    for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
        *sum += a * b;
    }
}

/// Cells between neighbours along an axis, and the place of a cell along it.
fn along(size: [usize; 3], index: usize, axis: usize) -> (usize, usize) {
    let stride: usize = size[..axis].iter().product();
    (stride, index / stride % size[axis])
}

/// The next cell along an axis.
fn follower(size: [usize; 3], index: usize, axis: usize, wraps: bool) -> Option<usize> {
    let (stride, place) = along(size, index, axis);
    if place + 1 < size[axis] { Some(index + stride) } else { wraps.then_some(index - place * stride) }
}

/// The cell before along an axis.
fn leader(size: [usize; 3], index: usize, axis: usize, wraps: bool) -> Option<usize> {
    let (stride, place) = along(size, index, axis);
    if place > 0 { Some(index - stride) } else { wraps.then_some(index + (size[axis] - 1) * stride) }
}

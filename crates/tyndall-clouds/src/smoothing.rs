//! Bits to density: the weighted mean of cld over a window of space and time, section 3.2 after Dobashi et al. 2000.
//!
//! The window is separable, with triangular weights (1-2-3-2-1 over five cells or steps); the paper gives none. Whole numbers
//! all the way: the sums are exact and fit 16 bits. One row at a time is summed over time, height and x, and rows wait in a
//! ring for the sum over y, so that nothing but bits is read from memory and nothing but the result is written.
#![expect(clippy::inline_always, reason = "only what is inlined is compiled for the processor's wider instructions")]

use rayon::prelude::*;
use tyndall_core::grid::Grid3;

use crate::bit_field::{BitField, HEIGHTS_PER_LAYER};
use crate::edges::Edges;
use crate::error::{CloudError, in_range};

/// Farthest cell or step of a window from its middle.
pub const MAX_REACH: u32 = 2;
const REACH: usize = MAX_REACH as usize;
/// Cells or steps of the widest window.
pub(crate) const TAPS: usize = 2 * REACH + 1;
/// Rows that a task makes.
const ROWS_PER_TASK: usize = 32;

/// How far density is smoothed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SmoothingWindow {
    cells: u32,
    steps: u32,
}

impl Default for SmoothingWindow {
    /// Five cells along each axis, five steps.
    fn default() -> Self {
        Self { cells: MAX_REACH, steps: MAX_REACH }
    }
}

impl SmoothingWindow {
    /// Reach to each side of the middle along x, y and height (cells), and before and after (steps); 0 is no smoothing.
    ///
    /// # Errors
    /// When a reach is above [`MAX_REACH`].
    pub fn new(cells: u32, steps: u32) -> Result<Self, CloudError> {
        let limits = (0.0, f64::from(MAX_REACH));
        in_range("reach of the smoothing", f64::from(cells), limits, " cells")?;
        in_range("reach of the smoothing", f64::from(steps), limits, " steps")?;
        Ok(Self { cells, steps })
    }

    /// Reach along x, y and height (cells).
    #[must_use]
    pub fn cells(self) -> u32 {
        self.cells
    }

    /// Reach in time (steps); density lags behind the automaton by as much.
    #[must_use]
    pub fn steps(self) -> u32 {
        self.steps
    }

    /// The sum of all weights: the value of a cell deep in cloud.
    #[must_use]
    pub fn full(self) -> u16 {
        let side = |reach: u32| u16::from(reach == 0) + 4 * u16::from(reach == 1) + 9 * u16::from(reach == 2);
        side(self.steps) * side(self.cells).pow(3)
    }
}

/// Weights of a triangular window, in the middle of [`TAPS`] places.
fn weights(reach: u32) -> [u16; TAPS] {
    match reach {
        0 => [0, 0, 1, 0, 0],
        1 => [0, 1, 2, 1, 0],
        _ => [1, 2, 3, 2, 1],
    }
}

/// The weighted sums of `history`, newest first, for every cell; [`SmoothingWindow::full`] deep in cloud.
///
/// Cells beyond open sides, the floor and the ceiling count as clear.
pub(crate) fn smooth(history: &[&BitField; TAPS], window: SmoothingWindow, edges: Edges, sums: &mut Grid3<u16>) {
    let [nx, ny, _] = history[0].size();
    let mut tasks: Vec<Vec<&mut [u16]>> = Vec::new();
    tasks.resize_with(ny.div_ceil(ROWS_PER_TASK), Vec::new);
    for (index, row) in sums.cells_mut().chunks_exact_mut(nx).enumerate() {
        tasks[(index % ny) / ROWS_PER_TASK].push(row);
    }
    let arch = pulp::Arch::new();
    tasks.into_par_iter().enumerate().for_each(|(task, rows)| {
        arch.dispatch(Task { history, window, edges, first: task * ROWS_PER_TASK, rows });
    });
}

/// Some rows y of all heights, height by height.
struct Task<'a> {
    history: &'a [&'a BitField; TAPS],
    window: SmoothingWindow,
    edges: Edges,
    first: usize,
    rows: Vec<&'a mut [u16]>,
}

impl pulp::WithSimd for Task<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(mut self, _simd: S) {
        let [nx, ny, nz] = self.history[0].size();
        let count = self.rows.len() / nz;
        let taps = weights(self.window.cells);
        // Row y stands at place (y + REACH - first) % TAPS of the ring.
        let mut ring = [(); TAPS].map(|()| vec![0_u16; nx * nz]);
        let mut scratch = Scratch::new(nx, nz);
        for step in 0..count + 2 * REACH {
            let y = row_index(self.first + step, ny, self.edges);
            row_sums(&self, y, &mut scratch, &mut ring[step % TAPS]);
            let Some(done) = step.checked_sub(2 * REACH) else { continue };
            let rows = [0, 1, 2, 3, 4].map(|tap| &ring[(done + tap) % TAPS][..]);
            for z in 0..nz {
                let parts = rows.map(|row| &row[z * nx..(z + 1) * nx]);
                weighted_sum(parts, taps, self.rows[z * count + done]);
            }
        }
    }
}

/// The grid's row at `position` - REACH; none beyond an open side.
fn row_index(position: usize, ny: usize, edges: Edges) -> Option<usize> {
    match (position.checked_sub(REACH), edges) {
        (Some(y), Edges::Open) => (y < ny).then_some(y),
        (None, Edges::Open) => None,
        (_, Edges::Wrap) => Some((position + REACH * ny - REACH) % ny),
    }
}

/// Buffers of one task.
struct Scratch {
    /// Sums over time, with REACH clear heights below and above.
    times: Vec<u16>,
    /// Sums over time and height of one row, with REACH cells before and after.
    padded: Vec<u16>,
}

impl Scratch {
    fn new(nx: usize, nz: usize) -> Self {
        Self { times: vec![0; nx * (nz + 2 * REACH)], padded: vec![0; nx + 2 * REACH] }
    }
}

/// Sums over time, height and x of one row of all heights.
#[inline(always)]
fn row_sums(task: &Task<'_>, y: Option<usize>, scratch: &mut Scratch, sums: &mut [u16]) {
    let Some(y) = y else {
        sums.fill(0);
        return;
    };
    let [nx, _, nz] = task.history[0].size();
    let (time_taps, taps) = (weights(task.window.steps), weights(task.window.cells));
    for z in 0..nz {
        let rows = task.history.map(|field| &field.row(z / HEIGHTS_PER_LAYER, y)[..nx]);
        time_sum(rows, time_taps, z % HEIGHTS_PER_LAYER, &mut scratch.times[(z + REACH) * nx..][..nx]);
    }
    for (z, sums) in sums.chunks_exact_mut(nx).enumerate() {
        let heights = [0, 1, 2, 3, 4].map(|tap| &scratch.times[(z + tap) * nx..][..nx]);
        weighted_sum(heights, taps, &mut scratch.padded[REACH..REACH + nx]);
        if task.edges == Edges::Wrap {
            for guard in 0..REACH {
                scratch.padded[guard] = scratch.padded[REACH + (guard + REACH * nx - REACH) % nx];
                scratch.padded[REACH + nx + guard] = scratch.padded[REACH + guard % nx];
            }
        }
        weighted_sum([0, 1, 2, 3, 4].map(|tap| &scratch.padded[tap..tap + nx]), taps, sums);
    }
}

/// The weighted sum of one height's bits over the steps.
#[inline(always)]
fn time_sum(rows: [&[u32]; TAPS], taps: [u16; TAPS], height: usize, sums: &mut [u16]) {
    let [a, b, c, d, e] = rows.map(|row| &row[..sums.len()]);
    let [far, near, middle, ..] = taps.map(u32::from);
    for (i, sum) in sums.iter_mut().enumerate() {
        let bit = |word: u32| (word >> height) & 1;
        let value = middle * bit(c[i]) + near * (bit(b[i]) + bit(d[i])) + far * (bit(a[i]) + bit(e[i]));
        *sum = low_half(value);
    }
}

#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "sums of five weighted bits are at most 9")]
fn low_half(value: u32) -> u16 {
    value as u16
}

/// The weighted sum of five rows; weights are symmetric.
#[inline(always)]
fn weighted_sum(rows: [&[u16]; TAPS], taps: [u16; TAPS], sums: &mut [u16]) {
    let [a, b, c, d, e] = rows.map(|row| &row[..sums.len()]);
    let [far, near, middle, ..] = taps;
    for (i, sum) in sums.iter_mut().enumerate() {
        *sum = middle * c[i] + near * (b[i] + d[i]) + far * (a[i] + e[i]);
    }
}

#[cfg(test)]
mod tests {
    use tyndall_core::rng::CellRng;

    use super::*;
    use crate::grid_size::cells;

    fn random_history(size: [usize; 3]) -> [BitField; TAPS] {
        let mut step = 0;
        [(); TAPS].map(|()| {
            let mut field = BitField::new(size);
            field.fill_with(|[x, y, z]| {
                CellRng::new(5).uniform(step, ((z * size[1] + y) * size[0] + x) as u64, 0) < 0.4
            });
            step += 1;
            field
        })
    }

    /// 625 taps, one after the other.
    fn direct(history: &[BitField; TAPS], window: SmoothingWindow, edges: Edges, cell: [usize; 3]) -> u32 {
        let size = history[0].size();
        let place = |axis: usize, tap: usize| {
            let position = cell[axis] + tap;
            match edges {
                Edges::Wrap if axis < 2 => Some((position + 4 * size[axis] - 2) % size[axis]),
                _ => position.checked_sub(2).filter(|&position| position < size[axis]),
            }
        };
        let (space, time) = (weights(window.cells), weights(window.steps));
        let mut sum = 0;
        for tap in cells([5, 5, 5]) {
            let [Some(x), Some(y), Some(z)] = [0, 1, 2].map(|axis| place(axis, tap[axis])) else { continue };
            let weight: u32 = tap.iter().map(|&tap| u32::from(space[tap])).product();
            for (field, time) in history.iter().zip(time) {
                sum += weight * u32::from(time) * u32::from(field.get([x, y, z]));
            }
        }
        sum
    }

    #[test]
    fn separable_sums_are_those_of_all_taps_one_by_one() {
        for size in [[37, 9, 5], [3, 70, 34], [1, 2, 1]] {
            let history = random_history(size);
            for (window, edges) in
                [((2, 2), Edges::Open), ((2, 2), Edges::Wrap), ((1, 2), Edges::Open), ((2, 0), Edges::Wrap)]
            {
                let window = SmoothingWindow::new(window.0, window.1).unwrap();
                let mut sums = Grid3::filled(size, 0);
                smooth(&history.each_ref(), window, edges, &mut sums);
                for cell in cells(size) {
                    let wanted = direct(&history, window, edges, cell);
                    assert_eq!(u32::from(sums[cell]), wanted, "{cell:?} of {size:?}, {window:?}, {edges:?}");
                }
            }
        }
    }

    #[test]
    fn deep_in_cloud_the_sum_is_full() {
        let mut field = BitField::new([9, 9, 9]);
        field.fill_with(|_| true);
        for (cells, steps, full) in [(2, 2, 6561), (0, 0, 1), (1, 2, 576), (2, 1, 2916)] {
            let window = SmoothingWindow::new(cells, steps).unwrap();
            assert_eq!(window.full(), full, "{window:?}");
            let mut sums = Grid3::filled([9, 9, 9], 0);
            smooth(&[&field; TAPS], window, Edges::Open, &mut sums);
            assert_eq!(sums[[4, 4, 4]], full, "{window:?}");
        }
    }

    #[test]
    fn a_window_beyond_sixteen_bits_is_refused() {
        let text = SmoothingWindow::new(3, 2).unwrap_err().to_string();
        assert_eq!(text, "reach of the smoothing = 3 cells is outside 0 to 2 cells");
    }
}

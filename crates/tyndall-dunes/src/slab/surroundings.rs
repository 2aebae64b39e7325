//! Mean height of the surroundings of each cell: the wind is faster where the bed stands higher than that.

use rayon::prelude::*;

use crate::edges::Edges;
use crate::lattice::Lattice;

/// Side of the square around a cell over which heights are averaged (cells), or the bed's side where that is less.
pub const SURROUNDINGS_CELLS: usize = 64;

/// Mean heights by two passes of running sums; integers, so no order of adding matters.
pub(super) fn mean_heights(lattice: Lattice, edges: Edges, heights: &[i32], means: &mut [i32]) {
    let (nx, ny) = (lattice.nx(), lattice.ny());
    let mut rows = vec![0; heights.len()];
    rows.par_chunks_mut(nx).zip(heights.par_chunks(nx)).for_each(|(out, row)| {
        running_mean(edges, nx, |x| row[x], |x, mean| out[x] = mean);
    });
    // Columns, a stripe of them at a time, each stripe on its own copy so that threads share nothing.
    let stripe = 64.min(nx);
    let stripes: Vec<Vec<i32>> = (0..nx / stripe)
        .into_par_iter()
        .map(|index| {
            let mut out = vec![0; stripe * ny];
            for x in 0..stripe {
                let column = index * stripe + x;
                running_mean(edges, ny, |y| rows[y * nx + column], |y, mean| out[y * stripe + x] = mean);
            }
            out
        })
        .collect();
    means.par_chunks_mut(nx).enumerate().for_each(|(y, row)| {
        for (row, stripe_rows) in row.chunks_exact_mut(stripe).zip(&stripes) {
            row.copy_from_slice(&stripe_rows[y * stripe..][..stripe]);
        }
    });
}

/// Means over the window around each of `count` values, rounded down.
fn running_mean(edges: Edges, count: usize, value: impl Fn(usize) -> i32, mut put: impl FnMut(usize, i32)) {
    let window = SURROUNDINGS_CELLS.min(count) as isize;
    let last = count as isize - 1;
    let at = |index: isize| match edges {
        Edges::Periodic => value((index & last).cast_unsigned()),
        Edges::Open => value(index.clamp(0, last).cast_unsigned()),
    };
    let mut sum: i32 = (-window / 2..window / 2).map(at).sum();
    for index in 0..count as isize {
        put(index.cast_unsigned(), sum >> window.ilog2());
        sum += at(index + window / 2) - at(index - window / 2);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hash::cell_word;

    #[test]
    fn means_are_those_of_the_square_around() {
        let lattice = Lattice::new([128, 64]).unwrap();
        let heights: Vec<i32> = (0..128 * 64).map(|cell| (cell_word(1, cell) >> 20) as i32).collect();
        let mut means = vec![0; heights.len()];
        for edges in [Edges::Periodic, Edges::Open] {
            mean_heights(lattice, edges, &heights, &mut means);
            for (x, y) in [(0, 0), (5, 60), (127, 31)] {
                let at = |x: i32, y: i32| match edges {
                    Edges::Periodic => heights[lattice.index(x, y)],
                    Edges::Open => heights[lattice.index(x.clamp(0, 127), y.clamp(0, 63))],
                };
                let row = |y: i32| (x - 32..x + 32).map(|x| at(x, y)).sum::<i32>() >> 6;
                let expected = (y - 32..y + 32).map(row).sum::<i32>() >> 6;
                assert_eq!(means[lattice.index(x, y)], expected, "({x}, {y}), {edges:?}");
            }
        }
    }
}

//! Sums and maxima along a direction, by passes of doubling reach: cell k of a line is met in log2(k) passes.

use rayon::prelude::*;

use crate::edges::Edges;

/// Values of a map (whose cells are 1 wide) shifted: at each cell those of the place `shift` cells further on, by bilinear
/// interpolation; `outside` beyond open edges.
pub(super) fn shifted<const N: usize>(
    values: &[[f32; N]],
    [nx, ny]: [usize; 2],
    edges: Edges,
    shift: [f64; 2],
    outside: [f32; N],
) -> Vec<[f32; N]> {
    let whole = shift.map(f64::floor);
    let [fx, fy] = [0, 1].map(|axis| (shift[axis] - whole[axis]) as f32);
    let [sx, sy] = whole.map(|part| part as isize);
    let at = |x: isize, count: usize| -> Option<usize> {
        let count = count.cast_signed();
        match edges {
            Edges::Periodic => Some(x.rem_euclid(count).cast_unsigned()),
            Edges::Open => (0..count).contains(&x).then(|| x.cast_unsigned()),
        }
    };
    let columns: Vec<Option<usize>> = (0..=nx.cast_signed()).map(|x| at(x + sx, nx)).collect();
    let mut result = vec![outside; values.len()];
    result.par_chunks_mut(nx).enumerate().for_each(|(y, row)| {
        let rows = [0, 1].map(|next| at(y.cast_signed() + sy + next, ny));
        let value = |row: Option<usize>, column: Option<usize>| match (row, column) {
            (Some(row), Some(column)) => values[row * nx + column],
            _ => outside,
        };
        for (x, result) in row.iter_mut().enumerate() {
            let [low, high] = rows.map(|row| mix(value(row, columns[x]), value(row, columns[x + 1]), fx));
            *result = mix(low, high, fy);
        }
    });
    result
}

fn mix<const N: usize>(a: [f32; N], b: [f32; N], share: f32) -> [f32; N] {
    std::array::from_fn(|part| a[part] + share * (b[part] - a[part]))
}

/// For each cell the sum over k = 0, 1, .. 2^passes - 1 of what its source k cells away in a direction has become on its way:
/// `carried(values, k)` is linear in the values, and `carried` over k and then l cells is that over k + l.
pub(super) fn carried_sum<const N: usize>(
    source: Vec<[f32; N]>,
    (size, edges): ([usize; 2], Edges),
    direction: [f64; 2],
    passes: u32,
    carried: impl Fn([f32; N], f64) -> [f32; N] + Sync,
) -> Vec<[f32; N]> {
    let mut sum = source;
    for pass in 0..passes {
        let cells = f64::from(1_u32 << pass);
        let arrived = shifted(&sum, size, edges, direction.map(|part| part * cells), [0.0; N]);
        sum.par_iter_mut().zip(arrived).for_each(|(sum, arrived)| {
            let arrived = carried(arrived, cells);
            for (sum, arrived) in sum.iter_mut().zip(arrived) {
                *sum += arrived;
            }
        });
    }
    sum
}

/// For each cell the highest line that starts from the heights 1, 2, .. 2^passes cells away in a direction and falls by `fall` a
/// cell on its way here.
pub(super) fn highest_line(
    heights: &[f32],
    (size, edges): ([usize; 2], Edges),
    direction: [f64; 2],
    passes: u32,
    fall: f64,
) -> Vec<f32> {
    let heights: Vec<[f32; 1]> = heights.iter().map(|&height| [height]).collect();
    let fallen = |line: Vec<[f32; 1]>, cells: f64| -> Vec<[f32; 1]> {
        line.into_par_iter().map(|[height]| [height - (fall * cells) as f32]).collect()
    };
    let mut line = fallen(shifted(&heights, size, edges, direction, [LOWEST]), 1.0);
    for pass in 0..passes {
        let cells = f64::from(1_u32 << pass);
        let far = fallen(shifted(&line, size, edges, direction.map(|part| part * cells), [LOWEST]), cells);
        line.par_iter_mut().zip(far).for_each(|(line, far)| line[0] = line[0].max(far[0]));
    }
    line.into_iter().map(|[height]| height).collect()
}

/// Lower than any bed (cells), and still a number that may be interpolated.
const LOWEST: f32 = -1e6;

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [usize; 2] = [64, 32];

    fn one_at([x, y]: [usize; 2]) -> Vec<f32> {
        (0..SIZE[0] * SIZE[1]).map(|cell| if cell == y * SIZE[0] + x { 1.0 } else { 0.0 }).collect()
    }

    #[test]
    fn passes_sum_the_geometric_series_of_what_comes_from_each_cell() {
        let source = one_at([10, 5]).into_iter().map(|value| [value]).collect();
        let keep = 0.9_f64;
        let carried = |[value]: [f32; 1], cells: f64| [value * keep.powf(cells) as f32];
        let sum = carried_sum(source, (SIZE, Edges::Periodic), [-1.0, 0.0], 5, carried);
        for far in 0..48_i32 {
            let found = f64::from(sum[5 * SIZE[0] + (10 + far.cast_unsigned() as usize) % SIZE[0]][0]);
            let expected = if far < 32 { keep.powi(far) } else { 0.0 };
            assert!((found - expected).abs() < 1e-6, "{far} cells on: {found} of {expected}");
        }
        let open = carried_sum(
            one_at([10, 5]).into_iter().map(|value| [value]).collect(),
            (SIZE, Edges::Open),
            [1.0, 0.0],
            5,
            carried,
        );
        assert!(open[5 * SIZE[0] + 63][0].abs() < 1e-9, "nothing comes back over an open edge");
        assert!((open[5 * SIZE[0]][0] - 0.9_f32.powi(10)).abs() < 1e-6, "what was there goes out");
    }

    #[test]
    fn a_carried_sum_keeps_what_a_slanting_direction_spreads() {
        let source: Vec<[f32; 1]> = one_at([30, 15]).into_iter().map(|value| [value]).collect();
        let direction = 0.4_f64.sin_cos();
        let sum = carried_sum(source, (SIZE, Edges::Periodic), [-direction.1, -direction.0], 4, |value, _| value);
        let total: f64 = sum.iter().map(|[value]| f64::from(*value)).sum();
        assert!((total - 16.0).abs() < 1e-3, "sixteen cells of one: {total}");
    }

    #[test]
    fn the_line_from_a_post_falls_evenly_and_is_not_seen_at_the_post() {
        let line = highest_line(&one_at([20, 7]), (SIZE, Edges::Periodic), [-1.0, 0.0], 5, 0.1);
        for far in 1..10_usize {
            let found = line[7 * SIZE[0] + 20 + far];
            assert!((found - (1.0 - 0.1 * far as f32)).abs() < 1e-5, "{far} cells on: {found}");
        }
        assert!(line[7 * SIZE[0] + 20] < 0.0, "at the post itself: {}", line[7 * SIZE[0] + 20]);
    }
}

//! How far a ray may jump: for each block of cells the distance to the next cloud.

use tyndall_clouds::Edges;
use tyndall_core::grid::Grid3;

/// Side of a block (cells).
pub(super) const BLOCK_CELLS: usize = 2;

/// Largest distance that is told (blocks); a ray that has come so far asks again.
const MOST_BLOCKS: u8 = 60;

/// For each block how many cells, along each axis, a ray may go on from anywhere in it without meeting cloud; 0 where there
/// may be some. Interpolation between cells' centres counts as cloud.
pub(super) fn skip_cells(extinction: &Grid3<f32>, edges: Edges) -> Grid3<u8> {
    let size = extinction.size();
    let mut blocks = blocks_with_cloud(extinction, edges);
    let wraps = edges == Edges::Wrap;
    // A wrapped grid that is no multiple of the block has a thinner one at its edge.
    let thin = wraps && size[..2].iter().any(|count| count % BLOCK_CELLS != 0);
    for axis in 0..3 {
        nearest_along(&mut blocks, axis, wraps && axis < 2);
    }
    let cells = |blocks: u8| {
        let clear = usize::from(blocks.saturating_sub(1)) * BLOCK_CELLS;
        u8::try_from(clear.saturating_sub(if thin { BLOCK_CELLS - 1 } else { 0 })).unwrap_or(u8::MAX)
    };
    blocks.cells_mut().iter_mut().for_each(|distance| *distance = cells(*distance));
    blocks
}

/// 0 for blocks that cloud reaches into, and the largest distance for others.
fn blocks_with_cloud(extinction: &Grid3<f32>, edges: Edges) -> Grid3<u8> {
    let size = extinction.size();
    let count = size.map(|cells| cells.div_ceil(BLOCK_CELLS));
    let mut blocks = Grid3::filled(count, MOST_BLOCKS);
    // The blocks of a cell and of its neighbours on both sides.
    let reached = |axis: usize, cell: usize| {
        let (last, wraps) = (size[axis] - 1, edges == Edges::Wrap && axis < 2);
        let before = cell.checked_sub(1).unwrap_or(if wraps { last } else { 0 });
        let after = if cell < last {
            cell + 1
        } else if wraps {
            0
        } else {
            last
        };
        [before / BLOCK_CELLS, cell / BLOCK_CELLS, after / BLOCK_CELLS]
    };
    for (index, _) in extinction.cells().iter().enumerate().filter(|(_, value)| **value > 0.0) {
        let cell = [index % size[0], index / size[0] % size[1], index / (size[0] * size[1])];
        for z in reached(2, cell[2]) {
            for y in reached(1, cell[1]) {
                for x in reached(0, cell[0]) {
                    blocks[[x, y, z]] = 0;
                }
            }
        }
    }
    blocks
}

/// The Chebyshev distance one axis further: the least over the line of the larger of the distances along and across it.
fn nearest_along(blocks: &mut Grid3<u8>, axis: usize, wraps: bool) {
    let size = blocks.size();
    let stride = [1, size[0], size[0] * size[1]][axis];
    let count = size[axis];
    let mut line = vec![0_u8; count];
    let firsts = (0..size.iter().product()).filter(|index| (index / stride).is_multiple_of(count));
    for first in firsts.collect::<Vec<usize>>() {
        for (place, value) in line.iter_mut().enumerate() {
            *value = blocks.cells()[first + place * stride];
        }
        for place in 0..count {
            blocks.cells_mut()[first + place * stride] = nearest_of_line(&line, place, wraps);
        }
    }
}

fn nearest_of_line(line: &[u8], place: usize, wraps: bool) -> u8 {
    let count = line.len();
    let mut nearest = line[place];
    for distance in 1..=MOST_BLOCKS {
        if distance >= nearest {
            break;
        }
        let step = usize::from(distance);
        let (before, after) = if wraps {
            (Some((place + count * step - step) % count), Some((place + step) % count))
        } else {
            (place.checked_sub(step), Some(place + step).filter(|after| *after < count))
        };
        for other in [before, after].into_iter().flatten() {
            nearest = nearest.min(line[other].max(distance));
        }
    }
    nearest
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether any cell within a jump's reach of any cell of its block has cloud.
    fn jumps_over_cloud(extinction: &Grid3<f32>, edges: Edges) -> Option<[usize; 3]> {
        let size = extinction.size();
        let jumps = skip_cells(extinction, edges);
        let cell_of = |i: usize| [i % size[0], i / size[0] % size[1], i / (size[0] * size[1])];
        let clouds: Vec<_> =
            (0..extinction.cells().len()).filter(|i| extinction.cells()[*i] > 0.0).map(cell_of).collect();
        let apart = |axis: usize, a: usize, b: usize| {
            let direct = a.abs_diff(b);
            if edges == Edges::Wrap && axis < 2 { direct.min(size[axis] - direct) } else { direct }
        };
        (0..extinction.cells().len()).map(cell_of).find(|cell| {
            let jump = usize::from(jumps[cell.map(|place| place / BLOCK_CELLS)]);
            // Interpolation reaches one cell further.
            jump > 0 && clouds.iter().any(|cloud| (0..3).all(|axis| apart(axis, cell[axis], cloud[axis]) <= jump))
        })
    }

    #[test]
    fn no_jump_passes_over_cloud_in_grids_of_any_size() {
        for (size, clouds) in [
            ([32, 24, 16], vec![[3, 3, 3], [20, 11, 9]]),
            ([33, 27, 10], vec![[0, 13, 9], [32, 0, 0]]),
            ([70, 9, 5], vec![[1, 4, 2]]),
        ] {
            for edges in [Edges::Open, Edges::Wrap] {
                let mut extinction = Grid3::filled(size, 0.0);
                for cloud in &clouds {
                    extinction[*cloud] = 0.5;
                }
                assert_eq!(jumps_over_cloud(&extinction, edges), None, "{size:?}, {edges:?}");
                assert!(skip_cells(&extinction, edges).cells().iter().any(|jump| *jump > 0), "{size:?}: some jump");
            }
        }
    }

    #[test]
    fn an_empty_sky_is_jumped_over_and_a_full_one_is_not() {
        let empty = skip_cells(&Grid3::filled([20, 20, 8], 0.0), Edges::Wrap);
        assert!(empty.cells().iter().all(|jump| usize::from(*jump) == (usize::from(MOST_BLOCKS) - 1) * BLOCK_CELLS));
        let full = skip_cells(&Grid3::filled([20, 20, 8], 0.1), Edges::Open);
        assert!(full.cells().iter().all(|jump| *jump == 0), "cloud everywhere");
    }
}

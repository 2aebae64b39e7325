//! How large a grid may be.

use crate::CloudError;

/// Most cells along x or y.
pub const MAX_SIDE_CELLS: usize = 8192;
/// Most cells along the height.
pub const MAX_HEIGHT_CELLS: usize = 1024;
/// Most cells in all: columns are numbered by 32 bits and memory is finite.
pub const MAX_CELLS: usize = 1 << 31;
/// Most cells along any axis of a grid made of balls: what a 3-D texture takes.
pub const MAX_BALL_SIDE_CELLS: usize = 2048;
/// Most cells in all of a grid made of balls.
pub const MAX_BALL_CELLS: usize = 1 << 25;

/// `size` = [nx, ny, nz] when the automaton takes it.
///
/// # Errors
/// [`CloudError::GridSize`] for a grid without cells or beyond the limits above.
pub fn check_size(size: [usize; 3]) -> Result<[usize; 3], CloudError> {
    let limits = [MAX_SIDE_CELLS, MAX_SIDE_CELLS, MAX_HEIGHT_CELLS];
    let within = size.iter().zip(limits).all(|(&count, limit)| (1..=limit).contains(&count));
    // The product cannot overflow once each factor is within its limit.
    if within && size.iter().product::<usize>() <= MAX_CELLS { Ok(size) } else { Err(CloudError::GridSize { size }) }
}

/// All cells of a grid in the order of files: x fastest, then y, then z.
pub(crate) fn cells([nx, ny, nz]: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
    let row = move |y, z| (0..nx).map(move |x| [x, y, z]);
    (0..nz).flat_map(move |z| (0..ny).flat_map(move |y| row(y, z)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grids_without_cells_or_beyond_the_limits_are_refused_with_the_limits() {
        assert_eq!(check_size([1024, 1024, 64]), Ok([1024, 1024, 64]), "asked for by the design");
        for size in [[0, 4, 4], [4, 4, 0], [8193, 1, 1], [1, 1, 1025], [8192, 8192, 64]] {
            let text = check_size(size).unwrap_err().to_string();
            assert!(text.contains("8192") && text.contains(&size[0].to_string()), "{size:?}: {text}");
        }
    }
}

//! How much of the sky a bed sees.

use rayon::prelude::*;

use crate::DuneError;
use crate::edges::Edges;
use crate::error::check_value;
use crate::horizon::HorizonMap;
use crate::measure::HeightGrid;

/// Share of the sky over each cell, from horizons in `azimuths` directions, of what an endless slope like the cell's would
/// leave of it.
///
/// # Errors
/// As for [`HorizonMap::new`].
pub fn openness(bed: &HeightGrid, azimuths: usize, edges: Edges) -> Result<Vec<f32>, DuneError> {
    let horizons = HorizonMap::new(bed, azimuths, edges)?;
    let [nx, _] = bed.size();
    let mut open = vec![0.0; bed.heights().len()];
    open.par_chunks_mut(nx).enumerate().for_each(|(y, row)| {
        for ((x, open), [gx, gy]) in row.iter_mut().enumerate().zip(bed.row_gradients(y)) {
            let alone = 0.5 + 0.5 / (1.0 + gx * gx + gy * gy).sqrt();
            *open = (horizons.sky_openness(y * nx + x) / alone).clamp(0.0, 1.0) as f32;
        }
    });
    Ok(open)
}

/// [`openness`] of a bed of cells `factor` times as wide, smooth between them: that many times squared as fast, without what is
/// smaller than its cells.
///
/// # Errors
/// As for [`HorizonMap::new`]; [`DuneError::Value`] when the sides are not multiples of `factor`.
pub fn coarse_openness(bed: &HeightGrid, azimuths: usize, edges: Edges, factor: usize) -> Result<Vec<f32>, DuneError> {
    let coarse = coarser(bed, factor)?;
    let open = openness(&coarse, azimuths, edges)?;
    Ok(finer(&open, coarse.size(), edges, factor))
}

/// Means of `factor` x `factor` cells, in lengths of the new cells.
fn coarser(bed: &HeightGrid, factor: usize) -> Result<HeightGrid, DuneError> {
    let [nx, ny] = bed.size();
    let rest = nx % factor.max(1) + ny % factor.max(1);
    check_value("rest of the sides over the cells that become one", rest as f64, " cells", 0.0..=0.0)?;
    let [wide, high] = [nx, ny].map(|side| side / factor.max(1));
    let mut sums = vec![0.0; wide * high];
    for (y, row) in bed.heights().chunks_exact(nx).enumerate() {
        let sums = &mut sums[y / factor * wide..(y / factor + 1) * wide];
        for (sum, cells) in sums.iter_mut().zip(row.chunks_exact(factor)) {
            *sum += cells.iter().sum::<f32>();
        }
    }
    let scale = 1.0 / (factor * factor * factor) as f32;
    let size = [wide, high];
    let found = sums.len();
    let heights = sums.into_iter().map(|sum| sum * scale).collect();
    HeightGrid::new(size, heights).ok_or(DuneError::GridSize { what: "the coarse bed", found, size })
}

/// Values between those of cells `factor` times as wide, linear along both sides.
fn finer(coarse: &[f32], [wide, high]: [usize; 2], edges: Edges, factor: usize) -> Vec<f32> {
    // The two coarse cells beside a fine one, and the second one's share.
    let beside = |at: usize, count: usize| {
        let place = (at as f32 + 0.5) / factor as f32 - 0.5;
        let first = place.floor();
        let index = |cell: isize| match edges {
            Edges::Periodic => cell.rem_euclid(count.cast_signed()).cast_unsigned(),
            Edges::Open => cell.clamp(0, count.cast_signed() - 1).cast_unsigned(),
        };
        (index(first as isize), index(first as isize + 1), place - first)
    };
    let columns: Vec<_> = (0..wide * factor).map(|x| beside(x, wide)).collect();
    let mix = |from: f32, to: f32, share: f32| from + share * (to - from);
    let mut fine = vec![0.0; wide * high * factor * factor];
    fine.par_chunks_mut(wide * factor).enumerate().for_each(|(y, row)| {
        let (south, north, share) = beside(y, high);
        let coarse = |x: usize| mix(coarse[south * wide + x], coarse[north * wide + x], share);
        let along: Vec<f32> = (0..wide).map(coarse).collect();
        for (value, &(west, east, share)) in row.iter_mut().zip(&columns) {
            *value = mix(along[west], along[east], share);
        }
    });
    fine
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hills of 32 cells, 5 cells high.
    fn hills() -> HeightGrid {
        let wave = |at: u32| (std::f32::consts::TAU * at as f32 / 32.0).sin();
        let height = |cell: u32| 2.5 * (1.0 + wave(cell % 64) * wave(cell / 64));
        HeightGrid::new([64, 64], (0..64 * 64).map(height).collect()).unwrap()
    }

    #[test]
    fn level_ground_and_endless_slopes_see_all_that_they_can() {
        let level = HeightGrid::new([16, 16], vec![1.0; 256]).unwrap();
        for open in openness(&level, 16, Edges::Periodic).unwrap() {
            assert!((open - 1.0).abs() < 1e-6, "level: {open}");
        }
        for open in coarse_openness(&level, 16, Edges::Open, 4).unwrap() {
            assert!((open - 1.0).abs() < 1e-6, "coarse: {open}");
        }
    }

    #[test]
    fn a_coarse_bed_sees_nearly_as_much_of_the_sky() {
        let bed = hills();
        for edges in [Edges::Periodic, Edges::Open] {
            let exact = openness(&bed, 16, edges).unwrap();
            let coarse = coarse_openness(&bed, 16, edges, 4).unwrap();
            let off: f32 = exact.iter().zip(&coarse).map(|(exact, coarse)| (exact - coarse).abs()).sum();
            let mean = off / exact.len() as f32;
            // The hills take up to a third of the sky.
            let least = exact.iter().fold(1.0_f32, |least, &open| least.min(open));
            assert!(least < 0.9 && mean < 0.02, "{edges:?}: least {least}, mean error {mean}");
        }
    }

    #[test]
    fn sides_that_do_not_divide_are_refused() {
        let message = coarse_openness(&hills(), 16, Edges::Open, 5).unwrap_err().to_string();
        assert!(message.contains("= 8 cells"), "{message}");
    }
}

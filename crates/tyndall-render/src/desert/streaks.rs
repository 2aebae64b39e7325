//! The tile of streaks that blowing sand gathers in: noise of several sizes, 1 on average, without seams.

use tyndall_dunes::hash::cell_word;

/// Texels of a side.
pub(super) const STREAK_TEXELS: usize = TEXELS as usize;
const TEXELS: u32 = 256;

/// Lattices of noise: cells along a side, and how much each adds.
const OCTAVES: [(u32, f32); 6] = [(4, 0.6), (8, 0.5), (16, 0.45), (32, 0.4), (64, 0.3), (128, 0.2)];

/// Contrast: natural logarithms from a common streak to a strong one.
const CONTRAST: f32 = 2.2;

/// The tile, row by row: exponentials of noise, as gusts are, divided by their mean.
pub(super) fn streak_tile() -> Vec<f32> {
    let at = |index: u32| {
        let place = [index % TEXELS, index / TEXELS];
        let sum: f32 = (0..).zip(OCTAVES).map(|(key, (cells, share))| share * noise(place, cells, key)).sum();
        (CONTRAST * sum).exp()
    };
    let tile: Vec<f32> = (0..TEXELS * TEXELS).map(at).collect();
    // Row by row, for a long sum of f32 loses what is small.
    let mean =
        tile.chunks(STREAK_TEXELS).map(|row| row.iter().sum::<f32>() / TEXELS as f32).sum::<f32>() / TEXELS as f32;
    tile.into_iter().map(|value| value / mean).collect()
}

/// Smooth noise, -1 to 1, at the middle of a texel between the corners of a lattice that repeats after the tile.
fn noise(texel: [u32; 2], cells: u32, key: u32) -> f32 {
    // In halves of texels.
    let [x, y] = texel.map(|at| (2 * at + 1) * cells);
    let [column, row] = [x, y].map(|at| at / (2 * TEXELS));
    let corner = |dx: u32, dy: u32| {
        let word = cell_word(0x51e_a45 + key, (row + dy) % cells * cells + (column + dx) % cells);
        (word >> 8) as f32 / 8_388_608.0 - 1.0
    };
    let [fx, fy] = [x, y].map(|at| {
        let share = (at % (2 * TEXELS)) as f32 / (2 * TEXELS) as f32;
        share * share * (3.0 - 2.0 * share)
    });
    let mix = |a: f32, b: f32, share: f32| a + share * (b - a);
    mix(mix(corner(0, 0), corner(1, 0), fx), mix(corner(0, 1), corner(1, 1), fx), fy)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streaks_add_no_sand_on_average_and_repeat_without_seams() {
        let tile = streak_tile();
        let mean = tile.iter().map(|&value| f64::from(value)).sum::<f64>() / tile.len() as f64;
        assert!((mean - 1.0).abs() < 1e-5, "mean {mean}");
        assert!(tile.iter().all(|value| *value > 0.0 && *value < 30.0), "between 0 and 30");
        let row = |y: usize| (0..STREAK_TEXELS).map(move |x| y * STREAK_TEXELS + x);
        let step = |a: usize, b: usize| {
            let sum: f32 = row(a).zip(row(b)).map(|(a, b)| (tile[a].ln() - tile[b].ln()).abs()).sum();
            sum / STREAK_TEXELS as f32
        };
        let (seam, within) = (step(STREAK_TEXELS - 1, 0), step(100, 101));
        assert!(seam < 2.0 * within, "from the last row to the first {seam}, within the tile {within}");
    }
}

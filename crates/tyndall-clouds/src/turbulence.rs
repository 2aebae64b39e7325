//! Turbulence finer than a cell: what turns the smooth edge of a grid of cells into the billows of a cumulus.
//!
//! The share of cloud in a cell, 0 to 1, is read as a probability: a place has cloud where noise is below the share. Noise
//! that takes every value of 0 to 1 equally often cuts just as much away as it adds, so the mean density stays what the
//! automaton made it, in every cell and at every distance: each mip level of the [`Billows`] is made uniform again.
//! [`eroded_share`] is exact about it for soft edges too.
//!
//! The noise is that of Worley, "A cellular texture basis function", SIGGRAPH 1996: distances to scattered points, round
//! lobes with sharp creases between them, in octaves. One tile costs 0.1 s and repeats without a seam.

use rayon::prelude::*;
use tyndall_core::rng::CellRng;

/// Side of the tile (texels).
pub const BILLOWS_SIDE: usize = 128;
/// Mip levels, the last one of 8 texels: coarser ones would hold no lobe any more.
pub const BILLOWS_LEVELS: usize = 5;
/// Lobes of the coarsest octave along a side of the tile.
const LOBES: usize = 4;
/// Octaves, each of half the size, and how much less each counts.
const OCTAVES: usize = 4;
const GAIN: f32 = 0.55;
/// Steps of the histogram that makes noise uniform.
const BINS: usize = 1 << 14;

/// A tile of noise, uniform over 0 to 255, and its mip levels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Billows {
    /// Cubes of [`BILLOWS_SIDE`] texels and of half the side each time, x fastest.
    pub levels: Vec<Vec<u8>>,
}

impl Billows {
    /// Makes the tile.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        let mut noise = octaves(&lobes(seed), BILLOWS_SIDE);
        let mut levels = vec![uniform(&noise)];
        for level in 1..BILLOWS_LEVELS {
            noise = halved(&noise, BILLOWS_SIDE >> level);
            levels.push(uniform(&noise));
        }
        Self { levels }
    }
}

/// Share of cloud at a place where noise has the value `noise`, of a `share` that is the mean over all of them.
///
/// `softness` 1 leaves the share as it is, 0 makes it cloud or none; in between an edge is that much of the share's range
/// wide. For uniform noise the mean of the result is the share. All of 0 to 1, softness above 0.
#[must_use]
pub fn eroded_share(share: f64, noise: f64, softness: f64) -> f64 {
    let reach = 1.0 - softness;
    ((eroded_level(share, softness) - noise * reach) / softness).clamp(0.0, 1.0)
}

/// Level at which noise of 0 to `1 - softness` has to be cut for the mean to be the share.
fn eroded_level(share: f64, softness: f64) -> f64 {
    let reach = 1.0 - softness;
    let (wide, narrow) = (softness.max(reach), softness.min(reach));
    let near = share.min(1.0 - share);
    // Towards no cloud and full cloud a part of the ramp is cut off, and the mean is a parabola.
    let level =
        if near < 0.5 * narrow / wide { (2.0 * softness * reach * near).sqrt() } else { 0.5 + (near - 0.5) * wide };
    if share > 0.5 { 1.0 - level } else { level }
}

/// Distance to the nearest of scattered points, one in each of [`LOBES`]^3 cubes, on the finest lattice.
fn lobes(seed: u64) -> Vec<f32> {
    let cube = BILLOWS_SIDE / LOBES;
    let rng = CellRng::new(seed);
    let points: Vec<[f32; 3]> = (0..LOBES.pow(3))
        .map(|index| {
            let corner = [index % LOBES, index / LOBES % LOBES, index / LOBES.pow(2)];
            let words = rng.words(0, index as u64, 0);
            [0, 1, 2].map(|axis| {
                let share = (words[axis] >> 8) as f32 / 16_777_216.0;
                (corner[axis] as f32 + share) * cube as f32
            })
        })
        .collect();
    let mut distances = vec![0.0; BILLOWS_SIDE.pow(3)];
    distances.par_chunks_exact_mut(BILLOWS_SIDE).enumerate().for_each(|(row, distances)| {
        let [y, z] = [row % BILLOWS_SIDE, row / BILLOWS_SIDE];
        for (lobe, texels) in distances.chunks_exact_mut(cube).enumerate() {
            nearest(&points, [lobe, y / cube, z / cube], [y as f32 + 0.5, z as f32 + 0.5], texels);
        }
    });
    distances
}

/// Distances in texels, of texels of a row within one cube, to the points of it and of those around it, over the cube's side.
fn nearest(points: &[[f32; 3]], cube: [usize; 3], [y, z]: [f32; 2], texels: &mut [f32]) {
    let side = texels.len() as f32;
    let tile = BILLOWS_SIDE as f32;
    texels.fill(f32::MAX);
    for index in 0..27_usize {
        let other = [index % 3, index / 3 % 3, index / 9];
        let place = [0, 1, 2].map(|axis| (cube[axis] + other[axis] + LOBES - 1) % LOBES);
        let wrap = [0, 1, 2].map(|axis| match (cube[axis], other[axis]) {
            (0, 0) => -tile,
            (last, 2) if last == LOBES - 1 => tile,
            _ => 0.0,
        });
        let point = points[(place[2] * LOBES + place[1]) * LOBES + place[0]];
        let across = (point[1] + wrap[1] - y).powi(2) + (point[2] + wrap[2] - z).powi(2);
        let first = cube[0] as f32 * side + 0.5 - point[0] - wrap[0];
        for (x, distance2) in texels.iter_mut().enumerate() {
            let along = first + x as f32;
            *distance2 = distance2.min(along * along + across);
        }
    }
    for distance2 in texels {
        *distance2 = distance2.sqrt() / side;
    }
}

/// The sum of octaves: each is the same tile, finer, moved and turned so that lobes do not lie in each other.
fn octaves(lobes: &[f32], side: usize) -> Vec<f32> {
    let at = |[x, y, z]: [usize; 3]| lobes[((z % side) * side + y % side) * side + x % side];
    let mut sum = vec![0.0; side.pow(3)];
    sum.par_chunks_exact_mut(side).enumerate().for_each(|(row, sum)| {
        let [y, z] = [row % side, row / side];
        for (x, sum) in sum.iter_mut().enumerate() {
            let mut place = [x, y, z];
            let mut weight = 1.0;
            for octave in 0..OCTAVES {
                *sum += weight * at(place.map(|part| part << octave));
                place = [place[1] + 37, place[2] + 11, place[0] + 73];
                weight *= GAIN;
            }
        }
    });
    sum
}

/// The mean of 2 x 2 x 2 texels each, for a cube with sides of `side`.
fn halved(noise: &[f32], side: usize) -> Vec<f32> {
    let fine = 2 * side;
    let texel = |index: usize| {
        let [x, y, z] = [index % side, index / side % side, index / (side * side)].map(|part| 2 * part);
        let corner = |i: usize| noise[((z + i / 4) * fine + y + i / 2 % 2) * fine + x + i % 2];
        (0..8).map(corner).sum::<f32>() / 8.0
    };
    (0..side.pow(3)).into_par_iter().map(texel).collect()
}

/// The share of texels with less, as 0 to 255: every value equally often.
#[expect(clippy::cast_possible_truncation, reason = "bins and shares are within their ranges")]
fn uniform(noise: &[f32]) -> Vec<u8> {
    let (low, high) = noise.iter().fold((f32::MAX, f32::MIN), |(low, high), value| (low.min(*value), high.max(*value)));
    let scale = (BINS as f32 - 0.01) / (high - low).max(f32::MIN_POSITIVE);
    let bin = |value: f32| (((value - low) * scale) as usize).min(BINS - 1);
    let mut counts = vec![0_usize; BINS];
    for value in noise {
        counts[bin(*value)] += 1;
    }
    let mut below = 0;
    let ranks: Vec<u8> = counts
        .iter()
        .map(|count| {
            let middle = below as f64 + 0.5 * *count as f64;
            below += count;
            (256.0 * middle / noise.len() as f64).min(255.0) as u8
        })
        .collect();
    noise.iter().map(|value| ranks[bin(*value)]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uniform_noise_leaves_the_mean_share_as_it_is_however_soft_the_edge() {
        for softness in [0.02, 0.2, 0.5, 0.7, 1.0] {
            for share in [0.0, 0.003, 0.05, 0.3, 0.5, 0.77, 0.96, 1.0] {
                let count = 20_000;
                let noise = |i: i32| (f64::from(i) + 0.5) / f64::from(count);
                let mean = (0..count).map(|i| eroded_share(share, noise(i), softness)).sum::<f64>() / f64::from(count);
                assert!((mean - share).abs() < 1e-4, "softness {softness}: {share} becomes {mean}");
            }
        }
    }

    #[test]
    fn more_cloud_and_less_noise_never_mean_less_cloud() {
        for softness in [0.05, 0.4, 0.9] {
            for step in 0..100 {
                let (low, high) = (f64::from(step) / 100.0, f64::from(step + 1) / 100.0);
                for other in [0.1, 0.5, 0.9] {
                    let rises = eroded_share(high, other, softness) - eroded_share(low, other, softness);
                    let falls = eroded_share(other, low, softness) - eroded_share(other, high, softness);
                    assert!(rises >= -1e-12 && falls >= -1e-12, "softness {softness}, {low}, {other}: {rises} {falls}");
                }
            }
        }
    }

    #[test]
    fn every_mip_level_takes_all_values_equally_often() {
        let billows = Billows::new(1);
        assert_eq!(billows.levels.len(), BILLOWS_LEVELS, "levels");
        for (level, texels) in billows.levels.iter().enumerate() {
            assert_eq!(texels.len(), (BILLOWS_SIDE >> level).pow(3), "level {level}");
            for share in [0.1, 0.25, 0.5, 0.8] {
                let below = texels.iter().filter(|value| f64::from(**value) < 255.0 * share).count();
                let found = below as f64 / texels.len() as f64;
                // A step of 8 bits, and of 512 texels one more.
                assert!((found - share).abs() < 2.0 / 256.0, "level {level}: {found} are below {share}");
            }
        }
    }

    #[test]
    fn the_tile_continues_at_its_sides_and_texels_do_not_jump() {
        let billows = Billows::new(3);
        let side = BILLOWS_SIDE;
        let at = |x: usize, y: usize, z: usize| f64::from(billows.levels[0][(z * side + y) * side + x]);
        let jump = |x: usize, next: usize| {
            let rows = (0..side).step_by(7).flat_map(|y| (0..side).step_by(5).map(move |z| (y, z)));
            let squares: Vec<f64> = rows.map(|(y, z)| (at(next, y, z) - at(x, y, z)).powi(2)).collect();
            (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
        };
        let inside = jump(50, 51);
        assert!(inside < 40.0, "neighbours are alike: {inside}");
        assert!(jump(side - 1, 0) < 1.3 * inside, "so are those across the seam: {} {inside}", jump(side - 1, 0));
    }
}

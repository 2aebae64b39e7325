//! The tile of ripples: a simulated bed as slopes B and their second moments M, with mip levels. WGSL:
//! `shaders/desert/ripples.wgsl`.
//!
//! The wind blows along +x. Heights of the rule are arbitrary; they are scaled to ripples of index
//! [`TILE_INDEX`](super::gpu_data). A texel of a mip level is the mean of four of the finer one, so that M - B B^T of a
//! level is the covariance of the slopes within its texels (Olano and Baker 2010).

use tyndall_dunes::blur::blur;
use tyndall_dunes::measure::{HeightGrid, mean_wavelength_cells};
use tyndall_dunes::ripples::RippleBed;
use tyndall_dunes::{DuneError, Edges, SandSimulation as _};
use tyndall_scene::RippleParams;

use super::gpu_data::{TILE_INDEX, TileScale};

/// Slopes of a texel: Bx, By, Mxx, Myy, Mxy.
pub type Moments = [f32; 5];

/// The tile's mip levels, the finest first.
#[derive(Clone, Debug, PartialEq)]
pub struct RippleTile {
    /// Moments of each level, x runs fastest.
    pub levels: Vec<Vec<Moments>>,
    /// Mean heights of each level's texels over the tile's mean, as shares of `scale.height`.
    pub heights: Vec<Vec<f32>>,
    /// Its size.
    pub scale: TileScale,
}

impl RippleTile {
    /// Ripples after some steps of the wind.
    ///
    /// # Errors
    /// When a parameter of the bed is outside its range.
    pub fn new(params: &RippleParams, steps: u32) -> Result<Self, DuneError> {
        let mut bed = RippleBed::new(params)?;
        bed.run(steps);
        let side = params.side.cells();
        // The rule's cells are noisy; grains smooth them.
        Ok(Self::of_heights(&blur(&bed.heights_cells(), [side, side], Edges::Periodic, 1), side))
    }

    /// From the heights of a periodic bed, in any unit.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "textures hold less than f32")]
    pub fn of_heights(heights: &[f32], side: usize) -> Self {
        let Some(grid) = HeightGrid::new([side, side], heights.to_vec()) else {
            return Self {
                levels: Vec::new(),
                heights: Vec::new(),
                scale: TileScale { texels: 0, ripples: 1.0, height: 0.0 },
            };
        };
        let wavelength_cells = mean_wavelength_cells(&grid, side / 4);
        // A flat bed has no waves at all.
        let wavelength_cells = if wavelength_cells.is_finite() { wavelength_cells } else { side as f64 };
        // A wave of this rms is 2 sqrt(2) times as high from trough to crest.
        let height_cells = 8_f64.sqrt() * grid.rms_cells();
        let gain = if height_cells > 1e-6 { wavelength_cells / (TILE_INDEX * height_cells) } else { 0.0 };
        let moments = |index: usize| {
            let [x, y] = [index % side, index / side].map(usize::cast_signed);
            let [bx, by] = grid.gradient(x, y).map(|slope| (gain * slope) as f32);
            [bx, by, bx * bx, by * by, bx * by]
        };
        let mean = grid.mean_cells();
        let over = |height: &f32| gain * (f64::from(*height) - mean);
        let highest = heights.iter().map(|height| over(height).abs()).fold(0.0, f64::max);
        let share = |height: &f32| if highest > 0.0 { (over(height) / highest) as f32 } else { 0.0 };
        Self {
            levels: halves((0..side * side).map(moments).collect(), side),
            heights: halves(heights.iter().map(|height| [share(height)]).collect(), side)
                .into_iter()
                .map(Vec::into_flattened)
                .collect(),
            scale: TileScale { texels: side, ripples: side as f64 / wavelength_cells, height: highest },
        }
    }
}

/// Mip levels of a square of a side, the finest first.
fn halves<const PARTS: usize>(finest: Vec<[f32; PARTS]>, side: usize) -> Vec<Vec<[f32; PARTS]>> {
    let mut levels = vec![finest];
    let mut width = side;
    while width > 1 {
        let coarser = levels.last().map(|finer| halve(finer, width));
        levels.extend(coarser);
        width /= 2;
    }
    levels
}

/// The next mip level.
fn halve<const PARTS: usize>(finer: &[[f32; PARTS]], width: usize) -> Vec<[f32; PARTS]> {
    let half = width / 2;
    let mean = |index: usize| {
        let [x, y] = [2 * (index % half), 2 * (index / half)];
        let four = [y * width + x, y * width + x + 1, (y + 1) * width + x, (y + 1) * width + x + 1];
        std::array::from_fn(|part| 0.25 * four.iter().map(|&at| finer[at][part]).sum::<f32>())
    };
    (0..half * half).map(mean).collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use super::*;

    /// Texels of a side.
    const SIDE: usize = 128;

    /// Mean over a level of something made of a texel's moments.
    fn mean(level: &[Moments], of: impl Fn([f64; 5]) -> f64) -> f64 {
        level.iter().map(|texel| of(texel.map(f64::from))).sum::<f64>() / level.len() as f64
    }

    /// Sines of a number of waves along x, of any height.
    #[expect(clippy::cast_possible_truncation, reason = "heights are f32")]
    fn sine(waves: f64) -> RippleTile {
        let height = |index: usize| (7.0 * (TAU * waves * (index % SIDE) as f64 / SIDE as f64).sin()) as f32;
        RippleTile::of_heights(&(0..SIDE * SIDE).map(height).collect::<Vec<_>>(), SIDE)
    }

    fn real() -> RippleTile {
        let params = RippleParams { side: tyndall_dunes::Side::Cells128, ..RippleParams::default() };
        RippleTile::new(&params, 600).expect("the default parameters are valid")
    }

    #[test]
    fn a_sine_has_the_slopes_of_its_closed_form_on_every_level() {
        for waves in [8.0, 16.0] {
            let tile = sine(waves);
            assert!((tile.scale.ripples - waves).abs() < 0.02 * waves, "{waves} waves: {}", tile.scale.ripples);
            let phase = TAU * waves / SIDE as f64;
            // A wave 16 times as long as high is pi / 16 steep; differences over two cells see sin(phase) / phase of it.
            let steepest = PI / TILE_INDEX * (phase.sin() / phase) * (waves / tile.scale.ripples);
            // Levels with four texels of a wave or more, over which squares of a sine have their mean.
            let levels = tile.levels.iter().enumerate();
            for (number, level) in levels.take_while(|(number, _)| f64::from(4 << number) * waves <= SIDE as f64) {
                // The mean of 2^number texels of a sine, relative to the sine.
                let cells = f64::from(1_u32 << number);
                let left = (0.5 * cells * phase).sin() / (cells * (0.5 * phase).sin());
                let (between, within) =
                    (0.5 * (steepest * left).powi(2), 0.5 * steepest * steepest * (1.0 - left * left));
                let found = mean(level, |m| m[0] * m[0]);
                assert!((found - between).abs() < 1e-6, "{waves} waves, level {number}: {found}, not {between}");
                let found = mean(level, |m| m[2] - m[0] * m[0]);
                assert!((found - within).abs() < 1e-6, "{waves} waves, level {number}: spread {found}, not {within}");
                let across = mean(level, |m| m[1].abs() + m[3] + m[4].abs());
                assert!(across < 1e-12, "{waves} waves, level {number}: the sine has slopes across, {across}");
            }
        }
    }

    #[test]
    fn every_level_keeps_mean_slopes_and_their_mean_products() {
        for (name, tile) in [("sine", sine(8.0)), ("ripples", real())] {
            let finest = &tile.levels[0];
            let steepness = mean(finest, |m| m[2] + m[3]);
            assert!(steepness > 1e-3, "{name} are not flat: {steepness}");
            // Each level is rounded to f32 once more.
            let allowed = [steepness.sqrt(), steepness.sqrt(), steepness, steepness, steepness].map(|size| 1e-6 * size);
            for (number, level) in tile.levels.iter().enumerate() {
                for (part, allowed) in allowed.into_iter().enumerate() {
                    let [found, wanted] = [level, finest].map(|level| mean(level, |m| m[part]));
                    assert!(
                        (found - wanted).abs() < allowed,
                        "{name}, level {number}, part {part}: {found}, not {wanted}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_texel_of_any_level_holds_mean_and_covariance_of_the_finest_texels_under_it() {
        let tile = real();
        for (number, level) in tile.levels.iter().enumerate() {
            let (cells, width) = (1 << number, SIDE >> number);
            for (index, texel) in level.iter().enumerate() {
                let [x, y] = [cells * (index % width), cells * (index / width)];
                let under = (0..cells * cells).map(|k| tile.levels[0][(y + k / cells) * SIDE + x + k % cells]);
                let slopes: Vec<[f64; 2]> = under.map(|m| [f64::from(m[0]), f64::from(m[1])]).collect();
                let over = |of: &dyn Fn(&[f64; 2]) -> f64| slopes.iter().map(of).sum::<f64>() / slopes.len() as f64;
                let middle = [over(&|s| s[0]), over(&|s| s[1])];
                let spread = |a: usize, b: usize| over(&|s| (s[a] - middle[a]) * (s[b] - middle[b]));
                let m = texel.map(f64::from);
                let found = [m[0], m[1], m[2] - m[0] * m[0], m[3] - m[1] * m[1], m[4] - m[0] * m[1]];
                let wanted = [middle[0], middle[1], spread(0, 0), spread(1, 1), spread(0, 1)];
                for (found, wanted) in found.iter().zip(wanted) {
                    assert!((found - wanted).abs() < 1e-6, "level {number}, texel {index}: {found}, not {wanted}");
                }
            }
        }
    }

    #[test]
    fn differences_of_heights_are_the_slopes_of_the_tile() {
        for (name, tile) in [("sine", sine(8.0)), ("ripples", real())] {
            let (heights, size) = (&tile.heights[0], tile.scale.height);
            let at = |x: usize, y: usize| size * f64::from(heights[y % SIDE * SIDE + x % SIDE]);
            for (index, texel) in tile.levels[0].iter().enumerate() {
                let [x, y] = [index % SIDE + SIDE, index / SIDE + SIDE];
                let slopes = [at(x + 1, y) - at(x - 1, y), at(x, y + 1) - at(x, y - 1)].map(|rise| 0.5 * rise);
                for (slope, wanted) in slopes.into_iter().zip(*texel) {
                    assert!((slope - f64::from(wanted)).abs() < 1e-5, "{name}, texel {index}: {slope}, not {wanted}");
                }
            }
            let mean = heights.iter().map(|height| f64::from(*height)).sum::<f64>() / heights.len() as f64;
            let highest = heights.iter().fold(0.0_f32, |most, height| most.max(height.abs()));
            assert!(mean.abs() < 1e-6 && (highest - 1.0).abs() < 1e-6, "{name}: mean {mean}, highest {highest}");
        }
    }

    #[test]
    fn the_mean_slope_of_a_tile_is_level_and_ripples_stand_across_the_wind() {
        let tile = real();
        let [top] = tile.levels.last().expect("levels")[..] else { panic!("the last level is one texel") };
        assert!(top[0].abs() < 1e-6 && top[1].abs() < 1e-6, "a bed that repeats rises nowhere: {top:?}");
        assert!(top[2] > 2.0 * top[3], "slopes along the wind {} and across it {}", top[2], top[3]);
    }
}

//! The tile of ripples: a simulated bed as slopes B and their second moments M, with mip levels. WGSL:
//! `shaders/desert/ripples.wgsl`.
//!
//! The wind blows along +x. Heights of the rule are arbitrary; they are scaled to ripples of index
//! [`TILE_INDEX`](super::gpu_data). A texel of a mip level is the mean of four of the finer one, so that M - B B^T of a
//! level is the covariance of the slopes within its texels (Olano and Baker 2010).

use tyndall_dunes::measure::{HeightGrid, mean_wavelength_cells};
use tyndall_dunes::ripples::RippleBed;
use tyndall_dunes::{DuneError, Edges, SandSimulation as _};
use tyndall_scene::RippleParams;

use super::gpu_data::{TILE_INDEX, TileScale};
use super::smooth::blur;

/// Slopes of a texel: Bx, By, Mxx, Myy, Mxy.
pub type Moments = [f32; 5];

/// The tile's mip levels, the finest first.
#[derive(Clone, Debug, PartialEq)]
pub struct RippleTile {
    /// Moments of each level, x runs fastest.
    pub levels: Vec<Vec<Moments>>,
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
            return Self { levels: Vec::new(), scale: TileScale { texels: 0, ripples: 1.0 } };
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
        let mut levels = vec![(0..side * side).map(moments).collect::<Vec<Moments>>()];
        let mut width = side;
        while width > 1 {
            let coarser = levels.last().map(|finer| halve(finer, width));
            levels.extend(coarser);
            width /= 2;
        }
        Self { levels, scale: TileScale { texels: side, ripples: side as f64 / wavelength_cells } }
    }
}

/// The next mip level.
fn halve(finer: &[Moments], width: usize) -> Vec<Moments> {
    let half = width / 2;
    let mean = |index: usize| {
        let [x, y] = [2 * (index % half), 2 * (index / half)];
        let four = [y * width + x, y * width + x + 1, (y + 1) * width + x, (y + 1) * width + x + 1];
        std::array::from_fn(|part| 0.25 * four.iter().map(|&at| finer[at][part]).sum::<f32>())
    };
    (0..half * half).map(mean).collect()
}

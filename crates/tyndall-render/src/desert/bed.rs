//! The bed of the desert as pictures see it: smooth heights, where the sun does not reach, how open the sky is, ripples.
//!
//! Heights between cells are cubic B-splines (WGSL: `shaders/desert/bed.wgsl`), twice smooth, of cells that have lost the
//! steps of single slabs ([`tyndall_dunes::smooth`]).

use tyndall_dunes::DesertSimulation;
use tyndall_dunes::Edges;
use tyndall_dunes::blur::{blur, quick_smooth_bed};
use tyndall_dunes::export::DuneMaps;
use tyndall_dunes::measure::HeightGrid;
use tyndall_dunes::openness::{coarse_openness, openness};
use tyndall_dunes::smooth::repose::at_repose;
use tyndall_dunes::smooth::smooth_bed;

use crate::RenderError;

/// Azimuths of the horizons that the sky's light is asked for.
const SKY_AZIMUTHS: usize = 16;

/// How much wider than the field's the cells are that a quick picture's openness is of, and its azimuths.
const QUICK_CELLS: usize = 4;
const QUICK_AZIMUTHS: usize = 8;

/// What is drawn of a field.
#[derive(Clone, Debug)]
pub struct Bed {
    /// Smooth heights (cells).
    pub heights: HeightGrid,
    /// Side of a cell (m).
    pub cell_m: f64,
    /// What lies beyond the field.
    pub edges: Edges,
    /// Share of the sky that a cell sees of what its slope would see alone.
    pub openness: Vec<f32>,
    /// For each cell: direction of ripples times their height (east, north), their scale, cover of sand.
    pub ripples: Vec<[f32; 4]>,
    /// Where the wind of the next step blows to, anticlockwise from east (deg).
    pub wind_toward_deg: f64,
}

impl Bed {
    /// Of a simulated field.
    ///
    /// # Errors
    /// When the field's numbers are out of range.
    pub fn new(simulation: &DesertSimulation) -> Result<Self, RenderError> {
        Self::made(simulation, false)
    }

    /// The same but for the sky's openness, which is that of a coarser bed: for pictures that are soon followed by others.
    ///
    /// # Errors
    /// As for [`Bed::new`].
    pub fn quick(simulation: &DesertSimulation) -> Result<Self, RenderError> {
        Self::made(simulation, true)
    }

    #[expect(clippy::cast_possible_truncation, reason = "textures hold less than f32")]
    fn made(simulation: &DesertSimulation, is_quick: bool) -> Result<Self, RenderError> {
        let maps = simulation.maps()?;
        let (size, edges, cell_m) = (maps.size, simulation.field().edges(), maps.cell_m);
        let cells: Vec<f32> = maps.height_m.iter().map(|height| (f64::from(*height) / cell_m) as f32).collect();
        let step = simulation.params().dunes.slab_cells as f32;
        let heights = HeightGrid::new(size, cells).expect("a field has as many heights as cells");
        let smooth = if is_quick {
            quick_smooth_bed(&heights, step, edges)
        } else {
            // The planes of brink and foot pull narrow slip faces steeper than sand lies.
            let steepest = simulation.params().dunes.repose_deg.to_radians().tan();
            at_repose(&smooth_bed(&heights, step, edges), &heights, steepest, edges)
        };
        let heights = over_rock(&smooth, &maps);
        let openness = if is_quick {
            coarse_openness(&heights, QUICK_AZIMUTHS, edges, QUICK_CELLS)?
        } else {
            openness(&heights, SKY_AZIMUTHS, edges)?
        };
        Ok(Self {
            openness: blur(&openness, size, edges, 1),
            ripples: ripples(&maps, &heights, edges),
            heights,
            cell_m,
            edges,
            wind_toward_deg: simulation.wind_toward_deg(),
        })
    }

    /// Highest height (m).
    #[must_use]
    pub fn highest_m(&self) -> f64 {
        self.cell_m * f64::from(self.heights.heights().iter().fold(0.0_f32, |high, &height| high.max(height)))
    }

    /// Height (m) and slopes to the east and the north at a place (m) east and north of the scene's origin.
    #[must_use]
    pub fn at(&self, x_m: f64, y_m: f64) -> [f64; 3] {
        let [nx, ny] = self.heights.size();
        let (x, y) = (x_m / self.cell_m + 0.5 * nx as f64 - 0.5, y_m / self.cell_m + 0.5 * ny as f64 - 0.5);
        let (along, along_slope) = (weights(x - x.floor()), slopes(x - x.floor()));
        let (across, across_slope) = (weights(y - y.floor()), slopes(y - y.floor()));
        let mut sum = [0.0; 3];
        for row in 0..4 {
            for column in 0..4 {
                let height = self.cell(x.floor() + column as f64 - 1.0, y.floor() + row as f64 - 1.0);
                sum[0] += across[row] * along[column] * height;
                sum[1] += across[row] * along_slope[column] * height;
                sum[2] += across_slope[row] * along[column] * height;
            }
        }
        let inside = self.inside(x_m, y_m);
        [inside * self.cell_m * sum[0], inside * sum[1], inside * sum[2]]
    }

    #[expect(clippy::cast_possible_truncation, reason = "cells are whole numbers")]
    fn cell(&self, x: f64, y: f64) -> f64 {
        let [nx, ny] = self.heights.size().map(usize::cast_signed);
        let (x, y) = (x as isize, y as isize);
        match self.edges {
            Edges::Periodic => self.heights.at(x, y),
            Edges::Open => self.heights.at(x.clamp(0, nx - 1), y.clamp(0, ny - 1)),
        }
    }

    /// 1 within the field and wherever it repeats; falls to 0 within 8 cells of an open edge.
    fn inside(&self, x_m: f64, y_m: f64) -> f64 {
        let [nx, ny] = self.heights.size();
        let away = |count: usize, at_m: f64| (0.5 * count as f64 - (at_m / self.cell_m).abs()) / 8.0;
        let share = away(nx, x_m).min(away(ny, y_m)).clamp(0.0, 1.0);
        if self.edges == Edges::Periodic { 1.0 } else { share * share * (3.0 - 2.0 * share) }
    }

    /// The same at a cell.
    #[expect(clippy::cast_possible_truncation, reason = "textures hold less than f32")]
    pub(super) fn inside_cell(&self, index: usize) -> f32 {
        let [nx, ny] = self.heights.size();
        let at_m = |at: usize, count: usize| self.cell_m * (at as f64 + 0.5 - 0.5 * count as f64);
        self.inside(at_m(index % nx, nx), at_m(index / nx, ny)) as f32
    }

    /// Mip levels of the heights (m), the finest first; each texel the weighted mean of 4 x 4 finer ones.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "textures hold f32")]
    pub fn height_levels(&self) -> Vec<Vec<f32>> {
        let metres = self.heights.heights().iter().map(|height| height * self.cell_m as f32).collect();
        mip_levels(metres, self.heights.size(), |value, weight| value * weight, |a, b| a + b)
    }
}

/// Mip levels of a map, the finest first: means of 2 x 2.
pub(super) fn mip_levels<T: Copy>(
    finest: Vec<T>,
    size: [usize; 2],
    scale: impl Fn(T, f32) -> T,
    add: impl Fn(T, T) -> T,
) -> Vec<Vec<T>> {
    let mut levels = vec![finest];
    let [mut nx, mut ny] = size;
    while nx > 1 && ny > 1 {
        let Some(finer) = levels.last() else { break };
        let mean = |index: usize| {
            let [x, y] = [2 * (index % (nx / 2)), 2 * (index / (nx / 2))];
            let at = |x: usize, y: usize| scale(finer[y * nx + x], 0.25);
            add(add(at(x, y), at(x + 1, y)), add(at(x, y + 1), at(x + 1, y + 1)))
        };
        let coarser = (0..nx / 2 * (ny / 2)).map(mean).collect();
        levels.push(coarser);
        (nx, ny) = (nx / 2, ny / 2);
    }
    levels
}

/// Weights of the four cells around a place between the two in the middle.
fn weights(t: f64) -> [f64; 4] {
    let u = 1.0 - t;
    [u * u * u, 4.0 + t * t * (3.0 * t - 6.0), 4.0 + u * u * (3.0 * u - 6.0), t * t * t].map(|weight| weight / 6.0)
}

/// Derivatives of the weights.
fn slopes(t: f64) -> [f64; 4] {
    let u = 1.0 - t;
    [-0.5 * u * u, t * (1.5 * t - 2.0), u * (2.0 - 1.5 * u), 0.5 * t * t]
}

/// Heights that are nowhere below the rock: at the foot of a slope the planes beside it would dip under bare ground.
#[expect(clippy::cast_possible_truncation, reason = "textures hold less than f32")]
fn over_rock(heights: &HeightGrid, maps: &DuneMaps) -> HeightGrid {
    let rock = maps.height_m.iter().zip(&maps.sand_m).map(|(height, sand)| (height - sand) / maps.cell_m as f32);
    let over = heights.heights().iter().zip(rock).map(|(height, rock)| height.max(rock)).collect();
    HeightGrid::new(heights.size(), over).expect("as many heights as before")
}

/// Ripples of a field: absent in the lee, where their heights fade over a few cells, and longer where the wind is stronger.
#[expect(clippy::cast_possible_truncation, reason = "textures hold less than f32")]
fn ripples(maps: &DuneMaps, heights: &HeightGrid, edges: Edges) -> Vec<[f32; 4]> {
    let soft =
        |part: &dyn Fn(usize) -> f32| blur(&(0..maps.ripples.len()).map(part).collect::<Vec<_>>(), maps.size, edges, 1);
    let east = soft(&|cell| maps.ripples[cell][0]);
    let north = soft(&|cell| maps.ripples[cell][1]);
    let cover = soft(&|cell| (maps.sand_m[cell] / (0.1 * maps.cell_m as f32)).clamp(0.0, 1.0));
    let (mean, rms) = (heights.mean_cells(), heights.rms_cells().max(1e-3));
    let scale = |cell: usize| 1.0 + 0.2 * ((f64::from(heights.heights()[cell]) - mean) / rms).clamp(-1.5, 1.5);
    (0..maps.ripples.len()).map(|cell| [east[cell], north[cell], scale(cell) as f32, cover[cell]]).collect()
}

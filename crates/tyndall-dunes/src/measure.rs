//! What a bed looks like, in numbers: wavelength, drift, slopes, direction of crests, separate bodies.
//!
//! Grids are heights in cells, x runs fastest, periodic. Nothing here decides anything in a simulation, so it is plain
//! floating point.

mod bodies;
mod crests;
mod slopes;
mod waves;

pub use bodies::{Bodies, bodies};
pub use crests::{Crests, crests, gaussian_blur};
pub use slopes::{WindSlopes, steepest_deg, wind_slopes};
pub use waves::{drift_cells, mean_wavelength_cells, spectrum_along_x};

/// Heights of a bed in cells.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightGrid {
    size: [usize; 2],
    heights: Vec<f32>,
}

impl HeightGrid {
    /// A grid of `size` = [nx, ny], or `None` when the number of heights is not nx * ny or a side is 0.
    #[must_use]
    pub fn new(size: [usize; 2], heights: Vec<f32>) -> Option<Self> {
        (heights.len() == size[0] * size[1] && !heights.is_empty()).then_some(Self { size, heights })
    }

    /// From integers that count `quanta_per_cell` in a cell length.
    #[must_use]
    pub fn from_quanta(size: [usize; 2], quanta: &[i32], quanta_per_cell: i32) -> Option<Self> {
        Self::new(size, quanta.iter().map(|&height| height as f32 / quanta_per_cell as f32).collect())
    }

    /// [nx, ny].
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Heights (cells) in index order.
    #[must_use]
    pub fn heights(&self) -> &[f32] {
        &self.heights
    }

    /// Height at a cell, both coordinates wrapped (cells).
    #[must_use]
    pub fn at(&self, x: isize, y: isize) -> f64 {
        let [nx, ny] = self.size.map(usize::cast_signed);
        let index = y.rem_euclid(ny) * nx + x.rem_euclid(nx);
        f64::from(self.heights[index.cast_unsigned()])
    }

    /// Slopes by central differences at a cell: [along x, along y] (1).
    #[must_use]
    pub fn gradient(&self, x: isize, y: isize) -> [f64; 2] {
        [0.5 * (self.at(x + 1, y) - self.at(x - 1, y)), 0.5 * (self.at(x, y + 1) - self.at(x, y - 1))]
    }

    /// [`HeightGrid::gradient`] of all cells of a row.
    pub(crate) fn row_gradients(&self, y: usize) -> impl Iterator<Item = [f64; 2]> + '_ {
        let [nx, ny] = self.size;
        let row = |y: usize| &self.heights[y * nx..(y + 1) * nx];
        let (below, here, above) = (row((y + ny - 1) % ny), row(y), row((y + 1) % ny));
        let half = |up: f32, down: f32| 0.5 * (f64::from(up) - f64::from(down));
        (0..nx).map(move |x| {
            let [left, right] = [if x == 0 { nx - 1 } else { x - 1 }, if x + 1 == nx { 0 } else { x + 1 }];
            [half(here[right], here[left]), half(above[x], below[x])]
        })
    }

    /// Mean height (cells).
    #[must_use]
    pub fn mean_cells(&self) -> f64 {
        self.heights.iter().map(|&height| f64::from(height)).sum::<f64>() / self.heights.len() as f64
    }

    /// Root mean square of the height over its mean (cells).
    #[must_use]
    pub fn rms_cells(&self) -> f64 {
        let mean = self.mean_cells();
        let square = |&height: &f32| (f64::from(height) - mean).powi(2);
        (self.heights.iter().map(square).sum::<f64>() / self.heights.len() as f64).sqrt()
    }

    /// All cells as [x, y].
    pub(crate) fn cells(&self) -> impl Iterator<Item = [isize; 2]> + use<> {
        let [nx, ny] = self.size.map(usize::cast_signed);
        (0..ny).flat_map(move |y| (0..nx).map(move |x| [x, y]))
    }
}

//! Terrain of any size as bedrock.

use crate::DuneError;
use crate::lattice::Lattice;

/// Heights of another program's terrain (m), x runs fastest, row 0 in the south.
#[derive(Clone, Debug, PartialEq)]
pub struct Terrain {
    /// Samples along x and y.
    pub size: [usize; 2],
    /// Heights (m).
    pub height_m: Vec<f32>,
}

impl Terrain {
    /// Bedrock of a bed (cells), by linear interpolation of the terrain stretched over the whole bed; the lowest height
    /// becomes 0.
    ///
    /// # Errors
    /// [`DuneError::GridSize`] when the terrain has another number of heights than its size says; [`DuneError::Height`] at
    /// the first height that is no number; [`DuneError::Value`] when `cell_m` is not 0.01 to 100 m.
    pub fn bedrock_cells(&self, lattice: Lattice, cell_m: f64) -> Result<Vec<f32>, DuneError> {
        crate::error::check_value("width of a cell", cell_m, " m", 0.01..=100.0)?;
        let [nx, ny] = self.size;
        if self.height_m.is_empty() || self.height_m.len() != nx * ny {
            return Err(DuneError::GridSize { what: "the terrain", found: self.height_m.len(), size: self.size });
        }
        if let Some(index) = self.height_m.iter().position(|height| !height.is_finite()) {
            let value = f64::from(self.height_m[index]);
            return Err(DuneError::Height {
                what: "the terrain",
                x: index % nx,
                y: index / nx,
                value,
                limit: f64::MAX,
            });
        }
        let lowest = f64::from(self.height_m.iter().copied().fold(f32::MAX, f32::min));
        let [bed_x, bed_y] = lattice.size();
        let rows = (0..bed_y).map(|y| neighbours(y, bed_y, ny));
        let columns: Vec<_> = (0..bed_x).map(|x| neighbours(x, bed_x, nx)).collect();
        let at = |x: usize, y: usize| f64::from(self.height_m[y * nx + x]);
        Ok(rows
            .flat_map(|(y0, y1, fy)| {
                columns.iter().map(move |&(x0, x1, fx)| {
                    let low = at(x0, y0) * (1.0 - fx) + at(x1, y0) * fx;
                    let high = at(x0, y1) * (1.0 - fx) + at(x1, y1) * fx;
                    ((low * (1.0 - fy) + high * fy - lowest) / cell_m) as f32
                })
            })
            .collect())
    }
}

/// The two samples around a cell's middle, and the weight of the second.
fn neighbours(cell: usize, cells: usize, samples: usize) -> (usize, usize, f64) {
    let position = ((cell as f64 + 0.5) / cells as f64 * samples as f64 - 0.5).clamp(0.0, (samples - 1) as f64);
    let first = position as usize;
    (first, (first + 1).min(samples - 1), position.fract())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terrain_of_the_same_size_is_taken_as_it_is() {
        let lattice = Lattice::new([32, 16]).unwrap();
        let height_m: Vec<f32> = (0..512).map(|i| (i * 7 % 31) as f32 + 100.0).collect();
        let bedrock = Terrain { size: [32, 16], height_m: height_m.clone() }.bedrock_cells(lattice, 2.0).unwrap();
        for (found, height) in bedrock.iter().zip(height_m) {
            assert!((found - (height - 100.0) / 2.0).abs() < 1e-5, "{found} cells for {height} m");
        }
    }

    #[test]
    fn a_slope_stays_a_slope_at_any_size() {
        let lattice = Lattice::new([64, 16]).unwrap();
        let ramp = (0..40 * 10).map(|i| (i % 40) as f32).collect();
        let bedrock = Terrain { size: [40, 10], height_m: ramp }.bedrock_cells(lattice, 1.0).unwrap();
        for (x, &found) in bedrock.iter().enumerate().take(62).skip(2) {
            let expected = (x as f64 + 0.5) * 40.0 / 64.0 - 0.5;
            assert!((f64::from(found) - expected).abs() < 1e-5, "column {x}: {found} of {expected}");
        }
    }

    #[test]
    fn terrain_that_is_no_terrain_is_refused() {
        let lattice = Lattice::new([16, 16]).unwrap();
        let refuse = |size, height_m| Terrain { size, height_m }.bedrock_cells(lattice, 1.0).unwrap_err().to_string();
        assert!(refuse([3, 3], vec![0.0; 8]).starts_with("the terrain has 8 cells"), "too few");
        assert!(refuse([1, 2], vec![0.0, f32::NAN]).starts_with("the terrain at cell (0, 1) is NaN"), "no number");
    }
}

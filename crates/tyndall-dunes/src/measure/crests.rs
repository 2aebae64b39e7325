//! The direction of crests, by the structure tensor.

use super::HeightGrid;

/// Crests of a bed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crests {
    /// Direction of the crest lines, anticlockwise from +x, 0 to 180 (deg).
    pub angle_deg: f64,
    /// How far the crests agree: 0 is any direction, 1 is one direction.
    pub coherence: f64,
}

/// Blur that takes slip faces out, which pull the tensor towards the wind (cells).
const BLUR_CELLS: f64 = 8.0;

/// Direction and coherence of the crests.
#[must_use]
pub fn crests(grid: &HeightGrid) -> Crests {
    let smooth = gaussian_blur(grid, BLUR_CELLS);
    let (mut difference, mut product, mut sum) = (0.0, 0.0, 0.0);
    for [x, y] in smooth.cells() {
        let [dx, dy] = smooth.gradient(x, y);
        difference += dx * dx - dy * dy;
        product += 2.0 * dx * dy;
        sum += dx * dx + dy * dy;
    }
    let across_deg = 0.5 * product.atan2(difference).to_degrees();
    let coherence = if sum > 0.0 { difference.hypot(product) / sum } else { 0.0 };
    Crests { angle_deg: (across_deg + 90.0).rem_euclid(180.0), coherence }
}

/// The grid blurred by a Gaussian of standard deviation `sigma_cells`, periodic.
#[must_use]
pub fn gaussian_blur(grid: &HeightGrid, sigma_cells: f64) -> HeightGrid {
    let radius = (3.0 * sigma_cells).ceil() as isize;
    let weights: Vec<f64> = (-radius..=radius).map(|i| (-0.5 * (i as f64 / sigma_cells).powi(2)).exp()).collect();
    let total: f64 = weights.iter().sum();
    let weights: Vec<f64> = weights.iter().map(|weight| weight / total).collect();
    let [nx, ny] = grid.size.map(usize::cast_signed);
    let row = |y: isize| {
        let start = (y.rem_euclid(ny) * nx).cast_unsigned();
        &grid.heights[start..start + grid.size[0]]
    };
    // Whole rows at a time, so that processors add several columns at once.
    let mut heights = Vec::with_capacity(grid.heights.len());
    for y in 0..ny {
        let mut column = vec![0.0; grid.size[0]];
        for (offset, weight) in (-radius..=radius).zip(&weights) {
            column.iter_mut().zip(row(y + offset)).for_each(|(sum, &height)| *sum += weight * f64::from(height));
        }
        let periodic: Vec<f64> = (-radius..nx + radius).map(|x| column[x.rem_euclid(nx).cast_unsigned()]).collect();
        let blurred = periodic.windows(weights.len()).map(|taps| taps.iter().zip(&weights).map(|(a, b)| a * b).sum());
        heights.extend(blurred.map(|height: f64| height as f32));
    }
    HeightGrid { size: grid.size, heights }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn oblique_waves_have_crests_across_their_wave_vector() {
        for (mx, my) in [(4.0, 0.0), (3.0, 3.0), (0.0, 5.0), (-4.0, 2.0)] {
            let phase = |i: usize| std::f64::consts::TAU * (mx * (i % 128) as f64 + my * (i / 128) as f64) / 128.0;
            let grid = HeightGrid::new([128, 128], (0..128 * 128).map(|i| phase(i).sin() as f32).collect()).unwrap();
            let found = crests(&grid);
            let expected = (f64::atan2(my, mx).to_degrees() + 90.0).rem_euclid(180.0);
            let off = (found.angle_deg - expected + 90.0).rem_euclid(180.0) - 90.0;
            // Central differences turn the gradient by up to k^2 / 12 (0.1 deg at these wavelengths).
            assert!(off.abs() < 0.2 && found.coherence > 0.99, "({mx}, {my}): {found:?}, expected {expected}");
        }
    }
}

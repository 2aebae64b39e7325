//! Waves along x.

use std::f64::consts::TAU;

use super::HeightGrid;

/// Power of the modes 0 to `modes` - 1 along x, the mean over all rows.
#[must_use]
pub fn spectrum_along_x(grid: &HeightGrid, modes: usize) -> Vec<f64> {
    (0..modes).map(|mode| rows(grid, mode).map(|[re, im]| re * re + im * im).sum()).collect()
}

/// Fourier coefficient of one mode for every row.
fn rows(grid: &HeightGrid, mode: usize) -> impl Iterator<Item = [f64; 2]> {
    let nx = grid.size()[0];
    let wave: Vec<[f64; 2]> = (0..nx)
        .map(|x| {
            let (sin, cos) = (TAU * (mode * x % nx) as f64 / nx as f64).sin_cos();
            [cos, -sin]
        })
        .collect();
    grid.heights().chunks_exact(nx).map(move |row| {
        row.iter().zip(&wave).fold([0.0, 0.0], |[re, im], (&height, [cos, sin])| {
            [re + f64::from(height) * cos, im + f64::from(height) * sin]
        })
    })
}

/// Mean wavelength along x (cells): the length of the bed over the power-weighted mean of modes 1 to `modes` - 1.
#[must_use]
pub fn mean_wavelength_cells(grid: &HeightGrid, modes: usize) -> f64 {
    let spectrum = spectrum_along_x(grid, modes);
    let power: f64 = spectrum.iter().skip(1).sum();
    let weighted: f64 = spectrum.iter().enumerate().map(|(mode, power)| mode as f64 * power).sum();
    grid.size()[0] as f64 * power / weighted
}

/// How far waves moved along x between two beds (cells), by the phase of the strongest of modes 1 to `modes` - 1;
/// unambiguous up to half a wavelength.
#[must_use]
pub fn drift_cells(before: &HeightGrid, after: &HeightGrid, modes: usize) -> f64 {
    let spectrum = spectrum_along_x(before, modes);
    let strongest = (1..modes).max_by(|&a, &b| spectrum[a].total_cmp(&spectrum[b])).unwrap_or(1);
    let turned = rows(before, strongest)
        .zip(rows(after, strongest))
        .fold([0.0, 0.0], |[re, im], (a, b)| [re + a[0] * b[0] + a[1] * b[1], im + a[0] * b[1] - a[1] * b[0]]);
    let wavenumber = TAU * strongest as f64 / before.size()[0] as f64;
    -turned[1].atan2(turned[0]) / wavenumber
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wave(mode: f64, shift: f64) -> HeightGrid {
        let height = |index: u16| (TAU * mode * (f64::from(index % 64) - shift) / 64.0).sin() as f32;
        HeightGrid::new([64, 16], (0..1024).map(height).collect()).unwrap()
    }

    #[test]
    fn a_sine_has_its_wavelength_and_its_drift() {
        let (before, after) = (wave(4.0, 0.0), wave(4.0, 1.25));
        let wavelength = mean_wavelength_cells(&before, 32);
        // Heights are f32: 1e-7 of the wave's power is noise in 31 modes.
        assert!((wavelength - 16.0).abs() < 1e-4, "{wavelength} cells");
        let drift = drift_cells(&before, &after, 32);
        assert!((drift - 1.25).abs() < 1e-5, "{drift} cells downwind");
    }
}

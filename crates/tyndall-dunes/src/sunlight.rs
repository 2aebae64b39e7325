//! What the sun leaves of a bed in the dark.

use rayon::prelude::*;

use crate::measure::HeightGrid;

/// Sunlight on each cell of that on a surface which faces the sun, where the tangents of the horizon's elevation towards the
/// sun ([`crate::horizon::horizon_tangents`]) do not hide it.
#[must_use]
pub fn sunlight(bed: &HeightGrid, tangents: &[f32], azimuth_from_east_rad: f64, elevation_rad: f64) -> Vec<f32> {
    let [nx, _] = bed.size();
    let (sine, cosine) = azimuth_from_east_rad.sin_cos();
    let (up, along, tangent) = (elevation_rad.sin(), elevation_rad.cos(), elevation_rad.tan());
    let mut lit = vec![0.0; tangents.len()];
    lit.par_chunks_mut(nx).zip(tangents.par_chunks(nx)).enumerate().for_each(|(y, (row, tangents))| {
        for ((lit, &horizon), [gx, gy]) in row.iter_mut().zip(tangents).zip(bed.row_gradients(y)) {
            let facing = (up - along * (gx * cosine + gy * sine)) / (1.0 + gx * gx + gy * gy).sqrt();
            *lit = if tangent > f64::from(horizon) { facing.max(0.0) as f32 } else { 0.0 };
        }
    });
    lit
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn level_ground_has_the_sine_of_the_sun_and_the_lee_of_a_wall_nothing() {
        let bed = HeightGrid::new([8, 4], vec![2.0; 32]).unwrap();
        let mut horizon = vec![0.0; 32];
        horizon[13] = 0.6;
        for (cell, lit) in sunlight(&bed, &horizon, 1.0, 0.5).into_iter().enumerate() {
            let expected = if cell == 13 { 0.0 } else { 0.5_f64.sin() };
            assert!((f64::from(lit) - expected).abs() < 1e-6, "cell {cell}: {lit}");
        }
    }

    #[test]
    fn a_slope_that_faces_the_sun_has_all_of_it_and_one_that_turns_away_none() {
        // The middle of a slope that rises by 0.5 to the east.
        let bed = HeightGrid::new([16, 8], (0..128).map(|index| 0.5 * (index % 16) as f32).collect()).unwrap();
        let elevation_rad = 0.5_f64.atan().mul_add(-1.0, std::f64::consts::FRAC_PI_2);
        let at = |azimuth_rad| sunlight(&bed, &[-9.0; 128], azimuth_rad, elevation_rad)[3 * 16 + 8];
        assert!((at(std::f64::consts::PI) - 1.0).abs() < 1e-6, "from the west: {}", at(std::f64::consts::PI));
        let low = sunlight(&bed, &[-9.0; 128], 0.0, 0.3)[3 * 16 + 8];
        assert!(low.abs() < 1e-12, "from behind: {low}");
    }
}

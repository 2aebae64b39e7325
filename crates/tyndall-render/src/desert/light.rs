//! What the sun leaves of a bed in the dark, and how much of its light sand throws around.

use tyndall_dunes::DuneError;
use tyndall_dunes::horizon::horizon_tangents;

use super::bed::Bed;
use super::smooth::blur;

/// Passes of the blur, the nth with taps n cells apart: some eight cells around.
const AROUND_PASSES: usize = 4;

/// For each cell: tangent of the horizon's elevation under the sun, openness of the sky, and sunlight that surfaces around
/// receive on the mean, of that on a surface that faces the sun.
///
/// # Errors
/// When the azimuth is no number.
#[expect(clippy::cast_possible_truncation, reason = "textures hold less than f32")]
pub(super) fn light_map(bed: &Bed, azimuth_from_east_rad: f64, elevation_rad: f64) -> Result<Vec<[f32; 4]>, DuneError> {
    let tangents = horizon_tangents(&bed.heights, azimuth_from_east_rad, bed.edges)?;
    let size = bed.heights.size();
    let [sine, cosine] = [azimuth_from_east_rad.sin(), azimuth_from_east_rad.cos()];
    let lit = |cell: usize| {
        let [x, y] = [cell % size[0], cell / size[0]].map(usize::cast_signed);
        let [gx, gy] = bed.heights.gradient(x, y);
        let facing = elevation_rad.sin() - elevation_rad.cos() * (gx * cosine + gy * sine);
        let seen = elevation_rad > f64::from(tangents[cell]).atan();
        if seen { (facing / (1.0 + gx * gx + gy * gy).sqrt()).max(0.0) as f32 } else { 0.0 }
    };
    let mut around: Vec<f32> = (0..tangents.len()).map(lit).collect();
    for pass in 1..=AROUND_PASSES {
        around = blur(&around, size, bed.edges, pass);
    }
    let cell = |((tangent, openness), around): ((&f32, &f32), &f32)| [*tangent, *openness, *around, 0.0];
    Ok(tangents.iter().zip(&bed.openness).zip(&around).map(cell).collect())
}

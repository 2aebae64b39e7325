//! What the sun leaves of a bed in the dark, and how much of its light sand throws around.

use tyndall_dunes::DuneError;
use tyndall_dunes::blur::blur;
use tyndall_dunes::horizon::horizon_tangents;
use tyndall_dunes::sunlight::sunlight;

use super::bed::Bed;

/// Passes of the blur, the nth with taps n cells apart: some eight cells around.
const AROUND_PASSES: usize = 4;

/// For each cell: tangent of the horizon's elevation under the sun, openness of the sky, and sunlight that surfaces around
/// receive on the mean, of that on a surface that faces the sun.
///
/// # Errors
/// When the azimuth is no number.
pub(super) fn light_map(bed: &Bed, azimuth_from_east_rad: f64, elevation_rad: f64) -> Result<Vec<[f32; 4]>, DuneError> {
    let tangents = horizon_tangents(&bed.heights, azimuth_from_east_rad, bed.edges)?;
    let size = bed.heights.size();
    let mut around = sunlight(&bed.heights, &tangents, azimuth_from_east_rad, elevation_rad);
    for pass in 1..=AROUND_PASSES {
        around = blur(&around, size, bed.edges, pass);
    }
    let cell = |((tangent, openness), around): ((&f32, &f32), &f32)| [*tangent, *openness, *around, 0.0];
    Ok(tangents.iter().zip(&bed.openness).zip(&around).map(cell).collect())
}

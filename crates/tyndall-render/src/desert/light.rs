//! What the sun leaves of a bed in the dark, and how much of its light sand throws around.

use tyndall_dunes::blur::blur;
use tyndall_dunes::horizon::horizon_tangents;
use tyndall_dunes::measure::HeightGrid;
use tyndall_dunes::sunlight::sunlight;
use tyndall_dunes::{DuneError, Edges};

use super::bed::Bed;

/// Passes of the blur, the nth with taps n cells apart: some eight cells around.
const AROUND_PASSES: usize = 4;

/// The same of cells twice as wide.
const QUICK_AROUND_PASSES: usize = 2;

/// For each cell: tangent of the horizon's elevation under the sun, openness of the sky, and sunlight that surfaces around
/// receive on the mean, of that on a surface that faces the sun.
///
/// # Errors
/// When the azimuth is no number.
pub(super) fn light_map(bed: &Bed, azimuth_from_east_rad: f64, elevation_rad: f64) -> Result<Vec<[f32; 4]>, DuneError> {
    let toward = [azimuth_from_east_rad, elevation_rad];
    light_of(&bed.heights, &bed.openness, bed.edges, toward, AROUND_PASSES)
}

/// The same in cells twice as wide, for beds that are soon followed by others: a quarter of the work. With the size of the map.
///
/// # Errors
/// When the azimuth is no number.
pub(super) fn quick_light_map(
    bed: &Bed,
    azimuth_from_east_rad: f64,
    elevation_rad: f64,
) -> Result<([usize; 2], Vec<[f32; 4]>), DuneError> {
    let size = bed.heights.size();
    let halved = size.map(|count| count / 2);
    let heights = halves(bed.heights.heights(), size).into_iter().map(|height| 0.5 * height).collect();
    let toward = [azimuth_from_east_rad, elevation_rad];
    Ok(match HeightGrid::new(halved, heights) {
        Some(heights) => {
            let openness = halves(&bed.openness, size);
            (halved, light_of(&heights, &openness, bed.edges, toward, QUICK_AROUND_PASSES)?)
        }
        // A field too small to be halved.
        None => (size, light_of(&bed.heights, &bed.openness, bed.edges, toward, AROUND_PASSES)?),
    })
}

/// Means over two by two cells.
fn halves(values: &[f32], [nx, ny]: [usize; 2]) -> Vec<f32> {
    let row = |y: usize| {
        let at = move |x: usize, y: usize| values[y * nx + x];
        (0..nx / 2).map(move |x| 0.25 * (at(2 * x, y) + at(2 * x + 1, y) + at(2 * x, y + 1) + at(2 * x + 1, y + 1)))
    };
    (0..ny / 2).flat_map(|y| row(2 * y)).collect()
}

fn light_of(
    heights: &HeightGrid,
    openness: &[f32],
    edges: Edges,
    [azimuth_from_east_rad, elevation_rad]: [f64; 2],
    passes: usize,
) -> Result<Vec<[f32; 4]>, DuneError> {
    let tangents = horizon_tangents(heights, azimuth_from_east_rad, edges)?;
    let mut around = sunlight(heights, &tangents, azimuth_from_east_rad, elevation_rad);
    for pass in 1..=passes {
        around = blur(&around, heights.size(), edges, pass);
    }
    let cell = |((tangent, openness), around): ((&f32, &f32), &f32)| [*tangent, *openness, *around, 0.0];
    Ok(tangents.iter().zip(openness).zip(&around).map(cell).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_are_means_over_two_by_two_cells() {
        let values: Vec<f32> = (0..8_u8).map(f32::from).collect();
        assert_eq!(halves(&values, [4, 2]), [2.5, 4.5], "two cells of four by two");
    }
}

//! Horizons under the sun in a finer grid than the field's.
//!
//! Horizons jump at crests and at the edges of shadows. In the field's own grid they would be smeared over a cell to each
//! side; and its cells are not the surface that is drawn, which is a spline of them.

use rayon::prelude::*;
use tyndall_dunes::horizon::horizon_tangents;
use tyndall_dunes::measure::HeightGrid;
use tyndall_dunes::{DuneError, Edges};

use super::bed::Bed;

/// Largest side of a finer grid (cells).
const FINEST_SIDE: usize = 1024;

/// Most cells of a finer grid along a cell of the field.
const FINEST: usize = 4;

/// Cells of a finer grid along a cell of a field.
#[must_use]
pub fn fineness(size: [usize; 2]) -> usize {
    (FINEST_SIDE / size[0].max(size[1]).max(1)).clamp(1, FINEST)
}

/// Tangents of the horizon's elevation of a bed's surface in a grid `fineness` times as fine.
///
/// # Errors
/// When the azimuth is no number.
pub fn sun_horizon(bed: &Bed, azimuth_from_east_rad: f64, fineness: usize) -> Result<Vec<f32>, DuneError> {
    let surface = surface(bed, fineness);
    horizon_tangents(surface.as_ref().unwrap_or(&bed.heights), azimuth_from_east_rad, bed.edges)
}

/// Heights (finer cells) of the surface that is drawn, in the middles of finer cells.
#[expect(clippy::cast_possible_truncation, reason = "heights are f32")]
fn surface(bed: &Bed, fineness: usize) -> Option<HeightGrid> {
    let size = bed.heights.size().map(|count| count * fineness);
    let cell_m = bed.cell_m / fineness as f64;
    let middle = |index: usize, count: usize| cell_m * (index as f64 + 0.5 - 0.5 * count as f64);
    let mut heights = vec![0.0; size[0] * size[1]];
    heights.par_chunks_mut(size[0].max(1)).enumerate().for_each(|(y, row)| {
        for (x, height) in row.iter_mut().enumerate() {
            *height = (bed.at(middle(x, size[0]), middle(y, size[1]))[0] / cell_m) as f32;
        }
    });
    HeightGrid::new(size, heights)
}

/// The light of a field's cells with the horizons of finer ones in place of theirs.
///
/// # Errors
/// When the azimuth is no number.
pub(super) fn with_fine_horizons(
    bed: &Bed,
    light: &[[f32; 4]],
    azimuth_from_east_rad: f64,
    fineness: usize,
) -> Result<Vec<[f32; 4]>, DuneError> {
    let tangents = sun_horizon(bed, azimuth_from_east_rad, fineness)?;
    let [nx, ny] = bed.heights.size();
    let across: Vec<_> = (0..nx * fineness).map(|x| between(x, fineness, nx, bed.edges)).collect();
    let texel = |(index, tangent): (usize, &f32)| {
        let ([x, next_x], share_x) = across[index % across.len()];
        let ([y, next_y], share_y) = between(index / across.len(), fineness, ny, bed.edges);
        let part = |part: usize| {
            let row = |y: usize| {
                let [here, next] = [x, next_x].map(|x| light[y * nx + x][part]);
                here + share_x * (next - here)
            };
            row(y) + share_y * (row(next_y) - row(y))
        };
        [*tangent, part(1), part(2), 0.0]
    };
    Ok(tangents.par_iter().enumerate().map(texel).collect())
}

/// The two cells beside the middle of a finer one, and the share of the second.
#[expect(clippy::cast_possible_truncation, reason = "a share of 1")]
fn between(index: usize, fineness: usize, count: usize, edges: Edges) -> ([usize; 2], f32) {
    // Counted from the middle of the cell before the first.
    let at = (index as f64 + 0.5) / fineness as f64 + 0.5;
    let cell = |number: usize| match edges {
        Edges::Periodic => (number + count - 1) % count,
        Edges::Open => number.saturating_sub(1).min(count - 1),
    };
    ([cell(at as usize), cell(at as usize + 1)], at.fract() as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_between_cells_are_those_of_a_texture() {
        assert_eq!(between(0, 1, 8, Edges::Open), ([0, 1], 0.0), "as fine as the field, its own cells");
        assert_eq!(between(0, 4, 8, Edges::Periodic), ([7, 0], 0.625), "before the first middle the last cell counts");
        assert_eq!(between(0, 4, 8, Edges::Open), ([0, 0], 0.625), "or the first one, where nothing repeats");
        assert_eq!(between(31, 4, 8, Edges::Periodic), ([7, 0], 0.375), "and behind the last middle the first");
    }

    #[test]
    fn a_field_gets_no_more_cells_than_a_texture_may_have() {
        let found = [64, 256, 512, 1024, 2048].map(|side| fineness([side, 64]));
        assert_eq!(found, [4, 4, 2, 1, 1], "cells along a cell");
    }
}

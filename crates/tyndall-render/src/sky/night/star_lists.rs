//! The stars in lists by cells of a cube, as the shader looks them up. WGSL: `shaders/sky/stars.wgsl`.

use glam::DVec3;
use tyndall_scene::astronomy::Star;

use super::colour::star_rec709;

/// Stars that the shader looks at in a cell; the faintest of a fuller one are left out.
const STARS_IN_CELL_MAX: usize = 384;

/// Part of a cell's width by which a star reaches into its neighbours.
const MARGIN: f64 = 0.25;

/// Most and fewest cells along an edge of the cube.
const GRID_MAX: u32 = 64;
const GRID_MIN: u32 = 4;

/// Pixels from a star to where its light ends, and the least angle (rad) of a cell's margin times the cells along an edge:
/// at the corners of the cube a cell is three times narrower than in the middle of a face.
const REACH_PX: f64 = 2.0;
const MARGIN_RAD: f64 = MARGIN * 2.0 / 3.0;

/// The lists.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct StarLists {
    /// Where the list of each cell begins, in stars; one more at the end.
    pub(super) cells: Vec<u32>,
    /// Two vectors a star: direction and illuminance (lux); colour.
    pub(super) list: Vec<[f32; 4]>,
}

/// Cells along an edge for pixels of this width (rad), a power of two.
pub(super) fn grid_for(pixel_rad: f64) -> u32 {
    let mut grid = GRID_MAX;
    while grid > GRID_MIN && REACH_PX * pixel_rad * f64::from(grid) > MARGIN_RAD {
        grid /= 2;
    }
    grid
}

/// Sorts stars, the brightest first, into the cells that they may touch.
pub(super) fn star_lists(stars: &[Star], grid: u32) -> StarLists {
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); (6 * grid * grid) as usize];
    for (index, star) in stars.iter().enumerate() {
        for cell in cells_of(star.direction, grid) {
            if members[cell].len() < STARS_IN_CELL_MAX {
                members[cell].push(index);
            }
        }
    }
    let mut lists = StarLists { cells: vec![0], list: Vec::new() };
    for members in members {
        lists.list.extend(members.iter().flat_map(|index| vectors(&stars[*index])));
        lists.cells.push(small(lists.list.len() / 2));
    }
    lists
}

#[expect(clippy::cast_possible_truncation, reason = "the GPU computes in f32")]
fn vectors(star: &Star) -> [[f32; 4]; 2] {
    let [x, y, z] = star.direction.to_array();
    let [r, g, b] = star_rec709(star.colour_index);
    [[x, y, z, star.illuminance_lux], [r, g, b, 0.0]].map(|vector| vector.map(|value| value as f32))
}

/// The cells whose margin a direction lies in, on all faces.
fn cells_of(direction: DVec3, grid: u32) -> Vec<usize> {
    let count = f64::from(grid);
    let mut cells = Vec::new();
    for axis in 0..3 {
        let along = direction[axis];
        let across =
            [direction[(axis + 1) % 3], direction[(axis + 2) % 3]].map(|part| (part / along.abs() * 0.5 + 0.5) * count);
        let inside = |at: f64| at > -MARGIN && at < count + MARGIN;
        if along == 0.0 || !inside(across[0]) || !inside(across[1]) {
            continue;
        }
        let face = 2 * axis + usize::from(along < 0.0);
        let [columns, rows] = across.map(|at| range(at, grid));
        for row in rows {
            cells.extend(columns.clone().map(|column| (face * grid as usize + row) * grid as usize + column));
        }
    }
    cells
}

/// The cells of a row that a place reaches.
#[expect(clippy::cast_possible_truncation, reason = "clamped to the count of cells")]
fn range(at: f64, grid: u32) -> std::ops::RangeInclusive<usize> {
    let cell = |at: f64| at.floor().clamp(0.0, f64::from(grid - 1)) as usize;
    cell(at - MARGIN)..=cell(at + MARGIN)
}

#[expect(clippy::cast_possible_truncation, reason = "counts of stars")]
fn small(count: usize) -> u32 {
    count as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use tyndall_scene::astronomy::bright_stars;

    /// Whether a star stands in the list of the cell of a direction.
    fn found(lists: &StarLists, grid: u32, star: &Star, direction: DVec3) -> bool {
        let cell = cell_of(direction, grid);
        let [first, end] = [lists.cells[cell], lists.cells[cell + 1]].map(|index| 2 * index as usize);
        let place = |vector: &[f32; 4]| DVec3::new(f64::from(vector[0]), f64::from(vector[1]), f64::from(vector[2]));
        lists.list[first..end].chunks(2).any(|two| place(&two[0]).distance(star.direction) < 1e-6)
    }

    /// The one cell of a direction, as `stars_cell` in WGSL.
    #[expect(clippy::cast_possible_truncation, reason = "counts of cells")]
    fn cell_of(direction: DVec3, grid: u32) -> usize {
        let axis = direction.abs().to_array().iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap().0;
        let along = direction[axis];
        let cell = [1, 2].map(|turn| {
            let at = (direction[(axis + turn) % 3] / along.abs() * 0.5 + 0.5) * f64::from(grid);
            (at as usize).min(grid as usize - 1)
        });
        ((2 * axis + usize::from(along < 0.0)) * grid as usize + cell[1]) * grid as usize + cell[0]
    }

    #[test]
    fn every_direction_finds_every_star_within_reach_in_its_cell() {
        let stars = bright_stars();
        for pixel_rad in [0.0005, 0.002, 0.005] {
            let grid = grid_for(pixel_rad);
            let lists = star_lists(&stars, grid);
            for star in stars.iter().take(2000) {
                let aside = star.direction.any_orthonormal_vector() * (REACH_PX * pixel_rad);
                for direction in [star.direction, star.direction + aside, star.direction - aside] {
                    assert!(
                        found(&lists, grid, star, direction.normalize()),
                        "{pixel_rad} rad: {star:?} from {direction}"
                    );
                }
            }
        }
    }

    #[test]
    fn finer_pixels_have_finer_cells_and_no_cell_is_too_full() {
        assert!(grid_for(1e-5) == GRID_MAX && grid_for(1.0) == GRID_MIN, "ends");
        let lists = star_lists(&bright_stars(), GRID_MIN);
        let longest = lists.cells.windows(2).map(|pair| pair[1] - pair[0]).max();
        assert!(longest <= Some(384), "{longest:?}");
    }
}

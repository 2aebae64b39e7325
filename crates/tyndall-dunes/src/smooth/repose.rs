//! A bed without slopes that sand cannot keep: for pictures and maps.
//!
//! Of all surfaces that are nowhere steeper than a limit one is the highest below the bed, and one the lowest above it. Their
//! mean is as gentle as both, as high as the bed where that is gentle, and cuts at a brink about what it fills in at the foot.
//! Within two cells of brink and foot slopes are those of the bed in part. Each is found by sweeps over neighbours up to a knight's move away, whose ways are at most 2.8 % longer than straight ones.
//! Rock and overgrown sand that are steeper by far stay as they are. About 0.2 us a cell on one core.

use crate::blur::blur;
use crate::edges::Edges;
use crate::measure::HeightGrid;

/// Where the bed was steeper than so many limits before it was smoothed, its slope is not that of loose sand.
const NOT_LOOSE: f32 = 1.2;

/// Neighbours that a sweep has met already: offsets, and distances.
const MET: [([isize; 2], f32); 8] = [
    ([-1, 0], 1.0),
    ([-1, -1], std::f32::consts::SQRT_2),
    ([0, -1], 1.0),
    ([1, -1], std::f32::consts::SQRT_2),
    ([-2, -1], SQRT_5),
    ([-1, -2], SQRT_5),
    ([1, -2], SQRT_5),
    ([2, -1], SQRT_5),
];
const SQRT_5: f32 = 2.236_068;

/// Length of the longest way between two cells, of the straight line.
const LONGEST_WAY: f32 = 1.028;

/// Sweeps there and back. The first meets all but what comes over a periodic edge, the second that as well.
const ROUNDS: usize = 2;

/// A smooth bed whose loose slopes are at most `steepest` (tangent); `rough` is the bed before it was smoothed.
#[must_use]
pub fn at_repose(smooth: &HeightGrid, rough: &HeightGrid, steepest: f64, edges: Edges) -> HeightGrid {
    let steepest = steepest as f32 / LONGEST_WAY;
    if smooth.size() != rough.size() {
        return smooth.clone();
    }
    let limits = limits(rough, steepest, edges);
    let turned: Vec<f32> = smooth.heights().iter().map(|height| -height).collect();
    let sweep = |heights| swept(heights, &limits, smooth.size(), edges);
    let (below, above) = rayon::join(|| sweep(smooth.heights()), || sweep(&turned));
    let moved: Vec<f32> = (below.iter().zip(&above).zip(smooth.heights()))
        .map(|((below, above), height)| 0.5 * (below - above) - height)
        .collect();
    // The ways leave facets, which low suns would show.
    let moved = blur(&moved, smooth.size(), edges, 1);
    let heights = smooth.heights().iter().zip(moved).map(|(height, moved)| height + moved).collect();
    HeightGrid::new(smooth.size(), heights).unwrap_or_else(|| smooth.clone())
}

/// The cell at an offset from another; `None` beyond an open edge.
fn cell([x, y]: [usize; 2], [dx, dy]: [isize; 2], [nx, ny]: [usize; 2], edges: Edges) -> Option<usize> {
    let at = |at: usize, d: isize, count: usize| {
        let (at, count) = (at.cast_signed() + d, count.cast_signed());
        match edges {
            Edges::Periodic => Some(at.rem_euclid(count).cast_unsigned()),
            Edges::Open => (0..count).contains(&at).then(|| at.cast_unsigned()),
        }
    };
    Some(at(y, dy, ny)? * nx + at(x, dx, nx)?)
}

/// The limit of each cell's slope: none where the bed at it or next to it is too steep for loose sand.
fn limits(rough: &HeightGrid, steepest: f32, edges: Edges) -> Vec<f32> {
    let (size, heights) = (rough.size(), rough.heights());
    let mut limits = vec![steepest; heights.len()];
    let around = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| [dx, dy]));
    for index in 0..heights.len() {
        let at = [index % size[0], index / size[0]];
        let height = |offset| cell(at, offset, size, edges).map_or(heights[index], |next| heights[next]);
        let [east, north] =
            [height([1, 0]) - height([-1, 0]), height([0, 1]) - height([0, -1])].map(|twice| 0.5 * twice);
        if east.hypot(north) > NOT_LOOSE * steepest {
            for next in around.clone().filter_map(|offset| cell(at, offset, size, edges)) {
                limits[next] = f32::INFINITY;
            }
        }
    }
    limits
}

/// The highest surface below another that no way between two cells is steeper on than the limits on it.
fn swept(heights: &[f32], limits: &[f32], size: [usize; 2], edges: Edges) -> Vec<f32> {
    let mut surface = heights.to_vec();
    let lower = |surface: &mut [f32], index: usize, side: isize| {
        let at = [index % size[0], index / size[0]];
        let inner = (2..size[0] - 2).contains(&at[0]) && (2..size[1] - 2).contains(&at[1]);
        for ([dx, dy], distance) in MET {
            let next = if inner {
                Some(index.wrapping_add_signed(side * (dy * size[0].cast_signed() + dx)))
            } else {
                cell(at, [side * dx, side * dy], size, edges)
            };
            let Some(next) = next else { continue };
            let most = surface[next] + distance * limits[index].max(limits[next]);
            surface[index] = surface[index].min(most);
        }
    };
    for _ in 0..ROUNDS {
        for index in 0..heights.len() {
            lower(&mut surface, index, 1);
        }
        for index in (0..heights.len()).rev() {
            lower(&mut surface, index, -1);
        }
    }
    surface
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [usize; 2] = [96, 64];
    const STEEPEST: f64 = 2.0 / 3.0;

    fn bed(height: impl Fn(f64, f64) -> f64) -> HeightGrid {
        let at = |index: usize| height((index % SIZE[0]) as f64 - 48.0, (index / SIZE[0]) as f64 - 32.0) as f32;
        HeightGrid::new(SIZE, (0..SIZE[0] * SIZE[1]).map(at).collect()).unwrap()
    }

    /// Windward slope 0.2 up to a brink, then down by `lee` in a direction.
    fn ridge(lee: f64, direction_deg: f64) -> HeightGrid {
        let (sin, cos) = direction_deg.to_radians().sin_cos();
        bed(|x, y| {
            let along = x * cos + y * sin;
            (8.0 + if along < 0.0 { 0.2 * along } else { -lee * along }).max(0.0)
        })
    }

    #[test]
    fn gentle_beds_stay_as_they_are() {
        let gentle = ridge(0.62, 0.0);
        assert_eq!(at_repose(&gentle, &gentle, STEEPEST, Edges::Periodic), gentle, "31.8 degrees");
    }

    #[test]
    fn slopes_of_loose_sand_come_to_the_limit_in_every_direction_and_keep_the_sand() {
        for direction_deg in [0.0, 20.0, 27.0, 45.0, 70.0, 90.0] {
            let steep = ridge(0.76, direction_deg);
            let mended = at_repose(&steep, &steep, STEEPEST, Edges::Open);
            let (sin, cos) = f64::to_radians(direction_deg).sin_cos();
            let on_lee = |(x, y): &(isize, isize)| (3.0..6.0).contains(&(*x as f64 * cos + *y as f64 * sin));
            let steepest = (-20..20_isize)
                .flat_map(|y| (-30..30_isize).map(move |x| (x, y)))
                .filter(on_lee)
                .map(|(x, y)| mended.gradient(x + 48, y + 32))
                .map(|[east, north]| east.hypot(north))
                .fold(0.0, f64::max);
            // Differences over two cells to each side, of facets.
            assert!(steepest < 1.01 * STEEPEST, "{direction_deg} degrees: {steepest}");
            let moved = mended.mean_cells() / steep.mean_cells() - 1.0;
            assert!(moved.abs() < 0.01, "{direction_deg} degrees: {moved} of the sand is lost or gained");
        }
    }

    #[test]
    fn walls_of_rock_stand() {
        let wall = ridge(3.0, 0.0);
        assert_eq!(at_repose(&wall, &wall, STEEPEST, Edges::Periodic), wall, "72 degrees");
    }
}

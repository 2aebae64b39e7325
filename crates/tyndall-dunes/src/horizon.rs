//! Horizons: how high the bed stands in each direction, for soft sun shadows and for the light of the sky.
//!
//! For each azimuth the bed is cut into parallel lines of cells. A line is walked towards the viewer with the upper hull of
//! what was passed on a stack, so the horizon is exact along the line, however far away it is, at a cost that does not
//! depend on the distance. Between cells lines take the heights of the two beside them. About 30 ns per cell and azimuth.

use std::f64::consts::TAU;

use rayon::prelude::*;

use crate::DuneError;
use crate::edges::Edges;
use crate::error::check_value;
use crate::measure::HeightGrid;

/// Most azimuths of a map.
pub const MAX_AZIMUTHS: usize = 64;

/// Angular radius of the sun seen from the Earth (rad).
pub const SUN_RADIUS_RAD: f64 = 0.004_65;

/// Tangents of the horizon's elevation in a number of azimuths.
#[derive(Clone, Debug, PartialEq)]
pub struct HorizonMap {
    size: [usize; 2],
    /// Azimuth by azimuth, in index order within each.
    tangents: Vec<Vec<f32>>,
}

impl HorizonMap {
    /// The horizons of a bed in `azimuths` directions, the first along +x, anticlockwise. Beyond open edges lies nothing.
    ///
    /// # Errors
    /// [`DuneError::Value`] when `azimuths` is not 4 to [`MAX_AZIMUTHS`].
    pub fn new(bed: &HeightGrid, azimuths: usize, edges: Edges) -> Result<Self, DuneError> {
        check_value("number of azimuths", azimuths as f64, "", 4.0..=MAX_AZIMUTHS as f64)?;
        let tangents =
            (0..azimuths).map(|index| one_azimuth(bed, TAU * index as f64 / azimuths as f64, edges)).collect();
        Ok(Self { size: bed.size(), tangents })
    }

    /// Number of azimuths.
    #[must_use]
    pub fn azimuths(&self) -> usize {
        self.tangents.len()
    }

    /// [nx, ny].
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Tangents of the horizon's elevation of all cells in one azimuth.
    #[must_use]
    pub fn tangents(&self, azimuth: usize) -> &[f32] {
        &self.tangents[azimuth]
    }

    /// Tangent of the horizon's elevation at a cell, linear between azimuths.
    #[must_use]
    pub fn tangent(&self, cell: usize, azimuth_rad: f64) -> f64 {
        let count = self.azimuths();
        let position = (azimuth_rad / TAU).rem_euclid(1.0) * count as f64;
        let first = position as usize % count;
        let at = |azimuth: usize| f64::from(self.tangents[azimuth % count][cell]);
        at(first) + position.fract() * (at(first + 1) - at(first))
    }

    /// Share of the sun's disc over the horizon of a cell, smooth over the disc's height; 0 to 1.
    #[must_use]
    pub fn sun_visibility(&self, cell: usize, azimuth_rad: f64, elevation_rad: f64) -> f64 {
        let over = elevation_rad - self.tangent(cell, azimuth_rad).atan();
        let share = (0.5 + 0.5 * over / SUN_RADIUS_RAD).clamp(0.0, 1.0);
        share * share * (3.0 - 2.0 * share)
    }

    /// Share of an even sky's light that falls on level ground at a cell: the mean of cos^2 of the horizon's elevation.
    #[must_use]
    pub fn sky_openness(&self, cell: usize) -> f64 {
        let open = |tangents: &Vec<f32>| {
            let tangent = f64::from(tangents[cell]).max(0.0);
            1.0 / (1.0 + tangent * tangent)
        };
        self.tangents.iter().map(open).sum::<f64>() / self.azimuths() as f64
    }
}

/// Tangents of the horizon's elevation of all cells in one direction (rad anticlockwise from +x), in index order.
///
/// # Errors
/// [`DuneError::Value`] when the azimuth is not within two turns.
pub fn horizon_tangents(bed: &HeightGrid, azimuth_rad: f64, edges: Edges) -> Result<Vec<f32>, DuneError> {
    check_value("azimuth", azimuth_rad, " rad", -2.0 * TAU..=2.0 * TAU)?;
    Ok(one_azimuth(bed, azimuth_rad, edges))
}

/// A bed seen along one azimuth: steps go one cell along the major axis, and between cells across it. All lines are alike, so
/// that where they pass between cells is worked out once.
struct View {
    /// Heights, turned so that rows lie along the major axis and are walked forwards.
    heights: Vec<f32>,
    edges: Edges,
    /// Cells along the major axis and across it.
    counts: [isize; 2],
    x_is_major: bool,
    is_mirrored: bool,
    /// Cells across for a cell along.
    shear: f64,
    steps: Vec<Between>,
}

/// Where lines are at a step along the major axis, and where they cross a row of cells before the next one.
struct Between {
    /// Rows from a line's first one to the row below it.
    row: isize,
    /// Share of the row above.
    share: f64,
    /// Rows to the one that is crossed, and the share of a step to there.
    crossed: Option<(isize, f64)>,
}

impl View {
    fn new(bed: &HeightGrid, azimuth_rad: f64, edges: Edges) -> Self {
        let (sin, cos) = azimuth_rad.sin_cos();
        let x_is_major = cos.abs() >= sin.abs();
        let [nx, ny] = bed.size();
        let (major, minor, [length, width]) = if x_is_major { (cos, sin, [nx, ny]) } else { (sin, cos, [ny, nx]) };
        // Along the axes the sine or cosine is zero but for rounding.
        let shear = if minor.abs() < 1e-9 { 0.0 } else { minor / major.abs() };
        let is_mirrored = major < 0.0;
        let heights = bed.heights();
        let turned = (0..width).flat_map(|across| {
            (0..length).map(move |along| {
                let along = if is_mirrored { length - 1 - along } else { along };
                heights[if x_is_major { across * nx + along } else { along * nx + across }]
            })
        });
        let counts = [length, width].map(usize::cast_signed);
        // A periodic line goes round twice, so that each cell sees at least one whole round.
        let rounds = if edges == Edges::Periodic { 2 } else { 1 };
        let steps = (0..rounds * length).map(|along| Between::new(along as f64, shear)).collect();
        Self { heights: turned.collect(), edges, counts, x_is_major, is_mirrored, shear, steps }
    }

    /// Where a row begins among the heights; `None` outside an open bed.
    fn row(&self, row: isize) -> Option<usize> {
        let [length, width] = self.counts;
        let inside = match self.edges {
            Edges::Periodic => Some(wrapped(row, width)),
            Edges::Open => (0..width).contains(&row).then_some(row),
        };
        inside.map(|row| (row * length).cast_unsigned())
    }

    /// Height where a line meets a step along the major axis, linear between two cells; `None` outside an open bed.
    fn height(&self, line: isize, step: &Between, along: usize) -> Option<f64> {
        let below = self.row(line + step.row)?;
        let above = if step.share > 0.0 { self.row(line + step.row + 1)? } else { below };
        Some(mix([below, above].map(|row| f64::from(self.heights[row + along])), step.share))
    }

    /// Steps from one along the major axis to where a line crosses a row of cells before the next, and the height there.
    fn crossing(&self, line: isize, step: &Between, along: usize) -> Option<[f64; 2]> {
        let (row, share) = step.crossed?;
        let row = self.row(line + row)?;
        let next = along + 1;
        let next = match self.edges {
            Edges::Periodic if next == self.counts[0].cast_unsigned() => 0,
            Edges::Open if next == self.counts[0].cast_unsigned() => return None,
            _ => next,
        };
        Some([share, mix([along, next].map(|along| f64::from(self.heights[row + along])), share)])
    }
}

impl Between {
    fn new(along: f64, shear: f64) -> Self {
        let across = [along, along + 1.0].map(|along| along * shear);
        let row = across[0].max(across[1]).floor();
        let share = (row - across[0]) / shear;
        Self {
            row: across[0].floor() as isize,
            share: across[0] - across[0].floor(),
            crossed: (share > 0.0 && share < 1.0).then_some((row as isize, share)),
        }
    }
}

/// A row that is at most a few beds away, within the bed.
fn wrapped(row: isize, count: isize) -> isize {
    if (0..count).contains(&row) { row } else { row.rem_euclid(count) }
}

fn mix([first, second]: [f64; 2], share: f64) -> f64 {
    first + share * (second - first)
}

fn one_azimuth(bed: &HeightGrid, azimuth_rad: f64, edges: Edges) -> Vec<f32> {
    let view = View::new(bed, azimuth_rad, edges);
    let [length, width] = view.counts;
    // Along an open bed lines that start outside come in from the sides; a sheared bed is up to twice as wide.
    let lines = match edges {
        Edges::Periodic => 0..width,
        Edges::Open => -length - 1..width + length + 1,
    };
    let (first_line, last_line) = (lines.start, lines.end - 1);
    let mut found = vec![0.0_f32; ((lines.end - lines.start) * length).cast_unsigned()];
    let by_line = found.par_chunks_exact_mut(length.cast_unsigned());
    by_line.zip(lines).for_each(|(found, line)| one_line(&view, line, found));
    let of_line = |line: isize, along: usize| {
        let line = match edges {
            Edges::Periodic => wrapped(line, width),
            Edges::Open => line.clamp(first_line, last_line) - first_line,
        };
        f64::from(found[(line * length).cast_unsigned() + along])
    };
    // Which lines pass on both sides of a cell, and the share of the second one.
    let beside: Vec<(isize, f64)> = (0..length)
        .map(|along| -(along as f64) * view.shear)
        .map(|line| (line.floor() as isize, line - line.floor()))
        .collect();
    let mut turned = vec![0.0; bed.heights().len()];
    turned.par_chunks_exact_mut(length.cast_unsigned()).enumerate().for_each(|(across, row)| {
        for ((along, tangent), &(line, share)) in row.iter_mut().enumerate().zip(&beside) {
            let line = across.cast_signed() + line;
            let here = of_line(line, along);
            let there = if share > 0.0 { of_line(line + 1, along) } else { here };
            *tangent = mix([here, there], share) as f32;
        }
    });
    unturned(&view, bed.size(), &turned)
}

/// Rows along the major axis as rows of the bed.
fn unturned(view: &View, [nx, ny]: [usize; 2], turned: &[f32]) -> Vec<f32> {
    let length = view.counts[0].cast_unsigned();
    let at = |x: usize, y: usize| {
        let [along, across] = if view.x_is_major { [x, y] } else { [y, x] };
        turned[across * length + if view.is_mirrored { length - 1 - along } else { along }]
    };
    (0..ny).flat_map(|y| (0..nx).map(move |x| (x, y))).map(|(x, y)| at(x, y)).collect()
}

/// Horizons along one line, a step after the other.
fn one_line(view: &View, line: isize, found: &mut [f32]) {
    let stride = view.shear.hypot(1.0);
    let mut hull: Vec<[f64; 2]> = Vec::with_capacity(64);
    let length = found.len();
    for (steps, step) in view.steps.iter().enumerate().rev() {
        let along = if steps < length { steps } else { steps - length };
        if let Some([share, height]) = view.crossing(line, step, along) {
            see(&mut hull, [(steps as f64 + share) * stride, height]);
        }
        let Some(height) = view.height(line, step, along) else { continue };
        let tangent = see(&mut hull, [steps as f64 * stride, height]);
        if let Some(found) = found.get_mut(steps) {
            *found = tangent.unwrap_or(0.0) as f32;
        }
    }
}

/// The steepest view from a place over what was passed, which the place joins.
fn see(hull: &mut Vec<[f64; 2]>, here: [f64; 2]) -> Option<f64> {
    let slope = |to: [f64; 2]| (to[1] - here[1]) / (to[0] - here[0]);
    while let [.., behind, top] = hull[..] {
        // All lie ahead, so that slopes compare without a division.
        let [near, far] = [top, behind].map(|to| [to[0] - here[0], to[1] - here[1]]);
        if far[1] * near[0] < near[1] * far[0] {
            break;
        }
        hull.pop();
    }
    let steepest = hull.last().map(|top| slope(*top));
    hull.push(here);
    steepest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hash::cell_word;

    fn rough(size: [usize; 2]) -> HeightGrid {
        let height = |cell: u32| (cell_word(7, cell) >> 20) as f32 / 512.0;
        HeightGrid::new(size, (0..(size[0] * size[1]) as u32).map(height).collect()).unwrap()
    }

    /// The steepest view from a cell along one axis, by looking at every cell.
    fn brute_force(bed: &HeightGrid, [x, y]: [isize; 2], [dx, dy]: [isize; 2], edges: Edges) -> f64 {
        let count = if dx == 0 { 16 } else { 32 };
        let cells = (1..=count).map(|far| (far, x + far * dx, y + far * dy));
        let inside = cells.filter(|(_, x, y)| edges == Edges::Periodic || ((0..32).contains(x) && (0..16).contains(y)));
        let views = inside.map(|(far, there_x, there_y)| (bed.at(there_x, there_y) - bed.at(x, y)) / far as f64);
        views.reduce(f64::max).unwrap_or(0.0)
    }

    #[test]
    fn along_the_axes_the_horizon_is_the_steepest_view_of_all() {
        let bed = rough([32, 16]);
        for edges in [Edges::Periodic, Edges::Open] {
            let map = HorizonMap::new(&bed, 4, edges).unwrap();
            for (azimuth, axis) in [[1, 0], [0, 1], [-1, 0], [0, -1]].into_iter().enumerate() {
                for ([x, y], &found) in bed.cells().zip(map.tangents(azimuth)) {
                    let off = f64::from(found) - brute_force(&bed, [x, y], axis, edges);
                    // Tangents are stored as f32.
                    assert!(off.abs() < 1e-5, "({x}, {y}), azimuth {azimuth}, {edges:?}: off by {off}");
                }
            }
        }
    }

    #[test]
    fn a_ridge_is_seen_at_the_same_height_from_every_oblique_azimuth() {
        // A wall of 10 cells along x at y = 100: from y the tangent is 10 / distance along the view.
        let wall = |index: usize| if index / 256 == 100 { 10.0 } else { 0.0 };
        let bed = HeightGrid::new([256, 256], (0..256 * 256).map(wall).collect()).unwrap();
        let map = HorizonMap::new(&bed, 16, Edges::Periodic).unwrap();
        for azimuth in 1..8 {
            let azimuth_rad = TAU * f64::from(azimuth) / 16.0;
            let distance = 30.0 / azimuth_rad.sin();
            let found = map.tangent(70 * 256 + 128, azimuth_rad);
            // The line is off by half a cell at most.
            let allowed = 10.0 / (distance - 1.5) - 10.0 / distance;
            assert!(
                (found - 10.0 / distance).abs() <= allowed,
                "azimuth {azimuth}: {found}, expected {}",
                10.0 / distance
            );
        }
    }

    #[test]
    fn level_ground_sees_the_whole_sky_and_half_the_setting_sun() {
        let bed = HeightGrid::new([16, 16], vec![3.0; 256]).unwrap();
        let map = HorizonMap::new(&bed, 8, Edges::Open).unwrap();
        assert!((map.sky_openness(100) - 1.0).abs() < 1e-12, "sky {}", map.sky_openness(100));
        assert!((map.sun_visibility(100, 1.0, 0.0) - 0.5).abs() < 1e-12, "half of the disc");
        assert!(map.sun_visibility(100, 1.0, 0.005) > 1.0 - 1e-12, "all of it");
        assert!(map.sun_visibility(100, 1.0, -0.005) < 1e-12, "none of it");
    }

    #[test]
    fn too_few_azimuths_are_refused() {
        let bed = HeightGrid::new([16, 16], vec![3.0; 256]).unwrap();
        let message = HorizonMap::new(&bed, 2, Edges::Open).unwrap_err().to_string();
        assert_eq!(message, "number of azimuths = 2 is outside 4 to 64", "names the value");
    }
}

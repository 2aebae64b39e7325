//! What a sky of cells amounts to: cover, heights, humidity against the percolation threshold, fractal dimension.

use tyndall_core::grid::Grid2;

use crate::bit_field::{BitField, HEIGHTS_PER_LAYER};
use crate::edges::Edges;
use crate::fields::CloudFields;

/// Share of humid cells at which one activated cell begins to fill the whole box: below, clouds stay small, above 0.2 one
/// cloud fills everything. Measured for the eleven neighbours; the most telling number of all.
pub const PERCOLATION_HUMIDITY: f64 = 0.165;

/// Figures of one state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CloudStatistics {
    /// Share of columns with cloud.
    pub cover: f64,
    /// Share of cells with cloud.
    pub cloud: f64,
    /// Share of humid cells.
    pub humidity: f64,
    /// Share of activated cells.
    pub activation: f64,
    /// Share of humid cells within the columns and heights that have cloud or vapour, over [`PERCOLATION_HUMIDITY`]: clouds
    /// stay separate below 1 and join above.
    pub percolation: f64,
    /// Lowest height with cloud (cells); 0 without cloud.
    pub base_cells: u32,
    /// Height above the highest cloud (cells); 0 without cloud.
    pub top_cells: u32,
}

impl CloudStatistics {
    /// Of a state.
    #[must_use]
    pub fn of(fields: &CloudFields) -> Self {
        let [nx, ny, nz] = fields.size();
        let cells = (nx * ny * nz) as f64;
        let [hum, act, cld] = fields.counts().map(|count| count as f64);
        let occupied = occupied_heights(&fields.cld);
        let moist = moist_cells(fields);
        Self {
            cover: cover(&fields.cld),
            cloud: cld / cells,
            humidity: hum / cells,
            activation: act / cells,
            percolation: if moist > 0 { hum / moist as f64 / PERCOLATION_HUMIDITY } else { 0.0 },
            base_cells: occupied.map_or(0, |(base, _)| base),
            top_cells: occupied.map_or(0, |(_, top)| top),
        }
    }
}

/// Whether there is cloud above each place of the ground.
#[must_use]
pub fn project(cld: &BitField) -> Grid2<bool> {
    let [nx, ny, _] = cld.size();
    let layers = 0..cld.layer_count();
    Grid2::from_fn([nx, ny], |x, y| layers.clone().any(|layer| cld.row(layer, y)[x] != 0))
}

/// Share of columns with cloud.
#[must_use]
pub fn cover(cld: &BitField) -> f64 {
    let projection = project(cld);
    let cells = projection.cells();
    cells.iter().filter(|&&cloud| cloud).count() as f64 / cells.len().max(1) as f64
}

/// Number of bits of each height.
fn height_counts(field: &BitField) -> Vec<u64> {
    let [_, ny, nz] = field.size();
    let rows = |layer: usize| (0..ny).flat_map(move |y| field.row(layer, y));
    let count = |z: usize| {
        rows(z / HEIGHTS_PER_LAYER).filter(|word| (*word >> (z % HEIGHTS_PER_LAYER)) & 1 == 1).count() as u64
    };
    (0..nz).map(count).collect()
}

/// The lowest height with cloud and the first above the highest.
fn occupied_heights(cld: &BitField) -> Option<(u32, u32)> {
    let counts = height_counts(cld);
    let base = counts.iter().position(|&count| count > 0)?;
    let top = counts.iter().rposition(|&count| count > 0)? + 1;
    Some((u32::try_from(base).ok()?, u32::try_from(top).ok()?))
}

/// Cells of the columns that have vapour or cloud, between the lowest and the highest of all.
fn moist_cells(fields: &CloudFields) -> u64 {
    let (hum, cld) = (height_counts(&fields.hum), height_counts(&fields.cld));
    let heights = hum.iter().zip(&cld).filter(|(hum, cld)| **hum + **cld > 0).count() as u64;
    let (wet, clouded) = (project(&fields.hum), project(&fields.cld));
    let columns = wet.cells().iter().zip(clouded.cells()).filter(|(wet, clouded)| **wet || **clouded).count() as u64;
    heights * columns
}

/// Area and perimeter of a projection: covered cells, and bare cells beside a covered one.
#[must_use]
pub fn area_and_perimeter(projection: &Grid2<bool>) -> [u64; 2] {
    let [nx, ny] = projection.size();
    let covered = |x: Option<usize>, y: Option<usize>| match (x, y) {
        (Some(x), Some(y)) if x < nx && y < ny => projection[[x, y]],
        _ => false,
    };
    let mut figures = [0; 2];
    // One cell more on each side, where a covered edge has its bare neighbours.
    for (x, y) in (0..ny + 2).flat_map(|y| (0..nx + 2).map(move |x| (x, y))) {
        let [left, here, right] = [x.checked_sub(2), x.checked_sub(1), Some(x)];
        let [below, level, above] = [y.checked_sub(2), y.checked_sub(1), Some(y)];
        if covered(here, level) {
            figures[0] += 1;
        } else if covered(left, level) || covered(right, level) || covered(here, below) || covered(here, above) {
            figures[1] += 1;
        }
    }
    figures
}

/// [`area_and_perimeter`] of each cloud of a projection by itself: covered cells that touch by their sides are one cloud, over
/// the edges of a wrapped grid too.
#[must_use]
pub fn separate_clouds(projection: &Grid2<bool>, edges: Edges) -> Vec<[u64; 2]> {
    let padded;
    let projection = if edges == Edges::Open {
        padded = with_bare_rim(projection);
        &padded
    } else {
        projection
    };
    let (clouds, count) = numbered_clouds(projection, edges);
    let [nx, ny] = projection.size();
    let mut figures = vec![[0; 2]; count];
    for place in (0..ny).flat_map(|y| (0..nx).map(move |x| [x, y])) {
        if clouds[place] > 0 {
            figures[clouds[place] - 1][0] += 1;
            continue;
        }
        let mut beside = neighbours(place, [nx, ny], edges).map(|cell| cell.map_or(0, |cell| clouds[cell]));
        beside.sort_unstable();
        for (index, &cloud) in beside.iter().enumerate() {
            // A bare cell counts once for each cloud beside it.
            if cloud > 0 && (index == 0 || beside[index - 1] != cloud) {
                figures[cloud - 1][1] += 1;
            }
        }
    }
    figures
}

/// A projection with a bare cell more on each side.
fn with_bare_rim(projection: &Grid2<bool>) -> Grid2<bool> {
    let [nx, ny] = projection.size();
    let inside = |x: usize, y: usize| (1..=nx).contains(&x) && (1..=ny).contains(&y);
    Grid2::from_fn([nx + 2, ny + 2], |x, y| inside(x, y) && projection[[x - 1, y - 1]])
}

/// The number of the cloud that covers each place, from 1, or 0; and how many there are.
fn numbered_clouds(projection: &Grid2<bool>, edges: Edges) -> (Grid2<usize>, usize) {
    let [nx, ny] = projection.size();
    let mut clouds = Grid2::filled([nx, ny], 0);
    let mut count = 0;
    for first in (0..ny).flat_map(|y| (0..nx).map(move |x| [x, y])) {
        if !projection[first] || clouds[first] > 0 {
            continue;
        }
        count += 1;
        clouds[first] = count;
        let mut open = vec![first];
        while let Some([x, y]) = open.pop() {
            for next in neighbours([x, y], [nx, ny], edges).into_iter().flatten() {
                if projection[next] && clouds[next] == 0 {
                    clouds[next] = count;
                    open.push(next);
                }
            }
        }
    }
    (clouds, count)
}

/// The four cells beside a cell, as far as they exist.
fn neighbours([x, y]: [usize; 2], [nx, ny]: [usize; 2], edges: Edges) -> [Option<[usize; 2]>; 4] {
    let wraps = edges == Edges::Wrap;
    let before = |place: usize, count: usize| place.checked_sub(1).or(wraps.then_some(count - 1));
    let after = |place: usize, count: usize| if place + 1 < count { Some(place + 1) } else { wraps.then_some(0) };
    [
        before(x, nx).map(|x| [x, y]),
        after(x, nx).map(|x| [x, y]),
        before(y, ny).map(|y| [x, y]),
        after(y, ny).map(|y| [x, y]),
    ]
}

/// Dimension D of perimeter ~ area^(D/2), by least squares of the logarithms, and its standard error; none for fewer than
/// three clouds or clouds of one size.
#[must_use]
pub fn area_perimeter_dimension(figures: &[[u64; 2]]) -> Option<(f64, f64)> {
    let points: Vec<_> = figures.iter().map(|figure| figure.map(|value| (value as f64).ln())).collect();
    let count = points.len() as f64;
    let mean = |axis: usize| points.iter().map(|point| point[axis]).sum::<f64>() / count;
    let [area, perimeter] = [mean(0), mean(1)];
    let sum = |f: &dyn Fn(&[f64; 2]) -> f64| points.iter().map(f).sum::<f64>();
    let spread = sum(&|point| (point[0] - area).powi(2));
    if points.len() < 3 || spread <= 0.0 {
        return None;
    }
    let slope = sum(&|point| (point[0] - area) * (point[1] - perimeter)) / spread;
    let residual = sum(&|point| (point[1] - perimeter - slope * (point[0] - area)).powi(2));
    Some((2.0 * slope, 2.0 * (residual / (count - 2.0) / spread).sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Automaton, AutomatonConfig, Probabilities};

    #[test]
    fn a_square_has_dimension_one_and_its_sides_as_perimeter() {
        let square = |side: usize| area_and_perimeter(&Grid2::from_fn([40, 40], |x, y| x < side && y < side));
        assert_eq!(square(3), [9, 12], "cells and their bare neighbours, at the grid's corner too");
        let (dimension, error) = area_perimeter_dimension(&[square(2), square(5), square(11), square(30)]).unwrap();
        assert!((dimension - 1.0).abs() < 1e-12 && error < 1e-12, "{dimension} +- {error}");
        assert!(area_perimeter_dimension(&[[9, 12], [9, 12], [9, 12]]).is_none(), "one size only");
    }

    #[test]
    fn clouds_are_told_apart_and_a_wrapped_one_is_whole() {
        let bar = |x: usize, y: usize| y == 4 && !(3..8).contains(&x);
        let square = |x: usize, y: usize| (4..6).contains(&x) && (6..8).contains(&y);
        let sky = Grid2::from_fn([10, 10], |x, y| bar(x, y) || square(x, y));
        let figures = |edges| {
            let mut figures = separate_clouds(&sky, edges);
            figures.sort_unstable();
            figures
        };
        assert_eq!(figures(Edges::Open), [[2, 6], [3, 8], [4, 8]], "two ends of a bar and a square");
        assert_eq!(figures(Edges::Wrap), [[4, 8], [5, 12]], "the ends are one bar");
        let one = separate_clouds(&Grid2::from_fn([7, 7], |x, y| x < 3 && y < 3), Edges::Open);
        assert_eq!(one, [[9, 12]], "as the whole projection's");
    }

    #[test]
    fn cover_base_and_top_are_counted() {
        let mut fields = CloudFields::new([10, 10, 40]).unwrap();
        fields.cld.set([1, 2, 5], true);
        fields.cld.set([1, 2, 35], true);
        fields.cld.set([7, 7, 20], true);
        let statistics = CloudStatistics::of(&fields);
        assert!((statistics.cover - 0.02).abs() < 1e-12 && (statistics.cloud - 3.0 / 4000.0).abs() < 1e-12, "shares");
        assert_eq!((statistics.base_cells, statistics.top_cells), (5, 36), "heights");
    }

    /// The protocol of the published measurement: one seed near the floor of a box with the percolating share of humid cells,
    /// the pure rule until nothing is active, the cloud's projection.
    #[test]
    fn projected_clouds_are_as_ragged_as_those_of_nagel_and_raschke() {
        let size = [81, 81, 48];
        let cloud = |seed: u64| {
            let mut automaton = Automaton::new(&AutomatonConfig { size, seed, ..AutomatonConfig::default() }).unwrap();
            automaton.moisten(&[Box::new(Probabilities { humidity: 0.17, ..Probabilities::default() })]);
            automaton.activate([40, 40, 4]);
            while automaton.fields().counts()[1] > 0 {
                automaton.step();
            }
            area_and_perimeter(&project(&automaton.fields().cld))
        };
        let figures: Vec<_> = (0..1000).map(cloud).filter(|figure| (10..2500).contains(&figure[0])).collect();
        assert!(figures.len() >= 300, "{} clouds in the range of areas", figures.len());
        let (dimension, error) = area_perimeter_dimension(&figures).unwrap();
        assert!((1.38..=1.48).contains(&dimension) && error < 0.02, "D = {dimension} +- {error}");
    }
}

//! Balls sorted into the cells of a plane: each is listed in every cell that its disc touches.

use crate::metaballs::Metaball;
use crate::narrow::narrow;

/// Most cells of a plane.
const MOST_CELLS: f64 = 4e6;

/// A ball as light sees it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Disc {
    /// Place on the plane (m).
    pub(super) place: [f32; 2],
    /// Place along the light, larger nearer to it (m).
    pub(super) toward: f32,
    /// One over the radius (1/m).
    pub(super) per_radius: f32,
    /// Optical depth through the centre over [`super::column::column`] there.
    pub(super) peak: f32,
}

/// Discs of a group.
pub(super) const LANES: usize = 8;

/// Discs side by side, as vector instructions take them; places without a disc have no peak.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct DiscGroup {
    /// As in [`Disc`].
    pub(super) place: [[f32; LANES]; 2],
    /// As in [`Disc`].
    pub(super) toward: [f32; LANES],
    /// As in [`Disc`].
    pub(super) per_radius: [f32; LANES],
    /// As in [`Disc`].
    pub(super) peak: [f32; LANES],
}

impl DiscGroup {
    fn set(&mut self, lane: usize, disc: &Disc) {
        let Disc { place, toward, per_radius, peak } = *disc;
        (self.place[0][lane], self.place[1][lane], self.toward[lane]) = (place[0], place[1], toward);
        (self.per_radius[lane], self.peak[lane]) = (per_radius, peak);
    }

    /// The discs one by one, with those that are not there.
    pub(super) fn discs(&self) -> impl Iterator<Item = Disc> {
        (0..LANES).map(|lane| Disc {
            place: [self.place[0][lane], self.place[1][lane]],
            toward: self.toward[lane],
            per_radius: self.per_radius[lane],
            peak: self.peak[lane],
        })
    }
}

/// Unit vectors: two across a direction, and the direction itself.
#[derive(Clone, Copy, Debug)]
pub(super) struct LightAxes {
    origin: [f64; 3],
    axes: [[f64; 3]; 3],
}

impl LightAxes {
    /// About a point, for a direction of length 1.
    pub(super) fn new(origin: [f64; 3], [x, y, z]: [f64; 3]) -> Self {
        // Frisvad's basis, whose only singular direction is straight down.
        let across = if z < -0.999_999 {
            [[0.0, -1.0, 0.0], [-1.0, 0.0, 0.0]]
        } else {
            let (a, b) = (1.0 / (1.0 + z), -x * y / (1.0 + z));
            [[1.0 - x * x * a, b, -x], [b, 1.0 - y * y * a, -y]]
        };
        Self { origin, axes: [across[0], across[1], [x, y, z]] }
    }

    /// A point (m) in these axes.
    pub(super) fn place(&self, point_m: [f32; 3]) -> [f32; 3] {
        let from = [0, 1, 2].map(|axis| f64::from(point_m[axis]) - self.origin[axis]);
        self.axes.map(|axis| narrow(axis[0] * from[0] + axis[1] * from[1] + axis[2] * from[2]))
    }

    /// A vector in these axes as one of the world.
    pub(super) fn world(&self, vector: [f32; 3]) -> [f32; 3] {
        let [a, b, c] = self.axes;
        [0, 1, 2].map(|axis| {
            let parts = f64::from(vector[0]) * a[axis] + f64::from(vector[1]) * b[axis];
            narrow(parts + f64::from(vector[2]) * c[axis])
        })
    }

    /// A ball in these axes.
    pub(super) fn disc(&self, ball: &Metaball) -> Disc {
        let [u, v, toward] = self.place(ball.centre_m);
        let peak = ball.extinction_per_m * ball.radius_m;
        Disc { place: [u, v], toward, per_radius: 1.0 / ball.radius_m, peak }
    }
}

/// The cells.
#[derive(Debug)]
pub(super) struct Bins {
    low: [f32; 2],
    side: f32,
    count: [usize; 2],
    /// The first group of each cell.
    starts: Vec<usize>,
    groups: Vec<DiscGroup>,
}

impl Bins {
    /// Sorts the discs; those of a cell keep their order.
    pub(super) fn new(discs: &[Disc]) -> Self {
        let mut low = [f32::INFINITY; 2];
        let mut high = [f32::NEG_INFINITY; 2];
        let mut radii = 0.0;
        for disc in discs {
            for axis in 0..2 {
                low[axis] = low[axis].min(disc.place[axis]);
                high[axis] = high[axis].max(disc.place[axis]);
            }
            radii += f64::from(1.0 / disc.per_radius);
        }
        if discs.is_empty() {
            (low, high) = ([0.0; 2], [0.0; 2]);
        }
        let extent = [0, 1].map(|axis| f64::from(high[axis]) - f64::from(low[axis]));
        let mean = radii / discs.len().max(1) as f64;
        let side = narrow(
            mean.max((extent[0] * extent[1] / MOST_CELLS).sqrt()).max(extent[0].max(extent[1]) / MOST_CELLS).max(1e-6),
        );
        let count = [0, 1].map(|axis| whole(narrow(extent[axis]) / side) + 1);
        let mut bins = Self { low, side, count, starts: vec![0; count[0] * count[1] + 1], groups: Vec::new() };
        bins.fill(discs);
        bins
    }

    fn fill(&mut self, discs: &[Disc]) {
        let mut counts = vec![0_usize; self.starts.len() - 1];
        for disc in discs {
            self.for_cells(disc, |cell| counts[cell] += 1);
        }
        for (cell, count) in counts.iter().enumerate() {
            self.starts[cell + 1] = self.starts[cell] + count.div_ceil(LANES);
        }
        let mut groups = vec![DiscGroup::default(); self.starts[counts.len()]];
        counts.fill(0);
        for disc in discs {
            self.for_cells(disc, |cell| {
                groups[self.starts[cell] + counts[cell] / LANES].set(counts[cell] % LANES, disc);
                counts[cell] += 1;
            });
        }
        self.groups = groups;
    }

    fn for_cells(&self, disc: &Disc, mut visit: impl FnMut(usize)) {
        let radius = 1.0 / disc.per_radius;
        let [columns, rows] = [0, 1].map(|axis| {
            let cell = |place: f32| whole((place - self.low[axis]) / self.side).min(self.count[axis] - 1);
            cell(disc.place[axis] - radius)..=cell(disc.place[axis] + radius)
        });
        for row in rows {
            for column in columns.clone() {
                visit(row * self.count[0] + column);
            }
        }
    }

    /// The discs that may cover a place.
    pub(super) fn near(&self, place: [f32; 2]) -> &[DiscGroup] {
        let [column, row] =
            [0, 1].map(|axis| whole((place[axis] - self.low[axis]) / self.side).min(self.count[axis] - 1));
        let cell = row * self.count[0] + column;
        &self.groups[self.starts[cell]..self.starts[cell + 1]]
    }
}

/// The whole part of a number of cells, 0 for what is below.
#[expect(clippy::cast_possible_truncation, reason = "negative and huge numbers are meant to saturate")]
fn whole(cells: f32) -> usize {
    cells as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_disc_that_covers_a_place_is_listed_there() {
        let disc = |i: u16| Disc {
            place: [f32::from(i % 23) * 3.1, f32::from(i % 17) * 5.3],
            toward: f32::from(i),
            per_radius: 1.0 / (1.0 + f32::from(i % 9)),
            peak: 1.0,
        };
        let discs: Vec<_> = (0..300).map(disc).collect();
        let bins = Bins::new(&discs);
        for place in [[0.0, 0.0], [33.3, 40.0], [68.2, 84.8], [10.0, 71.9]] {
            let covers = |disc: &Disc| {
                let away = (disc.place[0] - place[0]).hypot(disc.place[1] - place[1]);
                away * disc.per_radius < 1.0 && disc.peak > 0.0
            };
            let wanted: Vec<_> = discs.iter().filter(|disc| covers(disc)).map(|disc| disc.toward.to_bits()).collect();
            let near = bins.near(place).iter().flat_map(DiscGroup::discs).filter(covers);
            let found: Vec<_> = near.map(|disc| disc.toward.to_bits()).collect();
            assert_eq!(found, wanted, "at {place:?}");
        }
        assert!(Bins::new(&[]).near([3.0, 4.0]).is_empty(), "nothing among none");
    }

    #[test]
    fn the_axes_of_light_are_square_to_each_other_for_every_direction() {
        for direction in [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [0.6, 0.0, 0.8], [-0.6, 0.64, -0.48]] {
            let LightAxes { axes: [a, b, c], .. } = LightAxes::new([0.0; 3], direction);
            let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            for (value, wanted) in
                [(dot(a, b), 0.0), (dot(a, c), 0.0), (dot(b, c), 0.0), (dot(a, a), 1.0), (dot(b, b), 1.0)]
            {
                assert!((value - wanted).abs() < 1e-12, "{direction:?}: {value}");
            }
        }
    }
}

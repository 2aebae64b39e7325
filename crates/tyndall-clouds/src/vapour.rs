//! Layouts of humid air: which ellipsoids a pattern of vapour consists of.

use tyndall_core::rng::CellRng;

use crate::edges::Edges;
use crate::ellipsoids::Ellipsoid;
use crate::params::{CloudParams, VapourPattern};

/// Stream of the random numbers that place bubbles.
const STREAM_PLACE: u32 = 33;
/// Most bubbles of a layout; beyond it a step's probabilities cost more than the step.
const MAX_BUBBLES: usize = 4000;
/// Bubbles of a tower.
const TOWER_STOREYS: usize = 4;

impl VapourPattern {
    /// Parameters that show the pattern well; a preset.
    #[must_use]
    pub fn preset(self) -> CloudParams {
        let mut params = CloudParams::default();
        params.vapour.pattern = self;
        let (grid, vapour) = (&mut params.grid, &mut params.vapour);
        match self {
            Self::CumulusField => {}
            Self::Stratocumulus => {
                (grid.cell_m, grid.cells_up, grid.floor_m) = (40.0, 24, 700.0);
                (vapour.cover, vapour.bubble_radius_m, vapour.bubble_height_m) = (0.9, 900.0, 380.0);
                (vapour.bubble_spread, vapour.base_m) = (0.25, 120.0);
                (vapour.humidity, vapour.activation, vapour.extinction) = (0.2, 0.02, 0.05);
            }
            Self::Towering => {
                (grid.cell_m, grid.cells_up, grid.floor_m) = (60.0, 96, 800.0);
                (vapour.cover, vapour.bubble_radius_m, vapour.bubble_height_m) = (0.14, 1300.0, 4400.0);
                (vapour.bubble_spread, vapour.base_m) = (0.4, 200.0);
                (vapour.humidity, vapour.activation, vapour.extinction) = (0.2, 0.01, 0.04);
                // Shear would lean the towers over within minutes.
                (params.wind.ceiling_speed_m_s, params.wind.ceiling_from_deg) = (3.6, 240.0);
            }
            Self::SeaOfClouds => {
                (grid.cell_m, grid.cells_up, grid.floor_m) = (60.0, 32, 800.0);
                (vapour.cover, vapour.bubble_radius_m, vapour.bubble_height_m) = (1.0, 900.0, 1000.0);
                (vapour.bubble_spread, vapour.base_m) = (0.6, 180.0);
                (vapour.humidity, vapour.activation, vapour.extinction) = (0.2, 0.02, 0.04);
            }
            Self::FairWeather => {
                (grid.cell_m, grid.cells_up, grid.floor_m) = (30.0, 32, 1200.0);
                (vapour.cover, vapour.bubble_radius_m, vapour.bubble_height_m) = (0.12, 240.0, 330.0);
                (vapour.bubble_spread, vapour.base_m) = (0.6, 90.0);
                (vapour.humidity, vapour.activation, vapour.extinction) = (0.15, 0.01, 0.08);
            }
        }
        params
    }
}

/// The ellipsoids of the chosen pattern, cover and sizes; the same for the same seed.
#[must_use]
pub fn bubbles(params: &CloudParams) -> Vec<Ellipsoid> {
    let vapour = &params.vapour;
    let layout = Layout::new(params);
    match vapour.pattern {
        VapourPattern::CumulusField | VapourPattern::FairWeather => layout.scattered(layout.count(1.0)),
        VapourPattern::Towering => layout.towers(),
        VapourPattern::Stratocumulus => layout.closed_cells(),
        VapourPattern::SeaOfClouds => {
            // A thin deck without holes, and swells that stand out of it over half of the sky.
            let mut all = layout.scattered(layout.count(0.15));
            let swells = all.len();
            all.extend(layout.closed_cells());
            all.extend(layout.scattered(layout.count(0.6)).into_iter().skip(swells));
            for bubble in &mut all[swells..] {
                bubble.radii_cells[2] = (0.4 * bubble.radii_cells[2]).max(1.0);
            }
            all.truncate(MAX_BUBBLES);
            all
        }
    }
}

/// Sizes in cells, and random numbers.
struct Layout<'a> {
    params: &'a CloudParams,
    rng: CellRng,
    extent: [f64; 2],
    radius: f64,
    height: f64,
    base: f64,
    /// Room above the base, of which the largest bubbles fill most: a ceiling would cut them flat.
    room: f64,
}

impl<'a> Layout<'a> {
    fn new(params: &'a CloudParams) -> Self {
        let (grid, vapour) = (&params.grid, &params.vapour);
        Self {
            params,
            rng: CellRng::new(u64::from(grid.seed)),
            extent: [f64::from(grid.cells_east), f64::from(grid.cells_north)],
            radius: (vapour.bubble_radius_m / grid.cell_m).max(0.5),
            height: (vapour.bubble_height_m / grid.cell_m).max(0.5),
            base: vapour.base_m / grid.cell_m,
            room: 0.9 * (f64::from(grid.cells_up) - vapour.base_m / grid.cell_m).max(1.0),
        }
    }

    /// Four numbers in 0..1 of a bubble.
    fn numbers(&self, bubble: usize) -> [f64; 4] {
        self.rng.words(0, bubble as u64, STREAM_PLACE).map(|word| f64::from(word) / 4_294_967_296.0)
    }

    /// Bubbles that cover the wanted share of the sky `times` over: with bubbles at random places a share 1 - exp(-n a) is
    /// covered by n bubbles of area a.
    #[expect(clippy::cast_possible_truncation, reason = "clamped to the largest layout before the cast")]
    fn count(&self, times: f64) -> usize {
        let cover = self.params.vapour.cover.min(0.99);
        let area = std::f64::consts::PI * self.radius * self.radius / (self.extent[0] * self.extent[1]);
        (-(1.0 - cover).ln() / area * times).ceil().min(MAX_BUBBLES as f64) as usize
    }

    /// A bubble: half an ellipsoid that stands on its base.
    fn bubble(&self, [x, y]: [f64; 2], size: f64, turn: f64) -> Ellipsoid {
        // Not quite round, in two directions.
        let oval = 1.0 + 0.25 * (turn - 0.5);
        let height = (self.height * size).min(self.room);
        Ellipsoid {
            centre_cells: [x.floor() + 0.5, y.floor() + 0.5, self.base],
            radii_cells: [self.radius * size * oval, self.radius * size / oval, height].map(|r| r.max(1.0)),
            base_cells: self.base,
            strength: 1.0,
        }
    }

    /// Size of a bubble relative to the mean: many small ones and few large ones.
    fn size(&self, number: f64) -> f64 {
        let spread = self.params.vapour.bubble_spread;
        (1.0 - spread) + 3.0 * spread * number * number
    }

    fn scattered(&self, count: usize) -> Vec<Ellipsoid> {
        let place = |index| {
            let [x, y, size, turn] = self.numbers(index);
            self.bubble([x * self.extent[0], y * self.extent[1]], self.size(size), turn)
        };
        (0..count).map(place).collect()
    }

    /// Stacks of bubbles, each higher one narrower and a little aside.
    fn towers(&self) -> Vec<Ellipsoid> {
        let storey = |tower: usize, storey: usize| {
            let ([x, y, size, _], [aside, along, turn, _]) =
                (self.numbers(tower), self.numbers((tower + 1) * 64 + storey));
            let (level, size) = (storey as f64 / TOWER_STOREYS as f64, self.size(size));
            let place = [x * self.extent[0], y * self.extent[1]];
            let shift = |number: f64| (number - 0.5) * self.radius * size * 0.8;
            let width = size * (1.0 - 0.55 * level);
            let mut bubble = self.bubble([place[0] + shift(aside), place[1] + shift(along)], width, turn);
            let tower = (self.height * size).min(self.room);
            let height = tower / TOWER_STOREYS as f64;
            bubble.centre_cells[2] = self.base + (level * tower - 0.3 * height).max(0.0);
            bubble.radii_cells[2] = 1.3 * height;
            bubble
        };
        let count = self.count(1.0).min(MAX_BUBBLES / TOWER_STOREYS);
        (0..count).flat_map(|tower| (0..TOWER_STOREYS).map(move |level| storey(tower, level))).collect()
    }

    /// Bubbles on a disturbed hexagonal lattice, cut off below the middle.
    fn closed_cells(&self) -> Vec<Ellipsoid> {
        // Cloud fills nine tenths of a bubble's width: so far apart, a tenth of the sky is left between.
        let distance = 1.45 * self.radius / self.params.vapour.cover.max(0.05).sqrt();
        let counts =
            [self.extent[0] / distance, self.extent[1] / (distance * 0.75_f64.sqrt())].map(|n| n.round().max(1.0));
        let [east, north] = [self.extent[0] / counts[0], self.extent[1] / counts[1]];
        let mut all = Vec::new();
        let mut row = 0.0;
        while row < counts[1] && all.len() < MAX_BUBBLES {
            let mut column = 0.0;
            while column < counts[0] && all.len() < MAX_BUBBLES {
                let [aside, along, size, turn] = self.numbers(1_000_000 + all.len());
                let x = (column + 0.5 * (row % 2.0) + 0.4 * (aside - 0.5)) * east;
                let y = (row + 0.4 * (along - 0.5)) * north;
                all.push(self.bubble([x, y], 1.0 + self.params.vapour.bubble_spread * (size - 0.5), turn));
                column += 1.0;
            }
            row += 1.0;
        }
        if self.params.grid.edges == Edges::Wrap {
            for bubble in &mut all {
                let [x, y, _] = &mut bubble.centre_cells;
                (*x, *y) = (x.rem_euclid(self.extent[0]), y.rem_euclid(self.extent[1]));
            }
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pattern_stands_on_the_condensation_level_within_the_grid() {
        for &pattern in VapourPattern::ALL {
            let params = pattern.preset();
            let base = params.vapour.base_m / params.grid.cell_m;
            let all = bubbles(&params);
            assert!((1..=MAX_BUBBLES).contains(&all.len()), "{pattern:?}: {} bubbles", all.len());
            for bubble in all {
                let [x, y, z] = bubble.centre_cells;
                let margin = 2.0 * bubble.radii_cells[0];
                assert!((-margin..256.0 + margin).contains(&x) && (-margin..256.0 + margin).contains(&y), "{x}, {y}");
                assert!(z >= base - 1e-9 && (bubble.base_cells - base).abs() < 1e-9, "{pattern:?}: {bubble:?}");
            }
        }
    }

    #[test]
    fn more_cover_means_more_bubbles_and_another_seed_other_places() {
        let mut params = CloudParams::default();
        let few = bubbles(&params);
        assert_eq!(few, bubbles(&params), "the same seed, the same air");
        params.vapour.cover = 0.7;
        assert!(bubbles(&params).len() > few.len(), "more cover");
        params.vapour.cover = CloudParams::default().vapour.cover;
        params.grid.seed = 2;
        assert_ne!(bubbles(&params), few, "another seed");
    }
}

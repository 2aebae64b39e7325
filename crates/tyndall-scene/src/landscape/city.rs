//! A city: a grid of streets, four lots to a block, a box on most lots, tallest in the centre. WGSL reads the list of boxes
//! that [`City::buildings_near`] gives, and asks the lots themselves for shadows: `shaders/landscape/city.wgsl`.

use tyndall_core::rng::noise_pcg;

use super::M_PER_KM;
use crate::LandscapeParams;

/// Distance (m) from one street to the next.
pub const BLOCK_M: f64 = 130.0;

/// Width (m) of a street.
pub const STREET_M: f64 = 22.0;

/// Side (m) of a lot, half a block without its street.
pub const LOT_M: f64 = 0.5 * (BLOCK_M - STREET_M);

/// Share of lots without a building.
const EMPTY: f64 = 0.12;

/// A city. Lengths in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct City {
    /// Half the side of its square.
    pub half_size_m: f64,
    /// Height of the tallest buildings.
    pub tallest_m: f64,
    /// Key of the random numbers.
    pub key: u32,
}

/// A box on the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Building {
    /// West, south, east and north side.
    pub sides_m: [f64; 4],
    /// Height of the roof.
    pub height_m: f64,
    /// Random word for its looks.
    pub word: u32,
}

impl City {
    /// From its parameters.
    #[must_use]
    pub fn new(params: &LandscapeParams) -> Self {
        Self {
            half_size_m: 0.5 * params.size_km * M_PER_KM,
            tallest_m: params.building_m,
            key: noise_pcg(params.seed ^ 0x0C17_1E55),
        }
    }

    /// Altitude of the roof over a place, 0 in the streets.
    #[must_use]
    pub fn roof_m(&self, x_m: f64, y_m: f64) -> f64 {
        let inside = |building: &Building| {
            let [west, south, east, north] = building.sides_m;
            (west..=east).contains(&x_m) && (south..=north).contains(&y_m)
        };
        self.building(lot_of(x_m), lot_of(y_m)).filter(inside).map_or(0.0, |building| building.height_m)
    }

    /// The building of a lot, counted from the origin to the east and the north.
    #[must_use]
    pub fn building(&self, i: i32, j: i32) -> Option<Building> {
        let word = noise_pcg(i.cast_unsigned().wrapping_add(noise_pcg(j.cast_unsigned().wrapping_add(self.key))));
        let [taken, tall, inset, shift] = [1, 2, 3, 4].map(|k| unit(noise_pcg(word.wrapping_add(k))));
        let (west, south) = (lot_start_m(i), lot_start_m(j));
        let (x, y) = (west + 0.5 * LOT_M, south + 0.5 * LOT_M);
        let edge_m = self.half_size_m - x.abs().max(y.abs());
        if taken < EMPTY || edge_m < LOT_M {
            return None;
        }
        let [from_x, from_y] = [inset, shift].map(|share| 2.0 + 7.0 * share);
        let sides_m = [west + from_x, south + from_y, west + LOT_M - from_y, south + LOT_M - from_x];
        Some(Building { sides_m, height_m: self.height_m(x, y, tall), word })
    }

    /// Height of a building: many low ones, few tall ones, and those near the centre.
    fn height_m(&self, x_m: f64, y_m: f64, tall: f64) -> f64 {
        let from_centre = x_m.hypot(y_m) / (0.12 * self.half_size_m);
        let centre = 1.0 / (1.0 + from_centre * from_centre);
        let suburb = 1.0 / (1.0 + (0.35 * from_centre).powi(2));
        let tail = tall.powi(4);
        self.tallest_m
            * (0.03
                + 0.05 * tall
                + 0.07 * suburb * tall
                + centre * (0.1 * tall + 0.6 * tail)
                + 0.15 * suburb * tail.powi(3))
    }

    /// Buildings whose lots lie within `reach_m` of a place along each axis, in the order of the lots.
    pub fn buildings_near(&self, [x_m, y_m]: [f64; 2], reach_m: f64) -> impl Iterator<Item = Building> + use<> {
        let city = *self;
        let range = |at_m: f64| {
            let limit = city.half_size_m;
            lot_of((at_m - reach_m).clamp(-limit, limit))..=lot_of((at_m + reach_m).clamp(-limit, limit))
        };
        let (columns, rows) = (range(x_m), range(y_m));
        rows.flat_map(move |j| columns.clone().filter_map(move |i| city.building(i, j)))
    }
}

/// Number of the lot at a coordinate; streets belong to the lot before them.
#[expect(clippy::cast_possible_truncation, reason = "a city has some thousand lots")]
fn lot_of(at_m: f64) -> i32 {
    let block = (at_m / BLOCK_M).floor();
    2 * block as i32 + i32::from(at_m - block * BLOCK_M >= LOT_M)
}

/// Where a lot begins.
fn lot_start_m(index: i32) -> f64 {
    f64::from(index.div_euclid(2)) * BLOCK_M + f64::from(index.rem_euclid(2)) * LOT_M
}

/// A word as a number in 0..1.
fn unit(word: u32) -> f64 {
    f64::from(word >> 8) / 16_777_216.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::LandscapeKind;

    fn city() -> City {
        City::new(&LandscapeParams { kind: LandscapeKind::City, ..LandscapeParams::default() })
    }

    #[test]
    fn buildings_stand_on_their_lots_and_streets_are_free() {
        let city = city();
        for building in city.buildings_near([0.0, 0.0], 2000.0) {
            let [west, south, east, north] = building.sides_m;
            assert!(west < east && south < north, "{building:?}");
            assert!(building.height_m > 2.0 && building.height_m <= city.tallest_m, "{building:?}");
            let (x, y) = (0.5 * (west + east), 0.5 * (south + north));
            assert!((city.roof_m(x, y) - building.height_m).abs() < 1e-9, "{building:?} is found from its centre");
        }
        for k in 0..500 {
            let street = BLOCK_M * f64::from(k - 250) - 0.5 * STREET_M;
            assert!(city.roof_m(street, 31.0 * f64::from(k)).abs() < 1e-12, "street {k}");
        }
    }

    #[test]
    fn the_centre_is_the_tallest_part() {
        let mean = |at: [f64; 2]| {
            let heights: Vec<f64> = city().buildings_near(at, 1000.0).map(|building| building.height_m).collect();
            heights.iter().sum::<f64>() / heights.len() as f64
        };
        assert!(mean([0.0, 0.0]) > 2.0 * mean([15e3, 0.0]), "{} {}", mean([0.0, 0.0]), mean([15e3, 0.0]));
    }

    #[test]
    fn the_list_of_buildings_ends_at_the_citys_edge() {
        let city = City { half_size_m: 500.0, ..city() };
        let count = city.buildings_near([0.0, 0.0], 1e6).count();
        assert!((100..=240).contains(&count), "{count} on about 16 x 16 lots");
    }
}

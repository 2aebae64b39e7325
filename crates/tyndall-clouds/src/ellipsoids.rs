//! Ellipsoids of humid air that drift with the wind: how Dobashi et al. 2000 place clouds.
//!
//! Towards the middle of an ellipsoid vapour and activation are supplied more often and cloud vanishes less often, by
//! 1 - d^2 with d from 0 in the middle to 1 at the rim. Below a height of its own, the condensation level, an ellipsoid
//! supplies nothing, which makes the flat base that a thermal's cloud has.

use tyndall_core::rng::CellRng;

use crate::edges::Edges;
use crate::error::{CloudError, in_range};
use crate::narrow::narrow;
use crate::probability::{LayerMotion, ProbabilityLayer, ProbabilityRow};
use crate::wind::Wind;

/// Stream of the random numbers that say where new ellipsoids come in.
const STREAM_ENTRY: u32 = 32;

/// One ellipsoid of humid air.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipsoid {
    /// Middle (cells from the grid's low corner).
    pub centre_cells: [f64; 3],
    /// Half axes east, north and up (cells).
    pub radii_cells: [f64; 3],
    /// Height below which it supplies nothing (cells).
    pub base_cells: f64,
    /// Factor of the supply.
    pub strength: f64,
}

/// Probabilities of ellipsoids, per step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EllipsoidSupply {
    /// That cloud vanishes, in the middle; at the rim it is what the layers below say.
    pub extinction: f32,
    /// That a cell becomes humid, in the middle; 0 at the rim.
    pub humidity: f32,
    /// That a cell is activated, in the middle; 0 at the rim.
    pub activation: f32,
}

/// A layer of ellipsoids. Where they overlap, the stronger one counts.
#[derive(Clone, Debug)]
pub struct HumidEllipsoids {
    supply: EllipsoidSupply,
    size: [usize; 3],
    edges: Edges,
    seed: u64,
    ellipsoids: Vec<Moving>,
    /// Whether ellipsoids that move by whole cells have the same probabilities at their new place, to the last bit.
    shifts_exactly: bool,
}

/// An ellipsoid and how far it has drifted.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Moving {
    /// As it stands in the grid: a whole number of cells from where it began.
    shown: Ellipsoid,
    /// Drift that is not shown yet, below a cell.
    hidden: [f64; 2],
    /// Times it has left the grid and come in again.
    entries: u32,
}

impl HumidEllipsoids {
    /// Ellipsoids in a grid of [nx, ny, nz] cells; the seed says where those come in again that leave an open grid.
    ///
    /// # Errors
    /// When an ellipsoid's place, size or strength is not finite or not positive.
    pub fn new(
        size: [usize; 3],
        edges: Edges,
        seed: u64,
        supply: EllipsoidSupply,
        ellipsoids: &[Ellipsoid],
    ) -> Result<Self, CloudError> {
        for (index, ellipsoid) in ellipsoids.iter().enumerate() {
            for value in ellipsoid.centre_cells {
                in_range(format!("centre of ellipsoid {index}"), value, (-1e5, 1e5), " cells")?;
            }
            for value in ellipsoid.radii_cells {
                in_range(format!("radius of ellipsoid {index}"), value, (0.1, 1e5), " cells")?;
            }
            in_range(format!("base of ellipsoid {index}"), ellipsoid.base_cells, (-1e5, 1e5), " cells")?;
            in_range(format!("strength of ellipsoid {index}"), ellipsoid.strength, (0.0, 100.0), "")?;
        }
        let moving = |&shown: &Ellipsoid| Moving { shown, hidden: [0.0; 2], entries: 0 };
        let shifts_exactly = edges == Edges::Wrap && ellipsoids.iter().all(|ellipsoid| shifts_exactly(ellipsoid, size));
        let ellipsoids = ellipsoids.iter().map(moving).collect();
        Ok(Self { supply, size, edges, seed, ellipsoids, shifts_exactly })
    }

    /// The ellipsoids where they are now.
    pub fn ellipsoids(&self) -> impl Iterator<Item = &Ellipsoid> {
        self.ellipsoids.iter().map(|moving| &moving.shown)
    }

    fn apply_one(&self, ellipsoid: &Ellipsoid, east: f64, across2: f64, row: &mut ProbabilityRow) {
        let [nx, radius] = [row.extinction.len() as f64, ellipsoid.radii_cells[0]];
        let reach = radius * (1.0 - across2).sqrt();
        // A cell more on both sides, to which nothing happens: the rim may not depend on how its place is rounded.
        let [first, end] = [east - reach - 0.5, east + reach + 1.5].map(|x| cell_index(x.clamp(0.0, nx)));
        let (middle, inverse, across2) = (narrow(east), narrow(1.0 / radius), narrow(across2));
        let strength = narrow(ellipsoid.strength);
        let [humidity, activation] = [self.supply.humidity, self.supply.activation].map(|p| p * strength);
        for x in first..end {
            let away = (x as f32 + 0.5 - middle) * inverse;
            let inside = (1.0 - away * away - across2).max(0.0);
            row.humidity[x] = row.humidity[x].max(humidity * inside);
            row.activation[x] = row.activation[x].max(activation * inside);
            let extinction = row.extinction[x] + (self.supply.extinction - row.extinction[x]) * inside;
            row.extinction[x] = row.extinction[x].min(extinction);
        }
    }
}

/// The whole part of a place in a grid.
#[expect(clippy::cast_possible_truncation, reason = "clamped to the grid by the caller")]
fn cell_index(place: f64) -> usize {
    place as usize
}

impl ProbabilityLayer for HumidEllipsoids {
    fn apply(&self, y: usize, z: usize, row: &mut ProbabilityRow) {
        let [width, depth] = [self.size[0] as f64, self.size[1] as f64];
        let images: &[f64] = if self.edges == Edges::Wrap { &[-1.0, 0.0, 1.0] } else { &[0.0] };
        for Moving { shown, .. } in &self.ellipsoids {
            let up = (z as f64 + 0.5 - shown.centre_cells[2]) / shown.radii_cells[2];
            if up * up >= 1.0 || z as f64 + 0.5 < shown.base_cells {
                continue;
            }
            for north in images {
                let across = (y as f64 + 0.5 - shown.centre_cells[1] - north * depth) / shown.radii_cells[1];
                let across2 = up * up + across * across;
                if across2 >= 1.0 {
                    continue;
                }
                for east in images {
                    self.apply_one(shown, shown.centre_cells[0] + east * width, across2, row);
                }
            }
        }
    }

    fn blow(&mut self, wind: &Wind) -> LayerMotion {
        let (size, edges, rng) = (self.size, self.edges, CellRng::new(self.seed));
        let mut shifts = Vec::with_capacity(self.ellipsoids.len());
        for (moving, index) in self.ellipsoids.iter_mut().zip(0..) {
            let shift = drift(moving, wind, size);
            if shift != [0; 2] {
                enter_again(moving, size, edges, rng, index);
            }
            shifts.push(shift);
        }
        match shifts.first() {
            _ if shifts.iter().all(|shift| *shift == [0; 2]) => LayerMotion::Still,
            Some(first) if self.shifts_exactly && shifts.iter().all(|shift| shift == first) => {
                LayerMotion::Shifted(*first)
            }
            _ => LayerMotion::Changed,
        }
    }

    fn state(&self) -> Vec<f64> {
        let numbers = |m: &Moving| {
            let Ellipsoid { centre_cells: [x, y, _], .. } = m.shown;
            [x, y, m.hidden[0], m.hidden[1], f64::from(m.entries)]
        };
        self.ellipsoids.iter().flat_map(numbers).collect()
    }

    #[expect(clippy::cast_possible_truncation, reason = "a count that `state` wrote")]
    fn restore(&mut self, state: &[f64]) -> Result<(), CloudError> {
        let (found, expected) = (state.len(), 5 * self.ellipsoids.len());
        if found != expected {
            return Err(CloudError::WrongLength { what: "the state of the ellipsoids".to_owned(), found, expected });
        }
        for (moving, numbers) in self.ellipsoids.iter_mut().zip(state.chunks_exact(5)) {
            moving.shown.centre_cells[0] = numbers[0];
            moving.shown.centre_cells[1] = numbers[1];
            moving.hidden = [numbers[2], numbers[3]];
            moving.entries = numbers[4] as u32;
        }
        Ok(())
    }
}

/// Whether the numbers that `apply` computes depend on the columns' distance from the middle alone: at half cells differences
/// are exact, and an ellipsoid narrower than the grid meets no cell twice.
fn shifts_exactly(ellipsoid: &Ellipsoid, size: [usize; 3]) -> bool {
    [0, 1].into_iter().all(|axis| {
        let (place, side) = (ellipsoid.centre_cells[axis], size[axis] as f64);
        let at_half_cell = (2.0 * place).fract().abs() <= 0.0;
        at_half_cell && (0.0..side).contains(&place) && 2.0 * ellipsoid.radii_cells[axis] <= side
    })
}

/// Moves an ellipsoid by a step of the wind in its middle; by how many whole cells.
#[expect(clippy::cast_possible_truncation, reason = "winds are limited to 64 cells a step")]
fn drift(moving: &mut Moving, wind: &Wind, size: [usize; 3]) -> [i64; 2] {
    let height = cell_index(moving.shown.centre_cells[2].clamp(0.0, size[2] as f64 - 1.0));
    let speed = wind.speed_cells(height);
    [0, 1].map(|axis| {
        moving.hidden[axis] += speed[axis];
        let whole = moving.hidden[axis].floor();
        moving.hidden[axis] -= whole;
        moving.shown.centre_cells[axis] += whole;
        whole as i64
    })
}

/// Lets an ellipsoid that has left the grid come in on the other side: in an open grid at another place along that side.
fn enter_again(moving: &mut Moving, size: [usize; 3], edges: Edges, rng: CellRng, index: u64) {
    for axis in [0, 1] {
        let width = size[axis] as f64;
        let place = moving.shown.centre_cells[axis];
        if edges == Edges::Wrap {
            moving.shown.centre_cells[axis] = place.rem_euclid(width);
            continue;
        }
        let reach = moving.shown.radii_cells[axis];
        let way = width + 2.0 * reach;
        let back = if place - reach > width { -way } else { way };
        if place - reach > width || place + reach < 0.0 {
            moving.entries += 1;
            let share = f64::from(rng.uniform(moving.entries, index, STREAM_ENTRY));
            moving.shown.centre_cells[axis] += back;
            moving.shown.centre_cells[1 - axis] = (share * size[1 - axis] as f64).floor();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Probabilities, WindProfile};

    const SUPPLY: EllipsoidSupply = EllipsoidSupply { extinction: 0.02, humidity: 0.2, activation: 0.01 };

    fn one(edges: Edges, centre_cells: [f64; 3]) -> HumidEllipsoids {
        let ellipsoid = Ellipsoid { centre_cells, radii_cells: [8.0, 6.0, 5.0], base_cells: 4.0, strength: 1.0 };
        HumidEllipsoids::new([40, 30, 20], edges, 1, SUPPLY, &[ellipsoid]).unwrap()
    }

    fn row(layer: &HumidEllipsoids, y: usize, z: usize) -> ProbabilityRow {
        let mut row = ProbabilityRow::zeros(40);
        row.fill(Probabilities { extinction: 0.3, ..Probabilities::default() });
        layer.apply(y, z, &mut row);
        row
    }

    #[test]
    fn supply_falls_from_the_middle_to_nothing_at_the_rim_and_below_the_base() {
        let layer = one(Edges::Open, [20.5, 15.5, 6.5]);
        let middle = row(&layer, 15, 6);
        assert!((middle.humidity[20] - 0.2).abs() < 1e-6 && (middle.extinction[20] - 0.02).abs() < 1e-6, "middle");
        assert!((middle.humidity[24] - 0.2 * 0.75).abs() < 1e-6, "half way: 1 - 1/4");
        assert!(middle.humidity[28] < 1e-6 && (middle.extinction[28] - 0.3).abs() < 1e-6, "rim");
        assert!(row(&layer, 15, 3).humidity.iter().all(|p| *p < 1e-6), "below the base");
        assert!(row(&layer, 21, 6).humidity.iter().all(|p| *p < 1e-6), "beside it");
    }

    #[test]
    fn in_a_wrapped_grid_an_ellipsoid_reaches_over_the_edge() {
        let layer = one(Edges::Wrap, [0.5, 0.5, 6.5]);
        let found = row(&layer, 29, 6);
        assert!((found.humidity[39] - found.humidity[1]).abs() < 1e-6, "both sides alike");
        assert!(found.humidity[39] > 0.1, "{}", found.humidity[39]);
    }

    #[test]
    fn ellipsoids_drift_with_the_wind_of_their_height_and_come_in_again() {
        let mut layer = one(Edges::Open, [20.0, 15.0, 6.0]);
        let wind = Wind::new(WindProfile::uniform([0.5, 0.0]).unwrap(), 20);
        let changes = (0..10).filter(|_| layer.blow(&wind) != LayerMotion::Still).count();
        assert_eq!(changes, 5, "five whole cells in ten steps");
        let centre = layer.ellipsoids().next().unwrap().centre_cells;
        assert!((centre[0] - 25.0).abs() < 1e-9 && (centre[1] - 15.0).abs() < 1e-9, "{centre:?}");
        for _ in 0..50 {
            layer.blow(&wind);
        }
        let centre = layer.ellipsoids().next().unwrap().centre_cells;
        // 20 + 60 * 0.5 = 50 is past 40 + 8: it came in at 50 - 56.
        assert!((-8.0..0.0).contains(&centre[0]) && (0.0..30.0).contains(&centre[1]), "{centre:?}");
    }

    #[test]
    fn in_a_wrapped_grid_ellipsoids_of_one_height_shift_their_probabilities_exactly() {
        let mut layer = one(Edges::Wrap, [20.5, 15.5, 6.0]);
        let wind = Wind::new(WindProfile::uniform([1.7, -0.6]).unwrap(), 20);
        let mut sum = [0; 2];
        let start = row(&layer, 12, 7);
        for _ in 0..40 {
            let LayerMotion::Shifted(shift) = layer.blow(&wind) else { panic!("more than a cell a step") };
            sum = [sum[0] + shift[0], sum[1] + shift[1]];
            let found = row(&layer, usize::try_from((12 + sum[1]).rem_euclid(30)).unwrap(), 7);
            let mut expected = start.clone();
            for field in [&mut expected.extinction, &mut expected.humidity, &mut expected.activation] {
                field.rotate_right(usize::try_from(sum[0].rem_euclid(40)).unwrap());
            }
            assert_eq!(found, expected, "to the last bit after a drift of {sum:?}");
        }
        let mut odd = one(Edges::Wrap, [20.3, 15.5, 6.0]);
        assert_eq!(odd.blow(&wind), LayerMotion::Changed, "a third of a cell is rounded otherwise elsewhere");
    }

    #[test]
    fn a_saved_drift_is_taken_up_exactly() {
        let wind = Wind::new(WindProfile::uniform([0.37, -0.9]).unwrap(), 20);
        let mut first = one(Edges::Open, [20.0, 15.0, 6.0]);
        for _ in 0..55 {
            first.blow(&wind);
        }
        let mut second = one(Edges::Open, [20.0, 15.0, 6.0]);
        second.restore(&first.state()).unwrap();
        (0..99).for_each(|_| assert_eq!(first.blow(&wind), second.blow(&wind), "same steps"));
        assert_eq!(first.state(), second.state(), "same places");
        assert!(second.restore(&[1.0]).is_err(), "too short");
    }

    #[test]
    fn flat_and_infinite_ellipsoids_are_refused() {
        let ellipsoid =
            Ellipsoid { centre_cells: [1.0; 3], radii_cells: [1.0, 0.0, 1.0], base_cells: 0.0, strength: 1.0 };
        let text = HumidEllipsoids::new([9, 9, 9], Edges::Open, 1, SUPPLY, &[ellipsoid]).unwrap_err().to_string();
        assert_eq!(text, "radius of ellipsoid 0 = 0 cells is outside 0.1 to 100000 cells");
    }
}

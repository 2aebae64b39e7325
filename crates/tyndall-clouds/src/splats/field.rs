//! A field of balls that repeats to the horizon, coarser with distance.
//!
//! Balls are kept in blocks of a box, and each block on several levels: on every level eight balls, two along each axis, have
//! become one with twice the radius and the same mass, and the light of those that are seen best. A picture takes from each block the
//! finest level whose balls still cover a few pixels; balls much smaller than a pixel cost as much as larger ones.

use rayon::prelude::*;

use super::light::{LitBall, SplatLighting, light_balls};
use super::project::{SeenBall, project};
use super::view::SplatView;
use crate::error::{CloudError, in_range};
use crate::metaballs::{Metaball, Metaballs, cubes, merge};
use crate::narrow::narrow;

/// Levels, the finest included.
const LEVELS: usize = 5;
/// Radius (px) below which a coarser level is taken.
const LEAST_RADIUS_PX: f64 = 2.0;
/// Blocks of a box along each level axis.
const BLOCKS: usize = 8;
/// Most boxes to each side of the camera's.
const MOST_BOXES: f64 = 200.0;

/// Balls in a box, lit, on all levels.
#[derive(Debug)]
pub struct BallField {
    low_m: [f64; 2],
    /// Sides of a box that repeats; `None` for one that does not.
    period_m: Option<[f64; 2]>,
    block_m: [f64; 2],
    /// Lowest and highest centre (m).
    heights_m: [f64; 2],
    levels: Vec<Level>,
}

/// All blocks of a level.
#[derive(Debug)]
struct Level {
    /// Largest radius (m).
    radius_m: f64,
    blocks: Vec<Vec<LitBall>>,
}

impl BallField {
    /// Lights balls. With sides of a `period_m` to the east and north they repeat; they then lie within one box from
    /// `low_m` on. `spacing_m` is the distance of balls from their neighbours, by which they are merged.
    ///
    /// # Errors
    /// When the lighting or the spacing is not allowed.
    pub fn new(
        balls: &Metaballs,
        (low_m, period_m, spacing_m): ([f64; 2], Option<[f64; 2]>, f64),
        lighting: SplatLighting,
    ) -> Result<Self, CloudError> {
        in_range("distance of metaballs from each other", spacing_m, (1e-6, 1e9), " m")?;
        let sides = period_m.unwrap_or_else(|| sides(&balls.balls, low_m));
        let block_m = sides.map(|side| (side / BLOCKS as f64).max(spacing_m));
        let heights_m = heights(&balls.balls);
        let mut field = Self { low_m, period_m, block_m, heights_m, levels: Vec::new() };
        let list = canonical(&balls.balls);
        let mut lit = light_balls(&list, &field.neighbours(&list, lighting.to_sun), lighting)?;
        for level in 1..=LEVELS {
            let is_coarsest = level == LEVELS || lit.len() < BLOCKS * BLOCKS;
            let coarser = if is_coarsest { Vec::new() } else { merged(&lit, spacing_m * f64::from(1_u32 << level)) };
            field.push_level(std::mem::replace(&mut lit, coarser));
            if is_coarsest {
                break;
            }
        }
        Ok(field)
    }

    /// Replaces the light that balls scatter often by what is known better: the mean radiance (1/sr) of such sunlight at a
    /// place (m), for a sun of irradiance 1.
    #[must_use]
    pub fn with_diffuse(mut self, diffuse: impl Fn([f64; 3]) -> f32) -> Self {
        let balls = self.levels.iter_mut().flat_map(|level| level.blocks.iter_mut().flatten());
        balls.for_each(|lit| lit.diffuse = diffuse(lit.ball.centre_m.map(f64::from)));
        self
    }

    /// Number of balls of the finest level.
    #[must_use]
    pub fn len(&self) -> usize {
        self.levels.first().map_or(0, |level| level.blocks.iter().map(Vec::len).sum())
    }

    /// Whether there is no ball.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The balls that a camera sees, from back to front.
    #[must_use]
    pub fn seen(&self, view: &SplatView) -> Vec<SeenBall> {
        let balls: Vec<_> = self.boxes(view).into_par_iter().flat_map_iter(|shift| self.of_box(shift, view)).collect();
        project(&balls, view)
    }

    fn push_level(&mut self, balls: Vec<LitBall>) {
        let radius_m = f64::from(largest_radius(balls.iter().map(|lit| &lit.ball)));
        let mut blocks = vec![Vec::new(); BLOCKS * BLOCKS];
        for lit in balls {
            let [column, row] = [0, 1]
                .map(|axis| block_index((f64::from(lit.ball.centre_m[axis]) - self.low_m[axis]) / self.block_m[axis]));
            blocks[row * BLOCKS + column].push(lit);
        }
        self.levels.push(Level { radius_m, blocks });
    }

    /// The balls of the boxes around that throw shadows into this one, up to one box away.
    fn neighbours(&self, balls: &[Metaball], to_sun: [f64; 3]) -> Vec<Metaball> {
        let Some(period_m) = self.period_m else { return Vec::new() };
        let radius_m = f64::from(largest_radius(balls.iter()));
        let rise_m = self.heights_m[1] - self.heights_m[0];
        let slopes = [0, 1].map(|axis| (to_sun[axis] / to_sun[2].abs().max(1e-6)).abs());
        let margin = |axis: usize| (rise_m * slopes[axis] + 2.0 * radius_m).min(period_m[axis]);
        let margins = [margin(0), margin(1)];
        let mut around = Vec::new();
        for shift in [-1.0, 0.0, 1.0].iter().flat_map(|north| [-1.0, 0.0, 1.0].map(|east| [east, *north])) {
            if shift == [0.0, 0.0] {
                continue;
            }
            for ball in balls {
                let moved = [0, 1].map(|axis| f64::from(ball.centre_m[axis]) + shift[axis] * period_m[axis]);
                let is_near = |axis: usize| {
                    let from = moved[axis] - self.low_m[axis];
                    (-margins[axis]..period_m[axis] + margins[axis]).contains(&from)
                };
                if is_near(0) && is_near(1) {
                    let centre_m = [narrow(moved[0]), narrow(moved[1]), ball.centre_m[2]];
                    around.push(Metaball { centre_m, ..*ball });
                }
            }
        }
        around
    }

    /// Shifts (m) of the boxes within reach, all of them for a box that does not repeat.
    fn boxes(&self, view: &SplatView) -> Vec<[f64; 2]> {
        let Some(period_m) = self.period_m else { return vec![[0.0; 2]] };
        let span = |axis: usize| {
            let reach = (view.reach_m / period_m[axis]).min(MOST_BOXES);
            let own = (view.position_m[axis] - self.low_m[axis]) / period_m[axis];
            let boxes = box_index(own - reach)..=box_index(own + reach);
            boxes.map(|index| f64::from(index) * period_m[axis]).collect::<Vec<_>>()
        };
        let (east, north) = (span(0), span(1));
        north.iter().flat_map(|y| east.iter().map(|x| [*x, *y])).collect()
    }

    /// The balls of a box, each block on its level.
    fn of_box(&self, shift: [f64; 2], view: &SplatView) -> Vec<LitBall> {
        let mut taken = Vec::new();
        for block in 0..BLOCKS * BLOCKS {
            let corner = [0, 1].map(|axis| {
                let index = if axis == 0 { block % BLOCKS } else { block / BLOCKS };
                self.low_m[axis] + shift[axis] + self.block_m[axis] * index as f64
            });
            let Some(level) = self.level_of(corner, view) else { continue };
            let moved = |lit: &LitBall| {
                let [x, y, z] = lit.ball.centre_m;
                let centre_m = [narrow(f64::from(x) + shift[0]), narrow(f64::from(y) + shift[1]), z];
                LitBall { ball: Metaball { centre_m, ..lit.ball }, ..*lit }
            };
            taken.extend(level.blocks[block].iter().map(moved));
        }
        taken
    }

    /// The level of a block with its low corner there; `None` beyond the reach or behind the camera.
    fn level_of(&self, corner: [f64; 2], view: &SplatView) -> Option<&Level> {
        let finest = self.levels.first()?;
        let middle = [0, 1].map(|axis| corner[axis] + 0.5 * self.block_m[axis] - view.position_m[axis]);
        let half = 0.5 * self.block_m[0].hypot(self.block_m[1]) + finest.radius_m;
        let level_m = (middle[0].hypot(middle[1]) - half).max(0.0);
        if level_m > view.reach_m {
            return None;
        }
        let [lowest, highest] = self.heights_m;
        let above_m = (view.position_m[2] - highest).max(lowest - view.position_m[2]).max(0.0);
        let distance_m = level_m.hypot(above_m);
        let fits = |level: &&Level| view.radius_px(level.radius_m, distance_m) >= LEAST_RADIUS_PX;
        self.levels.iter().find(fits).or(self.levels.last())
    }
}

/// One ball for those of each cube, with the light of those that are seen best; its gradient is theirs.
fn merged(balls: &[LitBall], cube_m: f64) -> Vec<LitBall> {
    let groups = cubes(balls.iter(), narrow(cube_m), |lit| &lit.ball);
    groups.par_iter().filter_map(|group| merge_lit(group)).collect()
}

fn merge_lit(group: &[&LitBall]) -> Option<LitBall> {
    let ball = merge(&group.iter().map(|lit| &lit.ball))?;
    let mean = |value: fn(&LitBall) -> f32, weight: fn(&LitBall) -> f64| {
        let weights = || group.iter().map(|lit| weight(lit));
        let sum: f64 = group.iter().zip(weights()).map(|(lit, weight)| f64::from(value(lit)) * weight).sum();
        narrow(sum / weights().sum::<f64>())
    };
    // What is deep inside counts little, and something where all of it is.
    let of_light = |value| mean(value, |lit| (f64::from(lit.seen) + 1e-6) * lit.ball.mass_m2());
    Some(LitBall {
        ball,
        sun_depth: -of_light(|lit| (-lit.sun_depth).exp()).max(1e-30).ln(),
        gradient_per_m: [
            of_light(|lit| lit.gradient_per_m[0]),
            of_light(|lit| lit.gradient_per_m[1]),
            of_light(|lit| lit.gradient_per_m[2]),
        ],
        forward: of_light(|lit| lit.forward),
        diffuse: of_light(|lit| lit.diffuse),
        sky: of_light(|lit| lit.sky),
        seen: mean(|lit| lit.seen, |lit| lit.ball.mass_m2()),
    })
}

fn largest_radius<'a>(balls: impl Iterator<Item = &'a Metaball>) -> f32 {
    balls.map(|ball| ball.radius_m).fold(0.0, f32::max)
}

/// The balls in an order that does not depend on the list's.
fn canonical(balls: &[Metaball]) -> Vec<Metaball> {
    let mut sorted = balls.to_vec();
    let key = |ball: &Metaball| {
        let [x, y, z] = ball.centre_m;
        [z, y, x, ball.radius_m, ball.extinction_per_m].map(f32::to_bits)
    };
    sorted.par_sort_unstable_by_key(key);
    sorted
}

/// Altitudes (m) of the lowest and the highest ball.
fn heights(balls: &[Metaball]) -> [f64; 2] {
    let heights = balls.iter().map(|ball| f64::from(ball.centre_m[2]));
    let range = heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], z| [low.min(z), high.max(z)]);
    if balls.is_empty() { [0.0; 2] } else { range }
}

/// Sides of the box around balls.
fn sides(balls: &[Metaball], low_m: [f64; 2]) -> [f64; 2] {
    [0, 1].map(|axis| balls.iter().map(|ball| f64::from(ball.centre_m[axis]) - low_m[axis]).fold(1e-3, f64::max))
}

#[expect(clippy::cast_possible_truncation, reason = "places outside of the box belong to the blocks at its sides")]
fn block_index(place: f64) -> usize {
    (place as usize).min(BLOCKS - 1)
}

#[expect(clippy::cast_possible_truncation, reason = "cameras are less than 2^31 boxes away")]
fn box_index(place: f64) -> i32 {
    place.floor() as i32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::splats::{SplatOrders, SplatProjection, rasterise};

    const SUN: SplatLighting = SplatLighting { to_sun: [0.3, 0.2, 0.8], transport: Some(0.2) };

    /// A box of 32 x 32 x 8 cells of 50 m with clouds.
    fn clouds() -> Metaballs {
        let cells = (0..8192_u16).filter(|i| (i % 32 / 16 + i / 32 % 32 / 16) % 2 == 0);
        let ball = |i: u16| Metaball {
            centre_m: [i % 32, i / 32 % 32, i / 1024].map(|cell| 50.0 * f32::from(cell) + 25.0),
            radius_m: 100.0,
            extinction_per_m: 0.004,
        };
        Metaballs { balls: cells.map(ball).collect() }
    }

    fn view(altitude_m: f64, size_px: [usize; 2]) -> SplatView {
        SplatView {
            position_m: [800.0, 700.0, altitude_m],
            axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]],
            projection: SplatProjection::Perspective { tan_half: [0.2; 2] },
            size_px,
            planet_radius_m: f64::INFINITY,
            reach_m: 20e3,
        }
    }

    #[test]
    fn every_level_holds_the_mass_of_the_cloud() {
        let field = BallField::new(&clouds(), ([0.0; 2], Some([1600.0; 2]), 50.0), SUN).unwrap();
        assert_eq!(field.len(), clouds().balls.len(), "the finest level has all");
        assert!(field.levels.len() > 2, "{} levels", field.levels.len());
        for level in &field.levels {
            let mass: f64 = level.blocks.iter().flatten().map(|lit| lit.ball.mass_m2()).sum();
            assert!((mass / clouds().mass_m2() - 1.0).abs() < 1e-4, "{mass}");
        }
    }

    #[test]
    fn light_in_a_box_that_repeats_is_the_same_wherever_the_box_begins() {
        let period = Some([1600.0; 2]);
        let lit = |balls: &Metaballs| BallField::new(balls, ([0.0; 2], period, 50.0), SUN).unwrap();
        let mut moved = clouds();
        for ball in &mut moved.balls {
            ball.centre_m[0] = (ball.centre_m[0] + 800.0) % 1600.0;
        }
        let by_place = |field: &BallField, shift: f32| {
            let place = |lit: &LitBall| {
                let [x, y, z] = lit.ball.centre_m;
                ([((x + shift) % 1600.0).to_bits(), y.to_bits(), z.to_bits()], lit.sun_depth)
            };
            field.levels[0].blocks.iter().flatten().map(place).collect::<std::collections::BTreeMap<_, _>>()
        };
        let (here, there) = (by_place(&lit(&clouds()), 800.0), by_place(&lit(&moved), 0.0));
        assert_eq!(here.len(), there.len(), "the same balls");
        for (place, direct) in &here {
            assert!((direct - there[place]).abs() < 1e-3, "{direct} {}", there[place]);
        }
    }

    #[test]
    fn coarser_levels_keep_the_mean_of_the_picture() {
        let field = BallField::new(&clouds(), ([0.0; 2], Some([1600.0; 2]), 50.0), SUN).unwrap();
        let mean = |size_px: usize| {
            let view = view(12e3, [size_px; 2]);
            let balls = field.seen(&view);
            let planes = rasterise(&balls, &view, SplatOrders::All { transport: 0.2 }, None).unwrap();
            let pixels = (0..size_px).flat_map(|y| (0..size_px).map(move |x| (x, y)));
            let sum = pixels.map(|(x, y)| planes.pixel(x, y)).fold([0.0; 2], |sum, pixel| {
                [sum[0] + f64::from(pixel.direct), sum[1] + f64::from(pixel.transmittance)]
            });
            (balls.len(), sum.map(|sum| sum / (size_px * size_px) as f64))
        };
        let ((many, fine), (few, coarse)) = (mean(256), mean(64));
        assert!(few < many / 4, "{few} balls in place of {many}");
        for (fine, coarse) in fine.iter().zip(coarse) {
            // Balls twice as wide spread an edge by 100 m, of which there are four in 3200 m: 0.12 at most.
            assert!((fine - coarse).abs() < 0.12, "{fine:?} {coarse:?}");
        }
    }
}

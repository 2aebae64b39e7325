//! What clouds leave of the light on its way to the ground: a map on the plane of the grid's floor.
//!
//! The paper's program draws the sun's final light buffer on the ground as a shadow; here the map says three things of each
//! place: the share of sunlight that goes straight through, the share that clouds scatter through, and the share of the
//! sky's light that comes through the cloud above. The straight share is the integral of the extinction between cells'
//! centres, sampled twice a cell and along the sun's rays, within 0.01 of the reference; the other two are those of slabs as thick as the cloud
//! on the ray ([`slab_transmission`]), so that what clouds send back is missing below them and nothing else is.
//!
//! A lower sun than [`LOWEST_SUN`] throws the shadows of that one. The map of an open grid ends after [`MOST_TEXELS`].

use rayon::prelude::*;
use tyndall_core::grid::Grid3;

use crate::edges::Edges;
use crate::error::{CloudError, in_range};
use crate::matter::CloudMatter;
use crate::narrow::narrow;

/// Sine of the lowest elevation of a sun whose shadows are computed.
pub const LOWEST_SUN: f64 = 0.02;

/// Most texels along a side of the map.
pub const MOST_TEXELS: usize = 4096;

/// Samples of a ray on its way through a cell.
const SAMPLES: f64 = 2.0;

/// Shares of light, 0 to 1, that come down to a place on the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FloorLight {
    /// Of the sunlight, straight.
    pub direct: f32,
    /// Of the sunlight, scattered on its way.
    pub diffuse: f32,
    /// Of the sky's light.
    pub sky: f32,
}

/// No cloud in the way.
pub const OPEN_SKY: FloorLight = FloorLight { direct: 1.0, diffuse: 0.0, sky: 1.0 };

/// The map: a texel for each cell of the floor, row by row from south to north.
#[derive(Clone, Debug, PartialEq)]
pub struct FloorShadow {
    /// Texels from west to east, and from south to north.
    pub size: [usize; 2],
    /// Cells from the grid's low corner to the map's. Rays that enter an open grid from its sides begin outside of it.
    pub corner_cells: [i64; 2],
    /// Light at the texels' centres.
    pub light: Vec<FloorLight>,
}

/// Metres east and north that a ray towards the sun goes for each metre upwards.
#[must_use]
pub fn sun_slope(to_sun: [f64; 3]) -> [f64; 2] {
    let length = to_sun.iter().map(|part| part * part).sum::<f64>().sqrt();
    let up = (to_sun[2] / length).max(LOWEST_SUN);
    [to_sun[0] / length / up, to_sun[1] / length / up]
}

/// Share of the light that a slab without absorption lets through, straight or scattered, of light along its normal;
/// `depth` is the optical depth times one less the mean cosine. Eddington's approximation.
#[must_use]
pub fn slab_transmission(depth: f64) -> f64 {
    let through = (-depth).exp();
    (1.0 + through + 1.5 * (1.0 - through)) / (2.0 + 1.5 * depth)
}

/// The map below a grid of extinction (1/m) at the centres of cells of `cell_m`, for a sun in the direction `to_sun` and a
/// `transport` of 1 less the mean cosine of scattering.
///
/// # Errors
/// When `to_sun` is zero, or `cell_m` or `transport` is not positive.
pub fn floor_shadow(
    extinction: &Grid3<f32>,
    cell_m: f64,
    to_sun: [f64; 3],
    transport: f64,
    edges: Edges,
) -> Result<FloorShadow, CloudError> {
    in_range("side of a cell", cell_m, (1e-9, 1e9), " m")?;
    in_range("transport", transport, (1e-6, 2.0), "")?;
    let length = to_sun.iter().map(|part| part * part).sum::<f64>().sqrt();
    in_range("length of the sun's direction", length, (1e-100, 1e100), "")?;
    let rays = Rays::new(extinction, sun_slope(to_sun), edges);
    let above = Rays { size: rays.size, corner: rays.corner, ..Rays::new(extinction, [0.0; 2], edges) };
    let mut light = vec![OPEN_SKY; rays.size[0] * rays.size[1]];
    light.par_chunks_exact_mut(rays.size[0]).enumerate().for_each(|(row, light)| {
        let (slant, upright) = (rays.row(row), above.row(row));
        for ((light, slant), upright) in light.iter_mut().zip(slant).zip(upright) {
            *light = below(cell_m * f64::from(slant), cell_m * f64::from(upright), transport);
        }
    });
    Ok(FloorShadow { size: rays.size, corner_cells: rays.corner, light })
}

/// Optical depth of clouds from a place (m; altitude last) in a direction, by samples a quarter of a cell apart. A wrapped
/// grid is followed for at most [`MOST_TEXELS`] cells.
#[must_use]
pub fn optical_depth(matter: &CloudMatter, place_m: [f64; 3], direction: [f64; 3]) -> f64 {
    let length = direction.iter().map(|part| part * part).sum::<f64>().sqrt();
    let step: [f64; 3] = direction.map(|part| 0.25 * part / length);
    let mut place: [f64; 3] = std::array::from_fn(|axis| (place_m[axis] - matter.low_corner_m[axis]) / matter.cell_m);
    let layers = matter.extinction_per_m.size()[2] as f64;
    // From afar to the layers.
    let skipped = if step[2] > 0.0 { -place[2] / step[2] } else { (layers - place[2]) / step[2].min(-1e-12) };
    place.iter_mut().zip(step).for_each(|(place, step)| *place += skipped.max(0.0) * step);
    let mut sum = 0.0;
    for _ in 0..4 * MOST_TEXELS {
        place.iter_mut().zip(step).for_each(|(place, step)| *place += 0.5 * step);
        if !(0.0..=layers).contains(&place[2]) {
            break;
        }
        sum += extinction_at(matter, place);
        place.iter_mut().zip(step).for_each(|(place, step)| *place += 0.5 * step);
    }
    0.25 * matter.cell_m * sum
}

/// Extinction (1/m) at a place in cells, linear between the cells' centres.
fn extinction_at(matter: &CloudMatter, place: [f64; 3]) -> f64 {
    let cells = &matter.extinction_per_m;
    let size = cells.size();
    let wraps = matter.edges == Edges::Wrap;
    let is_outside = (0..2).any(|axis| !(0.0..=size[axis] as f64).contains(&place[axis]));
    if is_outside && !wraps {
        return 0.0;
    }
    let along = |axis: usize| neighbours(place[axis] - 0.5, size[axis], wraps && axis < 2);
    let ((columns, east), (rows, north), (layers, up)) = (along(0), along(1), along(2));
    let mut sum = 0.0;
    for (z, up) in layers.into_iter().zip([1.0 - up, up]) {
        for (y, north) in rows.into_iter().zip([1.0 - north, north]) {
            for (x, east) in columns.into_iter().zip([1.0 - east, east]) {
                sum += f64::from(up * north * east * cells[[x, y, z]]);
            }
        }
    }
    sum
}

/// Light below cloud of these optical depths towards the sun and upwards.
fn below(slant: f64, upright: f64, transport: f64) -> FloorLight {
    let direct = (-slant).exp();
    let diffuse = (slab_transmission(transport * slant) - direct).max(0.0);
    FloorLight {
        direct: narrow(direct),
        diffuse: narrow(diffuse),
        sky: narrow(1.0 / (1.0 + 0.75 * transport * upright)),
    }
}

/// Parallel rays from the floor through the grid.
struct Rays<'a> {
    extinction: &'a Grid3<f32>,
    edges: Edges,
    /// Cells east and north for each cell up.
    slope: [f64; 2],
    /// Samples of a layer.
    samples: f64,
    /// Length (cells) of a sample.
    length: f32,
    /// Layers between which there is cloud.
    layers: [f64; 2],
    size: [usize; 2],
    corner: [i64; 2],
}

impl<'a> Rays<'a> {
    fn new(extinction: &'a Grid3<f32>, slope: [f64; 2], edges: Edges) -> Self {
        let [nx, ny, nz] = extinction.size();
        let steepest = slope[0].abs().max(slope[1].abs());
        let samples = SAMPLES * steepest.ceil().max(1.0);
        let slant = (1.0 + slope[0] * slope[0] + slope[1] * slope[1]).sqrt();
        let (size, corner) = match edges {
            Edges::Wrap => ([nx, ny], [0, 0]),
            Edges::Open => {
                let [(east, width), (north, depth)] = [(slope[0], nx), (slope[1], ny)].map(|(s, n)| reach(s, n, nz));
                ([width, depth], [east, north])
            }
        };
        let length = narrow(slant / samples);
        Self { extinction, edges, slope, samples, length, layers: cloudy_layers(extinction), size, corner }
    }

    /// Extinction times cells along the rays from a row of texels.
    fn row(&self, row: usize) -> Vec<f32> {
        let mut sums = vec![0.0; self.size[0]];
        let mut line = vec![0.0; self.extinction.size()[0]];
        let mut height = self.layers[0] + 0.5 / self.samples;
        while height < self.layers[1] {
            let [east, north] = self.slope.map(|slope| slope * height);
            let north = north + 0.5 + row as f64 + self.corner[1] as f64;
            if self.blend(north, height, &mut line) {
                self.add(east + self.corner[0] as f64, &line, &mut sums);
            }
            height += 1.0 / self.samples;
        }
        for sum in &mut sums {
            *sum *= self.length;
        }
        sums
    }

    /// The row of extinctions at a place between the rows; false outside the grid.
    fn blend(&self, north: f64, height: f64, line: &mut [f32]) -> bool {
        let [nx, ny, nz] = self.extinction.size();
        if self.edges == Edges::Open && !(0.0..=ny as f64).contains(&north) {
            return false;
        }
        let (rows, north) = neighbours(north - 0.5, ny, self.edges == Edges::Wrap);
        let (layers, up) = neighbours(height - 0.5, nz, false);
        line.fill(0.0);
        for (layer, up) in layers.into_iter().zip([1.0 - up, up]) {
            for (row, north) in rows.into_iter().zip([1.0 - north, north]) {
                let cells = &self.extinction.cells()[(layer * ny + row) * nx..][..nx];
                line.iter_mut().zip(cells).for_each(|(sum, cell)| *sum += up * north * cell);
            }
        }
        true
    }

    /// Adds a row of extinctions, sampled `shift` cells to the east of the texels.
    fn add(&self, shift: f64, line: &[f32], sums: &mut [f32]) {
        let count = line.len();
        let (first, fraction) = (whole(shift.floor()), narrow(shift - shift.floor()));
        for (texel, sum) in sums.iter_mut().enumerate() {
            let cell = whole(texel as f64) + first;
            let (near, next) = match self.edges {
                Edges::Wrap => (wrapped(cell, count), wrapped(cell + 1, count)),
                Edges::Open => {
                    let place = cell as f64 + 0.5 + f64::from(fraction);
                    if !(0.0..=count as f64).contains(&place) {
                        continue;
                    }
                    (clamped(cell, count), clamped(cell + 1, count))
                }
            };
            *sum += (1.0 - fraction) * line[near] + fraction * line[next];
        }
    }
}

/// First texel and number of texels along an axis of an open grid, one more on each side.
fn reach(slope: f64, count: usize, layers: usize) -> (i64, usize) {
    let more = (slope.abs() * layers as f64).ceil().min((MOST_TEXELS - MOST_TEXELS.min(count + 2)) as f64);
    let first = if slope > 0.0 { -whole(more) - 1 } else { -1 };
    (first, count + 2 + clamped(whole(more), MOST_TEXELS))
}

/// Heights (cells) between which interpolation finds cloud.
fn cloudy_layers(extinction: &Grid3<f32>) -> [f64; 2] {
    let [nx, ny, nz] = extinction.size();
    let cloudy = |layer: &usize| extinction.cells()[layer * nx * ny..][..nx * ny].iter().any(|cell| *cell > 0.0);
    let first = (0..nz).find(cloudy);
    let last = (0..nz).rev().find(cloudy);
    match (first, last) {
        (Some(first), Some(last)) => [first.saturating_sub(1) as f64, (last + 2).min(nz) as f64],
        _ => [0.0; 2],
    }
}

/// The two cells around a place between centres, and the share of the second.
fn neighbours(place: f64, count: usize, wraps: bool) -> ([usize; 2], f32) {
    let first = whole(place.floor());
    let cells = [first, first + 1].map(|cell| if wraps { wrapped(cell, count) } else { clamped(cell, count) });
    (cells, narrow(place - place.floor()))
}

#[expect(clippy::cast_possible_truncation, reason = "places in cells are small")]
fn whole(cells: f64) -> i64 {
    cells as i64
}

fn wrapped(cell: i64, count: usize) -> usize {
    let count = i64::try_from(count).unwrap_or(i64::MAX);
    usize::try_from(cell.rem_euclid(count)).unwrap_or(0)
}

fn clamped(cell: i64, count: usize) -> usize {
    usize::try_from(cell.max(0)).unwrap_or(0).min(count.saturating_sub(1))
}

impl FloorShadow {
    /// Light at a place on the floor in cells from the grid's low corner, between the texels; beyond an open map that of
    /// its edge.
    #[must_use]
    pub fn at(&self, place_cells: [f64; 2], edges: Edges) -> FloorLight {
        let along = |axis: usize| {
            let place = place_cells[axis] - self.corner_cells[axis] as f64 - 0.5;
            neighbours(place, self.size[axis], edges == Edges::Wrap)
        };
        let ((columns, right), (rows, up)) = (along(0), along(1));
        let [low, high] = rows.map(|row| {
            let [a, b] = columns.map(|column| self.light[row * self.size[0] + column]);
            a.mixed(b, right)
        });
        low.mixed(high, up)
    }

    /// The map, and after it coarser and coarser ones down to a single texel.
    #[must_use]
    pub fn levels(self) -> Vec<Self> {
        let mut levels = vec![self];
        while let Some(half) = levels.last().filter(|last| last.size != [1, 1]).map(Self::halved) {
            levels.push(half);
        }
        levels
    }

    /// The map with half as many texels each way, at least one: each the mean of those it covers.
    #[must_use]
    pub fn halved(&self) -> Self {
        let size = self.size.map(|count| (count / 2).max(1));
        let columns: Vec<_> = (0..size[0]).map(|texel| covered(texel, size[0], self.size[0])).collect();
        let mean = |row: usize, column: usize| {
            let mut sum = FloorLight { direct: 0.0, diffuse: 0.0, sky: 0.0 };
            for &(y, north) in &covered(row, size[1], self.size[1]) {
                for &(x, east) in &columns[column] {
                    let light = self.light[y * self.size[0] + x];
                    sum.direct += north * east * light.direct;
                    sum.diffuse += north * east * light.diffuse;
                    sum.sky += north * east * light.sky;
                }
            }
            sum
        };
        let texels = (0..size[1]).flat_map(|row| (0..size[0]).map(move |column| (row, column)));
        Self { size, corner_cells: self.corner_cells, light: texels.map(|(row, column)| mean(row, column)).collect() }
    }
}

impl FloorLight {
    fn mixed(self, other: Self, share: f32) -> Self {
        let mix = |a: f32, b: f32| a + share * (b - a);
        Self {
            direct: mix(self.direct, other.direct),
            diffuse: mix(self.diffuse, other.diffuse),
            sky: mix(self.sky, other.sky),
        }
    }
}

/// Which of `fine` texels one of `coarse` covers, with their shares in it.
fn covered(texel: usize, coarse: usize, fine: usize) -> Vec<(usize, f32)> {
    let width = fine as f64 / coarse as f64;
    let (start, end) = (texel as f64 * width, (texel + 1) as f64 * width);
    let share = |cell: usize| ((cell as f64 + 1.0).min(end) - (cell as f64).max(start)).max(0.0) / width;
    let first = clamped(whole(start), fine);
    (first..fine).take_while(|cell| (*cell as f64) < end).map(|cell| (cell, narrow(share(cell)))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::Medium;

    /// Lumps whose cells reach optical depths of a few.
    fn lumps(size: [usize; 3]) -> Grid3<f32> {
        let value = |index: usize| {
            let [x, y, z] =
                [index % size[0], index / size[0] % size[1], index / (size[0] * size[1])].map(|place| place as f64);
            let wave = (0.9 * x).sin() * (0.7 * y + 1.0).cos() + 0.6 * (1.1 * z).sin();
            narrow(0.02 * wave.max(0.0))
        };
        Grid3::from_cells(size, (0..size.iter().product()).map(value).collect()).unwrap()
    }

    #[test]
    fn the_shadow_is_the_exponential_of_the_references_optical_depth() {
        let (size, cell_m) = ([20, 16, 9], 25.0);
        let mut grid = lumps(size);
        // A cloud that an open grid cuts off ends between two samples.
        for (index, cell) in grid.cells_mut().iter_mut().enumerate() {
            let [x, y] = [index % size[0], index / size[0] % size[1]];
            let within = (1..size[0] - 1).contains(&x) && (1..size[1] - 1).contains(&y);
            *cell *= f32::from(u8::from(within));
        }
        let medium = Medium::new(grid.clone(), cell_m).unwrap();
        for to_sun in [[0.0, 0.0, 1.0], [0.5, -0.3, 0.7], [-0.9, 0.2, 0.25]] {
            let map = floor_shadow(&grid, cell_m, to_sun, 0.15, Edges::Open).unwrap();
            let mut worst = 0.0_f64;
            for (index, light) in map.light.iter().enumerate() {
                let texel = [index % map.size[0], index / map.size[0]];
                let place = |axis: usize| (texel[axis] as f64 + 0.5 + map.corner_cells[axis] as f64) * cell_m;
                let length = to_sun.iter().map(|part| part * part).sum::<f64>().sqrt();
                let depth =
                    medium.optical_depth([place(0), place(1), 0.0], to_sun.map(|part| part / length), 0.02 * cell_m);
                worst = worst.max((f64::from(light.direct) - (-depth).exp()).abs());
            }
            assert!(worst < 1e-2, "sun {to_sun:?}: {worst}");
        }
    }

    #[test]
    fn the_open_map_ends_in_full_light_on_all_sides() {
        let grid = Grid3::filled([12, 10, 8], 0.1);
        let map = floor_shadow(&grid, 30.0, [0.6, -0.4, 0.5], 0.15, Edges::Open).unwrap();
        let [width, depth] = map.size;
        for (index, light) in map.light.iter().enumerate() {
            let [x, y] = [index % width, index / width];
            if x == 0 || y == 0 || x == width - 1 || y == depth - 1 {
                assert_eq!(*light, OPEN_SKY, "texel {x}, {y} of {:?}", map.size);
            }
        }
        assert!(map.light.iter().any(|light| light.direct < 1e-6), "and is dark in the middle");
    }

    #[test]
    fn a_wrapped_deck_throws_an_even_shadow_that_keeps_the_energy_of_a_slab() {
        let (cell_m, transport) = (50.0, 0.2);
        let grid = Grid3::filled([12, 12, 6], 0.02);
        let to_sun: [f64; 3] = [0.6, 0.0, 0.8];
        let map = floor_shadow(&grid, cell_m, to_sun, transport, Edges::Wrap).unwrap();
        let slant = 0.02 * 6.0 * cell_m / 0.8;
        for light in &map.light {
            let total = f64::from(light.direct + light.diffuse);
            assert!((total - slab_transmission(transport * slant)).abs() < 1e-5, "{total} of {light:?}");
            assert!((f64::from(light.sky) - 1.0 / 1.9).abs() < 1e-5, "a level depth of 6: {}", light.sky);
        }
    }

    #[test]
    fn a_slab_lets_through_all_light_when_it_is_thin_and_what_diffusion_says_when_thick() {
        assert!((slab_transmission(0.0) - 1.0).abs() < 1e-12, "nothing");
        assert!((slab_transmission(1e-3) - (1.0 - 0.5e-3)).abs() < 1e-6, "half of what is scattered goes on");
        assert!((slab_transmission(100.0) * 152.0 - 2.5).abs() < 1e-9, "thick");
    }

    #[test]
    fn halving_keeps_the_mean_of_maps_of_any_size() {
        let grid = lumps([13, 10, 9]);
        let map = floor_shadow(&grid, 25.0, [0.3, 0.2, 0.9], 0.15, Edges::Wrap).unwrap();
        let mean = |map: &FloorShadow| {
            map.light.iter().map(|light| f64::from(light.direct)).sum::<f64>() / map.light.len() as f64
        };
        let before = mean(&map);
        let levels = map.levels();
        let sizes: Vec<_> = levels.iter().map(|map| map.size).collect();
        assert_eq!(sizes, [[13, 10], [6, 5], [3, 2], [1, 1]], "halved, whatever the size");
        for map in levels {
            assert!((mean(&map) - before).abs() < 1e-5, "{:?}: {} of {before}", map.size, mean(&map));
        }
    }

    #[test]
    fn places_between_texels_are_interpolated_and_wrap() {
        let grid = lumps([8, 8, 9]);
        let map = floor_shadow(&grid, 25.0, [0.3, 0.2, 0.9], 0.15, Edges::Wrap).unwrap();
        let at = |x: f64| f64::from(map.at([x, 2.5], Edges::Wrap).direct);
        assert!((at(3.0) - 0.5 * (at(2.5) + at(3.5))).abs() < 1e-6, "between");
        assert!((at(8.5) - at(0.5)).abs() < 1e-6 && (at(-0.2) - at(7.8)).abs() < 1e-6, "around");
    }

    #[test]
    fn the_optical_depth_from_a_place_is_the_references_and_that_of_the_map_where_the_grid_repeats() {
        let (size, cell_m) = ([12, 10, 9], 25.0);
        let medium = Medium::new(lumps(size), cell_m).unwrap();
        let list = |edges| CloudMatter::of_density(lumps(size), cell_m, [-50.0, 20.0, 700.0], edges, cell_m);
        let (open, wrapped) = (list(Edges::Open), list(Edges::Wrap));
        let map = floor_shadow(&lumps(size), cell_m, [0.3, 0.2, 0.9], 0.15, Edges::Wrap).unwrap();
        for (x, y) in [(12.5, 12.5), (137.5, 87.5), (212.5, 162.5)] {
            let (place, sun) = ([x - 50.0, y + 20.0, 700.0], [0.3, 0.2, 0.9]);
            let length = 0.94_f64.sqrt();
            let wanted = medium.optical_depth([x, y, 0.0], sun.map(|part| part / length), 0.02 * cell_m);
            let found = optical_depth(&open, place, sun);
            assert!((found - wanted).abs() < 0.02 * wanted.max(1.0), "from {place:?}: {found} for {wanted}");
            // From far below, along the same ray.
            let below = std::array::from_fn(|axis| place[axis] - 500.0 * sun[axis]);
            assert!((optical_depth(&open, below, sun) - found).abs() < 0.05, "from below {place:?}");
            let direct = f64::from(map.at([x / cell_m, y / cell_m], Edges::Wrap).direct);
            let through = (-optical_depth(&wrapped, place, sun)).exp();
            assert!((through - direct).abs() < 0.02, "the map at {place:?}: {direct} for {through}");
        }
        assert!(optical_depth(&open, [0.0, 100.0, 2000.0], [0.0, 0.0, 1.0]) == 0.0, "nothing is above");
    }

    #[test]
    fn impossible_suns_and_cells_are_refused() {
        let grid = lumps([4, 4, 4]);
        assert!(floor_shadow(&grid, 25.0, [0.0; 3], 0.15, Edges::Wrap).is_err(), "no direction");
        assert!(floor_shadow(&grid, 0.0, [0.0, 0.0, 1.0], 0.15, Edges::Wrap).is_err(), "no cells");
        assert!(floor_shadow(&grid, 25.0, [0.0, 0.0, 1.0], 0.0, Edges::Wrap).is_err(), "straight on");
    }
}

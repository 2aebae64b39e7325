//! Sand that the wind holds in the air over a bed: a low layer wherever the wind blows hard enough, and plumes that leave
//! the brinks of slip faces and trail over the lee.
//!
//! Each column of air has an optical depth and a mean and a spread of heights. Over ground in the wind it holds the saturated
//! flux of [Kawamura's law](saturated_flux_kg_per_m_s) over the grains' speed; crests have more wind. Beyond a brink the finer
//! part goes on with the wind, sinks, spreads and thins out exponentially: mass, height and variance of a column follow
//! linear laws, which add up along the wind in passes of doubling reach.
//!
//! Not done: what falls in the lee does not build the slip face (the automaton does), and columns do not dim the sun for
//! others.

mod flux;
mod scan;

pub use flux::{THRESHOLD_M_PER_S, extinction_m2_per_kg, friction_m_per_s, saturated_flux_kg_per_m_s};

use crate::edges::Edges;
use crate::error::{DuneError, check_value};
use crate::measure::HeightGrid;
use scan::{carried_sum, highest_line};

/// Grains that hop, and those fine enough to be carried on beyond a brink (m); the share of these.
const HOPPING_M: f64 = 2e-4;
const FINE_M: f64 = 1e-4;
const FINE_SHARE: f64 = 0.2;
/// How fast fine grains fall (m/s).
const FALL_M_PER_S: f64 = 0.5;
/// Speed of grains in that of the wind at 10 m.
pub const GRAIN_SPEED: f64 = 0.5;
/// Mean height of hopping grains, and of fine ones; their standard deviations are as large (m).
const HOPPING_HEIGHT_M: f64 = 0.1;
const FINE_HEIGHT_M: f64 = 0.6;
/// Growth of the variance of heights in the lee, for each metre along the wind (m).
const SPREADING_M: f64 = 0.06;
/// Slope of the line from a brink under which the air is calm: 12 degrees.
const SEPARATION: f64 = 0.21;
/// How far (cells) below that line the calm is complete.
const CALM_CELLS: f32 = 0.3;
/// Passes: 256 cells of shadow, 128 of plumes.
const SHADOW_PASSES: u32 = 8;
const PLUME_PASSES: u32 = 7;
/// Least and most wind of that over level ground.
const SPEED_UP: [f64; 2] = [0.3, 2.0];

/// A wind over sand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SandWind {
    /// Where it blows to, anticlockwise from east (deg).
    pub toward_deg: f64,
    /// Speed 10 m over level sand (m/s).
    pub speed_m_per_s: f64,
}

/// Sand in the air over a cell.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BlownColumn {
    /// Optical depth straight down (1).
    pub depth: f32,
    /// Mean height (m) over the level that heights of the bed are counted from.
    pub height_m: f32,
    /// Variance of heights (m^2).
    pub variance_m2: f32,
}

/// Sand in the air over a bed whose cells are `cell_m` wide and are covered with sand to a share of 0 to 1; `None` where the
/// wind is too weak to lift any.
///
/// # Errors
/// [`DuneError::Value`] when a number is outside its range, [`DuneError::GridSize`] when the cover has another size than the bed.
pub fn blown_columns(
    (bed, cover): (&HeightGrid, &[f32]),
    cell_m: f64,
    edges: Edges,
    wind: SandWind,
) -> Result<Option<Vec<BlownColumn>>, DuneError> {
    check_value("width of a cell", cell_m, " m", 0.01..=100.0)?;
    check_value("speed of the wind", wind.speed_m_per_s, " m/s", 0.0..=100.0)?;
    check_value("direction of the wind", wind.toward_deg, " deg", -36_000.0..=36_000.0)?;
    if cover.len() != bed.heights().len() {
        return Err(DuneError::GridSize { what: "the cover of sand", found: cover.len(), size: bed.size() });
    }
    if friction_m_per_s(SPEED_UP[1] * wind.speed_m_per_s) <= THRESHOLD_M_PER_S {
        return Ok(None);
    }
    let (sin, cos) = wind.toward_deg.to_radians().sin_cos();
    let (upwind, field) = ([-cos, -sin], (bed.size(), edges));
    let exposed = exposed(bed, field, upwind);
    let supplied: Vec<f32> = exposed.iter().zip(cover).map(|(exposed, cover)| exposed * cover).collect();
    let flux = fluxes(bed, wind, &supplied);
    let before_brink =
        scan::shifted(&exposed.iter().map(|&e| [e]).collect::<Vec<_>>(), field.0, edges, [cos, sin], [1.0]);
    let cell = |index: usize| Cell { bed_m: cell_m * f64::from(bed.heights()[index]), flux: flux[index] };
    let speed = wind.speed_m_per_s;
    // What goes over the brink goes on; what still flies over ground in the wind does not.
    let source = (0..flux.len()).map(|at| cell(at).fine(speed).scaled(f64::from(1.0 - before_brink[at][0])).moments());
    let plumes = carried_sum(source.collect(), field, upwind, PLUME_PASSES, |moments, cells| {
        Moments::new(moments).carried(cells * cell_m, speed).moments()
    });
    let column = |index: usize| {
        let here = cell(index);
        let calm = f64::from(1.0 - exposed[index]);
        let low = here.hopping(speed).plus(here.fine(speed));
        low.plus(Moments::new(plumes[index]).scaled(calm)).column(here.bed_m)
    };
    Ok(Some((0..flux.len()).map(column).collect()))
}

/// For each cell the height (in cells) over which a light shines whose rays rise by `rise` towards `toward_deg`, where the bed
/// is in its way.
///
/// # Errors
/// [`DuneError::Value`] when a number is outside its range.
pub fn light_heights_cells(bed: &HeightGrid, edges: Edges, toward_deg: f64, rise: f64) -> Result<Vec<f32>, DuneError> {
    check_value("direction of the light", toward_deg, " deg", -36_000.0..=36_000.0)?;
    check_value("rise of the light", rise, "", 0.0..=1e9)?;
    let (sin, cos) = toward_deg.to_radians().sin_cos();
    Ok(highest_line(bed.heights(), (bed.size(), edges), [cos, sin], SHADOW_PASSES, rise))
}

/// For each cell 1 in the wind, 0 in the calm behind a brink.
fn exposed(bed: &HeightGrid, field: ([usize; 2], Edges), upwind: [f64; 2]) -> Vec<f32> {
    let line = highest_line(bed.heights(), field, upwind, SHADOW_PASSES, SEPARATION);
    let open = |(line, height): (&f32, &f32)| {
        let share = 1.0 - ((line - height) / CALM_CELLS).clamp(0.0, 1.0);
        share * share * (3.0 - 2.0 * share)
    };
    line.iter().zip(bed.heights()).map(open).collect()
}

/// Flux (kg/(m s)) over each cell, of which a share is in the wind and has sand. Over waves of a wavenumber k air moves faster
/// by k times their height, in which k is that of waves with the bed's height and slopes.
fn fluxes(bed: &HeightGrid, wind: SandWind, supplied: &[f32]) -> Vec<f64> {
    let (mean, rms) = (bed.mean_cells(), bed.rms_cells());
    let (sin, cos) = wind.toward_deg.to_radians().sin_cos();
    let square = |[east, north]: [f64; 2]| (east * cos + north * sin).powi(2);
    let rows = bed.size()[1];
    let slopes: f64 = (0..rows).flat_map(|y| bed.row_gradients(y).map(square)).sum();
    let wavenumber = (slopes / supplied.len() as f64).sqrt() / rms.max(1e-3);
    let flux = |(height, supplied): (&f32, &f32)| {
        let faster = (1.0 + wavenumber * (f64::from(*height) - mean)).clamp(SPEED_UP[0], SPEED_UP[1]);
        f64::from(*supplied) * saturated_flux_kg_per_m_s(friction_m_per_s(faster * wind.speed_m_per_s))
    };
    bed.heights().iter().zip(supplied).map(flux).collect()
}

/// A cell's height and the flux over it (kg/(m s)).
struct Cell {
    bed_m: f64,
    flux: f64,
}

impl Cell {
    fn hopping(&self, wind_m_per_s: f64) -> Moments {
        self.layer(extinction_m2_per_kg(HOPPING_M) * (1.0 - FINE_SHARE), HOPPING_HEIGHT_M, wind_m_per_s)
    }

    fn fine(&self, wind_m_per_s: f64) -> Moments {
        self.layer(extinction_m2_per_kg(FINE_M) * FINE_SHARE, FINE_HEIGHT_M, wind_m_per_s)
    }

    fn layer(&self, extinction_m2_per_kg: f64, height_m: f64, wind_m_per_s: f64) -> Moments {
        let depth = extinction_m2_per_kg * self.flux / (GRAIN_SPEED * wind_m_per_s);
        Moments::of(depth, self.bed_m + height_m, height_m * height_m)
    }
}

/// Sums of a column: optical depth, times height, times its square. Linear, so that columns may be added.
#[derive(Clone, Copy)]
struct Moments([f64; 3]);

impl Moments {
    fn new(moments: [f32; 3]) -> Self {
        Self(moments.map(f64::from))
    }

    fn of(depth: f64, height_m: f64, variance_m2: f64) -> Self {
        Self([depth, depth * height_m, depth * (height_m * height_m + variance_m2)])
    }

    fn moments(self) -> [f32; 3] {
        self.0.map(|part| part as f32)
    }

    fn plus(self, other: Self) -> Self {
        Self([0, 1, 2].map(|part| self.0[part] + other.0[part]))
    }

    fn scaled(self, factor: f64) -> Self {
        Self(self.0.map(|part| factor * part))
    }

    /// After a way (m) along the wind: grains fall while the wind carries them, and spread.
    fn carried(self, way_m: f64, wind_m_per_s: f64) -> Self {
        let [depth, first, second] = self.0;
        let sunk_m = way_m * FALL_M_PER_S / wind_m_per_s;
        let kept = (-sunk_m / FINE_HEIGHT_M).exp();
        let spread = SPREADING_M * way_m;
        let moments =
            [depth, first - sunk_m * depth, second - 2.0 * sunk_m * first + (sunk_m * sunk_m + spread) * depth];
        Self(moments).scaled(kept)
    }

    fn column(self, bed_m: f64) -> BlownColumn {
        let [depth, first, second] = self.0;
        if depth < 1e-9 {
            let variance_m2 = (FINE_HEIGHT_M * FINE_HEIGHT_M) as f32;
            return BlownColumn { depth: 0.0, height_m: (bed_m + FINE_HEIGHT_M) as f32, variance_m2 };
        }
        let height_m = first / depth;
        let variance_m2 = (second / depth - height_m * height_m).max(HOPPING_HEIGHT_M * HOPPING_HEIGHT_M);
        BlownColumn { depth: depth as f32, height_m: height_m as f32, variance_m2: variance_m2 as f32 }
    }
}

#[cfg(test)]
mod tests;

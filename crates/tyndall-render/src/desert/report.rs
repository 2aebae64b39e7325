//! What a field of dunes amounts to, for people who watch it.

use std::time::Duration;

use tyndall_dunes::measure::{Bodies, Crests, HeightGrid, WindSlopes, bodies, crests, wind_slopes};
use tyndall_dunes::slab::DUNE_QUANTA_PER_CELL;
use tyndall_dunes::wind::Wind;
use tyndall_dunes::{DesertSimulation, Ledger, SandSimulation as _, SteppedBy};

/// Least ground (cells) of a heap that counts.
const LEAST_HEAP: usize = 30;

/// Figures of the field at the step that a picture shows.
#[derive(Clone, Debug, PartialEq)]
pub struct DesertReport {
    /// Steps made.
    pub step: u32,
    /// Cells from west to east and from south to north.
    pub size: [usize; 2],
    /// Side of a cell (m).
    pub cell_m: f64,
    /// All sand, counted grain by grain (quanta of 1/256 of a cell).
    pub sand_quanta: i64,
    /// Where it came from and went to; [`Ledger::expected`] is what must have been counted.
    pub ledger: Ledger,
    /// Lowest and highest place (m).
    pub height_range_m: [f32; 2],
    /// Slopes along the winds' sum.
    pub slopes: WindSlopes,
    /// Direction of the crests.
    pub crests: Crests,
    /// Heaps that stand out by more than the standard deviation of the sand's depth.
    pub heaps: usize,
    /// Share of the ground that has no sand.
    pub bare_share: f64,
    /// All winds of a period.
    pub winds: Vec<Wind>,
    /// Where the wind of the next step blows to, anticlockwise from east (deg).
    pub wind_toward_deg: f64,
    /// How long it took.
    pub times: DesertTimes,
    /// Who made the steps.
    pub stepped_by: SteppedBy,
}

/// How long the parts of making a bed took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DesertTimes {
    /// One of the last steps, on average; `None` before the first.
    pub step: Option<Duration>,
    /// What the picture needs of the field, and its figures.
    pub picture: Duration,
}

impl DesertReport {
    /// Of a field.
    pub(super) fn new(simulation: &DesertSimulation, times: DesertTimes) -> Self {
        let (field, size) = (simulation.field(), simulation.size());
        let winds = field.winds().winds();
        let grid = |quanta: &[i32]| {
            HeightGrid::from_quanta(size, quanta, DUNE_QUANTA_PER_CELL).expect("a field has as many heights as cells")
        };
        let depth: Vec<i32> = field.heights().iter().zip(field.bedrock()).map(|(height, rock)| height - rock).collect();
        let (bed, sand) = (grid(field.heights()), grid(&depth));
        let sum = drift(winds);
        // Winds that cancel leave the one that blows.
        let along_deg = if sum.variability > 0.05 { sum.toward_deg } else { simulation.wind_toward_deg() };
        let heaps = bodies(&sand, sand.mean_cells() + sand.rms_cells(), LEAST_HEAP);
        let (slopes, crests) = (wind_slopes(&bed, along_deg), crests(&bed));
        Self::with_figures((slopes, crests, heaps), simulation, times)
    }

    /// Of a field whose slopes, crests and heaps are still about those of an earlier report.
    pub(super) fn with_figures_of(known: &Self, simulation: &DesertSimulation, times: DesertTimes) -> Self {
        let heaps = Bodies { count: known.heaps, bare_share: known.bare_share };
        Self::with_figures((known.slopes, known.crests, heaps), simulation, times)
    }

    fn with_figures(
        (slopes, crests, heaps): (WindSlopes, Crests, Bodies),
        simulation: &DesertSimulation,
        times: DesertTimes,
    ) -> Self {
        let field = simulation.field();
        Self {
            step: simulation.step_count(),
            size: simulation.size(),
            cell_m: simulation.cell_m(),
            sand_quanta: field.mass_quanta(),
            ledger: field.ledger(),
            height_range_m: simulation.height_range_m(),
            slopes,
            crests,
            heaps: heaps.count,
            bare_share: heaps.bare_share,
            winds: field.winds().winds().to_vec(),
            wind_toward_deg: simulation.wind_toward_deg(),
            times,
            stepped_by: SteppedBy::default(),
        }
    }

    /// Quanta (of sand) as a volume (m^3).
    #[must_use]
    pub fn volume_m3(&self, quanta: i64) -> f64 {
        quanta as f64 / f64::from(DUNE_QUANTA_PER_CELL) * self.cell_m.powi(3)
    }
}

/// The sum of winds by the sand that they move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drift {
    /// Length of the sum over the sum of lengths, RDP/DP: 1 is one wind, 0 winds that cancel.
    pub variability: f64,
    /// Where the sum points, anticlockwise from east (deg).
    pub toward_deg: f64,
}

/// Where winds carry sand together.
#[must_use]
pub fn drift(winds: &[Wind]) -> Drift {
    let [total, x, y] = winds.iter().fold([0.0; 3], |[total, x, y], wind| {
        let (sin, cos) = wind.toward_deg.to_radians().sin_cos();
        [total + wind.share, x + wind.share * cos, y + wind.share * sin]
    });
    let variability = if total > 0.0 { x.hypot(y) / total } else { 0.0 };
    Drift { variability, toward_deg: y.atan2(x).to_degrees().rem_euclid(360.0) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tyndall_dunes::{DesertInputs, DesertParams};
    use tyndall_scene::Side;

    #[test]
    fn equal_winds_drift_between_them_and_opposite_ones_nowhere() {
        let wind = |toward_deg, share| Wind { toward_deg, share };
        let found = drift(&[wind(0.0, 1.0), wind(90.0, 1.0)]);
        assert!((found.toward_deg - 45.0).abs() < 1e-9, "{found:?}");
        assert!((found.variability - 0.5_f64.sqrt()).abs() < 1e-12, "{found:?}");
        assert!(drift(&[wind(30.0, 2.0), wind(210.0, 2.0)]).variability < 1e-12, "they cancel");
        assert!(drift(&[]).variability.abs() < 1e-12, "no wind at all");
    }

    #[test]
    fn a_report_counts_exactly_the_sand_that_its_ledger_expects() {
        let mut params = DesertParams::default();
        params.dunes.side = Side::Cells64;
        let mut desert = DesertSimulation::cold(&params, &DesertInputs::default()).unwrap();
        desert.advance(30);
        let report = DesertReport::new(&desert, DesertTimes::default());
        assert_eq!((report.step, report.sand_quanta), (30, report.ledger.expected()), "{report:?}");
        let depth_m = report.volume_m3(report.sand_quanta) / (64.0 * 64.0);
        assert!((depth_m - 3.0).abs() < 0.51, "three cells and the noise: {depth_m} m");
    }
}

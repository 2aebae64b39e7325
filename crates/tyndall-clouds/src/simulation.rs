//! Clouds from parameters: the automaton with its vapour, wind and density put together.

use tyndall_core::grid::Grid3;

use crate::automaton::{Automaton, AutomatonConfig};
use crate::ball_lattice::ball_density_into;
use crate::density::CloudDensity;
use crate::ellipsoid_list::parse_ellipsoids;
use crate::ellipsoids::{Ellipsoid, EllipsoidSupply, HumidEllipsoids};
use crate::error::{CloudError, in_range};
use crate::narrow::narrow;
use crate::painted_map::PaintedMap;
use crate::painted_vapour::{PaintedRange, PaintedVapour};
use crate::params::CloudParams;
use crate::probability::{Probabilities, ProbabilityLayer};
use crate::smoothing::SmoothingWindow;
use crate::statistics::CloudStatistics;
use crate::vapour::bubbles;
use crate::wind::{WindKnot, WindProfile};

/// Clouds of a scene.
#[derive(Debug)]
pub struct CloudSimulation {
    params: CloudParams,
    automaton: Automaton,
    density: CloudDensity,
    /// Share of cloud of each cell at the moment that was asked for last.
    share: Grid3<f32>,
}

impl CloudSimulation {
    /// Lays out the vapour, moistens the air and makes the steps of the warm-up.
    ///
    /// # Errors
    /// When a parameter is outside its range, the grid is too large, or the wind is too fast for the grid.
    pub fn new(params: &CloudParams) -> Result<Self, CloudError> {
        let mut simulation = Self::cold(params)?;
        simulation.advance(params.grid.warm_up_steps);
        Ok(simulation)
    }

    /// As [`CloudSimulation::new`], before the first step of the warm-up.
    ///
    /// # Errors
    /// As for [`CloudSimulation::new`].
    pub fn cold(params: &CloudParams) -> Result<Self, CloudError> {
        check(params)?;
        let (grid, vapour) = (&params.grid, &params.vapour);
        let size = [grid.cells_east, grid.cells_north, grid.cells_up].map(|cells| cells as usize);
        let config = AutomatonConfig {
            size,
            seed: u64::from(grid.seed),
            supply_interval: vapour.supply_interval,
            edges: grid.edges,
            inflow_humidity: 0.0,
            wind: wind_profile(params)?,
        };
        let mut automaton = Automaton::new(&config)?;
        let ellipsoids = ellipsoids(params)?;
        let layer = |supply| HumidEllipsoids::new(size, grid.edges, u64::from(grid.seed), supply, &ellipsoids);
        let [start, humidity, activation] = [vapour.start_humidity, vapour.humidity, vapour.activation].map(narrow);
        let painted = |supply| painted_vapour(params, supply);
        let at_start = EllipsoidSupply { extinction: 0.0, humidity: start, activation };
        let mut first: Vec<Box<dyn ProbabilityLayer>> = vec![Box::new(layer(at_start)?)];
        first.extend(painted(at_start)?);
        automaton.moisten(&first);
        let outside = Probabilities { extinction: narrow(vapour.extinction_outside), ..Probabilities::default() };
        let supply = EllipsoidSupply { extinction: narrow(vapour.extinction), humidity, activation };
        let mut stack: Vec<Box<dyn ProbabilityLayer>> = vec![Box::new(outside), Box::new(layer(supply)?)];
        stack.extend(painted(supply)?);
        automaton.set_probabilities(stack);
        let window = SmoothingWindow::new(params.matter.smooth_cells, params.matter.smooth_steps)?;
        let density = CloudDensity::new(&automaton, window);
        Ok(Self { params: params.clone(), automaton, density, share: Grid3::filled(size, 0.0) })
    }

    /// The parameters it was made with.
    #[must_use]
    pub fn params(&self) -> &CloudParams {
        &self.params
    }

    /// The automaton.
    #[must_use]
    pub fn automaton(&self) -> &Automaton {
        &self.automaton
    }

    /// The automaton, to be painted on; use [`CloudSimulation::advance`] to step.
    pub fn automaton_mut(&mut self) -> &mut Automaton {
        &mut self.automaton
    }

    /// The last states of cloud cells.
    #[must_use]
    pub fn density_history(&self) -> &CloudDensity {
        &self.density
    }

    /// The last states of cloud cells, to be put back from a file.
    pub fn density_history_mut(&mut self) -> &mut CloudDensity {
        &mut self.density
    }

    /// Makes steps.
    pub fn advance(&mut self, steps: u32) {
        for _ in 0..steps {
            let plan = self.automaton.step();
            self.density.observe(&self.automaton, &plan);
        }
    }

    /// Time of the last step since the warm-up's end (s).
    #[must_use]
    pub fn time_s(&self) -> f64 {
        let steps = f64::from(self.automaton.step_count()) - f64::from(self.params.grid.warm_up_steps);
        steps * self.params.grid.step_s
    }

    /// Share of cloud (0 to 1) of every cell between the last two steps; see [`CloudDensity::at`].
    ///
    /// # Errors
    /// When the fraction is outside 0 to 1.
    pub fn share(&mut self, fraction: f32) -> Result<&Grid3<f32>, CloudError> {
        self.density.at_into(&self.automaton, fraction, &mut self.share)?;
        let threshold = narrow(self.params.matter.threshold);
        for share in self.share.cells_mut() {
            *share = if *share < threshold { 0.0 } else { *share };
        }
        Ok(&self.share)
    }

    /// Extinction (1/m) at the cells' centres between the last two steps: equation (3).
    ///
    /// # Errors
    /// When the fraction is outside 0 to 1.
    pub fn extinction_per_m(&mut self, fraction: f32) -> Result<Grid3<f32>, CloudError> {
        let mut density = Grid3::filled(self.automaton.size(), 0.0);
        self.extinction_into(fraction, &mut density)?;
        Ok(density)
    }

    /// [`CloudSimulation::extinction_per_m`] into a grid that is there already.
    ///
    /// # Errors
    /// Also when the grid has another size.
    pub fn extinction_into(&mut self, fraction: f32, density: &mut Grid3<f32>) -> Result<(), CloudError> {
        let scale = narrow(self.ball_extinction_per_m());
        let (radius, edges) = (self.params.matter.ball_radius_cells, self.params.grid.edges);
        self.share(fraction)?;
        ball_density_into(&self.share, radius, edges, density)?;
        density.cells_mut().iter_mut().for_each(|value| *value *= scale);
        Ok(())
    }

    /// Extinction (1/m) in the middle of each cell's ball, 0 where there is none.
    pub(crate) fn peaks_per_m(&mut self, fraction: f32) -> Result<Grid3<f32>, CloudError> {
        let scale = narrow(self.ball_extinction_per_m());
        let mut peaks = self.share(fraction)?.clone();
        peaks.cells_mut().iter_mut().for_each(|peak| *peak *= scale);
        Ok(peaks)
    }

    /// Cells with cloud at the moment that was asked for last: as many as [`crate::CloudMatter`] has balls.
    #[must_use]
    pub fn ball_count(&self) -> usize {
        self.share.cells().iter().filter(|share| **share > 0.0).count()
    }

    /// Cover, heights and humidity.
    #[must_use]
    pub fn statistics(&self) -> CloudStatistics {
        CloudStatistics::of(self.automaton.fields())
    }

    /// Extinction in the middle of a lone full ball, such that full balls all around add up to the cloud's (1/m).
    fn ball_extinction_per_m(&self) -> f64 {
        let matter = &self.params.matter;
        matter.extinction_per_m / (tyndall_core::metaball::BALL_MASS * matter.ball_radius_cells.powi(3))
    }
}

/// Every parameter against its declared range.
fn check(params: &CloudParams) -> Result<(), CloudError> {
    for (_, set) in params.groups() {
        for (index, info) in set.info().iter().enumerate() {
            let limits = (*info.range.start(), *info.range.end());
            in_range(info.name, set.get(index), limits, "")?;
        }
    }
    Ok(())
}

/// The ellipsoids of the list, or those of the pattern where there is none.
fn ellipsoids(params: &CloudParams) -> Result<Vec<Ellipsoid>, CloudError> {
    let listed = parse_ellipsoids(&params.vapour.ellipsoids)?;
    Ok(if listed.is_empty() { bubbles(params) } else { listed.iter().map(|one| one.in_cells(params)).collect() })
}

/// The painted map's layer, if anything is painted.
fn painted_vapour(
    params: &CloudParams,
    supply: EllipsoidSupply,
) -> Result<Option<Box<dyn ProbabilityLayer>>, CloudError> {
    let (grid, vapour) = (&params.grid, &params.vapour);
    let map = PaintedMap::parse(&vapour.painted)?;
    if map.is_blank() {
        return Ok(None);
    }
    let heights_m = [vapour.base_m, vapour.base_m + vapour.bubble_height_m];
    let range = PaintedRange {
        supply,
        dry_extinction: narrow(vapour.extinction_outside),
        heights_cells: heights_m.map(|height| narrow(height / grid.cell_m)),
    };
    let levels = map.sampled([grid.cells_east, grid.cells_north].map(|cells| cells as usize));
    Ok(Some(Box::new(PaintedVapour::new(levels, range, grid.edges))))
}

/// Wind in cells per step.
fn wind_profile(params: &CloudParams) -> Result<WindProfile, CloudError> {
    let (wind, grid) = (&params.wind, &params.grid);
    let knot = |share: f64, speed_m_s: f64, from_deg: f64| {
        let (sine, cosine) = from_deg.to_radians().sin_cos();
        let cells = speed_m_s * grid.step_s / grid.cell_m;
        let height_cells = share * f64::from(grid.cells_up);
        WindKnot { height_cells, cells_per_step: [-sine * cells, -cosine * cells] }
    };
    let mut knots = vec![knot(0.0, wind.floor_speed_m_s, wind.floor_from_deg)];
    if wind.middle {
        knots.push(knot(wind.middle_share, wind.middle_speed_m_s, wind.middle_from_deg));
    }
    knots.push(knot(1.0, wind.ceiling_speed_m_s, wind.ceiling_from_deg));
    WindProfile::new(knots)
}

#[cfg(test)]
mod tests {
    use tyndall_core::metaball::BALL_MASS;

    use super::*;
    use crate::params::VapourPattern;

    fn small(pattern: VapourPattern) -> CloudParams {
        let mut params = pattern.preset();
        (params.grid.cells_east, params.grid.cells_north, params.grid.warm_up_steps) = (96, 96, 30);
        params
    }

    #[test]
    fn every_pattern_makes_clouds_above_its_base_and_below_the_ceiling() {
        for &pattern in VapourPattern::ALL {
            let params = small(pattern);
            let simulation = CloudSimulation::new(&params).unwrap();
            let statistics = simulation.statistics();
            assert!(statistics.cover > 0.01, "{pattern:?} has clouds: {statistics:?}");
            let base = params.vapour.base_m / params.grid.cell_m;
            // Cloud spreads downwards, but only one cell a step and not for long.
            assert!(f64::from(statistics.base_cells) > base - 4.0, "{pattern:?}: {statistics:?} over {base}");
            assert!(statistics.top_cells < params.grid.cells_up, "{pattern:?} keeps below the ceiling: {statistics:?}");
        }
    }

    #[test]
    fn patterns_differ_in_cover_as_their_names_say() {
        let cover = |pattern| CloudSimulation::new(&small(pattern)).unwrap().statistics().cover;
        let (fair, sea) = (cover(VapourPattern::FairWeather), cover(VapourPattern::SeaOfClouds));
        let deck = cover(VapourPattern::Stratocumulus);
        assert!(fair < 0.35, "fair weather leaves most of the sky: {fair}");
        assert!(deck > 0.6 && sea > 0.9, "stratocumulus {deck}, sea {sea}");
    }

    #[test]
    fn metaballs_hold_the_mass_of_the_density_grid() {
        let params = small(VapourPattern::CumulusField);
        let mut simulation = CloudSimulation::new(&params).unwrap();
        let cell_m3 = params.grid.cell_m.powi(3);
        let grid: f64 =
            simulation.extinction_per_m(1.0).unwrap().cells().iter().map(|v| f64::from(*v)).sum::<f64>() * cell_m3;
        let balls = crate::CloudMatter::of_simulation(&mut simulation, 1.0).unwrap().balls();
        assert_eq!(balls.balls.len(), simulation.ball_count(), "balls are counted without a list");
        let list = balls.mass_m2();
        // In a wrapped grid nothing is lost but what spills over floor and ceiling.
        assert!((grid / list - 1.0).abs() < 0.005, "{grid} {list}");
        let one = balls.balls[0];
        let want = BALL_MASS * f64::from(one.extinction_per_m) * f64::from(one.radius_m).powi(3);
        assert!((one.mass_m2() / want - 1.0).abs() < 1e-6, "mass of one ball");
    }

    #[test]
    fn clouds_grow_where_vapour_is_painted_and_vanish_where_it_is_erased() {
        let mut params = small(VapourPattern::FairWeather);
        params.vapour.cover = 0.0;
        params.wind.floor_speed_m_s = 0.0;
        params.wind.ceiling_speed_m_s = 0.0;
        let cover = |params: &CloudParams| CloudSimulation::new(params).unwrap().statistics().cover;
        assert!(cover(&params) < 1e-9, "no bubbles, no clouds");
        // The southern half full of vapour.
        params.vapour.painted = "1152u1152k".to_owned();
        let painted = cover(&params);
        assert!((0.4..0.6).contains(&painted), "{painted}");
        params.vapour.painted = "2304a".to_owned();
        params.vapour.cover = 0.5;
        assert!(cover(&params) < 1e-9, "erased everywhere");
    }

    #[test]
    fn listed_ellipsoids_take_the_place_of_the_pattern() {
        let mut params = small(VapourPattern::CumulusField);
        params.wind.floor_speed_m_s = 0.0;
        params.wind.ceiling_speed_m_s = 0.0;
        params.vapour.ellipsoids = "1000 -600 0 500 500 600".to_owned();
        let simulation = CloudSimulation::new(&params).unwrap();
        let cld = crate::statistics::project(&simulation.automaton().fields().cld);
        let covered = |x: usize, y: usize| cld[[x, y]];
        assert!(covered(48 + 20, 48 - 12), "in its middle");
        assert!(!covered(20, 70) && !covered(48, 80), "elsewhere");
        params.vapour.ellipsoids = "1 2".to_owned();
        assert!(CloudSimulation::new(&params).unwrap_err().to_string().contains("6 are needed"), "refused");
    }

    #[test]
    fn the_wind_in_the_middle_counts_only_where_it_is_wanted() {
        let mut params = CloudParams::default();
        let wind = &mut params.wind;
        (wind.floor_from_deg, wind.middle_from_deg, wind.ceiling_from_deg) = (270.0, 180.0, 270.0);
        (wind.middle_share, wind.middle_speed_m_s) = (0.25, 5.0);
        let middle = |params: &CloudParams| wind_profile(params).unwrap().at(8.0);
        let [east, north] = middle(&params);
        assert!(east > 1.0 && north.abs() < 1e-9, "from the west, 3 to 6 m/s: {east} {north}");
        params.wind.middle = true;
        let [east, north] = middle(&params);
        // 5 m/s from the south, 20 s a step, cells of 50 m.
        assert!(east.abs() < 1e-9 && (north - 2.0).abs() < 1e-9, "a quarter up: {east} {north}");
    }

    #[test]
    fn parameters_outside_their_range_and_storms_are_refused() {
        let mut params = CloudParams::default();
        params.vapour.cover = 1.5;
        assert_eq!(CloudSimulation::new(&params).unwrap_err().to_string(), "cover = 1.5 is outside 0 to 1");
        let mut storm = CloudParams::default();
        (storm.wind.ceiling_speed_m_s, storm.grid.step_s, storm.grid.cell_m) = (100.0, 600.0, 1.0);
        let text = CloudSimulation::new(&storm).unwrap_err().to_string();
        assert!(text.contains("cells per step"), "{text}");
    }
}

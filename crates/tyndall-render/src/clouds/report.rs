//! What a simulation of clouds amounts to, for people who watch it.

use std::time::Duration;

use tyndall_clouds::CloudStatistics;
use tyndall_clouds::statistics::{area_perimeter_dimension, project, separate_clouds};

use super::source::CloudSource;

/// Least area (cells) of a cloud that counts for the dimension: smaller ones are as round as cells.
const LEAST_AREA: u64 = 10;

/// Figures of the simulation at the step that a picture shows.
#[derive(Clone, Debug, PartialEq)]
pub struct CloudReport {
    /// Time since the end of the warm-up (s).
    pub time_s: f64,
    /// Steps made since the first state, those of the warm-up included.
    pub steps: u32,
    /// Cells of the grid.
    pub cells: u64,
    /// Cells that have become metaballs.
    pub balls: usize,
    /// Cover, heights, humidity.
    pub statistics: CloudStatistics,
    /// Clouds seen from below that count for the dimension.
    pub clouds: usize,
    /// Dimension of the clouds' outlines and its standard error; `None` with too few clouds.
    pub dimension: Option<(f64, f64)>,
    /// Time since the end of the warm-up (s) and share of the sky with cloud, for each of the last steps.
    pub cover: Vec<(f64, f64)>,
    /// How long it took.
    pub times: CloudTimes,
}

/// How long the parts of making clouds took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CloudTimes {
    /// One of the last steps, on average; `None` before the first.
    pub step: Option<Duration>,
    /// The light in all cells.
    pub light: Duration,
}

impl CloudReport {
    /// Of a source and the time that the light took; `None` when no simulation is its source.
    pub(super) fn new(source: &CloudSource, light: Duration) -> Option<Self> {
        let simulation = source.simulation()?;
        let fields = simulation.automaton().fields();
        let edges = simulation.params().grid.edges;
        let mut figures = separate_clouds(&project(&fields.cld), edges);
        figures.retain(|[area, _]| *area >= LEAST_AREA);
        Some(Self {
            time_s: simulation.time_s(),
            steps: simulation.automaton().step_count(),
            cells: fields.size().iter().map(|&count| count as u64).product(),
            balls: simulation.ball_count(),
            statistics: simulation.statistics(),
            clouds: figures.len(),
            dimension: area_perimeter_dimension(&figures),
            cover: source.cover_history().iter().copied().collect(),
            times: CloudTimes { step: source.step_time(), light },
        })
    }
}

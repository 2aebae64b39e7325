//! What users choose of the clouds: four groups of parameters, ready for a scene.

use tyndall_core::{choices, params};

use crate::edges::Edges;

choices! {
    /// How humid air is laid out.
    pub enum VapourPattern {
        /// Bubbles of rising air with flat bases at one level, many and of several sizes.
        CumulusField = "cumulus-field",
        /// A thin layer in closed cells, with narrow gaps.
        Stratocumulus = "stratocumulus",
        /// A few stacks of bubbles, one above the other, each narrower.
        Towering = "towering",
        /// A whole layer with swells, as seen from a mountain or an aeroplane.
        SeaOfClouds = "sea-of-clouds",
        /// Small bubbles far from each other.
        FairWeather = "fair-weather",
    }
}

params! {
    /// The box that clouds live in, and the time they take.
    pub struct CloudGridParams {
        /// Cells from west to east.
        cells_east: u32 = 256, ["1", 8..=2048, Log], "Dobashi et al. 2000";
        /// Cells from south to north.
        cells_north: u32 = 256, ["1", 8..=2048, Log], "Dobashi et al. 2000";
        /// Cells from the floor to the ceiling.
        cells_up: u32 = 32, ["1", 4..=256, Log], "Dobashi et al. 2000";
        /// Side of a cell.
        cell_m: f64 = 50.0, ["m", 1.0..=1000.0, Log], "design";
        /// Altitude of the grid's floor.
        floor_m: f64 = 1000.0, ["m", 0.0..=20000.0, Linear], "design";
        /// What lies beyond the sides of the grid.
        edges: Edges = Edges::Wrap, "design";
        /// Seed of the random numbers; another seed, other clouds.
        seed: u32 = 1, ["1", 0..=4294967295.0, Linear], "design";
        /// Steps made before the first picture.
        warm_up_steps: u32 = 60, ["1", 0..=10000, Log], "design";
        /// Time of a step.
        step_s: f64 = 20.0, ["s", 0.1..=600.0, Log], "design";
    }
}

params! {
    /// Where vapour is supplied and how soon cloud vanishes.
    pub struct CloudVapourParams {
        /// How humid air is laid out.
        pattern: VapourPattern = VapourPattern::CumulusField, "paper section 3.2";
        /// Share of the sky over which there is humid air.
        cover: f64 = 0.35, ["1", 0.0..=1.0, Linear], "design";
        /// Mean half width of a bubble of humid air.
        bubble_radius_m: f64 = 700.0, ["m", 20.0..=20000.0, Log], "Dobashi et al. 2000";
        /// Height of a bubble above its base.
        bubble_height_m: f64 = 900.0, ["m", 20.0..=10000.0, Log], "Dobashi et al. 2000";
        /// How much the sizes of bubbles differ.
        bubble_spread: f64 = 0.5, ["1", 0.0..=0.95, Linear], "design";
        /// Height of the condensation level above the grid's floor.
        base_m: f64 = 150.0, ["m", 0.0..=5000.0, Linear], "design";
        /// Share of cells that are humid at the start, in the middle of a bubble; clouds percolate from 0.17 on.
        start_humidity: f64 = 0.5, ["1", 0.0..=1.0, Linear], "Nagel and Raschke 1992";
        /// Probability in a step that a dry cell becomes humid, in the middle of a bubble.
        humidity: f64 = 0.15, ["1", 0.0..=1.0, Linear], "paper section 3.2";
        /// Probability in a step that a cell is activated, in the middle of a bubble.
        activation: f64 = 0.01, ["1", 0.0..=0.2, Linear], "paper section 3.2";
        /// Probability in a step that cloud vanishes, in the middle of a bubble.
        extinction: f64 = 0.05, ["1", 0.0..=1.0, Linear], "paper section 3.2";
        /// Probability in a step that cloud vanishes outside of bubbles.
        extinction_outside: f64 = 0.5, ["1", 0.0..=1.0, Linear], "paper section 3.2";
        /// Steps from one supply of vapour and activation to the next.
        supply_interval: u32 = 1, ["1", 1..=100, Linear], "paper section 3.2";
    }
}

params! {
    /// Wind in the box, linear from floor to ceiling.
    pub struct CloudWindParams {
        /// Speed at the floor.
        floor_speed_m_s: f64 = 3.0, ["m/s", 0.0..=100.0, Linear], "paper section 3.2";
        /// Direction at the floor from which the wind blows, clockwise from north.
        floor_from_deg: f64 = 240.0, ["deg", 0.0..=360.0, Linear], "paper section 3.2";
        /// Speed at the ceiling.
        ceiling_speed_m_s: f64 = 6.0, ["m/s", 0.0..=100.0, Linear], "paper section 3.2";
        /// Direction at the ceiling from which the wind blows, clockwise from north.
        ceiling_from_deg: f64 = 260.0, ["deg", 0.0..=360.0, Linear], "paper section 3.2";
    }
}

params! {
    /// From cells to the matter of a cloud.
    pub struct CloudMatterParams {
        /// Extinction deep in a cloud; its inverse is how far one sees there.
        extinction_per_m: f64 = 0.04, ["1/m", 0.0001..=1.0, Log], "Stephens 1978";
        /// Radius of the metaballs that cells become.
        ball_radius_cells: f64 = 2.0, ["cells", 1.0..=4.0, Linear], "paper eq. (3)";
        /// Reach of the smoothing in space.
        smooth_cells: u32 = 2, ["1", 0..=2, Linear], "Dobashi et al. 2000";
        /// Reach of the smoothing in time.
        smooth_steps: u32 = 2, ["1", 0..=2, Linear], "Dobashi et al. 2000";
        /// Share of cloud in a cell below which there is none.
        threshold: f64 = 0.02, ["1", 0.0..=0.5, Linear], "design";
    }
}

/// All groups together.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CloudParams {
    /// The box.
    pub grid: CloudGridParams,
    /// Vapour.
    pub vapour: CloudVapourParams,
    /// Wind.
    pub wind: CloudWindParams,
    /// Matter.
    pub matter: CloudMatterParams,
}

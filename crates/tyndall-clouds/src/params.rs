//! What users choose of the clouds: four groups of parameters, ready for a scene.

use std::fmt::Write as _;

use tyndall_core::{ParamSet, choices, params};

use crate::edges::Edges;
use crate::fnv::fnv1a;
use crate::narrow::narrow;

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
    text {
        /// Painted map of 48 x 48 places that cover the grid, row after row from the south-west: letters from a (no vapour) over
        /// k (as it is) to u (as in the middle of a bubble), each after the number of times that it stands there. Empty for none.
        painted = "", "design";
        /// Ellipsoids of humid air in place of the pattern's: east, north, height above the condensation level and three half
        /// axes (m), from the grid's middle; a semicolon between ellipsoids. Empty leaves the layout to the pattern.
        ellipsoids = "", "Dobashi et al. 2000";
    }
}

params! {
    /// Wind in the box, linear from floor to ceiling or to a height in between and on from there.
    pub struct CloudWindParams {
        /// Speed at the floor.
        floor_speed_m_s: f64 = 3.0, ["m/s", 0.0..=100.0, Linear], "paper section 3.2";
        /// Direction at the floor from which the wind blows, clockwise from north.
        floor_from_deg: f64 = 240.0, ["deg", 0.0..=360.0, Linear], "paper section 3.2";
        /// Speed at the ceiling.
        ceiling_speed_m_s: f64 = 6.0, ["m/s", 0.0..=100.0, Linear], "paper section 3.2";
        /// Direction at the ceiling from which the wind blows, clockwise from north.
        ceiling_from_deg: f64 = 260.0, ["deg", 0.0..=360.0, Linear], "paper section 3.2";
        /// Whether the wind at a height in between is given too.
        middle: bool = false, "design";
        /// That height, as a share of the height from floor to ceiling.
        middle_share: f64 = 0.5, ["1", 0.05..=0.95, Linear], "design";
        /// Speed in the middle.
        middle_speed_m_s: f64 = 4.5, ["m/s", 0.0..=100.0, Linear], "paper section 3.2";
        /// Direction in the middle from which the wind blows, clockwise from north.
        middle_from_deg: f64 = 250.0, ["deg", 0.0..=360.0, Linear], "paper section 3.2";
    }
}

params! {
    /// From cells to the matter of a cloud.
    pub struct CloudMatterParams {
        /// Extinction deep in a cloud; its inverse is how far one sees there.
        extinction_per_m: f64 = 0.07, ["1/m", 0.0001..=1.0, Log], "Stephens 1978";
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

/// Parameters of [`CloudGridParams`] that no step depends on.
const NOT_STEPPED: [&str; 2] = ["floor_m", "warm_up_steps"];

impl CloudParams {
    /// The groups with their names in scene files.
    #[must_use]
    pub fn groups(&self) -> [(&'static str, &dyn ParamSet); 4] {
        [
            ("cloud_grid", &self.grid),
            ("cloud_vapour", &self.vapour),
            ("cloud_wind", &self.wind),
            ("cloud_matter", &self.matter),
        ]
    }

    /// Hash of the parameters that steps follow from: equal ones take one state to the same next state. The matter, which is
    /// made of states, does not count.
    #[must_use]
    pub fn step_hash(&self) -> u64 {
        let mut text = String::new();
        for (group, set) in self.groups().into_iter().filter(|(group, _)| *group != "cloud_matter") {
            for (index, info) in set.info().iter().enumerate().filter(|(_, info)| !NOT_STEPPED.contains(&info.name)) {
                // Adding zero turns -0 into 0, which is equal to it.
                let value = info.format(set.get(index) + 0.0);
                // Writing to a String cannot fail.
                let _ = writeln!(text, "{group}.{}={value}", info.name);
            }
            // An empty text counts as none, so that states from before there were texts are still taken up.
            let texts = set.text_info().iter().enumerate().map(|(index, info)| (info.name, set.text(index)));
            for (name, value) in texts.filter(|(_, value)| !value.is_empty()) {
                let _ = writeln!(text, "{group}.{name}={value}");
            }
        }
        fnv1a(text.as_bytes())
    }

    /// A time (s) as the step that ends next and how much of it has passed (0 to 1): a whole number of steps is the whole of
    /// the last one.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "a cast to u32 saturates, which no time in range reaches")]
    pub fn moment(&self, time_s: f64) -> (u32, f32) {
        let steps = time_s / self.grid.step_s;
        let last = steps.ceil();
        (last as u32, narrow(1.0 - (last - steps)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_counts_what_steps_follow_from_and_nothing_else() {
        let base = CloudParams::default();
        let change = |change: fn(&mut CloudParams)| {
            let mut params = base.clone();
            change(&mut params);
            params.step_hash() == base.step_hash()
        };
        assert!(change(|params| params.grid.floor_m += 100.0), "the floor is only drawn");
        assert!(change(|params| params.matter.threshold += 0.1), "matter is only drawn");
        assert!(!change(|params| params.grid.seed += 1), "the seed");
        assert!(!change(|params| params.vapour.cover += 0.1), "vapour");
        assert!(!change(|params| params.vapour.painted.push_str("2304u")), "paint");
        assert!(!change(|params| params.wind.floor_from_deg += 0.1), "wind");
    }

    #[test]
    fn moments_are_shares_of_the_step_that_ends_next() {
        let params = CloudParams::default();
        let moment = |steps: f64| params.moment(steps * params.grid.step_s);
        assert_eq!(moment(0.0), (0, 1.0), "the end of the warm-up");
        assert_eq!(moment(3.0), (3, 1.0), "a whole step");
        assert_eq!(moment(2.25), (3, 0.25), "a quarter of the third");
    }
}

//! What users choose of a ripple bed.

use tyndall_core::params;

use crate::side::Side;

params! {
    /// Wind ripples by the rule of Nishimori and Ouchi; lengths in cells, the wind blows along +x of the bed.
    pub struct RippleParams {
        /// Cells along each side of the periodic bed.
        side: Side = Side::Cells512, "design";
        /// Length of a hop over a flat bed; grows with the force of the wind.
        hop_cells: f64 = 7.3, ["cells", 0.0..=64.0, Linear], "Nishimori and Ouchi 1993, L0";
        /// How much longer a hop is for each cell of height at its start; the mean speed of the wind in flight.
        hop_per_height: f64 = 2.0, ["1", 0.0..=8.0, Linear], "Nishimori and Ouchi 1993, b";
        /// Thickness of the layer that every cell loses in a step.
        layer_cells: f64 = 0.1, ["cells", 0.0..=2.0, Linear], "Nishimori and Ouchi 1993, q";
        /// Share of a cell's height difference to its neighbours that creeps away in a step.
        creep: f64 = 0.25, ["1", 0.0..=0.75, Linear], "Nishimori and Ouchi 1993, D";
        /// Slope of the line under an upwind crest below which nothing is lifted, in cells of height per cell; 0 turns the
        /// lee shadow off and lets ripples creep upwind.
        lee_slope: f64 = 0.25, ["1", 0.0..=8.0, Linear], "design; measured drift";
        /// Whether the fraction of a hop's length is kept as a probability; without it a nearly flat bed never ripples.
        dither: bool = true, "design; the dead zone of rounding";
        /// Hop length above which the wind planes the bed: grains stay in the air and only creep is left.
        planed_above_cells: f64 = 30.0, ["cells", 1.0..=64.0, Linear], "the paper, section 5.1: critical range of the wind";
        /// Depth of the sand over bedrock at the start.
        depth_cells: f64 = 32.0, ["cells", 0.0..=1024.0, Log], "design";
        /// Height range of the noise on the bed at the start.
        noise_cells: f64 = 0.1, ["cells", 0.0..=8.0, Linear], "Nishimori and Ouchi 1993";
        /// Number that picks one bed of all that are possible.
        seed: u32 = 1, ["1", 0.0..=4294967295.0, Linear], "design";
    }
}

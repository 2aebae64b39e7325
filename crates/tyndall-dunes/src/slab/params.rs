//! What users choose of a field of dunes.

use tyndall_core::{choices, params};

use crate::edges::Edges;
use crate::side::Side;

choices! {
    /// The rule by which sand moves.
    pub enum DuneModel {
        /// Slabs that hop until they stick, after Werner 1995, with a lee that catches them.
        Slab = "slab",
        /// Layers whose thickness and hop follow the slope, after Onoue and Nishita 2000.
        Classic = "classic",
    }
}

params! {
    /// A field of dunes; lengths in cells.
    pub struct DuneParams {
        /// The rule by which sand moves.
        model: DuneModel = DuneModel::Slab, "Werner 1995; Onoue and Nishita 2000, reference 15 of the paper";
        /// Cells along each side of the bed.
        side: Side = Side::Cells512, "design";
        /// What lies beyond the edges.
        edges: Edges = Edges::Periodic, "design";
        /// Length of a cell's side.
        cell_m: f64 = 1.0, ["m", 0.01..=100.0, Log], "design";
        /// Depth of the sand at the start, spread evenly.
        sand_cells: f64 = 3.0, ["cells", 0.0..=100.0, Log], "Werner 1995";
        /// Height range of the noise at the start.
        noise_cells: f64 = 1.0, ["cells", 0.0..=10.0, Linear], "Werner 1995";
        /// Thickness of the slab that a gust moves.
        slab_cells: f64 = 0.083, ["cells", 0.004..=1.0, Log], "Werner 1995; thinner, for smooth slopes";
        /// Chance that a sandy cell in the wind loses a slab in a step.
        lift: f64 = 0.25, ["1", 0.0..=1.0, Linear], "Werner 1995";
        /// Length of a hop at mean height.
        hop_cells: f64 = 5.0, ["cells", 1.0..=32.0, Linear], "Werner 1995";
        /// How much longer a hop is for each cell of height over the surroundings, as the wind is faster there.
        speed_up: f64 = 0.8, ["1", 0.0..=4.0, Linear], "Momiji et al. 2000, c1";
        /// Chance that a slab stays where it hits sand.
        drop_on_sand: f64 = 0.6, ["1", 0.0..=1.0, Linear], "Werner 1995";
        /// Chance that a slab stays where it hits bare ground.
        drop_on_bare: f64 = 0.4, ["1", 0.0..=1.0, Linear], "Werner 1995";
        /// Angle below the horizontal of the line behind a crest under which there is no wind.
        shadow_deg: f64 = 15.0, ["deg", 1.0..=45.0, Linear], "Werner 1995";
        /// Slope at which sand starts to slide.
        repose_deg: f64 = 33.5, ["deg", 10.0..=60.0, Linear], "angle of repose of dry sand, 32 to 35 deg";
        /// How much less steep a slope is when sliding ends.
        repose_drop_deg: f64 = 1.5, ["deg", 0.0..=5.0, Linear], "design; static and dynamic angle of repose";
        /// Most passes of sliding in a step; what is left slides in the next one.
        slide_passes: u32 = 8, ["1", 1..=200, Log], "design";
        /// Chance that a cell of an open upwind edge lets a slab in, in a step.
        inflow: f64 = 0.0, ["1", 0.0..=1.0, Linear], "design";
        /// Number that picks one field of all that are possible.
        seed: u32 = 1, ["1", 0.0..=4294967295.0, Linear], "design";
    }
}

params! {
    /// The rule of Onoue and Nishita 2000: layers whose thickness and hop follow the slope s along the wind.
    pub struct ClassicParams {
        /// Length of a hop on level ground, L0.
        hop_cells: f64 = 6.0, ["cells", 1.0..=32.0, Linear], "Onoue and Nishita 2000, L0";
        /// L = L0 (1 + this tanh s): below 0, hops shorten uphill.
        hop_gain: f64 = -1.0, ["1", -1.0..=1.0, Linear], "Nishimori and Ouchi 1993; the sign differs between retellings";
        /// Thickness of the layer that moves on level ground, N0.
        layer_cells: f64 = 0.05, ["cells", 0.004..=0.5, Log], "Onoue and Nishita 2000, q0";
        /// Layer = N0 (1 + this + gain tanh s).
        layer_excess: f64 = 0.3, ["1", 0.0..=1.0, Linear], "Nishimori and Ouchi 1993, epsilon";
        /// Gain of the layer with slope: above 0, uphill slopes lose more.
        layer_gain: f64 = 1.0, ["1", -1.0..=1.0, Linear], "Nishimori and Ouchi 1993; the sign differs between retellings";
        /// Share of a cell's height difference to its neighbours that creeps away in a step.
        creep: f64 = 0.05, ["1", 0.0..=0.75, Linear], "Nishimori and Ouchi 1993, D";
    }
}

params! {
    /// Plants that hold sand.
    pub struct VegetationParams {
        /// Whether plants grow.
        enabled: bool = false, "Nield and Baas 2008";
        /// Share of cells that carry plants at the start.
        cover: f64 = 0.02, ["1", 0.0..=1.0, Linear], "Nield and Baas 2008";
        /// Radius of a clump of plants.
        clump_cells: u32 = 3, ["cells", 0.0..=16.0, Linear], "design";
        /// How much a plant's cover grows in 16 steps when it is buried at the best rate.
        growth: f64 = 0.1, ["1", 0.0..=0.5, Linear], "Nield and Baas 2008";
        /// Burial in 16 steps at which plants grow best.
        best_burial_cells: f64 = 0.1, ["cells", 0.0..=1.0, Linear], "Nield and Baas 2008";
        /// Burial or erosion in 16 steps, away from the best, at which plants neither grow nor die.
        tolerance_cells: f64 = 0.6, ["cells", 0.02..=2.0, Linear], "Nield and Baas 2008";
        /// Slope at which fully covered sand starts to slide.
        repose_deg: f64 = 45.0, ["deg", 10.0..=70.0, Linear], "Paris et al. 2019";
    }
}

params! {
    /// Rock that blown sand wears down.
    pub struct AbrasionParams {
        /// Whether blown sand wears bedrock.
        enabled: bool = false, "Paris et al. 2019";
        /// Hardness of bedrock where no map says otherwise: 1 is not worn at all.
        hardness: f64 = 0.5, ["1", 0.0..=1.0, Linear], "Paris et al. 2019";
        /// Chance that bare bedrock of hardness 0 loses 1/256 cell in a step.
        rate: f64 = 0.2, ["1", 0.0..=1.0, Linear], "Paris et al. 2019";
    }
}

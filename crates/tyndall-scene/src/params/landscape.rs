//! What stands on the ground.

use tyndall_core::{choices, params};

choices! {
    /// What the landscape is made of.
    pub enum LandscapeKind {
        /// Nothing: the bare planet.
        None = "none",
        /// Rounded hills with woods and meadows.
        Hills = "hills",
        /// Mountains with crests, gullies and snow.
        Mountains = "mountains",
        /// A winding valley between two ranges of mountains, from south to north.
        Valley = "valley",
    }
}

params! {
    /// Geometry to see air by. It stands around the scene's origin and falls to the planet's level at its edge.
    pub struct LandscapeParams {
        /// What the landscape is made of.
        kind: LandscapeKind = LandscapeKind::None, "paper Fig. 2";
        /// Number of the landscape; another one gives other hills.
        seed: u32 = 1, ["1", 0..=65535, Linear], "O'Neill 2014";
        /// Side of the square that the landscape fills.
        size_km: f64 = 60.0, ["km", 1.0..=400.0, Log], "design";
        /// Height of high peaks above the planet's level.
        height_m: f64 = 1500.0, ["m", 10.0..=6000.0, Log], "design";
        /// Width of a hill or a mountain, or of the valley from crest to crest.
        feature_km: f64 = 6.0, ["km", 0.5..=50.0, Log], "Musgrave et al. 1989";
        /// Altitude above which gentle slopes carry snow.
        snow_line_m: f64 = 1800.0, ["m", 0.0..=9000.0, Linear], "design";
    }
}

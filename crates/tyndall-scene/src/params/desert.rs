//! Whether there is a desert. What it consists of stands in the groups of [`tyndall_dunes::DesertParams`].

use tyndall_core::{choices, params};

choices! {
    /// What the desert is made by.
    pub enum DesertKind {
        /// There is none.
        None = "none",
        /// A field of dunes under the wind: see the groups that begin with dune, and `ripples`.
        Dunes = "dunes",
    }
}

params! {
    /// Sand under the wind. The field is centred on the scene's origin.
    pub struct DesertSceneParams {
        /// What the desert is made by.
        kind: DesertKind = DesertKind::None, "paper section 5";
        /// Steps of the field that the picture shows: how long the wind has blown.
        steps: u32 = 1000, ["1", 0..=1000000, Log], "paper section 5.2";
        /// Steps that the wind has blown over the tile of ripples.
        ripple_steps: u32 = 1500, ["1", 0..=100000, Log], "paper section 5.1";
        /// Height of the darkest sample of a height map whose file does not say it (.r16, .png of other programs).
        terrain_low_m: f64 = 0.0, ["m", -10000.0..=10000.0, Linear], "design";
        /// Height of the brightest sample of a height map whose file does not say it (.r16, .png of other programs).
        terrain_high_m: f64 = 50.0, ["m", -10000.0..=10000.0, Linear], "design";
        /// Size of the grains: finer sand moves in weaker winds. Used with a wind table.
        grain_um: f64 = 250.0, ["um", 60.0..=2000.0, Log], "Bagnold 1941";
        /// Sectors that the winds of a wind table are gathered in.
        wind_sectors: u32 = 16, ["1", 1..=64, Linear], "Fryberger 1979";
    }
    text {
        /// Height map of the rock under the sand, relative to the scene's file: .png, .exr, .r16 or .r32, stretched over the
        /// field, its lowest place at the level of the ground. Empty for level ground.
        terrain = "", "design";
        /// Winds by hand in place of those of `dune_wind`: where each blows to, anticlockwise from east in degrees, and its
        /// share of the sand that is moved, as `0 1; 120 0.5`. The period is that of `dune_wind`. Empty for none.
        winds = "", "design";
        /// Strokes by hand: step, tool (add, dig, flatten, walk), radius in m, depth in m or share flattened, and a path in m
        /// east and north of the field's middle, as `700 dig 6 0.4 10 -20 14 -22; ...`. Empty for none.
        strokes = "", "design";
        /// Table of measured winds (.csv) in place of the winds of `dune_wind`, relative to the scene's file: columns
        /// `direction_deg` (where the wind comes from, clockwise from north) and `speed_m_s`, if need be `weight`. The period is
        /// that of `dune_wind`. Empty for none.
        wind_table = "", "Fryberger 1979";
    }
}

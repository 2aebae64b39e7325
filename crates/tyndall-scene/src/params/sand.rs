//! What the sand of the desert looks like.

use tyndall_core::{choices, params};

choices! {
    /// How ripples are drawn.
    pub enum RippleLook {
        /// At any distance with their mean slope and its spread, so that far ripples keep brightness and gloss.
        Best = "best",
        /// As normals of four sizes, one for each quadrilateral by its distance, as in the paper.
        Paper = "paper",
        /// Not at all: smooth dunes.
        None = "none",
    }
}

params! {
    /// What the sand of the desert looks like; where it lies stands in the groups `desert` and `dunes`.
    pub struct SandParams {
        /// Share of red light that sand reflects.
        red: f64 = 0.52, ["1", 0.0..=1.0, Linear], "dry quartz sand with iron oxide";
        /// Share of green light that sand reflects.
        green: f64 = 0.36, ["1", 0.0..=1.0, Linear], "dry quartz sand with iron oxide";
        /// Share of blue light that sand reflects.
        blue: f64 = 0.22, ["1", 0.0..=1.0, Linear], "dry quartz sand with iron oxide";
        /// Standard deviation of the slopes of grains; rougher sand is flatter to look at.
        roughness_deg: f64 = 22.0, ["deg", 0.0..=45.0, Linear], "Oren and Nayar 1994";
        /// Strength of the sheen against the sun.
        shine: f64 = 0.5, ["1", 0.0..=4.0, Linear], "design";
        /// How much of the sheen comes from single grains.
        glints: f64 = 0.5, ["1", 0.0..=1.0, Linear], "design";
        /// How ripples are drawn.
        ripples: RippleLook = RippleLook::Best, "paper section 5.3; Olano and Baker 2010";
        /// Whether ripples near the camera hide and shade each other.
        relief: bool = true, "Policarpo, Oliveira and Comba 2005";
        /// Length of ripples on level sand, from crest to crest.
        ripple_length_m: f64 = 0.14, ["m", 0.01..=5.0, Log], "Bagnold 1941: 7 to 14 cm";
        /// Length of a ripple over its height.
        ripple_index: f64 = 16.0, ["1", 5.0..=100.0, Log], "Bagnold 1941: 15 to 20";
        /// Factor on the light that sunlit sand throws on the sand around it.
        bounce: f64 = 1.0, ["1", 0.0..=2.0, Linear], "design";
        /// Wind 10 m over level sand that blows sand over the crests as the picture is taken: from 5 m/s veils trail over the
        /// lee, 15 m/s is a storm; 0 for none.
        wind_m_s: f64 = 0.0, ["m/s", 0.0..=40.0, Linear], "Kawamura 1951; Bagnold 1941";
        /// How long that wind has carried the streaks of blowing sand; frames of an animation go on from here.
        wind_time_s: f64 = 0.0, ["s", 0.0..=100000.0, Linear], "design";
    }
}

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
        steps: u32 = 1000, ["1", 0..=200000, Log], "paper section 5.2";
        /// Steps that the wind has blown over the tile of ripples.
        ripple_steps: u32 = 1500, ["1", 0..=100000, Log], "paper section 5.1";
    }
}

//! Whether there are clouds, and how they are drawn. What they consist of stands in the groups of [`tyndall_clouds::params`].

use tyndall_core::{choices, params};

use super::Orders;

choices! {
    /// What the clouds are made by.
    pub enum CloudKind {
        /// There are none.
        None = "none",
        /// A cellular automaton on a grid: see the groups that begin with cloud.
        Automaton = "automaton",
    }
}

params! {
    /// Clouds in the sky. The grid is centred on the scene's origin.
    pub struct CloudsParams {
        /// What the clouds are made by.
        kind: CloudKind = CloudKind::None, "paper section 3";
        /// Time since the end of the warm-up: clouds drift, form and vanish.
        time_s: f64 = 0.0, ["s", 0.0..=100000.0, Linear], "paper section 3.2";
        /// Distance from the camera up to which clouds are drawn.
        reach_km: f64 = 60.0, ["km", 1.0..=300.0, Log], "design";
        /// Whether light counts that was scattered in a cloud once, as in the paper, or any number of times.
        orders: Orders = Orders::All, "paper section 3.3";
        /// Mean cosine of the forward lobe; near 1 bright edges around the sun.
        forward_asymmetry: f64 = 0.89, ["1", 0.0..=0.95, Linear], "Henyey and Greenstein 1941";
        /// Mean cosine of the backward lobe.
        backward_asymmetry: f64 = -0.5, ["1", -0.95..=0.0, Linear], "Henyey and Greenstein 1941";
        /// Share of the light in the forward lobe.
        forward_weight: f64 = 0.94, ["1", 0.0..=1.0, Linear], "two-term Henyey-Greenstein";
        /// How deep turbulence finer than a cell cuts into the edges of clouds; 0 leaves them smooth.
        detail: f64 = 0.6, ["1", 0.0..=1.0, Linear], "Schneider and Vos 2015";
    }
}

impl CloudsParams {
    /// Mean cosine of scattering.
    #[must_use]
    pub fn mean_cosine(&self) -> f64 {
        self.forward_weight * self.forward_asymmetry + (1.0 - self.forward_weight) * self.backward_asymmetry
    }
}

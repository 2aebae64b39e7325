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
        /// A grid or a list of metaballs: see `clouds.file`.
        File = "file",
    }
}

choices! {
    /// What the numbers of a grid in a file are.
    pub enum CloudFileHolds {
        /// How dense the cloud is in the middle of each cell.
        Density = "density",
        /// How dense the metaball of each cell is: the cloud is their sum.
        Balls = "balls",
    }
}

choices! {
    /// How clouds are drawn.
    pub enum CloudMethod {
        /// By a march through their grid at every pixel.
        Volume = "volume",
        /// As metaballs on billboards, as in the paper; smooth and fast.
        Splats = "splats",
    }
}

choices! {
    /// How many of the picture's pixels clouds are marched for.
    pub enum CloudResolution {
        /// Every pixel.
        Full = "full",
        /// One of four, and what lies between from their neighbours at the same depth.
        Half = "half",
    }
}

params! {
    /// Clouds in the sky. The grid is centred on the scene's origin.
    pub struct CloudsParams {
        /// What the clouds are made by.
        kind: CloudKind = CloudKind::None, "paper section 3";
        /// How clouds are drawn: marched, or as the paper's metaballs on billboards, which are smoother.
        method: CloudMethod = CloudMethod::Volume, "paper section 3.3";
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
        /// How sharply turbulence finer than a cell cuts the edges of clouds; 0 leaves them smooth. The mean density stays.
        detail: f64 = 0.85, ["1", 0.0..=1.0, Linear], "Schneider and Vos 2015";
        /// How many pixels are marched. Half costs a quarter and blurs the edges of clouds a little.
        resolution: CloudResolution = CloudResolution::Full, "design";
        /// What the numbers of a grid in a file are: the cloud itself, or the metaballs that add up to it, of the radius in
        /// `cloud_matter`. Used when kind is file.
        file_holds: CloudFileHolds = CloudFileHolds::Density, "paper eq. (3)";
        /// Where in its cell the metaball of a file's grid stands, along each axis; 0.5 is the middle. Used when the file holds
        /// balls.
        file_ball_place: f64 = 0.5, ["1", 0.0..=1.0, Linear], "scene convention";
        /// Samples of the cloud along each side of a cell of a file's grid: two are enough to show balls of two cells as they
        /// are (57 dB against a march), with one they blur (36 dB). Used when the file holds balls.
        file_samples: u32 = 2, ["1", 1..=4, Linear], "design";
    }
    text {
        /// The file that the clouds come from, relative to the scene's file: a grid (.npy, .npz) of bytes, 16-bit numbers (both
        /// as shares of their largest) or floats with the axes east, north, up, or a list of metaballs (.csv, .json) in metres
        /// east and north of the origin and altitudes. A grid is centred on the scene's origin; the cells' side, the floor and
        /// the edges are those of `cloud_grid`, and 1 stands for the extinction in `cloud_matter`. Used when kind is file.
        file = "", "design";
        /// Name of the grid in an .npz file; empty for the only one with three dimensions. Used when kind is file.
        array = "", "design";
    }
}

impl CloudsParams {
    /// Mean cosine of scattering.
    #[must_use]
    pub fn mean_cosine(&self) -> f64 {
        self.forward_weight * self.forward_asymmetry + (1.0 - self.forward_weight) * self.backward_asymmetry
    }
}

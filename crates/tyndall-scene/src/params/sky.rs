//! How the sky is computed.

use tyndall_core::{choices, params};

choices! {
    /// What surrounds everything.
    pub enum SkyKind {
        /// The atmosphere, lit by sun and moon, with stars behind it.
        Air = "air",
        /// Nothing: no air, no haze, no stars and no ground, only the sun's light on clouds.
        Black = "black",
    }
}

choices! {
    /// Where the colour of the sky is evaluated.
    pub enum SkyMode {
        /// At every pixel of the picture.
        PerPixel = "per-pixel",
        /// At the vertices of a dome, and interpolated in between, as in the paper.
        VertexDome = "vertex-dome",
    }
}

choices! {
    /// How often the light of the sky was scattered.
    pub enum Orders {
        /// Once, as in equation (1) of the paper: dark horizons, black earth shadow.
        Single = "single",
        /// Twice, the second time from eight directions: reference 7 of the paper.
        Nishita1996 = "nishita-1996",
        /// Any number of times, by the air, the aerosol and the ground.
        All = "all",
    }
}

choices! {
    /// How finely light that was scattered more than once is computed.
    pub enum OrdersDetail {
        /// One per cent by day, in an eighth of the time.
        Preview = "preview",
        /// Half a per cent by day.
        Best = "best",
    }
}

params! {
    /// The sky's method and its resolution. The defaults suit every scene; see each line for when to change it.
    pub struct SkyParams {
        /// What surrounds everything. Before a black sky without air or ground clouds are lit by the sun alone, as in
        /// pictures that renderers are compared by.
        kind: SkyKind = SkyKind::Air, "scene convention";
        /// Where the colour is evaluated: at every pixel, or as in the paper at the vertices of a dome.
        mode: SkyMode = SkyMode::PerPixel, "paper section 2; Hillaire 2020";
        /// Whether light counts that was scattered once, as in the paper, twice as its reference 7 has it (from eight directions, for air and sky; the ground and what stands on it are lit as by one), or any number of times, as in nature. Random walks (render --reference, validate) always count all.
        orders: Orders = Orders::All, "paper eq. (1); Nishita et al. 1996";
        /// How finely light that was scattered more than once is computed. Used with all orders.
        orders_detail: OrdersDetail = OrdersDetail::Best, "spherical harmonics of degree 4";
        /// Rows of the sky table, over the elevation of view. Raise it when a low sun shows rings at the horizon.
        table_elevations: u32 = 320, ["1", 32..=1024, Log], "Hillaire 2020";
        /// Columns of the sky table, over the angle from the sun's azimuth. Raise it for very hazy air.
        table_azimuths: u32 = 96, ["1", 8..=256, Log], "Hillaire 2020";
        /// Steps of the integral along each ray of view.
        march_steps: u32 = 32, ["1", 8..=64, Log], "paper eq. (2)";
        /// Columns of the volume of air in front of the camera, which things in the air are seen through. Raise it for very wide
        /// views. Used with a landscape.
        aerial_columns: u32 = 32, ["1", 4..=256, Log], "Hillaire 2020";
        /// Rows of that volume. Raise it when the surface of fog shows stripes.
        aerial_rows: u32 = 64, ["1", 4..=256, Log], "Hillaire 2020";
        /// Farthest distance of that volume; what lies beyond is dimmed as if it were there.
        aerial_distance_km: f64 = 200.0, ["km", 1.0..=1000.0, Log], "Hillaire 2020";
        /// Rings of the dome from horizon to zenith, denser at the horizon. Used in the vertex-dome mode.
        dome_rings: u32 = 48, ["1", 4..=256, Log], "paper section 2";
        /// Vertices in each ring of the dome. Used in the vertex-dome mode.
        dome_segments: u32 = 96, ["1", 8..=512, Log], "paper section 2";
    }
}

//! Metaballs drawn as billboards: the rendering of section 3.3 of the paper, for any list of balls, on the CPU.
//!
//! - [`ball_depths`]: the sun pass. How much cloud lies between the light and every ball, without any buffer of pixels and
//!   without reading one back: balls are sorted into the cells of a plane across the light, and each adds up the columns of
//!   those that it shares a cell with.
//! - [`light_balls`]: what follows from that for every ball: sunlight that arrives before its own splat, light that was
//!   scattered often, the share of the sky.
//! - [`SplatView`] and [`project`]: the balls as a camera sees them, sorted from back to front.
//! - [`rasterise`]: the view pass, C = C att + col (1 - att), in bands of rows on all threads; the closed form of the column
//!   in place of the paper's texture, so that a picture has no resolution but its own.
//! - [`BallField`]: a field of balls that repeats to the horizon, coarser with distance.
//! - [`shadow_map`]: the paper's final light buffer, for the ground.
//!
//! What a picture holds is [`SplatPlanes`]: shares of light, not colours, so that sun, sky and air are applied once a pixel.
//! The same bits result on any number of threads and for any order of the list.

mod bins;
mod column;
mod depths;
mod field;
mod light;
mod planes;
mod project;
mod raster;
mod shadow;
mod view;

pub use depths::{BallDepth, ball_depths};
pub use field::BallField;
pub use light::{LitBall, SplatLighting, light_balls};
pub use planes::{SplatPixel, SplatPlanes};
pub use project::{SeenBall, project};
pub use raster::{SplatOrders, rasterise};
pub use shadow::{ShadowPlane, shadow_map};
pub use view::{SplatProjection, SplatView};

//! Sky, sun's disc and ground. WGSL: `shaders/sky`.
//!
//! [`SkyTables`] keeps the column, irradiance, orders and sky-view tables and rebuilds the ones whose inputs changed: a
//! new medium rebuilds all, a new sun or altitude only the sky-view table. [`SkyRenderer`] draws the ground, then the sky per
//! pixel or, as in the paper, on a dome of coloured vertices.

mod building;
pub mod gpu_data;
pub(crate) mod light;
pub mod night;
mod orders;
mod orders_cpu;
mod orders_gpu;
mod passes;
mod tables;

pub use building::{TableBuilding, TableProgress, Wake};
pub use light::{SkyLightReach, SkyLightTable};
pub use orders::{OrdersRequest, OrdersTable};
pub use passes::{SkyDrawData, SkyRenderer};
pub use tables::SkyTables;

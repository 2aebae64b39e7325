//! The clouds' uniform and how it follows from a scene.

use tyndall_clouds::{CloudMatter, Edges};
use tyndall_scene::{CloudsParams, Orders};

use super::skip::BLOCK_CELLS;

/// Twin of `Clouds` in `shaders/clouds/clouds.wgsl`; units and meanings there.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[expect(missing_docs, reason = "documented at the WGSL twin")]
pub struct Clouds {
    pub size: [f32; 3],
    pub cell_m: f32,
    pub asymmetry: [f32; 2],
    pub forward_weight: f32,
    pub transport: f32,
    pub floor_m: f32,
    pub ceiling_m: f32,
    pub reach_m: f32,
    pub full_per_m: f32,
    pub wraps: u32,
    pub all_orders: u32,
    pub detail: f32,
    pub block_cells: f32,
    pub low_corner_m: [f32; 2],
    pub drift_cells: [f32; 2],
}

/// Twin of `CloudShadow` in `shaders/clouds/shade.wgsl`; units and meanings there.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[expect(missing_docs, reason = "documented at the WGSL twin")]
pub struct CloudShadow {
    pub map_corner_m: [f32; 2],
    pub map_size_m: [f32; 2],
    pub cells_corner_m: [f32; 2],
    pub cells_size_m: [f32; 2],
    pub slope: [f32; 2],
    pub floor_m: f32,
    pub ceiling_m: f32,
    pub texel_m: f32,
    pub spread: f32,
    pub layers: f32,
    pub wraps: u32,
    pub mean: [f32; 3],
    pub moonlit: u32,
    pub lamp: [f32; 3],
    pub padding: u32,
}

impl Clouds {
    /// From how clouds are drawn, what they consist of, the extinction deep in them (1/m), and how far the wind has moved their
    /// turbulence (cells east and north).
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "the GPU computes in f32")]
    pub fn new(drawn: &CloudsParams, matter: &CloudMatter, full_per_m: f64, drift_cells: [f64; 2]) -> Self {
        let [west, south, floor_m] = matter.low_corner_m;
        Self {
            size: matter.extinction_per_m.size().map(|cells| cells as f32),
            cell_m: matter.cell_m as f32,
            asymmetry: [drawn.forward_asymmetry, drawn.backward_asymmetry].map(|g| g as f32),
            forward_weight: drawn.forward_weight as f32,
            transport: transport(drawn) as f32,
            floor_m: floor_m as f32,
            ceiling_m: (floor_m + matter.extent_m()[2]) as f32,
            reach_m: (1e3 * drawn.reach_km) as f32,
            full_per_m: full_per_m as f32,
            wraps: u32::from(matter.edges == Edges::Wrap),
            all_orders: u32::from(drawn.orders == Orders::All),
            detail: drawn.detail as f32,
            block_cells: BLOCK_CELLS as f32,
            low_corner_m: [west as f32, south as f32],
            drift_cells: drift_cells.map(|cells| cells as f32),
        }
    }
}

/// One less the mean cosine of scattering: extinction times this is what light meets that was scattered often.
pub(super) fn transport(drawn: &CloudsParams) -> f64 {
    1.0 - drawn.mean_cosine()
}

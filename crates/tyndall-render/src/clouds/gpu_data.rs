//! The clouds' uniform and how it follows from a scene.

use tyndall_clouds::{CloudParams, Edges};
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
}

impl Clouds {
    /// From how clouds are drawn and what they consist of.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "the GPU computes in f32")]
    pub fn new(drawn: &CloudsParams, params: &CloudParams) -> Self {
        let grid = &params.grid;
        let size = [grid.cells_east, grid.cells_north, grid.cells_up].map(|cells| cells as f32);
        Self {
            size,
            cell_m: grid.cell_m as f32,
            asymmetry: [drawn.forward_asymmetry, drawn.backward_asymmetry].map(|g| g as f32),
            forward_weight: drawn.forward_weight as f32,
            transport: transport(drawn) as f32,
            floor_m: grid.floor_m as f32,
            ceiling_m: (grid.floor_m + f64::from(grid.cells_up) * grid.cell_m) as f32,
            reach_m: (1e3 * drawn.reach_km) as f32,
            full_per_m: params.matter.extinction_per_m as f32,
            wraps: u32::from(grid.edges == Edges::Wrap),
            all_orders: u32::from(drawn.orders == Orders::All),
            detail: drawn.detail as f32,
            block_cells: BLOCK_CELLS as f32,
        }
    }
}

/// One less the mean cosine of scattering: extinction times this is what light meets that was scattered often.
pub(super) fn transport(drawn: &CloudsParams) -> f64 {
    1.0 - drawn.mean_cosine()
}

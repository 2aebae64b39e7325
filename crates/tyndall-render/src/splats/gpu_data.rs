//! Buffers of splats.

use tyndall_clouds::splats::{SeenBall, SplatOrders, SplatProjection, SplatView};
use tyndall_scene::camera::NEAR_M;

/// Twin of `SplatBall` in `shaders/splats/splats.wgsl`; units and meanings there.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[expect(missing_docs, reason = "documented at the WGSL twin")]
pub struct SplatBall {
    pub centre_m: [f32; 3],
    pub radius_m: f32,
    pub extent: [f32; 4],
    pub peak: f32,
    pub distance_m: f32,
    pub sun_depth: f32,
    pub forward: f32,
    pub diffuse: f32,
    pub sky: f32,
    pub slope: [f32; 2],
}

impl From<&SeenBall> for SplatBall {
    fn from(ball: &SeenBall) -> Self {
        let SeenBall { centre_m, radius_m, extent, peak, distance_m, sun_depth, forward, diffuse, sky, slope } = *ball;
        Self { centre_m, radius_m, extent, peak, distance_m, sun_depth, forward, diffuse, sky, slope }
    }
}

/// Twin of `SplatCamera` in `shaders/splats/splats.wgsl`; units and meanings there.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[expect(missing_docs, reason = "documented at the WGSL twin")]
pub struct SplatCamera {
    pub half: [f32; 2],
    pub perspective: f32,
    pub transport: f32,
    pub near_m: f32,
    pub padding: f32,
}

impl SplatCamera {
    /// Of a view, for orders of scattering.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "the GPU computes in f32")]
    pub fn new(view: &SplatView, orders: SplatOrders) -> Self {
        let (half, perspective) = match view.projection {
            SplatProjection::Perspective { tan_half } => (tan_half, 1.0),
            SplatProjection::Orthographic { half_m } => (half_m, 0.0),
        };
        let transport = match orders {
            SplatOrders::Single => 0.0,
            SplatOrders::All { transport } => transport as f32,
        };
        Self { half: half.map(|part| part as f32), perspective, transport, near_m: NEAR_M as f32, padding: 0.0 }
    }
}

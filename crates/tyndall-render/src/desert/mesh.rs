//! How fine the desert's mesh is in a view. WGSL: `shaders/desert/mesh.wgsl`.
//!
//! Rings around the camera over the azimuths that are seen, each wider than the last by the same factor: quadrilaterals of
//! equal size on the picture at any distance, without seams, and none behind the camera. A dune's windward and lee slopes
//! make its crest's height wrong by a sixth of the spacing at most.

use tyndall_scene::Scene;

use crate::View;
use crate::landscape::mesh::{Azimuths, azimuths};

/// Rings, the centre included.
const RINGS: u32 = 1536;

/// The mesh of a view. Lengths in metres, angles from east to north.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DesertMesh {
    /// Vertices of a ring.
    pub columns: u32,
    /// Rings, the centre included.
    pub rings: u32,
    /// Radius of the first ring outside the centre.
    pub centre_radius_m: f64,
    /// Radius of the last ring.
    pub far_radius_m: f64,
    /// Azimuth of the first column.
    pub first_azimuth_rad: f64,
    /// From one column to the next.
    pub azimuth_step_rad: f64,
}

impl DesertMesh {
    /// For a view of a scene whose camera stands `clearance_m` over sand that is nowhere higher than `highest_m`.
    #[must_use]
    pub fn new(scene: &Scene, view: View, size_px: [u32; 2], clearance_m: f64, highest_m: f64) -> Self {
        let frame = view.frame(&scene.camera);
        let radius_m = 1e3 * scene.atmosphere.planet_radius_km;
        let horizon_m = |altitude_m: f64| (altitude_m.max(0.0) * (2.0 * radius_m + altitude_m)).sqrt();
        let far_radius_m = (horizon_m(frame.position.z) + horizon_m(highest_m)).clamp(1000.0, 1.5 * radius_m);
        let Azimuths { first_rad, step_rad, count } = azimuths(&frame, view, size_px);
        Self {
            columns: count,
            rings: RINGS,
            centre_radius_m: (0.25 * clearance_m).clamp(0.02, 0.25 * far_radius_m),
            far_radius_m,
            first_azimuth_rad: first_rad,
            azimuth_step_rad: step_rad,
        }
    }

    /// Number of vertices.
    #[must_use]
    pub fn vertices(&self) -> u32 {
        self.columns * self.rings
    }
}

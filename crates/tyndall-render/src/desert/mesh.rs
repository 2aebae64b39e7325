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

/// Rows of a quick picture for each ring, its least rings, and columns that become one.
const QUICK_RING_PX: u32 = 2;
const LEAST_RINGS: u32 = 96;
const QUICK_COLUMNS: u32 = 2;

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

    /// The same view with few quadrilaterals, each several pixels of the picture wide: for pictures that are soon followed by
    /// others. Software adapters shade whole blocks of pixels for each triangle, however small it is.
    #[must_use]
    pub fn quick(self, size_px: [u32; 2]) -> Self {
        let rings = (size_px[1] / QUICK_RING_PX).clamp(LEAST_RINGS, self.rings);
        let columns = (self.columns / QUICK_COLUMNS).max(2);
        let wider = f64::from(self.columns - 1) / f64::from(columns - 1);
        Self { rings, columns, azimuth_step_rad: self.azimuth_step_rad * wider, ..self }
    }

    /// Number of vertices.
    #[must_use]
    pub fn vertices(&self) -> u32 {
        self.columns * self.rings
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quick_mesh_covers_the_same_view_with_fewer_quadrilaterals() {
        let (scene, size_px) = (Scene::default(), [320, 180]);
        let fine = DesertMesh::new(&scene, View::Camera, size_px, 10.0, 30.0);
        let quick = fine.quick(size_px);
        let last = |mesh: &DesertMesh| mesh.first_azimuth_rad + mesh.azimuth_step_rad * f64::from(mesh.columns - 1);
        assert!((last(&quick) - last(&fine)).abs() < 1e-9, "{quick:?}, {fine:?}");
        assert!(quick.vertices() < fine.vertices() / 20, "{} of {} vertices", quick.vertices(), fine.vertices());
        let same =
            DesertMesh { rings: fine.rings, columns: fine.columns, azimuth_step_rad: fine.azimuth_step_rad, ..quick };
        assert_eq!(same, fine, "as far as before");
    }
}

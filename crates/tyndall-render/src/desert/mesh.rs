//! How fine the desert's mesh is in a view. WGSL: `shaders/desert/mesh.wgsl`.
//!
//! Rings around the camera over the azimuths that are seen, each wider than the last by the same factor: quadrilaterals of
//! equal size on the picture at any distance, without seams, and none behind the camera. Each vertex may move by half the
//! way to the next ring, onto the crest that the camera sees there against what is behind it: outlines are exact to a part of
//! the spacing. Within quadrilaterals each pixel finds its own place on the smooth sand.

use tyndall_scene::Scene;

use crate::View;
use crate::landscape::mesh::{Azimuths, azimuths, lowest_elevation, pixel_rad};

/// Most rings, the centre included, and the least.
const RINGS_MOST: u32 = 1536;
const RINGS_LEAST: u32 = 96;

/// From a ring to the next, and from a column to the next, in pixels that face the camera at that distance.
const FINE_PX: [f64; 2] = [12.0, 3.0];
const QUICK_PX: [f64; 2] = [16.0, 4.0];

/// How fine a mesh is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fineness {
    /// As fine as makes a difference.
    Full,
    /// For pictures.
    Fine,
    /// For pictures that are soon followed by others.
    Quick,
}

/// The mesh of a view. Lengths in metres, angles from east to north.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DesertMesh {
    /// Vertices of a ring.
    pub columns: u32,
    /// Rings, the centre included.
    pub rings: u32,
    /// The first ring of which something may lie in the picture; those before are below its lower edge.
    pub first_ring: u32,
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
    pub fn new(
        (scene, view, size_px): (&Scene, View, [u32; 2]),
        (clearance_m, highest_m): (f64, f64),
        fineness: Fineness,
    ) -> Self {
        let frame = view.frame(&scene.camera);
        let radius_m = 1e3 * scene.atmosphere.planet_radius_km;
        let horizon_m = |altitude_m: f64| (altitude_m.max(0.0) * (2.0 * radius_m + altitude_m)).sqrt();
        let far_radius_m = (horizon_m(frame.position.z) + horizon_m(highest_m)).clamp(1000.0, 1.5 * radius_m);
        let centre_radius_m = (0.25 * clearance_m).clamp(0.02, 0.25 * far_radius_m);
        let [ring_px, column_px] = fineness.spacing_px();
        let rings = (far_radius_m / centre_radius_m).ln() / (ring_px * pixel_rad(&frame, view, size_px));
        let Azimuths { first_rad, step_rad, count } = azimuths(&frame, view, size_px, column_px);
        #[expect(clippy::cast_possible_truncation, reason = "limited to the most rings")]
        let rings = rings.clamp(f64::from(RINGS_LEAST), f64::from(RINGS_MOST)) as u32;
        // Sand that is as high as any, in the lowest direction of the picture.
        let seen_from_m = (frame.position.z - highest_m).max(0.0)
            * lowest_elevation(&frame, view, size_px).map_or(0.0, |elevation| 1.0 / (-elevation).tan());
        let growth = (far_radius_m / centre_radius_m).powf(1.0 / f64::from(rings - 2));
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "limited to the rings")]
        let first_ring =
            ((seen_from_m / centre_radius_m).ln() / growth.ln() - 1.0).clamp(0.0, f64::from(rings - 2)) as u32;
        Self {
            columns: count,
            rings,
            first_ring,
            centre_radius_m,
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

impl Fineness {
    fn spacing_px(self) -> [f64; 2] {
        match self {
            Self::Full => [1.0, 1.0],
            Self::Fine => FINE_PX,
            Self::Quick => QUICK_PX,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn meshes_for_pictures_cover_the_same_view_with_fewer_quadrilaterals() {
        let (scene, size_px) = (Scene::default(), [320, 180]);
        let mesh = |fineness| DesertMesh::new((&scene, View::Camera, size_px), (10.0, 30.0), fineness);
        let [full, fine, quick] = [Fineness::Full, Fineness::Fine, Fineness::Quick].map(mesh);
        let last = |mesh: &DesertMesh| mesh.first_azimuth_rad + mesh.azimuth_step_rad * f64::from(mesh.columns - 1);
        for (coarser, times) in [(fine, 5), (quick, 20)] {
            assert!(
                coarser.first_azimuth_rad - full.first_azimuth_rad < full.azimuth_step_rad,
                "{coarser:?}, {full:?}"
            );
            assert!(last(&full) - last(&coarser) < full.azimuth_step_rad, "{coarser:?}, {full:?}");
            assert!(coarser.vertices() * times < full.vertices(), "{} of {}", coarser.vertices(), full.vertices());
            assert_eq!(
                (coarser.centre_radius_m, coarser.far_radius_m),
                (full.centre_radius_m, full.far_radius_m),
                "as far as before"
            );
        }
    }

    #[test]
    fn rings_below_the_picture_are_left_out_and_no_others() {
        let first = |pitch_deg, highest_m| {
            let mut scene = Scene::default();
            (scene.camera.altitude_m, scene.camera.pitch_deg) = (36.0, pitch_deg);
            let mesh = DesertMesh::new((&scene, View::Camera, [320, 180]), (36.0, highest_m), Fineness::Fine);
            let growth = (mesh.far_radius_m / mesh.centre_radius_m).powf(1.0 / f64::from(mesh.rings - 2));
            (mesh.first_ring, mesh.centre_radius_m * growth.powi(mesh.first_ring.cast_signed() - 1), growth)
        };
        // In the middle of the lower edge, the lowest direction there is.
        let (ring, radius_m, growth) = first(0.0, 8.0);
        let nearest_m = 28.0 / (0.5 * Scene::default().camera.field_of_view_deg.to_radians()).tan();
        assert!(
            ring > 0 && radius_m < nearest_m && radius_m * growth.powi(3) > nearest_m,
            "{radius_m} of {nearest_m} m"
        );
        assert_eq!(first(0.0, 40.0).0, 0, "sand may stand higher than the camera");
        assert_eq!(first(-80.0, 8.0).0, 0, "what is right below is in the picture");
    }

    #[test]
    fn larger_pictures_have_finer_meshes_up_to_the_most_rings() {
        let scene = Scene::default();
        let rings = |height_px| {
            let size_px = [2 * height_px, height_px];
            DesertMesh::new((&scene, View::Camera, size_px), (10.0, 30.0), Fineness::Fine).rings
        };
        assert!(rings(100) >= RINGS_LEAST && rings(100) < rings(200), "{} and {}", rings(100), rings(200));
        assert_eq!(rings(20_000), RINGS_MOST, "no more than that");
    }
}

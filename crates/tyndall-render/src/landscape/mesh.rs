//! How fine the landscape's mesh is in a view: rings around the camera over the azimuths that are seen, so that a triangle
//! is about as wide as a pixel at any distance. WGSL: `shaders/landscape/mesh.wgsl`.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use tyndall_scene::Scene;
use tyndall_scene::camera::CameraFrame;
use tyndall_scene::landscape::Landscape;

use crate::View;

/// Rings from the camera's feet to where the landscape begins to look distant, and from there to its edge.
const NEAR_RINGS: u32 = 128;
const FAR_RINGS: u32 = 512;

/// Most vertices of a ring.
const COLUMNS_MAX: u32 = 2048;

/// Width of a column in pixels.
const COLUMN_PX: f64 = 1.6;

/// Gap (rad) that keeps a full circle's first and last column on their sides of a panorama's seam.
const SEAM: f64 = 1e-5;

/// Points along each edge of the picture whose azimuths are asked.
const EDGE_POINTS: u32 = 16;

/// The mesh of a view. Lengths in metres, angles from east to north.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mesh {
    /// Vertices of a ring.
    pub columns: u32,
    /// Rings, the centre included.
    pub rings: u32,
    /// Rings beyond `split_radius_m`.
    pub far_rings: u32,
    /// Radius of the first ring outside the centre.
    pub centre_radius_m: f64,
    /// Radius from which the far rings are spaced.
    pub split_radius_m: f64,
    /// Radius of the last ring.
    pub far_radius_m: f64,
    /// Azimuth of the first column.
    pub first_azimuth_rad: f64,
    /// From one column to the next.
    pub azimuth_step_rad: f64,
}

impl Mesh {
    /// For a view of a grounded scene; `None` when the landscape is out of sight.
    #[must_use]
    pub fn new(scene: &Scene, landscape: &Landscape, view: View, size_px: [u32; 2]) -> Option<Self> {
        let frame = view.frame(&scene.camera);
        let (x_m, y_m) = (frame.position.x, frame.position.y);
        let half_m = landscape.half_size_m();
        let outside = |at_m: f64| (at_m.abs() - half_m).max(0.0);
        let nearest_m = outside(x_m).hypot(outside(y_m));
        let farthest_m = (x_m.abs() + half_m).hypot(y_m.abs() + half_m);
        let radius_m = 1e3 * scene.atmosphere.planet_radius_km;
        let horizon_m = |altitude_m: f64| (altitude_m.max(0.0) * (2.0 * radius_m + altitude_m)).sqrt();
        let seen_m = horizon_m(frame.position.z) + horizon_m(landscape.highest_m());
        let far_radius_m = farthest_m.min(seen_m).min(1.5 * radius_m);
        let clearance_m = (frame.position.z - landscape.ground_m(x_m, y_m)).max(0.5);
        let centre_radius_m = (0.25 * clearance_m).max(0.98 * nearest_m);
        if half_m <= 0.0 || centre_radius_m >= 0.5 * far_radius_m {
            return None;
        }
        let split_radius_m = (8.0 * centre_radius_m).clamp(200.0, 0.7 * far_radius_m.max(300.0));
        let azimuths = azimuths(&frame, view, size_px, COLUMN_PX);
        Some(Self {
            rings: NEAR_RINGS + FAR_RINGS,
            far_rings: FAR_RINGS,
            centre_radius_m,
            split_radius_m: split_radius_m.max(1.01 * centre_radius_m),
            far_radius_m,
            columns: azimuths.count,
            first_azimuth_rad: azimuths.first_rad,
            azimuth_step_rad: azimuths.step_rad,
        })
    }

    /// Number of vertices.
    #[must_use]
    pub fn vertices(&self) -> u32 {
        self.columns * self.rings
    }
}

/// The columns of a mesh.
pub(crate) struct Azimuths {
    /// Azimuth of the first column.
    pub(crate) first_rad: f64,
    /// From one column to the next.
    pub(crate) step_rad: f64,
    /// Number of columns.
    pub(crate) count: u32,
}

/// Columns `column_px` wide for what a view of so many pixels sees.
#[expect(clippy::cast_possible_truncation, reason = "limited to the largest number of columns")]
pub(crate) fn azimuths(frame: &CameraFrame, view: View, size_px: [u32; 2], column_px: f64) -> Azimuths {
    let step_rad = (column_px * pixel_rad(frame, view, size_px)).max(TAU / f64::from(COLUMNS_MAX - 4));
    let Some([low, high]) = azimuth_range(frame, view, size_px) else {
        let count = (TAU / step_rad).ceil();
        return Azimuths { first_rad: SEAM - PI, step_rad: (TAU - 2.0 * SEAM) / count, count: count as u32 + 1 };
    };
    // Multiples of the step, so that vertices stay where they are while the camera turns.
    let first = (low / step_rad).floor() - 1.0;
    let count = ((high / step_rad).ceil() + 1.0 - first + 1.0).clamp(2.0, f64::from(COLUMNS_MAX));
    Azimuths { first_rad: first * step_rad, step_rad, count: count as u32 }
}

/// Mean angle (rad) of a pixel: along a panorama's width, or up the picture.
pub(crate) fn pixel_rad(frame: &CameraFrame, view: View, [width_px, height_px]: [u32; 2]) -> f64 {
    if view == View::Panorama {
        TAU / f64::from(width_px)
    } else {
        2.0 * frame.tan_half_view.atan() / f64::from(height_px)
    }
}

/// Elevation of the lowest direction of a picture, below the horizon; `None` when it shows the nadir, nearly, or no ground,
/// and where directions say nothing of places.
pub(crate) fn lowest_elevation(frame: &CameraFrame, view: View, size_px: [u32; 2]) -> Option<f64> {
    if view == View::Panorama || frame.orthographic_m.is_some() || azimuth_range(frame, view, size_px).is_none() {
        return None;
    }
    let half = [frame.tan_half_view * f64::from(size_px[0]) / f64::from(size_px[1]), frame.tan_half_view];
    let lowest = edge_directions(frame, half).map(|direction| direction.z.asin()).fold(0.0, f64::min);
    (lowest < -1e-3).then_some(lowest)
}

/// Directions along the edges of a picture whose half sides are seen under these tangents.
fn edge_directions(frame: &CameraFrame, half: [f64; 2]) -> impl Iterator<Item = DVec3> {
    let edges = (0..=EDGE_POINTS).flat_map(|k| {
        let along = 2.0 * f64::from(k) / f64::from(EDGE_POINTS) - 1.0;
        [[along, 1.0], [along, -1.0], [1.0, along], [-1.0, along]]
    });
    edges.map(move |[x, y]| (frame.forward + x * half[0] * frame.right + y * half[1] * frame.up).normalize())
}

/// Azimuths at the picture's edges, which enclose those inside it; `None` when it shows zenith or nadir, or nearly.
fn azimuth_range(frame: &CameraFrame, view: View, [width_px, height_px]: [u32; 2]) -> Option<[f64; 2]> {
    let aspect = f64::from(width_px) / f64::from(height_px);
    let half = [frame.tan_half_view * aspect, frame.tan_half_view];
    let shows = |pole: DVec3| {
        let depth = pole.dot(frame.forward);
        let inside = |axis: DVec3, half: f64| (pole.dot(axis) / depth).abs() < 1.05 * half;
        depth > 0.0 && inside(frame.right, half[0]) && inside(frame.up, half[1])
    };
    if view == View::Panorama || shows(DVec3::Z) || shows(DVec3::NEG_Z) {
        return None;
    }
    let centre = frame.forward.y.atan2(frame.forward.x);
    let mut range = [centre, centre];
    for direction in edge_directions(frame, half) {
        if direction.x.hypot(direction.y) < 0.05 {
            return None;
        }
        let turn = (direction.y.atan2(direction.x) - centre + PI).rem_euclid(TAU) - PI;
        range = [range[0].min(centre + turn), range[1].max(centre + turn)];
    }
    (range[1] - range[0] < 1.8 * PI).then_some(range)
}

#[cfg(test)]
mod tests {
    use super::*;
    use tyndall_scene::LandscapeKind;

    fn scene(pitch_deg: f64) -> Scene {
        let mut scene = Scene::default();
        scene.landscape.kind = LandscapeKind::Hills;
        (scene.camera.pitch_deg, scene.camera.heading_deg) = (pitch_deg, 90.0);
        scene.grounded()
    }

    fn mesh(scene: &Scene, view: View) -> Option<Mesh> {
        Mesh::new(scene, &Landscape::new(&scene.landscape), view, [640, 480])
    }

    #[test]
    fn a_level_view_meshes_its_field_of_view_alone() {
        let mesh = mesh(&scene(0.0), View::Camera).expect("in sight");
        let last = mesh.first_azimuth_rad + f64::from(mesh.columns - 1) * mesh.azimuth_step_rad;
        // 60 degrees high, 75.2 wide at 4:3, to the east.
        let half = (30.0_f64.to_radians().tan() * 4.0 / 3.0).atan();
        assert!(mesh.first_azimuth_rad < -half && last > half, "{mesh:?}");
        assert!(last - mesh.first_azimuth_rad < 2.1 * half, "{mesh:?}");
    }

    #[test]
    fn a_view_of_the_nadir_and_a_panorama_mesh_the_whole_circle() {
        for (scene, view) in [(scene(-80.0), View::Camera), (scene(0.0), View::Panorama)] {
            let mesh = mesh(&scene, view).expect("in sight");
            let span = f64::from(mesh.columns - 1) * mesh.azimuth_step_rad;
            assert!((span - TAU).abs() < 1e-4, "{mesh:?}");
        }
    }

    #[test]
    fn a_landscape_beyond_the_horizon_is_not_meshed() {
        let mut scene = scene(0.0);
        scene.camera.x_m = 900_000.0;
        assert_eq!(mesh(&scene, View::Camera), None, "900 km away");
        scene.landscape.kind = LandscapeKind::None;
        scene.camera.x_m = 0.0;
        assert_eq!(mesh(&scene, View::Camera), None, "none");
    }
}

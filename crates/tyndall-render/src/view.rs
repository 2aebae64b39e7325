//! What a frame shows: what the camera sees, everything around it, or a face of a cube around it.

use glam::DVec3;
use tyndall_scene::CameraParams;
use tyndall_scene::camera::CameraFrame;

/// What a frame shows from the place of the scene's camera.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum View {
    /// What the camera sees.
    #[default]
    Camera,
    /// All directions, equirectangular: row 0 is the zenith, the centre is east, and columns go on to the south. This is
    /// what a Blender world takes for x east, y north, z up.
    Panorama,
    /// One face of a cube.
    CubeFace(CubeFace),
}

impl View {
    /// Position, axes and opening. For a panorama the axes are those of its centre, and the opening means nothing.
    #[must_use]
    pub fn frame(self, camera: &CameraParams) -> CameraFrame {
        let seen = CameraFrame::new(camera);
        match self {
            Self::Camera => seen,
            Self::Panorama => CubeFace::PosX.frame(seen.position),
            Self::CubeFace(face) => face.frame(seen.position),
        }
    }
}

/// The faces of a cube map in the order and orientation that Direct3D, Vulkan and OpenGL share: x is to the east, y up,
/// z to the north, and each face is seen from inside the cube. Worlds in which -z is north look up (x, y, -z).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CubeFace {
    /// East.
    PosX,
    /// West.
    NegX,
    /// The zenith, with north at the lower edge.
    PosY,
    /// The nadir, with north at the upper edge.
    NegY,
    /// North.
    PosZ,
    /// South.
    NegZ,
}

impl CubeFace {
    /// All faces, in the order of the layers of a cube texture.
    pub const ALL: [Self; 6] = [Self::PosX, Self::NegX, Self::PosY, Self::NegY, Self::PosZ, Self::NegZ];

    /// Name in file names: `posx` and so on.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::PosX => "posx",
            Self::NegX => "negx",
            Self::PosY => "posy",
            Self::NegY => "negy",
            Self::PosZ => "posz",
            Self::NegZ => "negz",
        }
    }

    /// The camera of the face at a position: east, north, altitude (m).
    #[must_use]
    pub fn frame(self, position: DVec3) -> CameraFrame {
        let (forward, up) = match self {
            Self::PosX => (DVec3::X, DVec3::Z),
            Self::NegX => (DVec3::NEG_X, DVec3::Z),
            Self::PosY => (DVec3::Z, DVec3::NEG_Y),
            Self::NegY => (DVec3::NEG_Z, DVec3::Y),
            Self::PosZ => (DVec3::Y, DVec3::Z),
            Self::NegZ => (DVec3::NEG_Y, DVec3::Z),
        };
        CameraFrame { position, right: forward.cross(up), up, forward, tan_half_view: 1.0, orthographic_m: None }
    }

    /// The face that a direction (east, north, up) meets, and where: to the right and upwards, -1 to 1.
    #[must_use]
    pub fn of_direction(direction: DVec3) -> (Self, [f64; 2]) {
        let size = direction.abs();
        let face = if size.z >= size.x && size.z >= size.y {
            if direction.z > 0.0 { Self::PosY } else { Self::NegY }
        } else if size.x >= size.y {
            if direction.x > 0.0 { Self::PosX } else { Self::NegX }
        } else if direction.y > 0.0 {
            Self::PosZ
        } else {
            Self::NegZ
        };
        let axes = face.frame(DVec3::ZERO);
        let depth = direction.dot(axes.forward);
        (face, [direction.dot(axes.right) / depth, direction.dot(axes.up) / depth])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Direction in a cube map's own axes of a face's coordinates, by the table of the OpenGL and Vulkan specifications:
    /// s to the right, t downwards, -1 to 1.
    fn specified(face: CubeFace, s: f64, t: f64) -> DVec3 {
        match face {
            CubeFace::PosX => DVec3::new(1.0, -t, -s),
            CubeFace::NegX => DVec3::new(-1.0, -t, s),
            CubeFace::PosY => DVec3::new(s, 1.0, t),
            CubeFace::NegY => DVec3::new(s, -1.0, -t),
            CubeFace::PosZ => DVec3::new(s, -t, 1.0),
            CubeFace::NegZ => DVec3::new(-s, -t, -1.0),
        }
    }

    #[test]
    fn faces_lie_as_the_specifications_of_cube_maps_say() {
        for face in CubeFace::ALL {
            let axes = face.frame(DVec3::ZERO);
            for (s, t) in [(0.0, 0.0), (0.9, 0.1), (-0.3, 0.7), (0.2, -0.8)] {
                let seen = axes.forward + s * axes.right - t * axes.up;
                let in_cube = DVec3::new(seen.x, seen.z, seen.y);
                assert!((in_cube - specified(face, s, t)).length() < 1e-12, "{face:?} at ({s}, {t}): {in_cube}");
            }
        }
    }

    #[test]
    fn a_direction_is_found_again_on_its_face() {
        for face in CubeFace::ALL {
            let axes = face.frame(DVec3::ZERO);
            for (x, y) in [(0.0, 0.0), (0.99, -0.5), (-0.7, 0.98)] {
                let (found, at) = CubeFace::of_direction((axes.forward + x * axes.right + y * axes.up).normalize());
                assert_eq!(found, face, "({x}, {y})");
                assert!((at[0] - x).abs() + (at[1] - y).abs() < 1e-12, "{at:?} for ({x}, {y})");
            }
        }
    }

    #[test]
    fn a_panorama_has_east_in_its_centre_and_south_to_the_right() {
        let frame =
            View::Panorama.frame(&CameraParams { heading_deg: 77.0, altitude_m: 9.0, ..CameraParams::default() });
        assert_eq!((frame.forward, frame.right, frame.up), (DVec3::X, DVec3::NEG_Y, DVec3::Z), "whatever the heading");
        assert!((frame.position.z - 9.0).abs() < 1e-12, "at the camera's altitude");
    }
}

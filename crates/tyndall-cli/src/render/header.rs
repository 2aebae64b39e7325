//! What the file says about the picture.

use tyndall_core::array::{ArrayData, NamedArrays};
use tyndall_io::PictureMetadata;
use tyndall_scene::camera::{CameraFrame, NEAR_M};
use tyndall_scene::{Scene, SunPosition};

use super::frame::Frame;

/// Header entry with the adapter's name: the same scene gives the same bytes on the same adapter only.
pub(crate) const ADAPTER: &str = "tyndall/adapter";

/// What tells the picture of a scene from any other: by it a finished file is known again.
pub(crate) fn identity(scene: &Scene, state: Option<&NamedArrays>) -> PictureMetadata {
    let number = |name: &str| {
        let array = state?.iter().find(|(found, _)| found == name);
        array.and_then(|(_, array)| match array.data() {
            ArrayData::U64(numbers) => numbers.first().copied(),
            _ => None,
        })
    };
    let mut scene_hash = scene.hash().to_string();
    if let (Some(step), Some(hash)) = (number("step"), number("hash")) {
        scene_hash = format!("{scene_hash}+{step}-{hash:016x}");
    }
    PictureMetadata { scene_hash, ..PictureMetadata::default() }
}

/// Metadata of a frame of the scene, of which the simulation began with the state.
pub(crate) fn metadata(scene: &Scene, state: Option<&NamedArrays>, frame: &Frame) -> PictureMetadata {
    let place = (scene.sun.position == SunPosition::Date).then_some(&scene.sun);
    #[expect(clippy::cast_possible_truncation, reason = "EXR stores these as f32")]
    PictureMetadata {
        title: scene.title.clone(),
        comments: scene.description.clone(),
        world_to_camera: world_to_camera(&CameraFrame::new(&scene.grounded().camera)),
        near_m: NEAR_M as f32,
        field_of_view_rad: scene.camera.field_of_view_deg.to_radians() as f32,
        latitude_deg: place.map(|sun| sun.latitude_deg),
        longitude_deg: place.map(|sun| sun.longitude_deg),
        exposure_ev100: frame.ev100,
        extra: vec![(ADAPTER.to_owned(), frame.adapter.clone())],
        ..identity(scene, state)
    }
}

/// The camera in `OpenEXR`'s convention. Its row vectors read our columns as rows, so that the transposed matrix has our
/// memory layout; its camera looks along +z, ours along -z.
#[expect(clippy::cast_possible_truncation, reason = "EXR stores the matrix as f32")]
pub(crate) fn world_to_camera(camera: &CameraFrame) -> [f32; 16] {
    let columns = camera.view_from_world().to_cols_array();
    std::array::from_fn(|index| if index % 4 == 2 { -columns[index] as f32 } else { columns[index] as f32 })
}

#[cfg(test)]
mod tests {
    use tyndall_core::array::Array;
    use tyndall_scene::CameraParams;

    use super::*;
    use crate::render::frame::Pixels;

    fn frame() -> Frame {
        let pixels = Pixels::Eight(Vec::new());
        Frame { size_px: [0, 0], pixels, adapter: "llvmpipe".to_owned(), ev100: 14.5, passes: Vec::new() }
    }

    /// Row vector times matrix, as `OpenEXR` multiplies.
    fn transform(point: [f32; 3], matrix: &[f32; 16]) -> [f32; 3] {
        let point = [point[0], point[1], point[2], 1.0];
        std::array::from_fn(|column| (0..4).map(|row| point[row] * matrix[4 * row + column]).sum())
    }

    #[test]
    fn a_point_in_front_of_the_camera_has_positive_z_in_the_header() {
        let camera = CameraParams { altitude_m: 2.0, pitch_deg: 0.0, heading_deg: 90.0, ..CameraParams::default() };
        let matrix = world_to_camera(&CameraFrame::new(&camera));
        // East of a camera that looks east: 10 m ahead, 3 m to its left (north), 1 m above it.
        let seen = transform([10.0, 3.0, 3.0], &matrix);
        for (value, expected) in seen.into_iter().zip([-3.0, 1.0, 10.0]) {
            assert!((value - expected).abs() < 1e-5, "{seen:?}: x to the right, y up, z forward");
        }
    }

    #[test]
    fn the_place_is_written_only_when_the_sun_stands_by_the_date() {
        let mut scene = Scene::default();
        assert_eq!(metadata(&scene, None, &frame()).latitude_deg, None, "the angles are of no place");
        scene.sun.position = SunPosition::Date;
        let metadata = metadata(&scene, None, &frame());
        assert_eq!(metadata.latitude_deg, Some(scene.sun.latitude_deg), "the place of the date");
        assert_eq!(metadata.longitude_deg, Some(scene.sun.longitude_deg), "the place of the date");
    }

    #[test]
    fn pictures_that_began_with_another_state_are_other_pictures() {
        let number = |value| Array::new(vec![], ArrayData::U64(vec![value])).unwrap();
        let state = |hash| vec![("step".to_owned(), number(7)), ("hash".to_owned(), number(hash))];
        let hash = |state: Option<&NamedArrays>| identity(&Scene::default(), state).scene_hash;
        assert_eq!(hash(None), Scene::default().hash().to_string(), "the scene alone");
        assert_eq!(hash(Some(&state(5))), format!("{}+7-0000000000000005", hash(None)), "step and hash of the state");
    }

    #[test]
    fn hash_exposure_and_adapter_are_in_the_header() {
        let scene = Scene::default();
        let metadata = metadata(&scene, None, &frame());
        assert_eq!(metadata.scene_hash, scene.hash().to_string(), "the whole hash");
        assert!((metadata.exposure_ev100 - 14.5).abs() < 1e-12, "{}", metadata.exposure_ev100);
        assert_eq!(metadata.extra, [("tyndall/adapter".to_owned(), "llvmpipe".to_owned())], "the adapter");
    }
}

//! Pixels and what is said about them.

use tyndall_core::primaries::RgbPrimaries;

use crate::IoError;

/// Longest side that is written or read, in pixels. Twice the largest picture of a scene, for panoramas.
pub const MAX_SIDE_PX: u32 = 32_768;

/// Most pixels that are written or read: a square picture of 16,384 x 16,384, 4 GiB of colour in memory.
pub const MAX_PIXELS: u64 = 1 << 28;

/// A picture in scene-linear light, associated alpha, row 0 on top. Primaries and unit are Rec.709 and cd/m^2 unless its
/// metadata says otherwise.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// Width and height.
    pub size_px: [u32; 2],
    /// Red, green, blue and alpha, row by row.
    pub rgba: Vec<[f32; 4]>,
    /// Planar view distance of each pixel in metres; [`SKY_DEPTH_M`](crate::SKY_DEPTH_M) where nothing stands.
    pub depth_m: Option<Vec<f32>>,
}

/// How the directions of view lie in a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Projection {
    /// As a camera sees: the entries of the camera are written.
    #[default]
    Perspective,
    /// All around, as on a map of the world (`envmap` latlong).
    LatLong,
    /// Several views in one picture, such as the faces of a cube.
    Assembled,
}

/// What a picture file says about its making. Empty texts are not written.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureMetadata {
    /// Program and version, such as `tyndall 0.1.0`.
    pub software: String,
    /// Hash of the scene that was rendered, in hexadecimal.
    pub scene_hash: String,
    /// Title of the scene.
    pub title: String,
    /// Primaries of the colours.
    pub primaries: RgbPrimaries,
    /// Luminance of the colour (1, 1, 1) in cd/m^2: what the numbers of the file count.
    pub white_luminance_cd_m2: f32,
    /// How the directions of view lie in the picture.
    pub projection: Projection,
    /// World to camera in `OpenEXR`'s convention: row vectors, the translation in elements 12 to 14, camera space in
    /// metres with x to the right, y up, z forward (left-handed).
    pub world_to_camera: [f32; 16],
    /// Distance of the near plane in metres.
    pub near_m: f32,
    /// Vertical field of view in radians.
    pub field_of_view_rad: f32,
    /// Latitude of the place in degrees, north positive.
    pub latitude_deg: Option<f64>,
    /// Longitude of the place in degrees, east positive.
    pub longitude_deg: Option<f64>,
    /// Exposure at which the picture was looked at, as EV at ISO 100. The pixels of an EXR are not scaled by it.
    pub exposure_ev100: f64,
    /// Free text.
    pub comments: String,
    /// Further entries, name and text; names of 1 to 79 printable ASCII characters, such as `tyndall/adapter`.
    pub extra: Vec<(String, String)>,
}

impl Default for PictureMetadata {
    fn default() -> Self {
        let mut identity = [0.0; 16];
        for axis in 0..4 {
            identity[5 * axis] = 1.0;
        }
        Self {
            software: format!("tyndall {}", env!("CARGO_PKG_VERSION")),
            scene_hash: String::new(),
            title: String::new(),
            primaries: RgbPrimaries::Rec709,
            white_luminance_cd_m2: 1.0,
            projection: Projection::Perspective,
            world_to_camera: identity,
            near_m: 0.1,
            field_of_view_rad: std::f32::consts::FRAC_PI_3,
            latitude_deg: None,
            longitude_deg: None,
            exposure_ev100: 0.0,
            comments: String::new(),
            extra: Vec::new(),
        }
    }
}

/// The number of pixels of a picture of this size; asked before anything is allocated for it.
///
/// # Errors
/// [`IoError::Size`] outside 1 x 1 to [`MAX_SIDE_PX`] a side and [`MAX_PIXELS`] in all.
pub fn check_size(size_px: [u32; 2]) -> Result<usize, IoError> {
    let pixels = u64::from(size_px[0]) * u64::from(size_px[1]);
    let sides_fit = size_px.iter().all(|side_px| (1..=MAX_SIDE_PX).contains(side_px));
    if !sides_fit || pixels > MAX_PIXELS {
        return Err(IoError::Size { size_px });
    }
    usize::try_from(pixels).map_err(|_too_large| IoError::Size { size_px })
}

/// Refuses a list that does not have one entry for each pixel.
pub(crate) fn check_length(what: &'static str, size_px: [u32; 2], found: usize) -> Result<(), IoError> {
    let expected = check_size(size_px)?;
    if found == expected { Ok(()) } else { Err(IoError::WrongLength { what, size_px, expected, found }) }
}

/// Refuses entries that a file format would refuse, or would read back differently.
pub(crate) fn check_extra(extra: &[(String, String)]) -> Result<(), IoError> {
    for (name, text) in extra {
        let problem = if !(1..=79).contains(&name.len()) || !name.bytes().all(|byte| (b'!'..=b'~').contains(&byte)) {
            "its name must have 1 to 79 printable ASCII characters without spaces"
        } else if text.contains('\0') {
            "its text contains a zero character"
        } else if extra.iter().filter(|(other, _)| other == name).count() > 1 {
            "the name occurs twice"
        } else {
            continue;
        };
        return Err(IoError::Metadata { name: name.clone(), problem: problem.to_owned() });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_without_pixels_or_beyond_the_limits_are_refused() {
        for size_px in [[0, 1], [1, 0], [60_000, 60_000], [MAX_SIDE_PX + 1, 1], [MAX_SIDE_PX, MAX_SIDE_PX]] {
            let error = check_size(size_px).unwrap_err().to_string();
            assert!(error.contains(&format!("{} x {}", size_px[0], size_px[1])), "{error}");
        }
        assert_eq!(check_size([16_384, 16_384]).unwrap(), 1 << 28, "largest square picture");
        assert_eq!(check_size([MAX_SIDE_PX, 8192]).unwrap(), 1 << 28, "widest panorama");
    }

    #[test]
    fn a_list_of_another_length_is_refused_with_both_numbers() {
        let error = check_length("rgba", [3, 2], 7).unwrap_err().to_string();
        assert!(error.contains("7 entries") && error.contains("needs 6"), "{error}");
    }

    #[test]
    fn metadata_names_that_no_file_can_hold_are_refused() {
        for name in ["", "with space", "caf\u{e9}", &"x".repeat(80), "twice"] {
            let extra = [(name.to_owned(), "a".to_owned()), ("twice".to_owned(), "b".to_owned())];
            assert!(check_extra(&extra).is_err(), "{name:?}");
        }
        assert!(check_extra(&[("tyndall/adapter".into(), "llvmpipe".into())]).is_ok(), "an ordinary entry");
    }
}

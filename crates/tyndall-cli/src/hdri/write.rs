//! Light into files.

use std::io::{self, Write as _};
use std::path::Path;

use image::codecs::hdr::HdrEncoder;
use tyndall_io::atomic::write_atomically;
use tyndall_io::{
    Channels, Compression, Destination, ExrOptions, IoError, Picture, PictureMetadata, Precision, Projection, write_exr,
};
use tyndall_render::environment::{Environment, LightUnit};
use tyndall_scene::{Scene, SunPosition};

use super::HdriArguments;
use crate::Failure;
use crate::interrupt::Interrupt;
use crate::render::header::ADAPTER;
use crate::render::write::Written;

/// What the file becomes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum HdriFormat {
    /// `OpenEXR`.
    Exr(Precision),
    /// Radiance RGBE: one part in 200.
    Hdr,
}

impl HdriFormat {
    /// The format that the file's ending asks for.
    pub(super) fn for_file(path: &Path, half: bool) -> Result<Self, Failure> {
        let file = path.display();
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
        match ending.as_deref() {
            Some("exr") => Ok(Self::Exr(if half { Precision::Half } else { Precision::Float })),
            Some("hdr") if half => Err(Failure::Usage(format!("--half concerns EXR files only, and {file} is none"))),
            Some("hdr") => Ok(Self::Hdr),
            Some("png" | "jpg" | "jpeg") => Err(Failure::Usage(format!(
                "cannot write {file}: PNG and JPEG hold pictures for the eye, not light; choose .exr or .hdr, or \
                 `tyndall cubemap` and `tyndall render` for pictures"
            ))),
            _ => Err(Failure::Usage(format!(
                "cannot write {file}: the file's ending decides its format and must be .exr or .hdr"
            ))),
        }
    }
}

/// Writes the file, complete or not at all; a signal stops it.
pub(super) fn write(
    arguments: &HdriArguments,
    format: HdriFormat,
    (scene, light, unit): (&Scene, Environment, LightUnit),
    adapter: &str,
    interrupt: &Interrupt,
) -> Result<Written, Failure> {
    let destination = Destination::new(&arguments.output).cancelled_by(interrupt.flag());
    let metadata = metadata(arguments, (scene, light.ev100, unit), adapter);
    let picture = Picture { size_px: light.size_px, rgba: light.rgba, depth_m: None };
    let written = match format {
        HdriFormat::Exr(precision) => {
            let options = ExrOptions { precision, compression: Compression::Zips, channels: Channels::Rgb };
            write_exr(destination, &picture, &metadata, &options).map(|report| Written {
                bytes: report.bytes,
                clamped_pixels: report.clamped_pixels,
                clamped_luminance_share: report.clamped_luminance_share,
            })
        }
        HdriFormat::Hdr => write_hdr(destination, &picture).map(|bytes| Written { bytes, ..Written::default() }),
    };
    match written {
        Err(IoError::Cancelled { path }) => {
            interrupt.check()?;
            Err(IoError::Cancelled { path }.into())
        }
        other => Ok(other?),
    }
}

fn metadata(
    arguments: &HdriArguments,
    (scene, ev100, unit): (&Scene, f64, LightUnit),
    adapter: &str,
) -> PictureMetadata {
    let place = (scene.sun.position == SunPosition::Date).then_some(&scene.sun);
    #[expect(clippy::cast_possible_truncation, reason = "EXR stores it as f32")]
    let white_luminance_cd_m2 = unit.white_luminance_cd_m2() as f32;
    PictureMetadata {
        scene_hash: scene.hash().to_string(),
        title: scene.title.clone(),
        comments: scene.description.clone(),
        primaries: arguments.primaries.into(),
        white_luminance_cd_m2,
        projection: Projection::LatLong,
        latitude_deg: place.map(|sun| sun.latitude_deg),
        longitude_deg: place.map(|sun| sun.longitude_deg),
        exposure_ev100: ev100,
        extra: vec![(ADAPTER.to_owned(), adapter.to_owned())],
        ..PictureMetadata::default()
    }
}

/// Radiance RGBE, without metadata.
fn write_hdr(destination: Destination<'_>, picture: &Picture) -> Result<u64, IoError> {
    let rgb: Vec<_> = picture.rgba.iter().map(|[red, green, blue, _]| image::Rgb([*red, *green, *blue])).collect();
    let [width, height] = picture.size_px.map(|side_px| side_px as usize);
    write_atomically(destination, |file| {
        HdrEncoder::new(&mut *file).encode(&rgb, width, height).map_err(io::Error::other)?;
        io::Seek::seek(file, io::SeekFrom::End(0))
    })
}

/// Writes a text file, complete or not at all.
pub(super) fn write_text(path: &Path, text: &str) -> Result<(), IoError> {
    write_atomically(path, |file| file.write_all(text.as_bytes()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ending_decides_the_format_and_pictures_are_refused() {
        let format = |file: &str, half: bool| HdriFormat::for_file(Path::new(file), half);
        assert_eq!(
            format("a.exr", false).unwrap(),
            HdriFormat::Exr(Precision::Float),
            "floats unless halves are asked for"
        );
        assert_eq!(format("a.EXR", true).unwrap(), HdriFormat::Exr(Precision::Half), "halves");
        assert_eq!(format("a.hdr", false).unwrap(), HdriFormat::Hdr, "RGBE");
        for (file, half, part) in [
            ("a.png", false, "not light"),
            ("a.jpeg", false, "not light"),
            ("a.tiff", false, "must be .exr or .hdr"),
            ("a", false, "must be .exr or .hdr"),
            ("a.hdr", true, "--half"),
        ] {
            let failure = format(file, half).expect_err(file);
            assert!(failure.to_string().contains(part), "{failure}");
        }
    }
}

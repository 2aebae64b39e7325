//! Pixels into the file.

use std::io;
use std::path::Path;

use image::ExtendedColorType;
use image::codecs::jpeg::JpegEncoder;
use tyndall_io::atomic::write_atomically;
use tyndall_io::{Destination, IoError, PictureMetadata, write_exr, write_png8, write_png16};

use super::format::OutputFormat;
use super::frame::{Frame, Pixels};
use crate::Failure;
use crate::interrupt::Interrupt;

/// Skies show blocks below this quality.
const JPEG_QUALITY: u8 = 92;

/// What became of the pixels.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Written {
    /// Size of the file.
    pub(crate) bytes: u64,
    /// Pixels that are brighter than the file can say.
    pub(crate) clamped_pixels: usize,
    /// Luminance lost by that, as a share of the picture's.
    pub(crate) clamped_luminance_share: f64,
}

/// Writes the file, complete or not at all; a signal stops it.
pub(crate) fn write(
    path: &Path,
    frame: &Frame,
    format: OutputFormat,
    metadata: &PictureMetadata,
    interrupt: &Interrupt,
) -> Result<Written, Failure> {
    let destination = Destination::new(path).cancelled_by(interrupt.flag());
    match pixels_to_file(destination, frame, format, metadata) {
        Err(IoError::Cancelled { path }) => {
            interrupt.check()?;
            Err(IoError::Cancelled { path }.into())
        }
        other => Ok(other?),
    }
}

fn pixels_to_file(
    destination: Destination<'_>,
    frame: &Frame,
    format: OutputFormat,
    metadata: &PictureMetadata,
) -> Result<Written, IoError> {
    let bytes = match &frame.pixels {
        Pixels::Light(picture) => {
            let report = write_exr(destination, picture, metadata, &format.exr_options())?;
            return Ok(Written {
                bytes: report.bytes,
                clamped_pixels: report.clamped_pixels,
                clamped_luminance_share: report.clamped_luminance_share,
            });
        }
        Pixels::Eight(rgba) if format == OutputFormat::Jpeg => write_jpeg(destination, frame.size_px, rgba)?,
        Pixels::Eight(rgba) => write_png8(destination, frame.size_px, rgba, metadata)?,
        Pixels::Sixteen(rgba) => write_png16(destination, frame.size_px, rgba, metadata)?,
    };
    Ok(Written { bytes, ..Written::default() })
}

/// JPEG without metadata, for web pages.
fn write_jpeg(destination: Destination<'_>, size_px: [u32; 2], rgba: &[[u8; 4]]) -> Result<u64, IoError> {
    let rgb: Vec<u8> = rgba.iter().flat_map(|[red, green, blue, _]| [*red, *green, *blue]).collect();
    write_atomically(destination, |file| {
        JpegEncoder::new_with_quality(&mut *file, JPEG_QUALITY)
            .encode(&rgb, size_px[0], size_px[1], ExtendedColorType::Rgb8)
            .map_err(io::Error::other)?;
        io::Seek::seek(file, io::SeekFrom::End(0))
    })
}

//! Pixels into the file.

use std::io;
use std::path::Path;

use image::ExtendedColorType;
use image::codecs::jpeg::JpegEncoder;
use tyndall_core::array::{Array, ArrayData};
use tyndall_io::atomic::write_atomically;
use tyndall_io::{Destination, IoError, Picture, PictureMetadata, write_exr, write_npy, write_png8, write_png16};

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
        Pixels::Light(picture) if format == OutputFormat::Npy => write_light_npy(destination, picture)?,
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

/// Rows, columns and the channels red, green and blue, in 32-bit floats; row 0 is on top.
fn write_light_npy(destination: Destination<'_>, picture: &Picture) -> Result<u64, IoError> {
    let path = destination.path();
    let [columns, rows] = picture.size_px.map(|side| side as usize);
    // The first index runs fastest in an array, and rows are the first.
    let value = |index: usize| picture.rgba[index % rows * columns + index / rows % columns][index / (rows * columns)];
    let values = (0..3 * rows * columns).map(value).collect();
    if let Some(array) = Array::new(vec![rows, columns, 3], ArrayData::F32(values)) {
        write_npy(destination, &array)?;
    }
    std::fs::metadata(path).map(|file| file.len()).map_err(|error| IoError::from_write(path, error))
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

//! Writes display-referred pictures as PNG with 8 or 16 bits: sRGB, straight alpha, row 0 on top.
//!
//! Chunks: sRGB, then texts Software, Title, Comment and `tyndall/sceneHash`. The pixels are packed row by row, so that
//! a cancelled write stops within a row and no second copy of the picture is made.

use std::io::{self, Write as _};

use crate::exr_attributes::SCENE_HASH;
use crate::picture::{check_extra, check_length};
use crate::{Destination, IoError, PictureMetadata, atomic};

/// Writes a PNG with 8 bits a channel; gives back the size of the file in bytes.
///
/// # Errors
/// [`IoError::Size`], [`IoError::WrongLength`] or [`IoError::Metadata`] before anything is written; otherwise what the
/// file system refuses.
pub fn write_png8<'a>(
    destination: impl Into<Destination<'a>>,
    size_px: [u32; 2],
    rgba: &[[u8; 4]],
    metadata: &PictureMetadata,
) -> Result<u64, IoError> {
    check_length("rgba", size_px, rgba.len())?;
    let rows = rgba.chunks_exact(size_px[0] as usize).map(|row| row.as_flattened().to_vec());
    write_png(destination.into(), size_px, png::BitDepth::Eight, metadata, rows)
}

/// Writes a PNG with 16 bits a channel; gives back the size of the file in bytes.
///
/// # Errors
/// As [`write_png8`].
pub fn write_png16<'a>(
    destination: impl Into<Destination<'a>>,
    size_px: [u32; 2],
    rgba: &[[u16; 4]],
    metadata: &PictureMetadata,
) -> Result<u64, IoError> {
    check_length("rgba", size_px, rgba.len())?;
    let rows = rgba
        .chunks_exact(size_px[0] as usize)
        .map(|row| row.as_flattened().iter().flat_map(|value| value.to_be_bytes()).collect());
    write_png(destination.into(), size_px, png::BitDepth::Sixteen, metadata, rows)
}

fn write_png(
    destination: Destination<'_>,
    size_px: [u32; 2],
    depth: png::BitDepth,
    metadata: &PictureMetadata,
    rows: impl Iterator<Item = Vec<u8>>,
) -> Result<u64, IoError> {
    check_extra(&metadata.extra)?;
    atomic::write_atomically(destination, |file| {
        let mut encoder = png::Encoder::new(&mut *file, size_px[0], size_px[1]);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(depth);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        for (keyword, text) in texts(metadata) {
            if text.is_ascii() {
                encoder.add_text_chunk(keyword.to_owned(), text.to_owned())?;
            } else {
                encoder.add_itxt_chunk(keyword.to_owned(), text.to_owned())?;
            }
        }
        let mut writer = encoder.write_header()?;
        let mut pixels = writer.stream_writer()?;
        for row in rows {
            pixels.write_all(&row)?;
        }
        pixels.finish()?;
        writer.finish()?;
        io::Seek::seek(file, io::SeekFrom::End(0))
    })
}

/// Keywords and texts, without those that are empty.
fn texts(metadata: &PictureMetadata) -> impl Iterator<Item = (&str, &str)> {
    let own = [
        ("Software", &metadata.software),
        ("Title", &metadata.title),
        ("Comment", &metadata.comments),
        (SCENE_HASH, &metadata.scene_hash),
    ];
    let extra = metadata.extra.iter().map(|(name, text)| (name.as_str(), text));
    own.into_iter().chain(extra).map(|(name, text)| (name, text.as_str())).filter(|(_, text)| !text.is_empty())
}

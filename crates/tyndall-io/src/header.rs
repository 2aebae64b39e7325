//! What a picture file says about itself, read without decoding its pixels.

use std::fs::File;
use std::io::{BufReader, Read as _};
use std::path::Path;

use crate::exr_attributes::SCENE_HASH;
use crate::{IoError, PictureMetadata, exr_read};

const EXR_MAGIC: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];
const PNG_MAGIC: [u8; 4] = [0x89, b'P', b'N', b'G'];

/// Format of a picture file, told from its first bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureFormat {
    /// `OpenEXR`.
    Exr,
    /// Portable Network Graphics.
    Png,
}

/// Size and origin of a picture file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PictureHeader {
    /// Format of the file.
    pub format: PictureFormat,
    /// Width and height.
    pub size_px: [u32; 2],
    /// Program that wrote it; empty when the file does not say.
    pub software: String,
    /// Hash of the scene; empty when the file does not say.
    pub scene_hash: String,
    /// Title of the scene; empty when the file does not say.
    pub title: String,
}

/// Reads the header of an EXR or PNG file.
///
/// # Errors
/// [`IoError::Read`] when the file cannot be read, [`IoError::Format`] when it is neither, or damaged.
pub fn read_picture_header(path: impl AsRef<Path>) -> Result<PictureHeader, IoError> {
    let path = path.as_ref();
    let read_error = |source| IoError::Read { path: path.to_path_buf(), source };
    let format_error = |problem: String| IoError::Format { path: path.to_path_buf(), problem };
    let mut magic = Vec::new();
    File::open(path).map_err(read_error)?.take(4).read_to_end(&mut magic).map_err(read_error)?;
    if magic == EXR_MAGIC {
        let (size_px, PictureMetadata { software, scene_hash, title, .. }) = exr_read::read_header(path)?;
        Ok(PictureHeader { format: PictureFormat::Exr, size_px, software, scene_hash, title })
    } else if magic == PNG_MAGIC {
        let file = BufReader::new(File::open(path).map_err(read_error)?);
        let reader = png::Decoder::new(file)
            .read_info()
            .map_err(|error| format_error(format!("not a readable PNG file ({error})")))?;
        Ok(png_header(reader.info()))
    } else {
        Err(format_error("neither an EXR nor a PNG file".to_owned()))
    }
}

/// Whether the file at `path` is the finished picture of this scene, by this program, at this size. As files appear
/// complete or not at all, its header is enough to tell.
#[must_use]
pub fn is_finished(path: impl AsRef<Path>, size_px: [u32; 2], metadata: &PictureMetadata) -> bool {
    read_picture_header(path).is_ok_and(|header| {
        header.size_px == size_px && header.scene_hash == metadata.scene_hash && header.software == metadata.software
    })
}

fn png_header(info: &png::Info<'_>) -> PictureHeader {
    let text = |keyword: &str| {
        let plain = info.uncompressed_latin1_text.iter().find(|chunk| chunk.keyword == keyword);
        let unicode = info.utf8_text.iter().find(|chunk| chunk.keyword == keyword);
        plain
            .map(|chunk| chunk.text.clone())
            .or_else(|| unicode.and_then(|chunk| chunk.get_text().ok()))
            .unwrap_or_default()
    };
    PictureHeader {
        format: PictureFormat::Png,
        size_px: [info.width, info.height],
        software: text("Software"),
        scene_hash: text(SCENE_HASH),
        title: text("Title"),
    }
}

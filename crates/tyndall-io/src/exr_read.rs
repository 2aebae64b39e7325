//! Reads EXR pictures back: those of this crate, and others with channels R, G and B.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use exr::meta::MetaData;
use exr::prelude::{AnyChannel, FlatSamples, Layer, read_first_flat_layer_from_file};

use crate::exr_attributes;
use crate::exr_write::{CHANNEL_NAMES, into_io_error};
use crate::picture::check_size;
use crate::{IoError, Picture, PictureMetadata};

/// The first flat layer of an EXR file; alpha is 1 where the file has none.
///
/// # Errors
/// [`IoError::Read`] when the file cannot be read, [`IoError::Format`] when it is damaged or has no channel R, G or B,
/// [`IoError::Size`] when it is larger than this crate takes.
pub fn read_exr(path: impl AsRef<Path>) -> Result<(Picture, PictureMetadata), IoError> {
    let path = path.as_ref();
    // The size is looked at first: a damaged header must not make the decoder allocate terabytes.
    read_header(path)?;
    let image = read_first_flat_layer_from_file(path).map_err(|error| read_error(path, error))?;
    let layer = image.layer_data;
    let picture = picture_of(path, &layer)?;
    Ok((picture, exr_attributes::metadata(&image.attributes, &layer.attributes)))
}

/// Size and metadata of an EXR file, without its pixels.
pub(crate) fn read_header(path: &Path) -> Result<([u32; 2], PictureMetadata), IoError> {
    let file = File::open(path).map_err(|source| IoError::Read { path: path.to_path_buf(), source })?;
    let meta = MetaData::read_from_buffered(BufReader::new(file), false).map_err(|error| read_error(path, error))?;
    let header = meta.headers.first().ok_or_else(|| format_error(path, "the file has no parts"))?;
    let size_px = size_of(path, header.layer_size)?;
    check_size(size_px)?;
    Ok((size_px, exr_attributes::metadata(&header.shared_attributes, &header.own_attributes)))
}

fn size_of(path: &Path, size: exr::math::Vec2<usize>) -> Result<[u32; 2], IoError> {
    let [Ok(width_px), Ok(height_px)] = [size.0, size.1].map(u32::try_from) else {
        return Err(format_error(path, "its size does not fit into 32 bits"));
    };
    Ok([width_px, height_px])
}

fn picture_of(path: &Path, layer: &Layer<exr::prelude::AnyChannels<FlatSamples>>) -> Result<Picture, IoError> {
    let size_px = size_of(path, layer.size)?;
    let find = |name: char| -> Option<&AnyChannel<FlatSamples>> {
        layer.channel_data.list.iter().find(|channel| channel.name.eq(name.to_string().as_str()))
    };
    let mut rgba = vec![[0.0, 0.0, 0.0, 1.0]; check_size(size_px)?];
    for (index, name) in CHANNEL_NAMES.into_iter().enumerate() {
        match find(name) {
            Some(channel) => {
                for (pixel, value) in rgba.iter_mut().zip(channel.sample_data.values_as_f32()) {
                    pixel[index] = value;
                }
            }
            None if name == 'A' => {}
            None => return Err(format_error(path, &format!("the file has no channel {name}"))),
        }
    }
    let depth_m = find('Z').map(|channel| channel.sample_data.values_as_f32().collect());
    Ok(Picture { size_px, rgba, depth_m })
}

fn read_error(path: &Path, error: exr::error::Error) -> IoError {
    match error {
        exr::error::Error::Io(_) => IoError::Read { path: path.to_path_buf(), source: into_io_error(error) },
        other => format_error(path, &format!("not a readable EXR file ({other})")),
    }
}

fn format_error(path: &Path, problem: &str) -> IoError {
    IoError::Format { path: path.to_path_buf(), problem: problem.to_owned() }
}

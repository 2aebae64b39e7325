//! Maps for other programs as PNG: grey with 8 bits, or three channels with 16 bits, without any colour management.
//!
//! As for height maps the first row of a file is the northern one, the first row of the samples the southern one.

use std::io::Write as _;

use crate::atomic::write_atomically;
use crate::picture::check_length;
use crate::{Destination, IoError};

/// Writes shares as PNG with 8 bits: 0 becomes 0, 255 is 255. The file appears complete or not at all.
///
/// # Errors
/// [`IoError::Size`] or [`IoError::WrongLength`] before anything is written; otherwise what the file system refuses.
pub fn write_grey_map<'a>(
    destination: impl Into<Destination<'a>>,
    size_px: [u32; 2],
    samples: &[u8],
) -> Result<(), IoError> {
    check_length("samples", size_px, samples.len())?;
    let rows = samples.chunks_exact(size_px[0] as usize).rev().map(<[u8]>::to_vec);
    write(destination.into(), size_px, (png::ColorType::Grayscale, png::BitDepth::Eight), rows)
}

/// Writes vectors with components from -1 to 1 as PNG with 16 bits: -1 becomes 0, 0 the middle, 1 becomes 65535. Normals
/// point east in red, north in green, up in blue, which is how `OpenGL` and Blender read them. The file appears complete or
/// not at all.
///
/// # Errors
/// As for [`write_grey_map`].
pub fn write_vector_map<'a>(
    destination: impl Into<Destination<'a>>,
    size_px: [u32; 2],
    vectors: &[[f32; 3]],
) -> Result<(), IoError> {
    check_length("vectors", size_px, vectors.len())?;
    let row = |row: &[[f32; 3]]| row.as_flattened().iter().flat_map(|part| to_u16(*part).to_be_bytes()).collect();
    let rows = vectors.chunks_exact(size_px[0] as usize).rev().map(row);
    write(destination.into(), size_px, (png::ColorType::Rgb, png::BitDepth::Sixteen), rows)
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 65535 by the clamp")]
fn to_u16(part: f32) -> u16 {
    (f64::from(part).mul_add(0.5, 0.5).clamp(0.0, 1.0) * 65535.0).round() as u16
}

fn write(
    destination: Destination<'_>,
    size_px: [u32; 2],
    (colour, depth): (png::ColorType, png::BitDepth),
    rows: impl Iterator<Item = Vec<u8>>,
) -> Result<(), IoError> {
    write_atomically(destination, |file| {
        let mut encoder = png::Encoder::new(file, size_px[0], size_px[1]);
        encoder.set_color(colour);
        encoder.set_depth(depth);
        let mut writer = encoder.write_header()?;
        let mut pixels = writer.stream_writer()?;
        for row in rows {
            pixels.write_all(&row)?;
        }
        pixels.finish()?;
        Ok(writer.finish()?)
    })
}

#[cfg(test)]
mod tests {
    use std::io::BufReader;

    use super::*;

    #[test]
    fn normals_come_back_within_a_hundredth_of_a_degree_with_north_on_top() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("n.png");
        let normals: Vec<[f32; 3]> = (0..12_u8)
            .map(|index| {
                let (sin, cos) = (f32::from(index) * 0.5).sin_cos();
                [0.6 * sin, 0.6 * cos, 0.8]
            })
            .collect();
        write_vector_map(&path, [4, 3], &normals).unwrap();
        let mut reader = png::Decoder::new(BufReader::new(std::fs::File::open(&path).unwrap())).read_info().unwrap();
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut bytes).unwrap();
        let parts: Vec<f64> =
            bytes.as_chunks::<2>().0.iter().map(|two| f64::from(u16::from_be_bytes(*two)) / 32767.5 - 1.0).collect();
        for (row, normals) in normals.chunks_exact(4).rev().enumerate() {
            for (column, normal) in normals.iter().enumerate() {
                let found = &parts[3 * (4 * row + column)..][..3];
                let off: f64 = found.iter().zip(normal).map(|(a, b)| (a - f64::from(*b)).powi(2)).sum::<f64>().sqrt();
                assert!(off.to_degrees() < 0.01, "row {row}, column {column}: {found:?} for {normal:?}");
            }
        }
    }

    #[test]
    fn maps_with_the_wrong_number_of_samples_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let error = write_grey_map(&folder.path().join("a.png"), [3, 3], &[0; 8]).unwrap_err();
        assert!(matches!(error, IoError::WrongLength { .. }), "{error}");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "nothing is written");
    }
}

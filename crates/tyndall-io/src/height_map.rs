//! Height maps: PNG with 16 bits, EXR, R16 and R32, as terrain tools and game engines read them.
//!
//! PNG16 and R16 spread the range of heights over 0 to 65535, so a height comes back within half of 1/65535 of the range;
//! EXR and R32 hold metres as 32-bit floats. R16 and R32 are bare little-endian rows. In files the first row is the northern
//! one. PNG carries range and scale as text; the others need them told, see [`HeightMap::description_json`].

use std::fs::File;
use std::io::{BufReader, Write as _};
use std::path::Path;

use crate::atomic::write_atomically;
use crate::picture::{check_length, check_size};
use crate::{Destination, IoError, exr_height};

/// Text chunks of a PNG height map.
const LOWEST_KEYWORD: &str = "tyndall/lowestM";
const HIGHEST_KEYWORD: &str = "tyndall/highestM";
const PIXEL_KEYWORD: &str = "tyndall/pixelM";
/// Value of the highest sample.
const FULL: f64 = 65535.0;

/// Heights of a terrain.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightMap {
    /// Samples from west to east and from south to north.
    pub size_px: [u32; 2],
    /// Distance of two samples (m).
    pub pixel_m: f64,
    /// Heights (m), row 0 in the south.
    pub heights_m: Vec<f32>,
}

/// Formats of height maps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HeightFormat {
    /// PNG, grey, 16 bits.
    Png16,
    /// `OpenEXR`, one channel of 32-bit floats, metres.
    Exr,
    /// Bare 16-bit numbers.
    R16,
    /// Bare 32-bit floats, metres.
    R32,
}

impl HeightFormat {
    /// The format that a file's ending names.
    ///
    /// # Errors
    /// [`IoError::Format`] for any other ending than png, exr, r16 and r32.
    pub fn of(path: &Path) -> Result<Self, IoError> {
        let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_ascii_lowercase();
        match ending.as_str() {
            "png" => Ok(Self::Png16),
            "exr" => Ok(Self::Exr),
            "r16" => Ok(Self::R16),
            "r32" => Ok(Self::R32),
            _ => Err(format_error(path, format!("`.{ending}` is no height map; .png, .exr, .r16 and .r32 are"))),
        }
    }
}

impl HeightMap {
    /// Lowest and highest height (m).
    #[must_use]
    pub fn range_m(&self) -> [f32; 2] {
        let heights = self.heights_m.iter();
        heights.fold([f32::MAX, f32::MIN], |[low, high], &height| [low.min(height), high.max(height)])
    }

    /// What a program needs to know beside the samples, as JSON.
    #[must_use]
    pub fn description_json(&self) -> String {
        let ([low, high], [width, height]) = (self.range_m(), self.size_px);
        let pixel_m = self.pixel_m;
        format!(
            "{{\n  \"width\": {width},\n  \"height\": {height},\n  \"metres_per_pixel\": {pixel_m},\n  \
             \"lowest_m\": {low},\n  \"highest_m\": {high},\n  \"first_row\": \"north\"\n}}\n"
        )
    }

    pub(crate) fn check(&self, path: &Path) -> Result<(), IoError> {
        check_length("heights_m", self.size_px, self.heights_m.len())?;
        let Some(index) = self.heights_m.iter().position(|height| !height.is_finite()) else { return Ok(()) };
        let width = self.size_px[0] as usize;
        let count = self.heights_m.iter().filter(|height| !height.is_finite()).count();
        // Positions of errors are those of the file, whose first row is the last here.
        let row = self.heights_m.len() / width - 1 - index / width;
        let place = |value: usize| u32::try_from(value).unwrap_or(u32::MAX);
        let (x_px, y_px) = (place(index % width), place(row));
        Err(IoError::NotFinite {
            path: path.to_path_buf(),
            channel: 'Z',
            x_px,
            y_px,
            value: self.heights_m[index],
            count,
        })
    }

    /// Rows from north to south.
    fn rows(&self) -> impl Iterator<Item = &[f32]> {
        self.heights_m.chunks_exact(self.size_px[0] as usize).rev()
    }
}

/// Writes a height map; the file appears complete or not at all.
///
/// # Errors
/// [`IoError::Size`], [`IoError::WrongLength`] or [`IoError::NotFinite`] before anything is written; otherwise what the
/// file system refuses.
pub fn write_height_map<'a>(
    destination: impl Into<Destination<'a>>,
    map: &HeightMap,
    format: HeightFormat,
) -> Result<(), IoError> {
    write_height_map_in(destination, map, format, map.range_m())
}

/// [`write_height_map`] with another range (m) for the 16-bit formats than the map's own: that of all tiles of a terrain, so
/// that equal heights are equal numbers in each of them.
///
/// # Errors
/// As [`write_height_map`], and [`IoError::Format`] when a height is outside the range.
pub fn write_height_map_in<'a>(
    destination: impl Into<Destination<'a>>,
    map: &HeightMap,
    format: HeightFormat,
    range_m: [f32; 2],
) -> Result<(), IoError> {
    let destination = destination.into();
    map.check(destination.path)?;
    let (own, [lowest, highest]) = (map.range_m(), range_m);
    if own[0] < lowest || own[1] > highest {
        let problem = format!("heights from {} to {} m do not fit into {lowest} to {highest} m", own[0], own[1]);
        return Err(format_error(destination.path, problem));
    }
    let [low, high] = range_m.map(f64::from);
    let scale = if high > low { FULL / (high - low) } else { 0.0 };
    let sample = |height: &f32| to_u16((f64::from(*height) - low) * scale);
    write_atomically(destination, |file| match format {
        HeightFormat::Png16 => {
            let mut encoder = png::Encoder::new(file, map.size_px[0], map.size_px[1]);
            encoder.set_color(png::ColorType::Grayscale);
            encoder.set_depth(png::BitDepth::Sixteen);
            for (keyword, value) in [(LOWEST_KEYWORD, low), (HIGHEST_KEYWORD, high), (PIXEL_KEYWORD, map.pixel_m)] {
                encoder.add_text_chunk(keyword.to_owned(), value.to_string())?;
            }
            let mut writer = encoder.write_header()?;
            let mut pixels = writer.stream_writer()?;
            for row in map.rows() {
                pixels.write_all(&row.iter().flat_map(|height| sample(height).to_be_bytes()).collect::<Vec<_>>())?;
            }
            pixels.finish()?;
            Ok(writer.finish()?)
        }
        HeightFormat::Exr => exr_height::write(file, map),
        HeightFormat::R16 => map.rows().try_for_each(|row| {
            file.write_all(&row.iter().flat_map(|height| sample(height).to_le_bytes()).collect::<Vec<_>>())
        }),
        HeightFormat::R32 => map.rows().try_for_each(|row| {
            file.write_all(&row.iter().flat_map(|height| height.to_le_bytes()).collect::<Vec<_>>())
        }),
    })
}

/// Scale of a height map whose file does not tell it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeightScale {
    /// Heights of the samples 0 and 65535 (m); of no account for EXR and R32.
    pub range_m: [f32; 2],
    /// Distance of two samples (m).
    pub pixel_m: f64,
}

/// Reads a height map; R16 and R32 are square. What a PNG says of its scale goes before `scale`.
///
/// # Errors
/// [`IoError::Read`] when the file cannot be read, [`IoError::Format`] when it is no height map, with the reason.
pub fn read_height_map(path: impl AsRef<Path>, scale: HeightScale) -> Result<HeightMap, IoError> {
    let path = path.as_ref();
    match HeightFormat::of(path)? {
        HeightFormat::Png16 => read_png(path, scale),
        HeightFormat::Exr => {
            let map = exr_height::read(path, scale.pixel_m)?;
            map.check(path).map_err(|_not_finite| not_finite(path))?;
            Ok(map)
        }
        HeightFormat::R16 => {
            read_bare(path, scale.pixel_m, |bytes: [u8; 2]| from_u16(u16::from_le_bytes(bytes), scale.range_m))
        }
        HeightFormat::R32 => read_bare(path, scale.pixel_m, f32::from_le_bytes),
    }
}

fn read_bare<const N: usize>(path: &Path, pixel_m: f64, sample: impl Fn([u8; N]) -> f32) -> Result<HeightMap, IoError> {
    let bytes = std::fs::read(path).map_err(|source| IoError::Read { path: path.to_path_buf(), source })?;
    let samples = bytes.as_chunks::<N>();
    let side = samples.0.len().isqrt();
    let size = u32::try_from(side).ok().filter(|_| side > 0 && side * side * N == bytes.len());
    let Some(side_px) = size else {
        let problem = format!("{} bytes are no square of {N}-byte samples", bytes.len());
        return Err(format_error(path, problem));
    };
    check_size([side_px; 2])?;
    let heights_m = samples.0.chunks_exact(side).rev().flatten().map(|bytes| sample(*bytes)).collect::<Vec<_>>();
    let map = HeightMap { size_px: [side_px; 2], pixel_m, heights_m };
    map.check(path).map_err(|_not_finite| not_finite(path))?;
    Ok(map)
}

fn not_finite(path: &Path) -> IoError {
    format_error(path, "it has heights that are no numbers".to_owned())
}

fn read_png(path: &Path, mut scale: HeightScale) -> Result<HeightMap, IoError> {
    let file = File::open(path).map_err(|source| IoError::Read { path: path.to_path_buf(), source })?;
    let wrong = |error: png::DecodingError| format_error(path, format!("this is no PNG: {error}"));
    let mut reader = png::Decoder::new(BufReader::new(file)).read_info().map_err(wrong)?;
    let info = reader.info();
    let (size_px, depth, colour) = ([info.width, info.height], info.bit_depth, info.color_type);
    if colour != png::ColorType::Grayscale || !matches!(depth, png::BitDepth::Eight | png::BitDepth::Sixteen) {
        return Err(format_error(
            path,
            format!("it is {colour:?} with {depth:?} bits; grey with 8 or 16 bits is needed"),
        ));
    }
    for chunk in &info.uncompressed_latin1_text {
        let value = chunk.text.parse::<f64>().ok().filter(|value| value.is_finite());
        match (chunk.keyword.as_str(), value) {
            (LOWEST_KEYWORD, Some(value)) => scale.range_m[0] = to_f32(value),
            (HIGHEST_KEYWORD, Some(value)) => scale.range_m[1] = to_f32(value),
            (PIXEL_KEYWORD, Some(value)) => scale.pixel_m = value,
            _ => {}
        }
    }
    check_size(size_px)?;
    let too_large = || format_error(path, "it is too large".to_owned());
    let mut bytes = vec![0; reader.output_buffer_size().ok_or_else(too_large)?];
    reader.next_frame(&mut bytes).map_err(wrong)?;
    let samples: Vec<u16> = match depth {
        png::BitDepth::Sixteen => bytes.as_chunks::<2>().0.iter().map(|bytes| u16::from_be_bytes(*bytes)).collect(),
        // 255 becomes 65535.
        _ => bytes.iter().map(|byte| u16::from(*byte) * 257).collect(),
    };
    let rows = samples.chunks_exact(size_px[0] as usize).rev();
    let heights_m = rows.flatten().map(|sample| from_u16(*sample, scale.range_m)).collect();
    Ok(HeightMap { size_px, pixel_m: scale.pixel_m, heights_m })
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 65535 by construction")]
fn to_u16(value: f64) -> u16 {
    value.round() as u16
}

fn from_u16(sample: u16, [low, high]: [f32; 2]) -> f32 {
    let (low, high) = (f64::from(low), f64::from(high));
    to_f32(low + f64::from(sample) / FULL * (high - low))
}

#[expect(clippy::cast_possible_truncation, reason = "heights are kept as f32")]
fn to_f32(value: f64) -> f32 {
    value as f32
}

fn format_error(path: &Path, problem: String) -> IoError {
    IoError::Format { path: path.to_path_buf(), problem }
}

impl From<HeightFormat> for &'static str {
    fn from(format: HeightFormat) -> Self {
        match format {
            HeightFormat::Png16 => "png",
            HeightFormat::Exr => "exr",
            HeightFormat::R16 => "r16",
            HeightFormat::R32 => "r32",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dunes() -> HeightMap {
        let height = |index: u16| 12.5 * (f32::from(index % 32) * 0.21).sin() + 0.3 * f32::from(index / 32) - 4.0;
        HeightMap { size_px: [32, 32], pixel_m: 0.5, heights_m: (0..1024).map(height).collect() }
    }

    const UNKNOWN: HeightScale = HeightScale { range_m: [0.0, 1.0], pixel_m: 1.0 };

    #[test]
    fn heights_come_back_within_a_65535th_of_their_range() {
        let folder = tempfile::tempdir().unwrap();
        let map = dunes();
        let [low, high] = map.range_m();
        for format in [HeightFormat::Png16, HeightFormat::Exr, HeightFormat::R16, HeightFormat::R32] {
            let path = folder.path().join("map").with_extension(<&str>::from(format));
            write_height_map(path.as_path(), &map, format).unwrap();
            let scale = if format == HeightFormat::Png16 {
                UNKNOWN
            } else {
                HeightScale { range_m: [low, high], pixel_m: 0.5 }
            };
            let back = read_height_map(&path, scale).unwrap();
            assert_eq!((back.size_px, back.pixel_m.to_bits()), (map.size_px, map.pixel_m.to_bits()), "{format:?}");
            let allowed =
                if matches!(format, HeightFormat::R32 | HeightFormat::Exr) { 0.0 } else { (high - low) / 65535.0 };
            let worst = back.heights_m.iter().zip(&map.heights_m).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
            assert!(worst <= allowed, "{format:?}: off by {worst} m of {allowed}");
        }
    }

    #[test]
    fn equal_heights_are_equal_numbers_in_tiles_of_one_range() {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, heights_m: Vec<f32>| {
            let map = HeightMap { size_px: [2, 1], pixel_m: 1.0, heights_m };
            let path = folder.path().join(name);
            write_height_map_in(&path, &map, HeightFormat::R16, [0.0, 10.0]).map(|()| std::fs::read(&path).unwrap())
        };
        let (left, right) = (write("a.r16", vec![1.0, 2.5]).unwrap(), write("b.r16", vec![2.5, 9.0]).unwrap());
        assert_eq!(left[2..], right[..2], "the shared border");
        let text = write("c.r16", vec![0.0, 11.0]).unwrap_err().to_string();
        assert!(text.contains("0 to 11 m do not fit into 0 to 10 m"), "{text}");
    }

    #[test]
    fn the_first_row_of_a_file_is_the_northern_one() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("map.r32");
        let map = HeightMap { size_px: [2, 2], pixel_m: 1.0, heights_m: vec![1.0, 2.0, 3.0, 4.0] };
        write_height_map(path.as_path(), &map, HeightFormat::R32).unwrap();
        let first = std::fs::read(&path).unwrap()[..4].to_vec();
        assert_eq!(first, 3.0_f32.to_le_bytes(), "the start of the upper row");
    }

    #[test]
    fn what_is_no_height_map_is_refused_with_its_reason() {
        let folder = tempfile::tempdir().unwrap();
        let message = |name: &str, bytes: &[u8]| {
            let path = folder.path().join(name);
            std::fs::write(&path, bytes).unwrap();
            read_height_map(&path, UNKNOWN).unwrap_err().to_string()
        };
        assert!(message("a.r16", &[0; 10]).ends_with("10 bytes are no square of 2-byte samples"), "not square");
        assert!(message("a.r32", &f32::NAN.to_le_bytes()).ends_with("it has heights that are no numbers"), "NaN");
        assert!(message("a.png", b"text").contains("this is no PNG"), "no PNG");
        assert!(message("a.tif", b"").ends_with("`.tif` is no height map; .png, .exr, .r16 and .r32 are"), "ending");
        let mut map = dunes();
        map.heights_m[33] = f32::INFINITY;
        let path = folder.path().join("b.png");
        let error = write_height_map(path.as_path(), &map, HeightFormat::Png16).unwrap_err().to_string();
        assert!(error.contains("pixel (1, 30) is inf") && !path.exists(), "{error}");
    }

    #[test]
    fn level_ground_is_written_too() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("flat.png");
        let map = HeightMap { size_px: [4, 4], pixel_m: 1.0, heights_m: vec![7.0; 16] };
        write_height_map(path.as_path(), &map, HeightFormat::Png16).unwrap();
        assert_eq!(read_height_map(&path, UNKNOWN).unwrap(), map, "7 m everywhere");
    }
}

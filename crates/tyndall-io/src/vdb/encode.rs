//! Bytes of a VDB file: numbers in little-endian, texts with their length, metadata, masks, packed values.

use std::io::{self, Write};

use flate2::Compression;
use flate2::write::ZlibEncoder;
use half::f16;

use super::{VdbGrid, VdbOptions, VdbPacking};

/// First eight bytes: " BDV" and zeros.
const MAGIC: u64 = 0x5644_4220;
/// Version of the layout, and the version of the library that introduced it.
const FILE_VERSION: u32 = 224;
const LIBRARY_VERSION: [u32; 2] = [8, 1];

/// Bits of a grid's way of packing.
const PACKED_ZIP: u32 = 1;
const PACKED_ACTIVE: u32 = 2;

/// Values of a block: inactive ones are all the background and left out.
const INACTIVE_ARE_BACKGROUND: u8 = 0;
/// Values of a block: all are stored.
const ALL_STORED: u8 = 6;

/// Before the first grid; `identifier` has 36 characters.
pub(super) fn header(file: &mut impl Write, identifier: &str) -> io::Result<()> {
    file.write_all(&MAGIC.to_le_bytes())?;
    word(file, FILE_VERSION)?;
    LIBRARY_VERSION.into_iter().try_for_each(|part| word(file, part))?;
    // There are offsets, so that readers may skip grids.
    file.write_all(&[1])?;
    file.write_all(identifier.as_bytes())?;
    Metadata::default().write(file)
}

/// A hash of the grids in the form of a UUID of version 8, which is left to programs.
pub(super) fn identifier(grids: &[VdbGrid<'_>]) -> String {
    let mut hasher = blake3::Hasher::new();
    for grid in grids {
        hasher.update(grid.name.as_bytes());
        for number in grid.low_corner_m.into_iter().chain([grid.cell_m]) {
            hasher.update(&number.to_le_bytes());
        }
        for block in grid.values.cells().chunks(8192) {
            hasher.update(&block.iter().flat_map(|value| value.to_le_bytes()).collect::<Vec<u8>>());
        }
    }
    let hex = hasher.finalize().to_hex();
    format!("{}-{}-8{}-a{}-{}", &hex[..8], &hex[8..12], &hex[12..15], &hex[15..18], &hex[18..30])
}

pub(super) fn word(file: &mut impl Write, value: u32) -> io::Result<()> {
    file.write_all(&value.to_le_bytes())
}

/// A place in the file.
pub(super) fn offset(file: &mut impl Write, value: u64) -> io::Result<()> {
    file.write_all(&value.to_le_bytes())
}

pub(super) fn text(file: &mut impl Write, value: &str) -> io::Result<()> {
    word(file, u32::try_from(value.len()).map_err(io::Error::other)?)?;
    file.write_all(value.as_bytes())
}

/// A cell.
pub(super) fn place(file: &mut impl Write, cell: [usize; 3]) -> io::Result<()> {
    cell.into_iter().try_for_each(|part| word(file, u32::try_from(part).map_err(io::Error::other)?))
}

pub(super) fn mask(file: &mut impl Write, words: &[u64]) -> io::Result<()> {
    file.write_all(&words.iter().flat_map(|word| word.to_le_bytes()).collect::<Vec<u8>>())
}

/// Cells to metres: the same scale along all axes, then a shift.
pub(super) fn uniform_scale_translate(file: &mut impl Write, cell_m: f64, shift_m: [f64; 3]) -> io::Result<()> {
    text(file, "UniformScaleTranslateMap")?;
    let inverse = 1.0 / cell_m;
    // The readers' own copies of what follows from the scale: size of a voxel, inverse, its square, half of it.
    let scales = [cell_m, cell_m, inverse, inverse * inverse, 0.5 * inverse];
    let numbers = shift_m.into_iter().chain(scales.into_iter().flat_map(|scale| [scale; 3]));
    numbers.into_iter().try_for_each(|number| file.write_all(&number.to_le_bytes()))
}

/// Entries about a grid.
#[derive(Debug, Default)]
pub(super) struct Metadata {
    entries: Vec<(&'static str, &'static str, Vec<u8>)>,
}

impl Metadata {
    pub(super) fn text(&mut self, name: &'static str, value: &str) {
        self.entries.push((name, "string", value.as_bytes().to_vec()));
    }

    pub(super) fn truth(&mut self, name: &'static str, value: bool) {
        self.entries.push((name, "bool", vec![u8::from(value)]));
    }

    pub(super) fn count(&mut self, name: &'static str, value: u64) {
        self.entries.push((name, "int64", value.to_le_bytes().to_vec()));
    }

    pub(super) fn cell(&mut self, name: &'static str, cell: [usize; 3]) {
        let bytes = cell.into_iter().flat_map(|part| u32::try_from(part).unwrap_or(u32::MAX).to_le_bytes());
        self.entries.push((name, "vec3i", bytes.collect()));
    }

    pub(super) fn write(&self, file: &mut impl Write) -> io::Result<()> {
        word(file, u32::try_from(self.entries.len()).map_err(io::Error::other)?)?;
        for (name, kind, bytes) in &self.entries {
            text(file, name)?;
            text(file, kind)?;
            word(file, u32::try_from(bytes.len()).map_err(io::Error::other)?)?;
            file.write_all(bytes)?;
        }
        Ok(())
    }
}

/// Packs values.
#[derive(Debug)]
pub(super) struct Encoder {
    options: VdbOptions,
}

impl Encoder {
    pub(super) fn new(options: VdbOptions) -> Self {
        Self { options }
    }

    /// The flags of a grid.
    pub(super) fn compression(&self) -> u32 {
        match self.options.packing {
            VdbPacking::Plain => PACKED_ACTIVE,
            VdbPacking::Zip => PACKED_ACTIVE | PACKED_ZIP,
        }
    }

    /// The active values of a block, whose others are background.
    pub(super) fn write_active(&self, file: &mut impl Write, values: &[f32]) -> io::Result<()> {
        file.write_all(&[INACTIVE_ARE_BACKGROUND])?;
        self.write_values(file, values)
    }

    /// A block of `count` values of which none is active.
    pub(super) fn write_inactive(&self, file: &mut impl Write, count: usize) -> io::Result<()> {
        match self.options.packing {
            VdbPacking::Plain => self.write_active(file, &[]),
            // Readers disagree whether a deflated list of nothing has a length, so all zeros are stored.
            VdbPacking::Zip => {
                file.write_all(&[ALL_STORED])?;
                self.write_values(file, &vec![0.0; count])
            }
        }
    }

    fn write_values(&self, file: &mut impl Write, values: &[f32]) -> io::Result<()> {
        let bytes: Vec<u8> = if self.options.half {
            values.iter().flat_map(|value| f16::from_f32(*value).to_le_bytes()).collect()
        } else {
            values.iter().flat_map(|value| value.to_le_bytes()).collect()
        };
        match self.options.packing {
            VdbPacking::Plain => file.write_all(&bytes),
            VdbPacking::Zip => write_deflated(file, &bytes),
        }
    }
}

/// A length and deflated bytes; a negative length and the bytes as they are where that would be shorter.
fn write_deflated(file: &mut impl Write, bytes: &[u8]) -> io::Result<()> {
    let mut deflater = ZlibEncoder::new(Vec::new(), Compression::default());
    deflater.write_all(bytes)?;
    let deflated = deflater.finish()?;
    let length = |bytes: &[u8]| i64::try_from(bytes.len()).map_err(io::Error::other);
    if deflated.len() < bytes.len() {
        file.write_all(&length(&deflated)?.to_le_bytes())?;
        file.write_all(&deflated)
    } else {
        file.write_all(&(-length(bytes)?).to_le_bytes())?;
        file.write_all(bytes)
    }
}

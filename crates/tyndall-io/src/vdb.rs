//! `OpenVDB` files of float grids: the volumes that film and game programs read.
//!
//! File version 224 of the layout that `OpenVDB` documents: one tree 5-4-3 for each grid (blocks of 4096, 128 and 8 cells a side),
//! cells above 0 active, background 0, blocks of 8 x 8 x 8 without an active cell left out. Values are stored as they are or, with
//! [`VdbPacking::Zip`], deflated block by block; Blosc is not written. Equal grids make equal files: the identifier that every file
//! carries is a hash of the cells.
//!
//! A voxel of VDB is centred on its whole coordinates, a cell of ours half a cell further: the transform says so.

mod encode;
mod tree;

use std::io::{self, Seek, SeekFrom, Write};

use tyndall_core::grid::Grid3;

use crate::atomic::write_atomically;
use crate::{Destination, IoError};
use encode::{Encoder, Metadata};
use tree::Tree;

/// Largest value that a half float holds.
const LARGEST_HALF: f32 = 65_504.0;

/// How values are packed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum VdbPacking {
    /// Active values alone, as they are: every reader takes it.
    #[default]
    Plain,
    /// The same deflated: smaller, slower.
    Zip,
}

/// How values are stored.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct VdbOptions {
    /// 16-bit floats, three significant digits, in place of 32-bit ones.
    pub half: bool,
    /// How values are packed.
    pub packing: VdbPacking,
}

/// A grid of a VDB file.
#[derive(Clone, Copy, Debug)]
pub struct VdbGrid<'a> {
    /// Name by which programs find it; `density` for what they should draw.
    pub name: &'a str,
    /// Values, 0 and more, index x east, y north, z up.
    pub values: &'a Grid3<f32>,
    /// Side of a cell (m).
    pub cell_m: f64,
    /// Place of the grid's low corner (m).
    pub low_corner_m: [f64; 3],
}

/// What was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VdbReport {
    /// Size of the file.
    pub bytes: u64,
    /// Cells above 0, of all grids.
    pub active_cells: u64,
    /// Blocks of 512 cells that were stored, of all grids.
    pub blocks: u64,
}

/// Writes grids as fog volumes; the file appears complete or not at all.
///
/// # Errors
/// [`IoError::Volume`] when a cell is negative, not finite, or beyond half floats where those were asked for, and when a side of a
/// cell is not above 0; otherwise when the folder or the disk refuses, or when cancelled.
pub fn write_vdb<'a>(
    destination: impl Into<Destination<'a>>,
    grids: &[VdbGrid<'_>],
    options: VdbOptions,
) -> Result<VdbReport, IoError> {
    let destination = destination.into();
    for grid in grids {
        check(grid, options).map_err(|problem| {
            let (path, grid) = (destination.path.to_path_buf(), grid.name.to_owned());
            IoError::Volume { path, grid, problem }
        })?;
    }
    let trees: Vec<Tree> = grids.iter().map(|grid| Tree::of(grid.values)).collect();
    write_atomically(destination, |file| {
        encode::header(file, &encode::identifier(grids))?;
        encode::word(file, u32::try_from(grids.len()).map_err(io::Error::other)?)?;
        for (grid, tree) in grids.iter().zip(&trees) {
            write_grid(file, grid, tree, options)?;
        }
        let sum = |count: fn(&Tree) -> u64| trees.iter().map(count).sum();
        let bytes = file.seek(SeekFrom::End(0))?;
        Ok(VdbReport { bytes, active_cells: sum(Tree::active_cells), blocks: sum(Tree::leaf_count) })
    })
}

/// A sentence about what no file can hold.
fn check(grid: &VdbGrid<'_>, options: VdbOptions) -> Result<(), String> {
    let (cell_m, corner) = (grid.cell_m, grid.low_corner_m);
    if !(cell_m.is_finite() && cell_m > 0.0) {
        return Err(format!("the side of a cell is {cell_m} m; it must be above 0"));
    }
    if let Some(place) = corner.iter().find(|place| !place.is_finite()) {
        return Err(format!("the low corner lies at {place} m"));
    }
    let most = if options.half { LARGEST_HALF } else { f32::MAX };
    let Some(index) = grid.values.cells().iter().position(|value| !(0.0..=most).contains(value)) else { return Ok(()) };
    let ([nx, ny, _], value) = (grid.values.size(), grid.values.cells()[index]);
    let cell = [index % nx, index / nx % ny, index / (nx * ny)];
    Err(format!("cell {cell:?} is {value}; 0 to {most} is allowed"))
}

/// The descriptor of a grid, with the places of its parts filled in at the end, and the grid.
fn write_grid(file: &mut (impl Write + Seek), grid: &VdbGrid<'_>, tree: &Tree, options: VdbOptions) -> io::Result<()> {
    encode::text(file, grid.name)?;
    encode::text(file, if options.half { "Tree_float_5_4_3_HalfFloat" } else { "Tree_float_5_4_3" })?;
    encode::text(file, "")?;
    let descriptor = file.stream_position()?;
    [0; 3].into_iter().try_for_each(|place| encode::offset(file, place))?;

    let encoder = Encoder::new(options);
    let start = file.stream_position()?;
    encode::word(file, encoder.compression())?;
    metadata(grid, tree, options).write(file)?;
    encode::uniform_scale_translate(file, grid.cell_m, grid.low_corner_m.map(|low| low + 0.5 * grid.cell_m))?;
    tree.write_topology(file, &encoder)?;
    let blocks = file.stream_position()?;
    tree.write_values(file, grid.values, &encoder)?;
    let end = file.stream_position()?;

    file.seek(SeekFrom::Start(descriptor))?;
    [start, blocks, end].into_iter().try_for_each(|place| encode::offset(file, place))?;
    file.seek(SeekFrom::Start(end)).map(drop)
}

fn metadata(grid: &VdbGrid<'_>, tree: &Tree, options: VdbOptions) -> Metadata {
    let mut metadata = Metadata::default();
    metadata.text("class", "fog volume");
    metadata.text("creator", concat!("Tyndall ", env!("CARGO_PKG_VERSION")));
    if let Some([low, high]) = tree.bounds() {
        metadata.cell("file_bbox_max", high);
        metadata.cell("file_bbox_min", low);
    }
    metadata.text(
        "file_compression",
        match options.packing {
            VdbPacking::Plain => "active values",
            VdbPacking::Zip => "zip + active values",
        },
    );
    metadata.count("file_voxel_count", tree.active_cells());
    metadata.truth("is_local_space", false);
    metadata.truth("is_saved_as_half_float", options.half);
    metadata.text("name", grid.name);
    metadata
}

#[cfg(test)]
mod tests;

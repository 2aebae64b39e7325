//! Files of a layer: one, or one a tile.

use std::path::{Path, PathBuf};

use tyndall_dunes::DesertSimulation;
use tyndall_dunes::export::{Tile, tiles};
use tyndall_io::{
    Destination, HeightFormat, HeightMap, IoError, write_glb, write_grey_map, write_height_map_in, write_vector_map,
};
use tyndall_scene::SceneError;

use super::layers::{Layer, Samples};
use super::{Form, HeightmapArguments, finished};
use crate::Failure;
use crate::interrupt::Interrupt;

/// Column from the west and row from the north, without tiles `None`, and the samples of a file.
type Piece<T> = (Option<[usize; 2]>, Vec<T>);

/// What files are written from and by.
pub(super) struct Writer<'a> {
    pub(super) arguments: &'a HeightmapArguments,
    pub(super) form: Form,
    pub(super) desert: &'a DesertSimulation,
    pub(super) interrupt: &'a Interrupt,
}

/// A file that was written.
#[derive(Clone, Debug)]
pub(super) struct Written {
    pub(super) path: PathBuf,
    /// Column from the west and row from the north; `None` without tiles.
    pub(super) tile: Option<[usize; 2]>,
}

impl Writer<'_> {
    /// Samples along each side of a file.
    pub(super) fn file_size(&self) -> [usize; 2] {
        let size = self.desert.size();
        match (self.arguments.tiles, self.arguments.shared_edge) {
            (Some(count), _) => [0, 1].map(|axis| size[axis] / count[axis] + 1),
            (None, true) => size.map(|side| side + 1),
            (None, false) => size,
        }
    }

    /// Writes a layer; of a mesh its normals are among `layers` or made anew.
    pub(super) fn write(&self, layer: &Layer, layers: &[Layer]) -> Result<Vec<Written>, Failure> {
        if layer.suffix.is_empty() && self.form == Form::Mesh {
            return self.write_mesh(layer, layers);
        }
        match &layer.samples {
            Samples::Amounts(amounts) => {
                let format = if let Form::Map(format) = self.form { format } else { HeightFormat::Exr };
                let range = range(amounts);
                self.each(layer, amounts, format.into(), |destination, size_px, samples| {
                    let map = HeightMap { size_px, pixel_m: self.desert.cell_m(), heights_m: samples };
                    write_height_map_in(destination, &map, format, range)
                })
            }
            Samples::Vectors(vectors) => self.each(layer, vectors, "png", |destination, size_px, samples| {
                write_vector_map(destination, size_px, &samples)
            }),
            Samples::Shares(shares) => self.each(layer, shares, "png", |destination, size_px, samples| {
                write_grey_map(destination, size_px, &samples)
            }),
        }
    }

    fn write_mesh(&self, heights: &Layer, layers: &[Layer]) -> Result<Vec<Written>, Failure> {
        let normals = layers.iter().find_map(|layer| match &layer.samples {
            Samples::Vectors(normals) if layer.suffix == "normal" => Some(normals.clone()),
            _ => None,
        });
        let normals = match normals {
            Some(normals) => normals,
            None => self.desert.maps().map_err(SceneError::Sand)?.normals,
        };
        let Samples::Amounts(heights_m) = &heights.samples else { return Ok(Vec::new()) };
        let (heights, normals) = (self.cut(heights_m)?, self.cut(&normals)?);
        let mut written = Vec::new();
        for ((tile, heights_m), (_, normals)) in heights.into_iter().zip(normals) {
            let map = HeightMap { size_px: self.size_px(), pixel_m: self.desert.cell_m(), heights_m };
            let path = self.arguments.output.clone();
            let destination = Destination::new(&path).cancelled_by(self.interrupt.flag());
            finished(write_glb(destination, &map, &normals), self.interrupt)?;
            written.push(Written { path, tile });
        }
        Ok(written)
    }

    /// Writes every file of a layer.
    fn each<T: Copy>(
        &self,
        layer: &Layer,
        samples: &[T],
        ending: &str,
        write: impl Fn(Destination<'_>, [u32; 2], Vec<T>) -> Result<(), IoError>,
    ) -> Result<Vec<Written>, Failure> {
        let mut written = Vec::new();
        for (tile, samples) in self.cut(samples)? {
            let path = file_name(&self.arguments.output, layer.suffix, tile, ending);
            let destination = Destination::new(&path).cancelled_by(self.interrupt.flag());
            finished(write(destination, self.size_px(), samples), self.interrupt)?;
            written.push(Written { path, tile });
        }
        Ok(written)
    }

    /// The samples of every file, with column and row of the tile.
    fn cut<T: Copy>(&self, samples: &[T]) -> Result<Vec<Piece<T>>, Failure> {
        if self.arguments.tiles.is_none() && !self.arguments.shared_edge {
            return Ok(vec![(None, samples.to_vec())]);
        }
        let count = self.arguments.tiles.unwrap_or([1, 1]);
        let edges = self.desert.field().edges();
        let cut = tiles(samples, self.desert.size(), count, edges).map_err(SceneError::Sand)?;
        // Tiles count from the south, files from the north as their rows do.
        let place = |tile: &Tile<T>| [tile.place[0], count[1] - 1 - tile.place[1]];
        let named = |tile: Tile<T>| (self.arguments.tiles.map(|_| place(&tile)), tile.samples);
        Ok(cut.into_iter().map(named).collect())
    }

    fn size_px(&self) -> [u32; 2] {
        // Sides are at most 4097.
        self.file_size().map(|side| u32::try_from(side).unwrap_or(u32::MAX))
    }
}

/// Lowest and highest of all amounts.
pub(super) fn range(amounts: &[f32]) -> [f32; 2] {
    amounts.iter().fold([f32::MAX, f32::MIN], |[low, high], amount| [low.min(*amount), high.max(*amount)])
}

/// `dunes.png` with the suffix `normal` and the tile [1, 0] is `dunes-normal_x1_y0.png`.
fn file_name(output: &Path, suffix: &str, tile: Option<[usize; 2]>, ending: &str) -> PathBuf {
    let mut name = output.file_stem().unwrap_or_default().to_os_string();
    if !suffix.is_empty() {
        name.push(format!("-{suffix}"));
    }
    if let Some([x, y]) = tile {
        name.push(format!("_x{x}_y{y}"));
    }
    let own = output.extension().unwrap_or_default();
    name.push(".");
    // The heights keep the ending as the user wrote it.
    name.push(if own.eq_ignore_ascii_case(ending) { own } else { ending.as_ref() });
    output.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_named_after_layer_and_tile() {
        let name = |suffix, tile, ending| file_name(Path::new("out/dunes.PNG"), suffix, tile, ending);
        assert_eq!(name("", None, "png"), Path::new("out/dunes.PNG"), "the heights");
        assert_eq!(name("normal", None, "png"), Path::new("out/dunes-normal.PNG"), "a map");
        assert_eq!(name("age", Some([1, 0]), "r32"), Path::new("out/dunes-age_x1_y0.r32"), "a tile of a map");
    }
}

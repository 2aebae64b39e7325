//! Terrain as a mesh: binary glTF 2.0 (`.glb`), which Blender and game engines open.
//!
//! One mesh of two triangles a cell, with normals and texture coordinates. glTF has y up and z to the south: x is east, y
//! the height, both in metres, the middle of the map at the origin. Texture coordinates have their origin in the
//! north-west, as the rows of the maps. Not done: tiles, levels of detail, materials.

use std::io::{self, Write};

use serde_json::json;

use crate::atomic::write_atomically;
use crate::picture::check_length;
use crate::{Destination, HeightMap, IoError};

/// Bytes of a vertex: place, normal, texture coordinates.
const VERTEX_BYTES: u64 = 32;
/// Most bytes of the numbers of a file, whose lengths have 32 bits.
const MOST_BYTES: u64 = 0xFFFF_0000;

/// Writes a mesh of the heights with these unit normals (east, north, up); the file appears complete or not at all.
///
/// # Errors
/// [`IoError::Size`], [`IoError::WrongLength`] or [`IoError::Format`] for a mesh beyond 4 GiB, before anything is written;
/// otherwise what the file system refuses.
pub fn write_glb<'a>(
    destination: impl Into<Destination<'a>>,
    map: &HeightMap,
    normals: &[[f32; 3]],
) -> Result<(), IoError> {
    let destination = destination.into();
    map.check(destination.path())?;
    check_length("normals", map.size_px, normals.len())?;
    let mesh = Mesh { map, normals };
    if mesh.vertex_bytes() + mesh.index_bytes() > MOST_BYTES || map.size_px.contains(&1) {
        let [columns, rows] = map.size_px;
        let problem = format!("{columns} x {rows} samples make no mesh of 2 x 2 or more within 4 GiB");
        return Err(IoError::Format { path: destination.path().to_path_buf(), problem });
    }
    write_atomically(destination, |file| mesh.write(file))
}

/// What a mesh is made of.
struct Mesh<'a> {
    map: &'a HeightMap,
    normals: &'a [[f32; 3]],
}

impl Mesh<'_> {
    fn vertices(&self) -> u64 {
        self.map.size_px.map(u64::from).iter().product()
    }

    fn vertex_bytes(&self) -> u64 {
        self.vertices() * VERTEX_BYTES
    }

    fn indices(&self) -> u64 {
        self.map.size_px.map(|side| u64::from(side) - 1).iter().product::<u64>() * 6
    }

    fn index_bytes(&self) -> u64 {
        self.indices() * 4
    }

    /// Half the sides of the map (m).
    fn half_m(&self) -> [f64; 2] {
        self.map.size_px.map(|side| f64::from(side - 1) * self.map.pixel_m / 2.0)
    }

    fn write(&self, target: &mut impl Write) -> io::Result<()> {
        let mut text = self.description().to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let length = |bytes: u64| u32::try_from(bytes).map_err(|_too_large| io::Error::other("more than 4 GiB"));
        let numbers = self.vertex_bytes() + self.index_bytes();
        target.write_all(b"glTF")?;
        for number in [2, length(12 + 8 + text.len() as u64 + 8 + numbers)?, length(text.len() as u64)?] {
            target.write_all(&number.to_le_bytes())?;
        }
        target.write_all(b"JSON")?;
        target.write_all(&text)?;
        target.write_all(&length(numbers)?.to_le_bytes())?;
        target.write_all(b"BIN\0")?;
        self.write_vertices(target)?;
        self.write_indices(target)
    }

    fn description(&self) -> serde_json::Value {
        let ([low, high], [half_x, half_y]) = (self.map.range_m(), self.half_m().map(narrow));
        json!({
            "asset": { "version": "2.0", "generator": concat!("tyndall ", env!("CARGO_PKG_VERSION")) },
            "scene": 0,
            "scenes": [{ "nodes": [0] }],
            "nodes": [{ "mesh": 0, "name": "terrain" }],
            "meshes": [{ "primitives": [{
                "attributes": { "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2 }, "indices": 3,
            }] }],
            "buffers": [{ "byteLength": self.vertex_bytes() + self.index_bytes() }],
            "bufferViews": [
                { "buffer": 0, "byteLength": self.vertex_bytes(), "byteStride": VERTEX_BYTES, "target": 34962 },
                { "buffer": 0, "byteOffset": self.vertex_bytes(), "byteLength": self.index_bytes(), "target": 34963 },
            ],
            "accessors": [
                {
                    "bufferView": 0, "componentType": 5126, "type": "VEC3", "count": self.vertices(),
                    "min": [-half_x, low, -half_y], "max": [half_x, high, half_y],
                },
                { "bufferView": 0, "byteOffset": 12, "componentType": 5126, "type": "VEC3", "count": self.vertices() },
                { "bufferView": 0, "byteOffset": 24, "componentType": 5126, "type": "VEC2", "count": self.vertices() },
                { "bufferView": 1, "componentType": 5125, "type": "SCALAR", "count": self.indices() },
            ],
        })
    }

    /// Row after row from the south, each from the west.
    fn write_vertices(&self, target: &mut impl Write) -> io::Result<()> {
        let ([columns, rows], half_m) = (self.map.size_px, self.half_m());
        let width = columns as usize;
        for (y, (heights, normals)) in
            (0..rows).zip(self.map.heights_m.chunks_exact(width).zip(self.normals.chunks_exact(width)))
        {
            let mut row = Vec::with_capacity(width * 32);
            for (x, (height, [east, north, up])) in (0..columns).zip(heights.iter().zip(normals)) {
                let place = [f64::from(x) * self.map.pixel_m - half_m[0], half_m[1] - f64::from(y) * self.map.pixel_m];
                let texture = [share(x, columns), 1.0 - share(y, rows)];
                let [place, texture] = [place, texture].map(|pair| pair.map(narrow));
                for number in [place[0], *height, place[1], *east, *up, -north, texture[0], texture[1]] {
                    row.extend(number.to_le_bytes());
                }
            }
            target.write_all(&row)?;
        }
        Ok(())
    }

    /// Two triangles a cell, anticlockwise seen from above.
    fn write_indices(&self, target: &mut impl Write) -> io::Result<()> {
        let [columns, rows] = self.map.size_px;
        for y in 0..rows - 1 {
            let first = y * columns;
            let cell = |x: u32| {
                let [a, b] = [first + x, first + columns + x];
                [a, a + 1, b, a + 1, b + 1, b]
            };
            let row: Vec<u8> = (0..columns - 1).flat_map(cell).flat_map(u32::to_le_bytes).collect();
            target.write_all(&row)?;
        }
        Ok(())
    }
}

/// Place of a sample along a side, 0 to 1.
fn share(index: u32, count: u32) -> f64 {
    f64::from(index) / f64::from(count - 1)
}

#[expect(clippy::cast_possible_truncation, reason = "meshes are f32")]
fn narrow(value: f64) -> f32 {
    value as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers<const N: usize>(bytes: &[u8]) -> Vec<[u8; N]> {
        bytes.as_chunks::<N>().0.to_vec()
    }

    #[test]
    fn the_mesh_has_every_height_at_its_place_and_triangles_that_face_up() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.glb");
        let map = HeightMap { size_px: [3, 2], pixel_m: 2.0, heights_m: vec![0.0, 1.0, 0.5, 3.0, 2.0, -1.0] };
        write_glb(&path, &map, &[[0.0, 0.6, 0.8]; 6]).unwrap();
        let bytes = std::fs::read(&path).unwrap();
        let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!((&bytes[..4], word(4), word(8)), (&b"glTF"[..], 2, bytes.len()), "header");
        let text: serde_json::Value = serde_json::from_slice(&bytes[20..20 + word(12)]).unwrap();
        let body = &bytes[20 + word(12) + 8..];
        assert_eq!(word(20 + word(12)), body.len(), "the numbers fill the file");
        assert_eq!(text["accessors"][0]["min"], json!([-2.0, -1.0, -1.0]), "{text}");
        let floats: Vec<f32> = numbers::<4>(&body[..6 * 32]).into_iter().map(f32::from_le_bytes).collect();
        let vertices: Vec<&[f32]> = floats.chunks_exact(8).collect();
        assert_eq!(vertices[0], [-2.0, 0.0, 1.0, 0.0, 0.8, -0.6, 0.0, 1.0], "the south-western corner, z to the south");
        assert_eq!(vertices[4][..3], [0.0, 2.0, -1.0], "middle of the northern row");
        let indices: Vec<u32> = numbers::<4>(&body[6 * 32..]).into_iter().map(u32::from_le_bytes).collect();
        assert_eq!(indices.len(), 2 * 2 * 3, "two triangles a cell");
        for triangle in indices.chunks_exact(3) {
            let [a, b, c] = [0, 1, 2].map(|corner| vertices[triangle[corner] as usize]);
            // The y of (b - a) x (c - a).
            let up = (b[2] - a[2]) * (c[0] - a[0]) - (b[0] - a[0]) * (c[2] - a[2]);
            assert!(up > 0.0, "{triangle:?} faces up");
        }
    }

    #[test]
    fn a_line_of_samples_makes_no_mesh() {
        let folder = tempfile::tempdir().unwrap();
        let map = HeightMap { size_px: [1, 3], pixel_m: 1.0, heights_m: vec![0.0; 3] };
        let error = write_glb(&folder.path().join("a.glb"), &map, &[[0.0, 0.0, 1.0]; 3]).unwrap_err();
        assert!(error.to_string().contains("1 x 3 samples make no mesh"), "{error}");
    }
}

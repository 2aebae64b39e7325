//! Files read back by a reader of their own, which knows the layout and nothing of the writer.

use std::fs;

use half::f16;

use super::*;

/// Reads one file from front to back.
struct Reader<'a> {
    bytes: &'a [u8],
    place: usize,
}

/// What a reader finds of a grid.
#[derive(Debug)]
struct Found {
    name: String,
    kind: String,
    metadata: Vec<(String, Vec<u8>)>,
    /// Shift, then scale (m).
    transform: [f64; 6],
    /// Active cells and their values.
    cells: Vec<([usize; 3], f32)>,
    leaves: usize,
}

impl<'a> Reader<'a> {
    fn take(&mut self, count: usize) -> &'a [u8] {
        self.place += count;
        &self.bytes[self.place - count..self.place]
    }

    fn u32(&mut self) -> u32 {
        u32::from_le_bytes(self.take(4).try_into().unwrap())
    }

    fn u64(&mut self) -> u64 {
        u64::from_le_bytes(self.take(8).try_into().unwrap())
    }

    fn f64(&mut self) -> f64 {
        f64::from_bits(self.u64())
    }

    fn text(&mut self) -> String {
        let length = self.u32() as usize;
        String::from_utf8(self.take(length).to_vec()).unwrap()
    }

    fn metadata(&mut self) -> Vec<(String, Vec<u8>)> {
        let entry = |reader: &mut Self| {
            let (name, _kind, length) = (reader.text(), reader.text(), reader.u32() as usize);
            (name, reader.take(length).to_vec())
        };
        (0..self.u32()).map(|_| entry(self)).collect()
    }

    /// Numbers of the set bits.
    fn mask(&mut self, bits: usize) -> Vec<usize> {
        let bytes = self.take(bits / 8);
        (0..bits).filter(|bit| (bytes[bit / 8] >> (bit % 8)) & 1 == 1).collect()
    }

    /// Values of a block of `count`, `active` of which are active.
    fn values(&mut self, count: usize, active: usize, flags: u32, half: bool) -> Vec<f32> {
        let stored = match self.take(1)[0] {
            0 => active,
            6 => count,
            other => panic!("way {other} of storing values"),
        };
        let size = if half { 2 } else { 4 };
        let raw = if flags & 1 == 0 {
            self.take(stored * size).to_vec()
        } else {
            let length = i64::from_le_bytes(self.take(8).try_into().unwrap());
            let bytes = self.take(usize::try_from(length.abs()).unwrap());
            if length > 0 { inflate(bytes) } else { bytes.to_vec() }
        };
        assert_eq!(raw.len(), stored * size, "as many values as the mask says");
        if half {
            raw.as_chunks().0.iter().map(|bytes| f16::from_le_bytes(*bytes).to_f32()).collect()
        } else {
            raw.as_chunks().0.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect()
        }
    }
}

fn inflate(bytes: &[u8]) -> Vec<u8> {
    let mut inflated = Vec::new();
    io::Read::read_to_end(&mut flate2::read::ZlibDecoder::new(bytes), &mut inflated).unwrap();
    inflated
}

/// Place of child `number` in a block of 2^`log2` children a side of `side` cells each.
fn child(origin: [usize; 3], number: usize, log2: u32, side: usize) -> [usize; 3] {
    let mask = (1 << log2) - 1;
    let [x, y, z] = [number >> (2 * log2), (number >> log2) & mask, number & mask];
    [origin[0] + x * side, origin[1] + y * side, origin[2] + z * side]
}

fn read(bytes: &[u8]) -> Vec<Found> {
    let mut reader = Reader { bytes, place: 0 };
    assert_eq!(reader.take(8), b" BDV\0\0\0\0", "the first bytes of every VDB file");
    assert_eq!(reader.u32(), 224, "version of the layout");
    reader.take(8);
    assert_eq!(reader.take(1), [1], "with offsets");
    let identifier = String::from_utf8(reader.take(36).to_vec()).unwrap();
    assert!(identifier.bytes().filter(|byte| *byte == b'-').count() == 4, "{identifier}");
    assert!(reader.metadata().is_empty(), "nothing about the file");
    (0..reader.u32()).map(|_| read_grid(&mut reader)).collect()
}

fn read_grid(reader: &mut Reader<'_>) -> Found {
    let (name, kind, parent) = (reader.text(), reader.text(), reader.text());
    assert_eq!(parent, "", "no instance of another grid");
    let [start, blocks, end] = [reader.u64(), reader.u64(), reader.u64()].map(|place| usize::try_from(place).unwrap());
    assert_eq!(reader.place, start, "the grid follows its descriptor");
    let flags = reader.u32();
    let metadata = reader.metadata();
    assert_eq!(reader.text(), "UniformScaleTranslateMap", "kind of the transform");
    let transform = [(); 6].map(|()| reader.f64());
    reader.take(12 * 8);
    let half = kind.ends_with("_HalfFloat");
    assert_eq!([reader.u32(), reader.u32(), reader.u32()], [1, 0, 0], "one buffer, background 0, no tiles");
    let leaves = read_topology(reader, flags, half);
    assert_eq!(reader.place, blocks, "values where the descriptor says");
    let mut cells = Vec::new();
    for (origin, on) in &leaves {
        assert_eq!(reader.mask(512), *on, "the same mask before the values");
        let values = reader.values(512, on.len(), flags, half);
        cells.extend(on.iter().zip(values).map(|(number, value)| (child(*origin, *number, 3, 1), value)));
    }
    assert_eq!(reader.place, end, "the end where the descriptor says");
    Found { name, kind, metadata, transform, cells, leaves: leaves.len() }
}

fn read_topology(reader: &mut Reader<'_>, flags: u32, half: bool) -> Vec<([usize; 3], Vec<usize>)> {
    let mut leaves = Vec::new();
    for _ in 0..reader.u32() {
        let top = [(); 3].map(|()| reader.u32() as usize);
        for middle in read_branch(reader, 5, flags, half) {
            let middle = child(top, middle, 5, 128);
            for leaf in read_branch(reader, 4, flags, half) {
                leaves.push((child(middle, leaf, 4, 8), reader.mask(512)));
            }
        }
    }
    leaves
}

/// Numbers of a block's children.
fn read_branch(reader: &mut Reader<'_>, log2: u32, flags: u32, half: bool) -> Vec<usize> {
    let count = 1 << (3 * log2);
    let children = reader.mask(count);
    assert!(reader.mask(count).is_empty(), "no tile is active");
    assert!(reader.values(count, 0, flags, half).iter().all(|value| value.to_bits() == 0), "all are background");
    children
}

/// A cloud in a grid that reaches into several blocks of every size and fills none.
fn cloud() -> Grid3<f32> {
    let size = [4103, 19, 13];
    let mut grid = Grid3::filled(size, 0.0);
    for (x, y, z) in
        [(0, 0, 0), (7, 18, 12), (8, 7, 8), (127, 3, 4), (128, 3, 4), (4095, 9, 9), (4096, 9, 9), (4102, 18, 0)]
    {
        grid[[x, y, z]] = 0.01 + (x + 3 * y + 5 * z) as f32 / 700.0;
    }
    // A block in which all cells are active.
    for number in 0..512 {
        let [x, y, z] = child([1600, 8, 0], number, 3, 1);
        grid[[x, y, z]] = 1.0 + number as f32;
    }
    grid
}

fn written(values: &Grid3<f32>, options: VdbOptions) -> (Vec<u8>, VdbReport) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cloud.vdb");
    let grid = VdbGrid { name: "density", values, cell_m: 25.0, low_corner_m: [-100.0, 50.0, 1200.0] };
    let report = write_vdb(&path, &[grid], options).unwrap();
    (fs::read(&path).unwrap(), report)
}

/// The active cells of a grid, sorted.
fn active(values: &Grid3<f32>) -> Vec<([usize; 3], f32)> {
    let [nx, ny, _] = values.size();
    let cells = values.cells().iter().enumerate().filter(|(_, value)| **value > 0.0);
    let mut cells: Vec<_> = cells.map(|(i, value)| ([i % nx, i / nx % ny, i / (nx * ny)], *value)).collect();
    cells.sort_by_key(|(cell, _)| *cell);
    cells
}

#[test]
fn every_cell_comes_back_with_its_value_and_its_place_packed_or_not() {
    let values = cloud();
    for packing in [VdbPacking::Plain, VdbPacking::Zip] {
        let (bytes, report) = written(&values, VdbOptions { half: false, packing });
        let found = read(&bytes);
        let mut cells = found[0].cells.clone();
        cells.sort_by_key(|(cell, _)| *cell);
        assert_eq!(cells, active(&values), "{packing:?}");
        assert_eq!((report.active_cells, report.blocks), (520, found[0].leaves as u64), "{packing:?}");
        assert_eq!(report.bytes, bytes.len() as u64, "{packing:?}");
        assert_eq!((found[0].name.as_str(), found[0].kind.as_str()), ("density", "Tree_float_5_4_3"), "{packing:?}");
        let transform = found[0].transform.map(|number| number.to_string()).join(" ");
        assert_eq!(transform, "-87.5 62.5 1212.5 25 25 25", "centre of the first cell, then scale");
    }
}

#[test]
fn half_floats_keep_three_digits_in_half_of_the_bytes() {
    let values = cloud();
    for packing in [VdbPacking::Plain, VdbPacking::Zip] {
        let found = &read(&written(&values, VdbOptions { half: true, packing }).0)[0];
        assert_eq!(found.kind, "Tree_float_5_4_3_HalfFloat", "{packing:?}");
        let mut cells = found.cells.clone();
        cells.sort_by_key(|(cell, _)| *cell);
        for ((cell, half), (expected, float)) in cells.into_iter().zip(active(&values)) {
            assert_eq!(cell, expected, "{packing:?}");
            assert!((half / float - 1.0).abs() < 4.9e-4, "{packing:?}: {half} for {float}");
        }
    }
    let dense = Grid3::filled([64, 64, 64], 0.04);
    let [float, half] = [false, true].map(|half| written(&dense, VdbOptions { half, ..VdbOptions::default() }).0.len());
    assert!((2 * half).abs_diff(float) < float / 8, "{half} bytes in place of {float}");
}

#[test]
fn blocks_without_cloud_are_not_written() {
    let (bytes, report) = written(&cloud(), VdbOptions::default());
    assert_eq!(report.blocks, 9, "seven blocks with a cell or two, one full, of 513 x 3 x 2");
    assert!(bytes.len() < 60_000, "{} bytes for a grid of 4 MB", bytes.len());
    let (_, empty) = written(&Grid3::filled([33, 33, 33], 0.0), VdbOptions::default());
    assert_eq!((empty.active_cells, empty.blocks), (0, 0), "a clear sky is a file all the same");
}

#[test]
fn deflated_files_are_smaller_and_equal_grids_make_equal_files() {
    let dense = Grid3::filled([64, 64, 64], 0.04);
    let [plain, zip] =
        [VdbPacking::Plain, VdbPacking::Zip].map(|packing| written(&dense, VdbOptions { half: false, packing }).0);
    assert!(4 * zip.len() < plain.len(), "{} and {} bytes", zip.len(), plain.len());
    assert!(plain == written(&dense, VdbOptions::default()).0, "byte for byte");
    let mut other = dense;
    other[[1, 2, 3]] = 0.05;
    assert!(plain[21..57] != written(&other, VdbOptions::default()).0[21..57], "other cells, another identifier");
}

#[test]
fn the_grid_says_that_it_is_a_fog_volume_and_where_its_cloud_is() {
    let found = &read(&written(&cloud(), VdbOptions::default()).0)[0];
    let entry = |name: &str| &found.metadata.iter().find(|(known, _)| known == name).expect(name).1[..];
    assert_eq!(entry("class"), b"fog volume", "drawn as a volume");
    assert_eq!(entry("file_voxel_count"), 520_u64.to_le_bytes(), "active cells");
    let numbers =
        |name: &str| -> Vec<u32> { entry(name).as_chunks().0.iter().map(|b| u32::from_le_bytes(*b)).collect() };
    assert_eq!([numbers("file_bbox_min"), numbers("file_bbox_max")], [vec![0, 0, 0], vec![4102, 18, 12]], "bounds");
}

#[test]
fn what_no_volume_holds_is_refused_with_the_cell() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.vdb");
    let refused = |value: f32, half: bool, cell_m: f64| {
        let mut values = Grid3::filled([3, 4, 5], 0.0);
        values[[2, 1, 4]] = value;
        let grid = VdbGrid { name: "density", values: &values, cell_m, low_corner_m: [0.0; 3] };
        write_vdb(&path, &[grid], VdbOptions { half, ..VdbOptions::default() }).unwrap_err().to_string()
    };
    assert!(refused(f32::NAN, false, 1.0).contains("grid `density`: cell [2, 1, 4] is NaN; 0 to"), "NaN");
    assert!(refused(-1.0, false, 1.0).contains("cell [2, 1, 4] is -1"), "negative");
    assert!(refused(7e4, true, 1.0).contains("cell [2, 1, 4] is 70000; 0 to 65504"), "beyond half floats");
    assert!(refused(1.0, false, 0.0).contains("the side of a cell is 0 m"), "no size");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "nothing was left behind");
}

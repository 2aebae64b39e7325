//! Clouds of a file: a grid of any program, or a list of metaballs.

use std::path::PathBuf;
use std::time::SystemTime;

use tyndall_clouds::grid_size::{MAX_BALL_CELLS, MAX_BALL_SIDE_CELLS};
use tyndall_clouds::matter::centred;
use tyndall_clouds::{
    BallGrid, CloudGridParams, CloudMatter, CloudMatterParams, Edges, Metaball, Metaballs, density_from_array,
    density_from_arrays,
};
use tyndall_core::grid::Grid3;
use tyndall_core::metaball::BALL_MASS;
use tyndall_io::{IoError, read_npy, read_npz};
use tyndall_scene::{CloudFileHolds, CloudsParams, Scene};

/// Endings that are read.
const ENDINGS: &str = ".npz, .npy, .csv and .json";
/// Most bytes of a list of balls: some 10 million of them.
const MOST_LIST_BYTES: u64 = 1 << 29;

/// Why clouds could not be taken from a file.
#[derive(Debug, thiserror::Error)]
pub enum CloudFileError {
    /// No file was named.
    #[error(
        "clouds.kind is file, and clouds.file is empty; name a grid (.npz, .npy) or a list of metaballs (.csv, .json)"
    )]
    Unnamed,
    /// The file cannot be read; the message names it.
    #[error(transparent)]
    Io(Box<IoError>),
    /// The file has something that cannot be drawn.
    #[error("{}: {problem}", .path.display())]
    Refused {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        problem: String,
    },
}

/// Everything that the clouds of a file follow from.
#[derive(Clone, Debug, PartialEq)]
pub struct CloudFileRequest {
    path: PathBuf,
    /// Length (bytes) and time of the last change, to notice another file of the same name.
    version: Option<(u64, SystemTime)>,
    drawn: CloudsParams,
    grid: CloudGridParams,
    matter: CloudMatterParams,
}

impl CloudFileRequest {
    /// Of a scene whose clouds come from a file.
    pub(super) fn of(scene: &Scene) -> Self {
        let path = scene.cloud_file();
        let version = std::fs::metadata(&path).and_then(|data| Ok((data.len(), data.modified()?))).ok();
        // What is drawn differently is the same cloud.
        let CloudsParams { file, array, file_holds, file_ball_place, file_samples, .. } = scene.clouds.clone();
        let drawn = CloudsParams { file, array, file_holds, file_ball_place, file_samples, ..CloudsParams::default() };
        Self { path, version, drawn, grid: scene.cloud_grid.clone(), matter: scene.cloud_matter.clone() }
    }

    /// Reads the file.
    pub(super) fn read(&self) -> Result<CloudMatter, CloudFileError> {
        if self.drawn.file.is_empty() {
            return Err(CloudFileError::Unnamed);
        }
        let ending = self.path.extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_lowercase();
        match ending.as_str() {
            "npz" | "npy" => self.of_grid(self.grid(&ending)?),
            "csv" => self.of_list(Metaballs::from_csv(&self.text()?)),
            "json" => self.of_list(Metaballs::from_json(&self.text()?)),
            _ => Err(self.refused(format!("its name must end in one of {ENDINGS}"))),
        }
    }

    fn grid(&self, ending: &str) -> Result<Grid3<f32>, CloudFileError> {
        let name = Some(self.drawn.array.as_str()).filter(|name| !name.is_empty());
        let file = |error: IoError| CloudFileError::Io(Box::new(error));
        let read = if ending == "npz" {
            density_from_arrays(&read_npz(&self.path).map_err(file)?, name)
        } else {
            density_from_array(name.unwrap_or("of the file"), &read_npy(&self.path).map_err(file)?)
        };
        let grid = read.map_err(|problem| self.refused(problem.to_string()))?;
        let size = grid.size();
        if size.contains(&0)
            || size.iter().any(|side| *side > MAX_BALL_SIDE_CELLS)
            || grid.cells().len() > MAX_BALL_CELLS
        {
            let [x, y, z] = size;
            return Err(self.refused(format!(
                "{x} x {y} x {z} cells; 1 to {MAX_BALL_SIDE_CELLS} along each axis and {MAX_BALL_CELLS} in all are allowed"
            )));
        }
        Ok(grid)
    }

    fn text(&self) -> Result<String, CloudFileError> {
        if self.version.is_some_and(|(bytes, _)| bytes > MOST_LIST_BYTES) {
            return Err(self.refused(format!("a list of balls may have {MOST_LIST_BYTES} bytes")));
        }
        std::fs::read_to_string(&self.path).map_err(|error| self.refused(format!("cannot be read: {error}")))
    }

    fn of_grid(&self, mut values: Grid3<f32>) -> Result<CloudMatter, CloudFileError> {
        let (matter, edges) = (&self.matter, self.grid.edges);
        let low_corner_m = centred(values.size(), self.grid.cell_m, self.grid.floor_m);
        if self.drawn.file_holds == CloudFileHolds::Balls {
            return self.of_lattice(&values, low_corner_m);
        }
        let scale = narrow(matter.extinction_per_m);
        values.cells_mut().iter_mut().for_each(|value| *value *= scale);
        let radius_m = matter.ball_radius_cells * self.grid.cell_m;
        self.checked(CloudMatter::of_density(values, self.grid.cell_m, low_corner_m, edges, radius_m))
    }

    /// One ball for each cell that is not zero, so strong that full balls all around add up to the extinction of the scene.
    fn of_lattice(&self, values: &Grid3<f32>, low_corner_m: [f64; 3]) -> Result<CloudMatter, CloudFileError> {
        let (cell_m, radius_cells) = (self.grid.cell_m, self.matter.ball_radius_cells);
        let peak_per_m = self.matter.extinction_per_m / (BALL_MASS * radius_cells.powi(3));
        let size = values.size();
        let samples = self.drawn.file_samples as usize;
        let grid = BallGrid {
            size: size.map(|side| side * samples),
            cell_m: cell_m / samples as f64,
            low_corner_m,
            edges: self.grid.edges,
        };
        if grid.size.iter().any(|side| *side > MAX_BALL_SIDE_CELLS)
            || grid.size.iter().product::<usize>() > MAX_BALL_CELLS
        {
            let [x, y, z] = grid.size;
            return Err(self.refused(format!(
                "{x} x {y} x {z} samples; {MAX_BALL_SIDE_CELLS} along each axis and {MAX_BALL_CELLS} in all are allowed: lower \
                 clouds.file_samples"
            )));
        }
        let place = |index: usize, axis: usize| {
            let cell = [index % size[0], index / size[0] % size[1], index / (size[0] * size[1])][axis];
            low_corner_m[axis] + (cell as f64 + self.drawn.file_ball_place) * cell_m
        };
        let filled = values.cells().iter().enumerate().filter(|(_, value)| **value > 0.0);
        let ball = |(index, value): (usize, &f32)| Metaball {
            centre_m: [0, 1, 2].map(|axis| narrow(place(index, axis))),
            radius_m: narrow(radius_cells * cell_m),
            extinction_per_m: narrow(peak_per_m) * value,
        };
        self.checked(CloudMatter::of_balls(Metaballs { balls: filled.map(ball).collect() }, &grid))
    }

    fn of_list(&self, list: Result<Metaballs, tyndall_clouds::CloudError>) -> Result<CloudMatter, CloudFileError> {
        let refused = |problem: tyndall_clouds::CloudError| self.refused(problem.to_string());
        let list = list.map_err(refused)?;
        let grid = BallGrid::around(&list, self.grid.cell_m).map_err(refused)?;
        self.checked(CloudMatter::of_balls(list, &BallGrid { edges: Edges::Open, ..grid }))
    }

    /// Numbers of a file may add up to more than a half float holds.
    fn checked(&self, matter: CloudMatter) -> Result<CloudMatter, CloudFileError> {
        let most = f64::from(half::f16::MAX);
        let found = matter.most_per_m();
        if found > most {
            return Err(self.refused(format!("its extinction reaches {found} 1/m; up to {most} 1/m is drawn")));
        }
        Ok(matter)
    }

    fn refused(&self, problem: String) -> CloudFileError {
        CloudFileError::Refused { path: self.path.clone(), problem }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "matter is stored in single precision")]
fn narrow(value: f64) -> f32 {
    value as f32
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use tyndall_core::array::{Array, ArrayData};
    use tyndall_io::{write_npy, write_npz};

    use super::*;

    /// A scene whose clouds come from a file in a folder.
    fn scene(folder: &Path, file: &str, changes: &[(&str, &str)]) -> Scene {
        let mut scene = Scene { folder: folder.to_owned().into(), ..Scene::default() };
        let fixed =
            [("clouds.kind", "file"), ("clouds.file", file), ("cloud_grid.cell_m", "20"), ("cloud_grid.edges", "open")];
        for (path, value) in fixed.iter().chain(changes) {
            scene.set_text(path, value).unwrap();
        }
        scene
    }

    fn read(folder: &Path, file: &str, changes: &[(&str, &str)]) -> Result<CloudMatter, String> {
        CloudFileRequest::of(&scene(folder, file, changes)).read().map_err(|error| error.to_string())
    }

    fn array(values: ArrayData) -> Array {
        Array::new(vec![2, 3, 4], values).unwrap()
    }

    #[test]
    fn bytes_are_shares_of_255_and_the_grid_is_centred_above_the_floor() {
        let folder = tempfile::tempdir().unwrap();
        let mut bytes = vec![0_u8; 24];
        (bytes[0], bytes[3]) = (255, 51);
        write_npy(&folder.path().join("a.npy"), &array(ArrayData::U8(bytes))).unwrap();
        let changes = [("cloud_matter.extinction_per_m", "0.05"), ("cloud_grid.floor_m", "700")];
        let matter = read(folder.path(), "a.npy", &changes).unwrap();
        let found = [matter.extinction_per_m[[0, 0, 0]], matter.extinction_per_m[[1, 1, 0]]];
        assert!((found[0] - 0.05).abs() < 1e-7 && (found[1] - 0.01).abs() < 1e-7, "{found:?}");
        assert_eq!((matter.low_corner_m, matter.extent_m()), ([-20.0, -30.0, 700.0], [40.0, 60.0, 80.0]));
    }

    #[test]
    fn a_grid_of_balls_is_the_sum_of_their_fields_at_any_number_of_samples() {
        let folder = tempfile::tempdir().unwrap();
        let mut values = vec![0.0_f32; 24];
        (values[5], values[14]) = (1.0, 0.25);
        let named = vec![
            ("noise".to_owned(), array(ArrayData::F32(vec![1.0; 24]))),
            ("q".to_owned(), array(ArrayData::F32(values))),
        ];
        write_npz(&folder.path().join("a.npz"), &named).unwrap();
        let balls = [("clouds.array", "q"), ("clouds.file_holds", "balls"), ("clouds.file_ball_place", "0.625")];
        for samples in ["1", "3"] {
            let matter =
                read(folder.path(), "a.npz", &[&balls[..], &[("clouds.file_samples", samples)]].concat()).unwrap();
            let list = matter.balls();
            assert_eq!(list.balls.len(), 2, "one for each cell that is not zero");
            // Cell [1, 2, 0] of a grid of 2 x 3 x 4 whose cells have 20 m.
            let first = Metaball { centre_m: [12.5, 22.5, 1012.5], ..list.balls[0] };
            assert_eq!(list.balls[0], first, "place in its cell");
            let full: f64 = list.balls[0].mass_m2() / 20.0_f64.powi(3);
            assert!((full - 0.07).abs() < 1e-6, "a full ball has the mass of a full cell: {full} 1/m");
            let cell = [1, 1, 1];
            let point = [0, 1, 2].map(|axis| matter.low_corner_m[axis] + (cell[axis] as f64 + 0.5) * matter.cell_m);
            let gap = f64::from(matter.extinction_per_m[cell]) - list.extinction_per_m(point);
            assert!(gap.abs() < 1e-8, "{samples} samples: {gap}");
        }
        let refused = read(folder.path(), "a.npz", &[]).unwrap_err();
        assert!(refused.contains("a.npz: array `density`: name one of the arrays"), "{refused}");
    }

    #[test]
    fn a_list_of_balls_makes_the_same_cloud_as_csv_and_as_json() {
        let folder = tempfile::tempdir().unwrap();
        let ball = |x: f32| Metaball { centre_m: [x, 2.0, 900.0], radius_m: 45.0, extinction_per_m: 0.03 };
        let list = Metaballs { balls: vec![ball(-10.0), ball(31.5)] };
        std::fs::write(folder.path().join("a.csv"), list.to_csv()).unwrap();
        std::fs::write(folder.path().join("a.json"), list.to_json()).unwrap();
        let [csv, json] = ["a.csv", "a.json"].map(|file| read(folder.path(), file, &[]).unwrap());
        assert_eq!(csv, json, "two forms of one list");
        assert_eq!((csv.balls(), csv.cell_m), (list, 20.0), "as it was written");
    }

    #[test]
    fn bad_files_are_refused_with_their_name_and_the_reason() {
        let folder = tempfile::tempdir().unwrap();
        let flat = Array::new(vec![6, 4], ArrayData::U8(vec![0; 24])).unwrap();
        write_npy(&folder.path().join("flat.npy"), &flat).unwrap();
        let mut values = vec![0.0_f32; 24];
        values[7] = f32::NAN;
        write_npy(&folder.path().join("nan.npy"), &array(ArrayData::F32(values.clone()))).unwrap();
        values[7] = -0.5;
        write_npy(&folder.path().join("negative.npy"), &array(ArrayData::F32(values.clone()))).unwrap();
        values[7] = 1e7;
        write_npy(&folder.path().join("dense.npy"), &array(ArrayData::F32(values))).unwrap();
        write_npy(&folder.path().join("whole.npy"), &array(ArrayData::U32(vec![1; 24]))).unwrap();
        std::fs::write(folder.path().join("text.npz"), "no zip").unwrap();
        std::fs::write(folder.path().join("empty.csv"), "x_m,y_m,z_m,radius_m,extinction_per_m\n").unwrap();
        std::fs::write(folder.path().join("short.csv"), "1,2,3\n").unwrap();
        for (file, reason) in [
            ("flat.npy", "its shape is [6, 4]; three dimensions are needed"),
            ("nan.npy", "NaN is no density; 0 and more is allowed"),
            ("negative.npy", "-0.5 is no density; 0 and more is allowed"),
            ("dense.npy", "its extinction reaches 700000"),
            ("whole.npy", "whole numbers of 32 or 64 bits are no density"),
            ("text.npz", "this is no NPZ file"),
            ("empty.csv", "the list of metaballs is empty"),
            ("short.csv", "line 1: 3 values in place of the five"),
            ("cloud.vdb", "its name must end in one of .npz, .npy, .csv and .json"),
            ("absent.csv", "cannot be read"),
        ] {
            let refused = read(folder.path(), file, &[]).unwrap_err();
            let name = folder.path().join(file).display().to_string();
            assert!(refused.contains(&name) && refused.contains(reason), "{refused}");
        }
        let refused = read(folder.path(), "", &[]).unwrap_err();
        assert!(refused.contains("clouds.file is empty"), "{refused}");
    }
}

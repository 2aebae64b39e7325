//! Files of arrays: NPY with one, NPZ with several by name, as `NumPy` reads and writes them.

use std::fs::File;
use std::io::{self, BufReader};
use std::path::Path;

use tyndall_core::array::{Array, NamedArrays};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive, ZipWriter};

use crate::atomic::write_atomically;
use crate::npy::{read_array, write_array};
use crate::{Destination, IoError};

/// Ending of the arrays' names within the file.
const MEMBER_SUFFIX: &str = ".npy";

/// Writes arrays by name, compressed; the file appears complete or not at all. Equal arrays make equal files.
///
/// # Errors
/// When the folder or the disk refuses, or when cancelled.
pub fn write_npz<'a>(destination: impl Into<Destination<'a>>, arrays: &NamedArrays) -> Result<(), IoError> {
    write_atomically(destination, |file| {
        let mut zip = ZipWriter::new(file);
        // The time of 1980 in every file; members above 4 GiB need the large form.
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .compression_level(Some(3))
            .last_modified_time(zip::DateTime::default())
            .large_file(true);
        for (name, array) in arrays {
            zip.start_file(format!("{name}{MEMBER_SUFFIX}"), options).map_err(io::Error::other)?;
            write_array(&mut zip, array)?;
        }
        zip.finish().map_err(io::Error::other).map(drop)
    })
}

/// Writes one array.
///
/// # Errors
/// As for [`write_npz`].
pub fn write_npy<'a>(destination: impl Into<Destination<'a>>, array: &Array) -> Result<(), IoError> {
    write_atomically(destination, |file| write_array(file, array))
}

/// Reads all arrays of an NPZ file.
///
/// # Errors
/// When the file cannot be opened, is no such file, or an array of it cannot be read.
pub fn read_npz(path: impl AsRef<Path>) -> Result<NamedArrays, IoError> {
    let path = path.as_ref();
    let wrong = |problem: String| IoError::Format { path: path.to_path_buf(), problem };
    let mut zip = ZipArchive::new(open(path)?).map_err(|error| wrong(format!("this is no NPZ file: {error}")))?;
    let mut arrays = NamedArrays::new();
    for index in 0..zip.len() {
        let mut member = zip.by_index(index).map_err(|error| wrong(error.to_string()))?;
        let Some(name) = member.name().ok().and_then(|name| name.strip_suffix(MEMBER_SUFFIX).map(str::to_owned)) else {
            continue;
        };
        let array = read_array(&mut member).map_err(|problem| wrong(format!("array `{name}`: {problem}")))?;
        arrays.push((name, array));
    }
    Ok(arrays)
}

/// Reads the array of an NPY file.
///
/// # Errors
/// When the file cannot be opened, or the array cannot be read.
pub fn read_npy(path: impl AsRef<Path>) -> Result<Array, IoError> {
    let path = path.as_ref();
    read_array(&mut open(path)?).map_err(|problem| IoError::Format { path: path.to_path_buf(), problem })
}

fn open(path: &Path) -> Result<BufReader<File>, IoError> {
    let file = File::open(path).map_err(|source| IoError::Read { path: path.to_path_buf(), source })?;
    Ok(BufReader::new(file))
}

#[cfg(test)]
mod tests {
    use tyndall_core::array::ArrayData;

    use super::*;

    fn arrays() -> NamedArrays {
        let cells =
            Array::new(vec![30, 20, 10], ArrayData::U8((0..6000_u32).map(|i| (i % 7) as u8).collect())).unwrap();
        let step = Array::new(vec![], ArrayData::U64(vec![123])).unwrap();
        vec![("cells".to_owned(), cells), ("step".to_owned(), step)]
    }

    #[test]
    fn arrays_come_back_by_name_and_equal_arrays_make_equal_files() {
        let folder = tempfile::tempdir().unwrap();
        let [first, second] = ["a.npz", "b.npz"].map(|name| folder.path().join(name));
        write_npz(&first, &arrays()).unwrap();
        write_npz(&second, &arrays()).unwrap();
        assert_eq!(read_npz(&first).unwrap(), arrays(), "all of them");
        let bytes = std::fs::read(&first).unwrap();
        assert_eq!(bytes, std::fs::read(&second).unwrap(), "byte for byte");
        assert!(bytes.len() < 3000, "compressed: {} bytes", bytes.len());
    }

    #[test]
    fn one_array_comes_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.npy");
        write_npy(&path, &arrays()[0].1).unwrap();
        assert_eq!(read_npy(&path).unwrap(), arrays()[0].1, "the array");
    }

    #[test]
    fn files_of_other_kinds_are_refused_with_their_name() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.npz");
        std::fs::write(&path, "no arrays here").unwrap();
        for error in [read_npz(&path).unwrap_err(), read_npy(&path).unwrap_err()] {
            let text = error.to_string();
            assert!(text.contains("a.npz") && text.contains("this is no NP"), "{text}");
        }
        assert!(read_npz(folder.path().join("none.npz")).unwrap_err().to_string().contains("none.npz"), "missing");
    }
}

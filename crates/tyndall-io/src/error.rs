//! Why a file was not written or read, and what to do about it.

use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use crate::picture::{MAX_PIXELS, MAX_SIDE_PX};

/// Everything that can go wrong with a file.
#[derive(Debug, thiserror::Error)]
pub enum IoError {
    /// The folder of the destination does not exist.
    #[error(
        "cannot write {}: the folder {} does not exist; create it or choose another",
        .path.display(), .folder.display()
    )]
    MissingFolder {
        /// The destination.
        path: PathBuf,
        /// Its folder.
        folder: PathBuf,
    },
    /// A part of the destination's path is a file where a folder is needed.
    #[error("cannot write {}: {} is not a folder; choose another place", .path.display(), .folder.display())]
    NotAFolder {
        /// The destination.
        path: PathBuf,
        /// Its supposed folder.
        folder: PathBuf,
    },
    /// The destination is a folder.
    #[error("cannot write {}: it is a folder; add a file name", .path.display())]
    IsFolder {
        /// The destination.
        path: PathBuf,
    },
    /// The destination is a device, a pipe or a socket, which a rename would replace.
    #[error("cannot write {}: it is not a regular file; choose a file name in a folder", .path.display())]
    NotAFile {
        /// The destination.
        path: PathBuf,
    },
    /// The folder is read-only for this user, or the whole file system is.
    #[error(
        "cannot write {}: no permission to write in {}; change its rights or choose another folder",
        .path.display(), .folder.display()
    )]
    NotWritable {
        /// The destination.
        path: PathBuf,
        /// Its folder.
        folder: PathBuf,
    },
    /// No space, or the user's quota is used up.
    #[error("cannot write {}: the disk is full; free some space or choose another folder", .path.display())]
    DiskFull {
        /// The destination.
        path: PathBuf,
    },
    /// The cancel flag was set while the file was being written; nothing was left behind.
    #[error("writing {} was cancelled; nothing was left behind", .path.display())]
    Cancelled {
        /// The destination.
        path: PathBuf,
    },
    /// Any other failure of the operating system while writing.
    #[error("cannot write {}: {source}", .path.display())]
    Write {
        /// The destination.
        path: PathBuf,
        /// What the operating system said.
        source: io::Error,
    },
    /// The file could not be opened or read.
    #[error("cannot read {}: {source}", .path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        source: io::Error,
    },
    /// The file was read, but is no picture that this crate understands.
    #[error("cannot read {}: {problem}", .path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        problem: String,
    },
    /// A pixel is NaN or infinite; such values spread through every filter of every other program.
    #[error(
        "cannot write {}: channel {channel} of pixel ({x_px}, {y_px}) is {value}; the first of {count} such values",
        .path.display()
    )]
    NotFinite {
        /// The destination.
        path: PathBuf,
        /// R, G, B, A or Z.
        channel: char,
        /// Column from the left.
        x_px: u32,
        /// Row from the top.
        y_px: u32,
        /// The offending value.
        value: f32,
        /// How many values of the picture are NaN or infinite.
        count: usize,
    },
    /// A list of samples does not have one entry for each pixel.
    #[error("{what} has {found} entries, but a picture of {} x {} pixels needs {expected}", .size_px[0], .size_px[1])]
    WrongLength {
        /// Which list.
        what: &'static str,
        /// Width and height.
        size_px: [u32; 2],
        /// Width times height.
        expected: usize,
        /// The length of the list.
        found: usize,
    },
    /// A picture without pixels, or with more than this crate takes.
    #[error(
        "a picture of {} x {} pixels is outside 1 x 1 to {MAX_SIDE_PX} pixels a side and {MAX_PIXELS} pixels in all",
        .size_px[0], .size_px[1]
    )]
    Size {
        /// Width and height.
        size_px: [u32; 2],
    },
    /// A grid that no volume file can hold.
    #[error("cannot write {}: grid `{grid}`: {problem}", .path.display())]
    Volume {
        /// The destination.
        path: PathBuf,
        /// Name of the grid.
        grid: String,
        /// What is wrong with it.
        problem: String,
    },
    /// A metadata entry that no file can hold.
    #[error("metadata entry {name:?} cannot be written: {problem}")]
    Metadata {
        /// Its name.
        name: String,
        /// What is wrong with it.
        problem: String,
    },
}

impl IoError {
    /// The failure `source` of writing to `path`, sorted by what its user can do about it.
    #[must_use]
    pub fn from_write(path: &Path, source: io::Error) -> Self {
        let path = path.to_path_buf();
        let folder = crate::atomic::folder_of(&path).to_path_buf();
        match source.kind() {
            ErrorKind::NotFound => Self::MissingFolder { path, folder },
            ErrorKind::NotADirectory => Self::NotAFolder { path, folder },
            ErrorKind::IsADirectory => Self::IsFolder { path },
            ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => Self::NotWritable { path, folder },
            ErrorKind::StorageFull | ErrorKind::QuotaExceeded => Self::DiskFull { path },
            _ => Self::Write { path, source },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_failure_of_the_system_says_what_to_do() {
        for (kind, advice) in [
            (ErrorKind::NotFound, "create it"),
            (ErrorKind::NotADirectory, "choose another place"),
            (ErrorKind::IsADirectory, "add a file name"),
            (ErrorKind::PermissionDenied, "change its rights"),
            (ErrorKind::ReadOnlyFilesystem, "change its rights"),
            (ErrorKind::StorageFull, "free some space"),
            (ErrorKind::QuotaExceeded, "free some space"),
        ] {
            let text = IoError::from_write(Path::new("out/sky.exr"), kind.into()).to_string();
            assert!(text.contains("out/sky.exr") && text.contains(advice), "{kind:?}: {text}");
        }
    }
}

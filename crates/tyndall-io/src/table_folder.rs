//! Tables kept in a folder of the user's cache.
//!
//! A file a table, named by the hash of its key: a line that says what it is, the hash of its bytes, the bytes. What is
//! damaged, cut off or of another version counts as absent. Files appear complete or not at all, so that any number of
//! processes may share the folder; when it grows beyond its bound, those go that were not used for the longest time.

use std::fs::{self, File};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use directories::ProjectDirs;
use tyndall_core::table_store::TableStore;

use crate::atomic::write_atomically;

/// First line of every file.
const HEAD: &[u8] = b"tyndall table 1\n";

/// Bytes of a hash.
const HASH_BYTES: usize = 32;

/// Ending of the files.
const ENDING: &str = "table";

/// Environment variable that names the folder.
pub const CACHE_VARIABLE: &str = "TYNDALL_CACHE_DIR";

/// Most bytes of all tables together, unless said otherwise: about a hundred tables of the sky.
const MAX_BYTES: u64 = 64 << 20;

/// A folder of tables.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TableFolder {
    folder: PathBuf,
    max_bytes: u64,
}

impl TableFolder {
    /// The folder at a path; it is made when something is kept in it.
    #[must_use]
    pub fn new(folder: impl Into<PathBuf>) -> Self {
        Self { folder: folder.into(), max_bytes: MAX_BYTES }
    }

    /// The folder that [`CACHE_VARIABLE`] names, or the program's own in the user's cache; `None` without a home.
    #[must_use]
    pub fn of_user() -> Option<Self> {
        let named = std::env::var_os(CACHE_VARIABLE).filter(|folder| !folder.is_empty()).map(PathBuf::from);
        named.or_else(|| Some(ProjectDirs::from("", "", "tyndall")?.cache_dir().to_path_buf())).map(Self::new)
    }

    /// The same folder with another bound on the bytes of all its tables.
    #[must_use]
    pub fn bounded(self, max_bytes: u64) -> Self {
        Self { max_bytes, ..self }
    }

    /// Where the tables lie.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.folder
    }

    fn file(&self, key: &str) -> PathBuf {
        self.folder.join(format!("{:.32}.{ENDING}", blake3::hash(key.as_bytes()).to_hex()))
    }

    /// Removes what was not used for the longest time until the rest is within the bound.
    fn tidy(&self) {
        let Ok(entries) = fs::read_dir(&self.folder) else { return };
        let table = |entry: fs::DirEntry| {
            let path = entry.path();
            let data = entry.metadata().ok().filter(|_| path.extension().is_some_and(|ending| ending == ENDING))?;
            Some((data.modified().ok()?, data.len(), path))
        };
        let mut tables: Vec<_> = entries.flatten().filter_map(table).collect();
        tables.sort();
        let mut bytes: u64 = tables.iter().map(|(_, bytes, _)| bytes).sum();
        for (_, file_bytes, path) in tables {
            if bytes <= self.max_bytes {
                break;
            }
            // Another process may have removed it already.
            let _ = fs::remove_file(path);
            bytes -= file_bytes;
        }
    }
}

impl TableStore for TableFolder {
    fn load(&self, key: &str) -> Option<Vec<u8>> {
        let path = self.file(key);
        let mut bytes = fs::read(&path).ok()?;
        let (head, table) = bytes.split_at_checked(HEAD.len() + 2 * HASH_BYTES)?;
        if head != heading(key, table) {
            return None;
        }
        bytes.drain(..HEAD.len() + 2 * HASH_BYTES);
        // Used just now; in a folder that is read-only it ages.
        let _ = File::options().append(true).open(&path).and_then(|file| file.set_modified(SystemTime::now()));
        Some(bytes)
    }

    fn store(&self, key: &str, bytes: &[u8]) {
        let write = || {
            fs::create_dir_all(&self.folder).ok()?;
            let path = self.file(key);
            write_atomically(&path, |file| {
                file.write_all(&heading(key, bytes))?;
                file.write_all(bytes)
            })
            .ok()
        };
        if write().is_some() {
            self.tidy();
        }
    }
}

/// What stands before the bytes of a table.
fn heading(key: &str, bytes: &[u8]) -> Vec<u8> {
    [HEAD, blake3::hash(key.as_bytes()).as_bytes(), blake3::hash(bytes).as_bytes()].concat()
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    fn folder() -> (tempfile::TempDir, TableFolder) {
        let place = tempfile::tempdir().unwrap();
        let tables = TableFolder::new(place.path().join("made/when/needed"));
        (place, tables)
    }

    #[test]
    fn what_is_kept_comes_back_under_its_key_alone() {
        let (_place, tables) = folder();
        assert_eq!(tables.load("a"), None, "nothing yet");
        tables.store("a", b"first");
        tables.store("b", b"");
        assert_eq!(tables.load("a").as_deref(), Some(&b"first"[..]), "a");
        assert_eq!(tables.load("b").as_deref(), Some(&b""[..]), "empty tables are tables");
        assert_eq!(tables.load("c"), None, "another key");
        tables.store("a", b"second");
        assert_eq!(tables.load("a").as_deref(), Some(&b"second"[..]), "replaced");
    }

    #[test]
    fn damaged_files_count_as_absent_and_are_replaced() {
        let (_place, tables) = folder();
        tables.store("a", b"some bytes");
        let path = tables.file("a");
        let whole = fs::read(&path).unwrap();
        let mut flipped = whole.clone();
        *flipped.last_mut().unwrap() ^= 1;
        let cut = whole[..whole.len() - 1].to_vec();
        for damaged in [flipped, cut, Vec::new(), b"tyndall table 0\n".to_vec(), vec![0; 500]] {
            fs::write(&path, &damaged).unwrap();
            assert_eq!(tables.load("a"), None, "{} bytes", damaged.len());
        }
        tables.store("a", b"some bytes");
        assert_eq!(fs::read(&path).unwrap(), whole, "made anew");
    }

    #[test]
    fn beyond_the_bound_the_tables_go_that_were_unused_for_longest() {
        let (_place, tables) = folder();
        let tables = tables.bounded(350);
        for (age_s, key) in [(30, "old but used"), (20, "oldest"), (10, "younger")] {
            tables.store(key, &[0; 20]);
            let aged = SystemTime::now() - Duration::from_secs(age_s);
            File::options().append(true).open(tables.file(key)).unwrap().set_modified(aged).unwrap();
        }
        assert!(tables.load("old but used").is_some(), "it is there, and young again");
        // Each file has 100 bytes; the fourth is one too many.
        tables.store("new", &[0; 20]);
        assert_eq!(tables.load("oldest"), None, "gone");
        for key in ["old but used", "younger", "new"] {
            assert!(tables.load(key).is_some(), "{key}");
        }
    }

    #[test]
    fn a_folder_that_cannot_be_is_an_empty_one() {
        let (place, _) = folder();
        fs::write(place.path().join("file"), "text").unwrap();
        let tables = TableFolder::new(place.path().join("file"));
        tables.store("a", b"bytes");
        assert_eq!(tables.load("a"), None, "nothing is kept, nothing breaks");
    }
}

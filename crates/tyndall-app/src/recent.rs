//! Scene files used lately.

use std::path::{Path, PathBuf};

/// Files that are remembered.
const CAPACITY: usize = 10;

/// Scene files used lately, the latest first, each once.
#[derive(Clone, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub(crate) struct Recent(Vec<PathBuf>);

impl Recent {
    /// Puts a file first.
    pub(crate) fn add(&mut self, path: &Path) {
        let path = std::path::absolute(path).unwrap_or_else(|_gone| path.to_owned());
        self.0.retain(|known| *known != path);
        self.0.insert(0, path);
        self.0.truncate(CAPACITY);
    }

    /// Forgets a file, as it cannot be opened.
    pub(crate) fn remove(&mut self, path: &Path) {
        self.0.retain(|known| known != path);
    }

    /// The files, the latest first.
    pub(crate) fn paths(&self) -> &[PathBuf] {
        &self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_file_is_listed_once_the_latest_first() {
        let mut recent = Recent::default();
        for name in ["/a", "/b", "/a"] {
            recent.add(Path::new(name));
        }
        assert_eq!(recent.paths(), [PathBuf::from("/a"), PathBuf::from("/b")], "a was used last");
        recent.remove(Path::new("/a"));
        assert_eq!(recent.paths(), [PathBuf::from("/b")], "a is gone");
    }

    #[test]
    fn old_files_are_forgotten() {
        let mut recent = Recent::default();
        (0..2 * CAPACITY).for_each(|number| recent.add(Path::new(&format!("/{number}"))));
        assert_eq!(recent.paths().len(), CAPACITY, "{recent:?}");
    }
}

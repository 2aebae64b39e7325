//! Reference data that are too large or too foreign for the repository.

use std::path::{Path, PathBuf};

/// A file or folder of the reference data, which lie in `shared/data` beside the workspace's root. `None`, with a sentence
/// on stderr, when they are not there: a test then checks what it can without them.
#[must_use]
pub fn shared_data(name: &str) -> Option<PathBuf> {
    let path = workspace_root().join("../shared/data").join(name);
    if path.exists() {
        return Some(path);
    }
    #[expect(clippy::print_stderr, reason = "who reads the test's output must see that a part was left out")]
    {
        eprintln!("reference data {name:?} are not here ({}); this comparison is left out", path.display());
    }
    None
}

/// Root of the workspace.
pub(crate) fn workspace_root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."))
}

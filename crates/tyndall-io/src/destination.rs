//! Where a file goes, and the flag that stops it.

use std::path::Path;
use std::sync::atomic::AtomicBool;

/// A path, with an optional flag that cancels the write: set by Ctrl-C on the command line, by a button in the app.
///
/// Every writer takes `impl Into<Destination>`, so that a plain `&path` does where nothing cancels.
#[derive(Clone, Copy, Debug)]
pub struct Destination<'a> {
    pub(crate) path: &'a Path,
    pub(crate) cancel: Option<&'a AtomicBool>,
}

impl<'a> Destination<'a> {
    /// The file at `path`; nothing cancels.
    pub fn new<P: AsRef<Path> + ?Sized>(path: &'a P) -> Self {
        Self { path: path.as_ref(), cancel: None }
    }

    /// The file.
    #[must_use]
    pub fn path(&self) -> &'a Path {
        self.path
    }

    /// Stops soon after `cancel` becomes true, and leaves nothing behind.
    #[must_use]
    pub fn cancelled_by(self, cancel: &'a AtomicBool) -> Self {
        Self { cancel: Some(cancel), ..self }
    }
}

impl<'a, P: AsRef<Path> + ?Sized> From<&'a P> for Destination<'a> {
    fn from(path: &'a P) -> Self {
        Self::new(path)
    }
}

//! Where tables that are slow to make may be kept between two runs of the program.

use std::fmt::Debug;

/// Keeps the bytes of tables by a text that names everything they follow from. A store may forget anything at any time,
/// but what it gives back is what was kept under this very text.
pub trait TableStore: Debug + Send + Sync {
    /// The bytes kept under a text.
    fn load(&self, key: &str) -> Option<Vec<u8>>;

    /// Keeps bytes under a text. What cannot be kept is forgotten.
    fn store(&self, key: &str, bytes: &[u8]);
}

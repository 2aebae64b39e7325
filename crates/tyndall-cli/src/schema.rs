//! `tyndall schema`: the JSON schema of scene files, for editors.

use crate::{Failure, output};

/// Prints the schema.
///
/// # Errors
/// When standard output refuses.
pub fn run() -> Result<(), Failure> {
    output::print(&format!("{:#}\n", tyndall_scene::schema()))
}

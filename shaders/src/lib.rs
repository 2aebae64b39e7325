//! The WGSL sources of Tyndall and their composer.
//!
//! A shader file is plain WGSL. What it needs from another file stands in comment lines, so that editors, formatters
//! and graphics debuggers read every file as it is:
//!
//! ```wgsl
//! // @import common/phase.wgsl
//! ```
//!
//! [`compose`] puts the imported files in front, each once, in the order of the import lines, and keeps for every line
//! of the result the file and line it came from, so that an error of the shader compiler can name the original place.
//! Variation comes from `override` constants or from swapping a file of the same function signatures; there is no
//! preprocessor.
//!
//! The table [`FILES`] holds all texts, so a program needs no shader folder at run time. In builds with debug assertions
//! the environment variable `TYNDALL_SHADER_DIR` names a folder that is read instead, to edit shaders without
//! compiling; release builds ignore it.

mod compose;
mod error;
mod files;

pub use compose::{Composed, compose, compose_snippet, compose_text};
pub use error::ComposeError;
pub use files::FILES;

/// Names of the files that have a compute, vertex or fragment entry point, sorted.
#[must_use]
pub fn entries() -> Vec<&'static str> {
    FILES.iter().filter(|(_, text)| has_entry_point(text)).map(|(name, _)| *name).collect()
}

/// Whether the text declares an entry point: an attribute of a shader stage at the start of a line.
#[must_use]
pub fn has_entry_point(text: &str) -> bool {
    let stages = ["@compute", "@vertex", "@fragment"];
    text.lines().any(|line| stages.iter().any(|stage| line.trim_start().starts_with(stage)))
}

//! Why WGSL files could not be put together.

/// Errors of [`compose`](crate::compose) and [`compose_text`](crate::compose_text).
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ComposeError {
    /// The file asked for is not there.
    #[error("there is no shader file {name:?}{hint}")]
    UnknownFile {
        /// The name as it was asked for.
        name: String,
        /// Where to look, or empty.
        hint: String,
    },
    /// An import line names a file that is not there.
    #[error("{file}:{line}: imports {import:?}, but there is no such shader file")]
    MissingImport {
        /// File with the import line.
        file: String,
        /// Its line, from 1.
        line: u32,
        /// The file it names.
        import: String,
    },
    /// Files import each other in a circle.
    #[error("{file}:{line}: import cycle: {chain}")]
    Cycle {
        /// File with the import line that closes the circle.
        file: String,
        /// Its line, from 1.
        line: u32,
        /// The files of the circle, joined by arrows.
        chain: String,
    },
    /// A comment that looks like an import line but is none.
    #[error("{file}:{line}: {text:?} is no import; the form is `// @import folder/name.wgsl`")]
    Malformed {
        /// File with the line.
        file: String,
        /// Its line, from 1.
        line: u32,
        /// The line without its indentation.
        text: String,
    },
}

//! Figures: for people on stdout, for programs as JSON lines in a file.

use std::fs::File;
use std::io::{self, Write as _};
use std::path::Path;

use anyhow::{Context as _, Result};
use serde_json::Value;

/// One line for people.
///
/// # Errors
/// When stdout refuses.
pub fn print_line(text: &str) -> Result<()> {
    writeln!(io::stdout().lock(), "{text}").context("cannot write to stdout")
}

/// The file for programs, if one is wanted.
#[derive(Debug)]
pub struct JsonLines {
    file: Option<File>,
}

impl JsonLines {
    /// Starts the file anew.
    ///
    /// # Errors
    /// When it cannot be created.
    pub fn create(path: Option<&Path>) -> Result<Self> {
        let create = |path: &Path| File::create(path).with_context(|| format!("cannot create {}", path.display()));
        Ok(Self { file: path.map(create).transpose()? })
    }

    /// Adds one object.
    ///
    /// # Errors
    /// When the file refuses.
    pub fn write(&mut self, figures: &Value) -> Result<()> {
        match &mut self.file {
            Some(file) => writeln!(file, "{figures}").context("cannot write the JSON lines"),
            None => Ok(()),
        }
    }
}

//! Textual composition: imported files first, each once, with a map from lines of the result to original lines.

use std::borrow::Cow;
use std::path::PathBuf;
use std::sync::Arc;

use crate::{ComposeError, FILES};

/// One module: the text for the shader compiler and where each of its lines came from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Composed {
    /// The text, one `\n` after each line.
    pub source: String,
    /// For each line of `source`: file and line (from 1).
    pub origin: Vec<(Arc<str>, u32)>,
    /// The files in the order in which they stand in `source`; the entry file is the last.
    pub files: Vec<Arc<str>>,
}

impl Composed {
    /// File and line (from 1) of line `line` (from 1) of the composed text. Beyond the end, where compilers report an
    /// unexpected end of file, it is the last line.
    #[must_use]
    pub fn locate(&self, line: u32) -> (&str, u32) {
        let index = (line.max(1) as usize - 1).min(self.origin.len().saturating_sub(1));
        self.origin.get(index).map_or(("", 0), |(file, line)| (file.as_ref(), *line))
    }
}

/// Composes one of the [`FILES`] with everything it imports.
///
/// # Errors
/// When there is no such file, an import is missing or malformed, or the imports form a cycle.
pub fn compose(name: &str) -> Result<Composed, ComposeError> {
    let library = Library::of_this_build();
    let Some(text) = library.text(name) else {
        return Err(ComposeError::UnknownFile { name: name.to_owned(), hint: library.hint() });
    };
    compose_with(name, &text, &library)
}

/// Composes a text that is no file; its imports are looked up where [`compose`] looks.
///
/// # Errors
/// When an import is missing or malformed, or the imports form a cycle.
pub fn compose_snippet(name: &str, text: &str) -> Result<Composed, ComposeError> {
    compose_with(name, text, &Library::of_this_build())
}

/// Composes a text with imports from `files` alone, a table like [`FILES`].
///
/// # Errors
/// When an import is missing or malformed, or the imports form a cycle.
pub fn compose_text(name: &str, text: &str, files: &[(&str, &str)]) -> Result<Composed, ComposeError> {
    compose_with(name, text, &Library::Table(files))
}

fn compose_with(name: &str, text: &str, library: &Library<'_>) -> Result<Composed, ComposeError> {
    let mut composer = Composer {
        library,
        stack: Vec::new(),
        out: Composed { source: String::new(), origin: Vec::new(), files: Vec::new() },
    };
    composer.append(name, text)?;
    Ok(composer.out)
}

/// Where imports are looked up.
enum Library<'a> {
    Table(&'a [(&'a str, &'a str)]),
    Folder(PathBuf),
}

impl Library<'static> {
    /// The table, or in builds with debug assertions the folder that `TYNDALL_SHADER_DIR` names.
    fn of_this_build() -> Self {
        let folder = if cfg!(debug_assertions) { std::env::var_os("TYNDALL_SHADER_DIR") } else { None };
        folder.map_or(Self::Table(FILES), |folder| Self::Folder(folder.into()))
    }
}

impl Library<'_> {
    fn text(&self, name: &str) -> Option<Cow<'_, str>> {
        match self {
            Self::Table(files) => files.iter().find(|(file, _)| *file == name).map(|(_, text)| Cow::Borrowed(*text)),
            Self::Folder(folder) => std::fs::read_to_string(folder.join(name)).ok().map(Cow::Owned),
        }
    }

    fn hint(&self) -> String {
        match self {
            Self::Table(_) => String::new(),
            Self::Folder(folder) => format!(" in TYNDALL_SHADER_DIR={}", folder.display()),
        }
    }
}

struct Composer<'a> {
    library: &'a Library<'a>,
    /// Files that are being appended, outermost first: meeting one of them again is a cycle.
    stack: Vec<Arc<str>>,
    out: Composed,
}

impl Composer<'_> {
    fn append(&mut self, name: &str, text: &str) -> Result<(), ComposeError> {
        let name: Arc<str> = name.into();
        self.stack.push(Arc::clone(&name));
        for (line, content) in (1..).zip(text.lines()) {
            if let Some(import) = parse_import(&name, line, content)? {
                self.import(&name, line, import)?;
            }
        }
        self.stack.pop();
        for (line, content) in (1..).zip(text.lines()) {
            self.out.source.push_str(content);
            self.out.source.push('\n');
            self.out.origin.push((Arc::clone(&name), line));
        }
        self.out.files.push(name);
        Ok(())
    }

    fn import(&mut self, file: &Arc<str>, line: u32, import: &str) -> Result<(), ComposeError> {
        if let Some(start) = self.stack.iter().position(|open| open.as_ref() == import) {
            let circle: Vec<&str> = self.stack[start..].iter().map(AsRef::as_ref).chain([import]).collect();
            return Err(ComposeError::Cycle { file: file.to_string(), line, chain: circle.join(" -> ") });
        }
        if self.out.files.iter().any(|done| done.as_ref() == import) {
            return Ok(());
        }
        let library = self.library;
        match library.text(import) {
            Some(text) => self.append(import, &text),
            None => Err(ComposeError::MissingImport { file: file.to_string(), line, import: import.to_owned() }),
        }
    }
}

/// The file that a line imports, if it is an import line. A misspelt one (`//@import`, quotes, nothing after it) is an
/// error: as a mere comment it would surface later as an unknown function.
fn parse_import<'a>(file: &str, line: u32, content: &'a str) -> Result<Option<&'a str>, ComposeError> {
    let content = content.trim();
    let Some(comment) = content.strip_prefix("//") else { return Ok(None) };
    let Some(rest) = comment.trim_start_matches('/').trim_start().strip_prefix("@import") else { return Ok(None) };
    let path = rest.trim();
    let is_exact = content.starts_with("// @import ");
    let is_path =
        path.strip_suffix(".wgsl").is_some() && !path.starts_with('/') && !path.contains(['"', '\'', ' ', '\\', ';']);
    if is_exact && is_path && !path.split('/').any(|part| part.is_empty() || part == "..") {
        return Ok(Some(path));
    }
    Err(ComposeError::Malformed { file: file.to_owned(), line, text: content.to_owned() })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(name: &str, files: &[(&str, &str)]) -> String {
        let text = files.iter().find(|(file, _)| *file == name).map_or("", |(_, text)| text);
        compose_text(name, text, files).expect_err("these files do not compose").to_string()
    }

    const DIAMOND: &[(&str, &str)] = &[
        ("common/units.wgsl", "alias Length = f32;\n"),
        ("left.wgsl", "// @import common/units.wgsl\nfn left() -> Length { return 1.0; }\n"),
        ("right.wgsl", "// @import common/units.wgsl\nfn right() -> Length { return 2.0; }"),
        ("top.wgsl", "// top\n// @import left.wgsl\n// @import right.wgsl\nfn top() {}\n"),
    ];

    #[test]
    fn a_file_imported_twice_stands_once_and_before_its_users() {
        let composed = compose_text("top.wgsl", DIAMOND[3].1, DIAMOND).expect("the files compose");
        let files: Vec<&str> = composed.files.iter().map(AsRef::as_ref).collect();
        assert_eq!(files, ["common/units.wgsl", "left.wgsl", "right.wgsl", "top.wgsl"], "depth first, each once");
        assert_eq!(composed.source.matches("alias Length").count(), 1, "{}", composed.source);
    }

    #[test]
    fn every_line_of_the_result_maps_to_the_line_it_was() {
        let composed = compose_text("top.wgsl", DIAMOND[3].1, DIAMOND).expect("the files compose");
        assert_eq!(composed.source.lines().count(), composed.origin.len(), "one origin a line");
        for (line, content) in (1..).zip(composed.source.lines()) {
            let (file, original) = composed.locate(line);
            let text = DIAMOND.iter().find(|(name, _)| *name == file).expect("a known file").1;
            assert_eq!(text.lines().nth(original as usize - 1), Some(content), "{file}:{original}");
        }
    }

    #[test]
    fn lines_beyond_the_end_map_to_the_last_line() {
        let composed = compose_text("top.wgsl", DIAMOND[3].1, DIAMOND).expect("the files compose");
        assert_eq!(composed.locate(999), ("top.wgsl", 4), "compilers report the end of file one line later");
        assert_eq!(composed.locate(0), ("common/units.wgsl", 1), "a line 0 is the first");
    }

    #[test]
    fn a_missing_import_names_the_file_and_line_that_ask_for_it() {
        let files = [("a.wgsl", "// text\n// @import b.wgsl\n"), ("b.wgsl", "\n\n// @import common/nope.wgsl\n")];
        let message = message("a.wgsl", &files);
        assert_eq!(message, "b.wgsl:3: imports \"common/nope.wgsl\", but there is no such shader file", "the place");
    }

    #[test]
    fn a_cycle_names_the_closing_line_and_the_files_of_the_circle() {
        let files = [
            ("a.wgsl", "// @import b.wgsl\n"),
            ("b.wgsl", "// @import c.wgsl\n"),
            ("c.wgsl", "fn c() {}\n// @import b.wgsl\n"),
        ];
        let message = message("a.wgsl", &files);
        assert_eq!(message, "c.wgsl:2: import cycle: b.wgsl -> c.wgsl -> b.wgsl", "only the circle itself");
    }

    #[test]
    fn a_file_that_imports_itself_is_a_cycle() {
        let message = message("a.wgsl", &[("a.wgsl", "// @import a.wgsl\n")]);
        assert_eq!(message, "a.wgsl:1: import cycle: a.wgsl -> a.wgsl", "the shortest circle");
    }

    #[test]
    fn misspelt_imports_are_errors_and_not_comments() {
        for line in [
            "//@import a.wgsl",
            "//  @import a.wgsl",
            "/// @import a.wgsl",
            "// @import",
            "// @import \"a.wgsl\"",
            "// @import a.wgsl;",
            "// @import a",
            "// @import ../a.wgsl",
            "// @import /a.wgsl",
        ] {
            let message = message("x.wgsl", &[("a.wgsl", ""), ("x.wgsl", line)]);
            assert!(message.starts_with("x.wgsl:1: ") && message.contains("no import"), "{line:?} gave {message}");
        }
    }

    #[test]
    fn a_comment_that_mentions_imports_in_its_middle_is_a_comment() {
        let composed = compose_text("x.wgsl", "// see the @import line below\n", &[]).expect("no import line");
        assert_eq!(composed.files.len(), 1, "nothing imported");
    }

    #[test]
    fn windows_line_ends_compose_like_others() {
        let files = [("a.wgsl", "const A = 1.0;\r\n"), ("b.wgsl", "// @import a.wgsl\r\nconst B = A;\r\n")];
        let composed = compose_text("b.wgsl", files[1].1, &files).expect("carriage returns are no part of a line");
        assert_eq!(composed.source, "const A = 1.0;\n// @import a.wgsl\nconst B = A;\n", "line ends are unified");
    }

    #[test]
    fn an_unknown_entry_file_is_named() {
        let message = compose("sky/nope.wgsl").expect_err("no such file").to_string();
        assert!(message.starts_with("there is no shader file \"sky/nope.wgsl\""), "{message}");
    }

    #[test]
    fn a_snippet_imports_from_the_table() {
        for (name, _) in FILES {
            let composed = compose_snippet("snippet.wgsl", &format!("// @import {name}\nfn mine() {{}}\n"));
            let composed = composed.unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(composed.locate(u32::MAX), ("snippet.wgsl", 2), "the snippet stands last");
        }
    }

    #[test]
    fn a_folder_of_shaders_composes_like_the_table() {
        let folder = Library::Folder(env!("CARGO_MANIFEST_DIR").into());
        for name in crate::entries() {
            let text = folder.text(name).expect("the folder has the files of the table");
            assert_eq!(compose_with(name, &text, &folder), compose_with(name, &text, &Library::Table(FILES)), "{name}");
        }
        assert_eq!(folder.text("sky/nope.wgsl"), None, "no such file");
        assert!(folder.hint().contains("TYNDALL_SHADER_DIR"), "the message names the variable: {}", folder.hint());
    }
}

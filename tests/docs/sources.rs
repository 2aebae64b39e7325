//! Looks up Rust paths, WGSL functions and tests in the source text.
//!
//! Text is enough: the compiler checks everything else, and a look-up takes no build. A path is the one of its
//! definition; re-exports are not followed.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Words that declare an item.
const DECLARING: [&str; 9] = ["fn", "struct", "enum", "trait", "const", "static", "type", "mod", "macro_rules"];

/// Words that open a block with members.
const WITH_MEMBERS: [&str; 5] = ["impl", "trait", "enum", "struct", "mod"];

/// The sources of a workspace.
#[derive(Debug)]
pub(crate) struct Sources {
    root: PathBuf,
    tests: BTreeSet<String>,
}

impl Sources {
    /// Reads the names of all tests below `root`.
    pub(crate) fn below(root: &Path) -> Self {
        let mut tests = BTreeSet::new();
        for folder in ["crates", "shaders/src", "tests", "benches", "assets"] {
            for file in rust_files(&root.join(folder)) {
                tests.extend(tests_in(&fs::read_to_string(file).unwrap_or_default()));
            }
        }
        Self { root: root.to_path_buf(), tests }
    }

    /// Whether `path#function` or `path` exists in the tree.
    pub(crate) fn find_in_file(&self, reference: &str) -> Result<(), String> {
        let (path, function) = reference.split_once('#').unwrap_or((reference, ""));
        let text =
            fs::read_to_string(self.root.join(path)).map_err(|_unreadable| format!("there is no file {path}"))?;
        if function.is_empty() || declares(&words(&text), function) {
            return Ok(());
        }
        Err(format!("{path} declares no {function}"))
    }

    /// Whether a test of this name exists anywhere, or below this path.
    pub(crate) fn find_test(&self, reference: &str) -> Result<(), String> {
        let name = reference.rsplit(['#', ':']).next().unwrap_or(reference);
        if !self.tests.contains(name) {
            return Err(format!("there is no test {name}"));
        }
        match reference {
            _ if reference.contains('#') => self.find_in_file(reference),
            _ if reference.contains("::") => self.find_rust(reference),
            _ => Ok(()),
        }
    }

    /// Whether the item of a path such as `tyndall_core::grid::Grid2::sample` exists.
    pub(crate) fn find_rust(&self, path: &str) -> Result<(), String> {
        let mut segments = path.split("::");
        let folder = self.crate_folder(segments.next().unwrap_or_default())?;
        let mut file = folder.join("lib.rs");
        let mut modules = folder;
        let mut rest: Vec<_> = segments.collect();
        while let Some(segment) = rest.first() {
            let candidates = [modules.join(format!("{segment}.rs")), modules.join(segment).join("mod.rs")];
            let Some(found) = candidates.into_iter().find(|candidate| candidate.is_file()) else { break };
            (file, modules) = (found, modules.join(segment));
            rest.remove(0);
        }
        let text = fs::read_to_string(&file).map_err(|error| format!("{}: {error}", file.display()))?;
        let shown = file.strip_prefix(&self.root).unwrap_or(&file).display();
        has_member(&words(&text), &rest).map_err(|missing| format!("{shown} declares no {missing}"))
    }

    fn crate_folder(&self, name: &str) -> Result<PathBuf, String> {
        let folder = name.replace('_', "-");
        let candidates =
            [self.root.join("crates").join(&folder), self.root.join(folder.trim_start_matches("tyndall-"))];
        let found = candidates.into_iter().map(|candidate| candidate.join("src")).find(|folder| folder.is_dir());
        found.ok_or_else(|| format!("there is no crate {name}"))
    }
}

/// Names, and the signs that matter here, in order; without comments and strings.
fn words(text: &str) -> Vec<String> {
    let mut words = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let length = if let Some(length) = unspoken_length(rest) {
            length
        } else if first.is_alphanumeric() || first == '_' {
            rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len())
        } else {
            first.len_utf8()
        };
        let (word, after) = rest.split_at(length);
        if first.is_alphanumeric() || "_{};#[".contains(first) {
            words.push(word.to_owned());
        }
        rest = after;
    }
    words
}

/// Bytes of the comment, string or character literal at the start of `text`, if there is one.
fn unspoken_length(text: &str) -> Option<usize> {
    let until = |end: &str, start: usize| text[start..].find(end).map_or(text.len(), |found| start + found + end.len());
    match text.as_bytes() {
        [b'/', b'/', ..] => Some(until("\n", 2)),
        [b'/', b'*', ..] => Some(until("*/", 2)),
        [b'r', b'#', b'"', ..] => Some(until("\"#", 3)),
        [b'"', ..] => Some(string_length(text)),
        [b'\'', b'\\', _, ..] => Some(until("'", 3)),
        // Anything else that begins with an apostrophe is a lifetime.
        [b'\'', _, b'\'', ..] => Some(3),
        _ => None,
    }
}

/// Bytes of the string literal at the start of `text`.
fn string_length(text: &str) -> usize {
    let mut escaped = false;
    for (index, character) in text.char_indices().skip(1) {
        match character {
            '"' if !escaped => return index + 1,
            '\\' => escaped = !escaped,
            _ => escaped = false,
        }
    }
    text.len()
}

fn declares(words: &[String], name: &str) -> bool {
    words.windows(2).any(|pair| DECLARING.contains(&pair[0].as_str()) && pair[1] == name)
}

/// Whether the nested names, outermost first, are declared; otherwise the first one that is not.
fn has_member<'a>(words: &[String], path: &[&'a str]) -> Result<(), &'a str> {
    match path {
        [] => Ok(()),
        [name] => {
            if declares(words, name) {
                Ok(())
            } else {
                Err(name)
            }
        }
        [outer, member] => {
            let blocks = blocks_of(words, outer);
            let found = blocks.iter().any(|block| block.iter().any(|word| word == member));
            if found { Ok(()) } else { Err(member) }
        }
        [outer, rest @ ..] => {
            let inside: Vec<_> = blocks_of(words, outer).concat();
            has_member(&inside, rest)
        }
    }
}

/// What stands between the braces of every block whose head names `name`.
fn blocks_of(words: &[String], name: &str) -> Vec<Vec<String>> {
    let mut blocks = Vec::new();
    for (start, word) in words.iter().enumerate() {
        if !WITH_MEMBERS.contains(&word.as_str()) {
            continue;
        }
        let is_end = |word: &String| word == "{" || word == ";";
        let Some(head_length) = words[start..].iter().position(is_end) else { continue };
        let (head, body) = words[start..].split_at(head_length);
        if head.iter().any(|word| word == name) && body[0] == "{" {
            blocks.push(body[1..block_length(body)].to_vec());
        }
    }
    blocks
}

/// Number of words before the brace that closes the one at the start.
fn block_length(words: &[String]) -> usize {
    let mut depth = 0_usize;
    for (index, word) in words.iter().enumerate() {
        match word.as_str() {
            "{" => depth += 1,
            "}" => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return index;
        }
    }
    words.len()
}

/// The functions marked as tests.
fn tests_in(text: &str) -> Vec<String> {
    let words = words(text);
    let mut tests = Vec::new();
    for (index, mark) in words.windows(3).enumerate() {
        if mark == ["#", "[", "test"] {
            let function = words[index..].windows(2).find(|pair| pair[0] == "fn");
            tests.extend(function.map(|pair| pair[1].clone()));
        }
    }
    tests
}

/// All Rust files below a folder, which may not exist.
fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            files.extend(rust_files(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    files
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn braces_and_quotes_in_literals_do_not_disturb() {
        let text = r##"impl A { fn a() { ('"', '{', '\'', "\"}", r#"}"}"#) } /* } */ fn b<'x>() {} } fn c() {}"##;
        let words = words(text);
        assert_eq!(has_member(&words, &["A", "b"]), Ok(()), "b is within A: {words:?}");
        assert_eq!(has_member(&words, &["A", "c"]), Err("c"), "c is outside: {words:?}");
    }

    /// A crate, a shader and a test.
    fn workspace() -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        let files = [
            ("crates/tyndall-demo/src/lib.rs", "pub mod air; pub mod sky;\npub const TOP_M: f64 = 1.0;"),
            (
                "crates/tyndall-demo/src/air.rs",
                "/// fn only_in_a_comment\npub struct Air { pub density: f64 }\n\
                 impl Air { pub fn column(&self) -> f64 { let text = \"fn only_in_a_string {\"; 1.0 } }\n\
                 pub enum Kind { Dry, Wet }\npub trait Medium { fn extinction(&self) -> f64; }\nfn outside() {}\n\
                 #[cfg(test)]\nmod tests {\n    #[test]\n    fn air_is_light() {}\n}\n",
            ),
            ("crates/tyndall-demo/src/sky/mod.rs", "pub mod dome;"),
            ("crates/tyndall-demo/src/sky/dome.rs", "pub fn rings() {}"),
            ("shaders/src/lib.rs", "pub fn compose() {}"),
            ("shaders/common/air.wgsl", "// fn commented()\nfn air_density(h_m: f32) -> f32 { return 1.0; }"),
            ("tests/physics/main.rs", "#[test]\nfn light_is_conserved() {}\nfn helper() {}\n"),
        ];
        for (path, text) in files {
            let path = folder.path().join(path);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        folder
    }

    #[test]
    fn items_modules_and_members_are_found() {
        let folder = workspace();
        let sources = Sources::below(folder.path());
        for path in [
            "tyndall_demo::TOP_M",
            "tyndall_demo::air",
            "tyndall_demo::air::Air",
            "tyndall_demo::air::Air::column",
            "tyndall_demo::air::Air::density",
            "tyndall_demo::air::Kind::Wet",
            "tyndall_demo::air::Medium::extinction",
            "tyndall_demo::air::tests::air_is_light",
            "tyndall_demo::sky::dome::rings",
            "tyndall_shaders::compose",
        ] {
            assert_eq!(sources.find_rust(path), Ok(()), "{path}");
        }
    }

    #[test]
    fn planted_wrong_paths_are_named() {
        let folder = workspace();
        let sources = Sources::below(folder.path());
        for (path, fault) in [
            ("tyndall_none::air", "there is no crate tyndall_none"),
            ("tyndall_demo::BOTTOM_M", "crates/tyndall-demo/src/lib.rs declares no BOTTOM_M"),
            ("tyndall_demo::air::Earth", "crates/tyndall-demo/src/air.rs declares no Earth"),
            ("tyndall_demo::air::Air::outside", "crates/tyndall-demo/src/air.rs declares no outside"),
            ("tyndall_demo::air::only_in_a_comment", "crates/tyndall-demo/src/air.rs declares no only_in_a_comment"),
            ("tyndall_demo::air::only_in_a_string", "crates/tyndall-demo/src/air.rs declares no only_in_a_string"),
            ("tyndall_demo::sky::rings", "crates/tyndall-demo/src/sky/mod.rs declares no rings"),
        ] {
            assert_eq!(sources.find_rust(path), Err(fault.to_owned()), "{path}");
        }
    }

    #[test]
    fn shader_functions_and_tests_are_found_and_missing_ones_named() {
        let folder = workspace();
        let sources = Sources::below(folder.path());
        assert_eq!(sources.find_in_file("shaders/common/air.wgsl#air_density"), Ok(()), "function");
        assert_eq!(sources.find_in_file("shaders/common/air.wgsl"), Ok(()), "whole file");
        assert_eq!(sources.find_test("light_is_conserved"), Ok(()), "by name");
        assert_eq!(sources.find_test("tests/physics/main.rs#light_is_conserved"), Ok(()), "by file");
        assert_eq!(sources.find_test("tyndall_demo::air::tests::air_is_light"), Ok(()), "by path");
        for fault in [
            sources.find_in_file("shaders/common/air.wgsl#commented"),
            sources.find_in_file("shaders/common/none.wgsl"),
            sources.find_test("helper"),
            sources.find_test("tests/physics/main.rs#air_is_light"),
            sources.find_test("tyndall_demo::sky::air_is_light"),
        ] {
            assert!(fault.is_err(), "{fault:?}");
        }
    }
}

//! House rules that no other tool checks: length of files, words that must not be in the tree.

use std::fs;

use anyhow::{Context as _, Result, bail};

use super::Outcome;
use crate::shell::{in_root, output_of, root};

/// Suffix of a file's name and the most lines it may have.
const MAX_LINES: &[(&str, usize)] = &[(".rs", 600), (".wgsl", 350), ("README.md", 200), ("ARCHITECTURE.md", 150)];

/// Words that must not be in any text, and what to do instead. They are put together here so as not to find themselves.
const FORBIDDEN: &[(&str, &str)] = &[
    (concat!("TO", "DO"), "do it, or file an issue"),
    (concat!("FIX", "ME"), "repair it, or file an issue"),
    (concat!("#[", "ignore"), "a test runs or is removed"),
    (concat!("#[", "allow("), "use #[expect(.., reason = \"..\")]"),
    (concat!("#![", "allow("), "use #![expect(.., reason = \"..\")]"),
    (concat!("/ho", "me/"), "use a relative path"),
    (concat!("/ro", "ot/"), "use a relative path"),
    (concat!("/tm", "p/"), "use a relative path, in tests the tempfile crate"),
    (concat!("/wo", "rk/"), "use a relative path"),
    (concat!("C:", "\\"), "use a relative path"),
];

/// Looks through every text file that git knows or would add.
pub(crate) fn tree(_fix: bool) -> Result<Outcome> {
    let mut problems = Vec::new();
    for path in files()? {
        let bytes = fs::read(in_root(&path)).with_context(|| format!("cannot read {path}"))?;
        // What is not UTF-8 is a picture or the like.
        if let Ok(text) = String::from_utf8(bytes) {
            problems.extend(problems_of(&path, &text));
        }
    }
    if problems.is_empty() { Ok(Outcome::Ok) } else { bail!("{}", problems.join("\n")) }
}

/// Paths of the tree's files, with forward slashes, relative to the root.
pub(crate) fn files() -> Result<Vec<String>> {
    let mut command = std::process::Command::new("git");
    command.args(["ls-files", "-z", "--cached", "--others", "--exclude-standard"]).current_dir(root());
    let listed = output_of(&mut command)?;
    let exists = |path: &&str| !path.is_empty() && in_root(path).is_file();
    Ok(listed.split('\0').filter(exists).map(str::to_owned).collect())
}

fn problems_of(path: &str, text: &str) -> Vec<String> {
    let mut problems = Vec::new();
    let lines = text.lines().count();
    if let Some((_, most)) = MAX_LINES.iter().find(|(suffix, most)| path.ends_with(suffix) && lines > *most) {
        problems.push(format!("{path}: {lines} lines, at most {most}; split it by concept"));
    }
    for (index, line) in text.lines().enumerate() {
        for (word, advice) in FORBIDDEN {
            if line.contains(word) {
                problems.push(format!("{path}:{}: {word:?}: {advice}", index + 1));
            }
        }
    }
    problems
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forbidden_words_are_named_with_file_and_line() {
        for (word, advice) in FORBIDDEN {
            let problems = problems_of("crates/a/src/lib.rs", &format!("fine\n// {word} later\n"));
            let expected = format!("crates/a/src/lib.rs:2: {word:?}: {advice}");
            assert_eq!(problems, [expected], "{word}");
        }
    }

    #[test]
    fn files_may_have_as_many_lines_as_their_kind_allows_and_no_more() {
        for (suffix, most) in MAX_LINES {
            assert!(problems_of(suffix, &"line\n".repeat(*most)).is_empty(), "{suffix} with {most} lines");
            assert_eq!(problems_of(suffix, &"line\n".repeat(most + 1)).len(), 1, "{suffix} with one more");
        }
        assert!(problems_of("Cargo.lock", &"line\n".repeat(9000)).is_empty(), "other files have no limit");
    }

    #[test]
    fn this_file_is_in_the_list() {
        let files = files().unwrap();
        assert!(files.iter().any(|path| path == "crates/xtask/src/check/hygiene.rs"), "{} files", files.len());
    }
}

//! Checks that the local links of the documentation lead to files.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// The faults of all Markdown files below `root`.
pub(crate) fn faults_below(root: &Path) -> io::Result<Vec<String>> {
    let mut faults = Vec::new();
    for path in markdown_files(root)? {
        let text = fs::read_to_string(&path)?;
        let folder = path.parent().unwrap_or(root);
        let shown = path.strip_prefix(root).unwrap_or(&path).display();
        for (line, target) in targets(&text) {
            if !folder.join(&target).exists() {
                faults.push(format!("{shown}:{line}: {target} does not exist"));
            }
        }
    }
    Ok(faults)
}

fn markdown_files(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.is_dir() {
            if name != "target" && !name.starts_with('.') {
                files.extend(markdown_files(&path)?);
            }
        } else if path.extension().is_some_and(|extension| extension == "md") {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

/// Line numbers and paths of the local targets, outside of code.
fn targets(text: &str) -> Vec<(usize, String)> {
    let mut targets = Vec::new();
    let mut in_code = false;
    for (index, line) in text.lines().enumerate() {
        if line.trim_start().starts_with("```") {
            in_code = !in_code;
        } else if !in_code {
            let prose: String = line.split('`').step_by(2).collect::<Vec<_>>().join("`");
            let local = link_targets(&prose).into_iter().filter_map(local_path);
            targets.extend(local.map(|target| (index + 1, target)));
        }
    }
    targets
}

/// Targets of `[text](target)`, `[name]: target`, `src="target"` and `href="target"`.
fn link_targets(line: &str) -> Vec<&str> {
    let mut targets = Vec::new();
    for (open, close) in [("](", [')', ' ']), ("src=\"", ['"', '"']), ("href=\"", ['"', '"'])] {
        let starts = line.match_indices(open).map(|(start, _)| &line[start + open.len()..]);
        targets.extend(starts.filter_map(|rest| rest.find(close).map(|end| &rest[..end])));
    }
    let definition = line.strip_prefix('[').and_then(|rest| rest.split_once("]: "));
    targets.extend(definition.and_then(|(_, target)| target.split_whitespace().next()));
    targets
}

/// The path of a target within the tree, without its anchor.
fn local_path(target: &str) -> Option<String> {
    let path = target.split('#').next().unwrap_or_default();
    let is_elsewhere = path.contains("://") || path.starts_with("mailto:");
    (!path.is_empty() && !is_elsewhere).then(|| path.replace("%20", " "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planted_dead_links_are_found_with_file_and_line() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("docs")).unwrap();
        fs::write(folder.path().join("picture.png"), "").unwrap();
        let text = "[good](../picture.png) and [dead](gone.md#part)\n\n[name]: none.md\n\
                    <img src=\"no.png\" width=\"9\">\n\
                    ```\n[code](in-code.md)\n```\n`[code](in-code.md)` [far](https://example.org/x) [here](#part)\n\
                    ![titled](../picture.png \"with a title\")\n";
        fs::write(folder.path().join("docs/a.md"), text).unwrap();
        let faults = faults_below(folder.path()).unwrap();
        let expected = ["1: gone.md", "3: none.md", "4: no.png"];
        assert_eq!(faults, expected.map(|fault| format!("docs/a.md:{fault} does not exist")), "dead links");
    }
}

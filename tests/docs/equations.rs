//! Checks the table of equations: `| eq | what | correction | Rust path | shader | tests |`.
//!
//! Names stand in backticks. A row is either built, then it names at least one Rust item and one test, or its Rust cell
//! says `not yet built`. Shader cells name `file.wgsl#function`, tests a function, `file.rs#function` or a Rust path.

use crate::sources::Sources;

const CELLS: usize = 6;
const NUMBERED_EQUATIONS: usize = 6;
const NOT_BUILT: &str = "not yet built";

/// A row of the table.
#[derive(Debug)]
struct Row {
    line: usize,
    cells: Vec<String>,
}

/// Everything that is wrong with the document, each fault with its line.
pub(crate) fn faults(name: &str, document: &str, sources: &Sources) -> Vec<String> {
    let rows = rows(document);
    let mut faults = Vec::new();
    for number in 1..=NUMBERED_EQUATIONS {
        if !rows.iter().any(|row| row.cells[0].contains(&format!("({number})"))) {
            faults.push(format!("{name}: no row for equation ({number})"));
        }
    }
    for row in &rows {
        let found = faults_of(row, sources);
        faults.extend(found.into_iter().map(|fault| format!("{name}:{}: {fault}", row.line)));
    }
    faults
}

fn faults_of(row: &Row, sources: &Sources) -> Vec<String> {
    if row.cells.len() != CELLS {
        return vec![format!("{} cells in place of {CELLS}", row.cells.len())];
    }
    let [rust, shader, tests] = [3, 4, 5].map(|index| names(&row.cells[index]));
    let mut faults = Vec::new();
    if !row.cells[3].contains(NOT_BUILT) {
        for (what, names) in [("Rust item", &rust), ("test", &tests)] {
            if names.is_empty() {
                faults.push(format!("equation {} names no {what} and is not marked `{NOT_BUILT}`", row.cells[0]));
            }
        }
    }
    faults.extend(rust.iter().filter_map(|path| sources.find_rust(path).err()));
    faults.extend(shader.iter().filter_map(|reference| sources.find_in_file(reference).err()));
    faults.extend(tests.iter().filter_map(|reference| sources.find_test(reference).err()));
    faults
}

/// The rows of every table whose first column is called `eq`, without head and rule.
fn rows(document: &str) -> Vec<Row> {
    let mut rows = Vec::new();
    let mut inside = false;
    for (index, line) in document.lines().enumerate() {
        let Some(cells) = cells(line) else {
            inside = false;
            continue;
        };
        if inside && !is_rule(&cells) {
            rows.push(Row { line: index + 1, cells });
        } else if !inside {
            inside = cells[0].eq_ignore_ascii_case("eq");
        }
    }
    rows
}

fn is_rule(cells: &[String]) -> bool {
    cells.iter().all(|cell| cell.contains('-') && cell.chars().all(|character| "-: ".contains(character)))
}

/// The cells of a line of a table; none for any other line. `\|` is a bar within a cell.
fn cells(line: &str) -> Option<Vec<String>> {
    let inner = line.trim().strip_prefix('|')?.strip_suffix('|')?.replace("\\|", "\0");
    Some(inner.split('|').map(|cell| cell.trim().replace('\0', "|")).collect())
}

/// What stands in backticks.
fn names(cell: &str) -> Vec<String> {
    let spans = cell.split('`').skip(1).step_by(2);
    spans.map(str::trim).filter(|name| *name != NOT_BUILT && !name.is_empty()).map(str::to_owned).collect()
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    const HEAD: &str =
        "# Equations\n\n| Eq | what | correction | Rust | shader | tests |\n|---|:---|---|---|---|--:|\n";

    /// The faults of a document with these rows, where equations (2) to (6) are not built.
    fn faults_with(first_rows: &str) -> Vec<String> {
        let folder = tempfile::tempdir().unwrap();
        for (path, text) in [
            ("crates/tyndall-demo/src/lib.rs", "pub fn phase() {}\n#[test]\nfn phase_is_normalised() {}"),
            ("shaders/phase.wgsl", "fn phase() {}"),
        ] {
            let path = folder.path().join(path);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        let rest = [2, 3, 4, 5, 6].map(|number| format!("| ({number}) | x | none | not yet built | | |\n")).concat();
        faults("e.md", &format!("{HEAD}{first_rows}{rest}"), &Sources::below(folder.path()))
    }

    #[test]
    fn a_complete_row_has_no_fault() {
        let row =
            "| (1) | \\|F\\| | none | `tyndall_demo::phase` | `shaders/phase.wgsl#phase` | `phase_is_normalised` |\n";
        assert!(faults_with(row).is_empty(), "{:?}", faults_with(row));
    }

    #[test]
    fn every_planted_fault_is_found_with_its_line() {
        for (row, fault) in [
            ("", "e.md: no row for equation (1)"),
            (
                "| (1) | x | none | `tyndall_demo::tone` | | `phase_is_normalised` |\n",
                "e.md:5: crates/tyndall-demo/src/lib.rs declares no tone",
            ),
            (
                "| (1) | x | none | `tyndall_demo::phase` | `shaders/phase.wgsl#tone` | `phase_is_normalised` |\n",
                "e.md:5: shaders/phase.wgsl declares no tone",
            ),
            (
                "| (1) | x | none | `tyndall_demo::phase` | `shaders/tone.wgsl` | `phase_is_normalised` |\n",
                "e.md:5: there is no file shaders/tone.wgsl",
            ),
            (
                "| (1) | x | none | `tyndall_demo::phase` | | `phase_is_positive` |\n",
                "e.md:5: there is no test phase_is_positive",
            ),
            (
                "| (1) | x | none | `tyndall_demo::phase` | | |\n",
                "e.md:5: equation (1) names no test and is not marked `not yet built`",
            ),
            (
                "| (1) | x | none | | | `phase_is_normalised` |\n",
                "e.md:5: equation (1) names no Rust item and is not marked `not yet built`",
            ),
            ("| (1) | x | none |\n", "e.md:5: 3 cells in place of 6"),
        ] {
            assert_eq!(faults_with(row), [fault], "{row}");
        }
    }
}

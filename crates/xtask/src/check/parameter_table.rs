//! The parameter tables in the documentation are those that the program prints.

use std::fs;

use anyhow::{Context as _, Result, bail};

use super::Outcome;
use crate::shell::{cargo, in_root, output_of};

const DOCUMENT: &str = "docs/parameters.md";
const BEGIN: &str = "<!-- params:begin -->";
const END: &str = "<!-- params:end -->";

/// Compares the table between the two marks with `tyndall params --markdown`.
pub(crate) fn table(fix: bool) -> Result<Outcome> {
    let mut command = cargo(["run", "--quiet", "--locked", "--package", "tyndall-cli", "--", "params", "--markdown"]);
    let table = output_of(&mut command)?;
    let path = in_root(DOCUMENT);
    let document = fs::read_to_string(&path).with_context(|| format!("cannot read {DOCUMENT}"))?;
    let expected = with_table(&document, &table)?;
    if document == expected {
        return Ok(Outcome::Ok);
    }
    if fix {
        fs::write(&path, expected).with_context(|| format!("cannot write {DOCUMENT}"))?;
        return Ok(Outcome::Ok);
    }
    let line = 1 + document.lines().zip(expected.lines()).take_while(|(found, wanted)| found == wanted).count();
    bail!("{DOCUMENT}:{line} differs from what the program prints; `cargo xtask check --fix` regenerates it")
}

/// The document with what stands between the marks replaced.
fn with_table(document: &str, table: &str) -> Result<String> {
    let marked = document.split_once(BEGIN).and_then(|(before, rest)| Some((before, rest.split_once(END)?.1)));
    let (before, after) = marked.with_context(|| format!("{DOCUMENT} lacks {BEGIN} or {END}"))?;
    Ok(format!("{before}{BEGIN}\n\n{}\n\n{END}{after}", table.trim()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_stands_between_the_marks_is_replaced() {
        let document = format!("above\n{BEGIN}\nold\n{END}\nbelow\n");
        let renewed = with_table(&document, "| new |\n").unwrap();
        assert_eq!(renewed, format!("above\n{BEGIN}\n\n| new |\n\n{END}\nbelow\n"), "first time");
        assert_eq!(with_table(&renewed, "| new |\n").unwrap(), renewed, "the second time changes nothing");
    }

    #[test]
    fn a_document_without_marks_is_an_error() {
        for document in [String::new(), format!("{BEGIN} only"), format!("{END} before {BEGIN}")] {
            assert!(with_table(&document, "table").is_err(), "{document}");
        }
    }
}

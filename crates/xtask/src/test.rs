//! `cargo xtask test`: all tests of the workspace, with a count at the end.

use std::io::{BufRead as _, BufReader};
use std::process::Stdio;
use std::time::Instant;

use anyhow::{Context as _, Result, bail};

use crate::{setup, shell};

/// Sums of the lines that end each test program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Count {
    programs: usize,
    passed: usize,
    failed: usize,
    ignored: usize,
}

/// Runs all tests, or those that the arguments choose; those after a failure too.
pub(crate) fn test(arguments: &[String]) -> Result<()> {
    let start = Instant::now();
    let mut command = shell::cargo(["test", "--locked", "--no-fail-fast"]);
    if arguments.is_empty() {
        command.arg("--workspace");
    }
    command.args(arguments).envs(setup::software_adapter_variables()).stdout(Stdio::piped());
    println!("$ {}", shell::shown(&command));
    let mut child = command.spawn().context("cannot start cargo")?;
    let output = child.stdout.take().context("the output of cargo was asked for")?;
    let mut count = Count::default();
    for line in BufReader::new(output).lines() {
        let line = line?;
        count.add(&line);
        println!("{line}");
    }
    let status = child.wait()?;
    println!("{} test programs, {} ignored, {:.0} s", count.programs, count.ignored, start.elapsed().as_secs_f64());
    println!("{} passed, {} failed", count.passed, count.failed);
    if !status.success() {
        bail!("{}", if count.failed > 0 { "tests failed" } else { "the tests could not be built or run" });
    }
    if count.passed == 0 {
        bail!("no test ran");
    }
    Ok(())
}

impl Count {
    /// Adds a line such as `test result: ok. 3 passed; 0 failed; 0 ignored; 0 measured; ...`; ignores all others.
    fn add(&mut self, line: &str) {
        let Some(result) = line.strip_prefix("test result: ") else { return };
        let number = |word: &str| {
            let mut parts = result.split(['.', ';']);
            parts.find_map(|part| part.trim().strip_suffix(word)?.trim().parse().ok()).unwrap_or(0)
        };
        self.programs += 1;
        self.passed += number("passed");
        self.failed += number("failed");
        self.ignored += number("ignored");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_of_several_test_programs_are_added() {
        let mut count = Count::default();
        for line in [
            "running 3 tests",
            "test result: ok. 12 passed; 0 failed; 1 ignored; 0 measured; 0 filtered out; finished in 0.01s",
            "test a ... ok",
            "test result: FAILED. 30 passed; 2 failed; 0 ignored; 0 measured; 4 filtered out; finished in 1.25s",
        ] {
            count.add(line);
        }
        assert_eq!(count, Count { programs: 2, passed: 42, failed: 2, ignored: 1 }, "sums");
    }
}

//! `cargo xtask check`: everything that CI checks besides the tests.
//!
//! All checks run, also after a failure; each prints one line, a failed one its reason below it.

mod hygiene;
mod package;
mod parameter_table;
mod rust_tools;
mod wheels;

use std::io::Write as _;
use std::time::Instant;

use anyhow::{Result, bail};

/// What a check that did not fail has to say.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// Everything is in order.
    Ok,
    /// It could not be made on this machine, and why.
    Skipped(String),
}

/// A name and what to do; the argument tells whether to repair what can be repaired.
type Check = (&'static str, fn(bool) -> Result<Outcome>);

/// The quick ones first.
const CHECKS: &[Check] = &[
    ("rustfmt", rust_tools::rustfmt),
    ("hygiene", hygiene::tree),
    ("typos", wheels::typos),
    ("taplo", wheels::taplo),
    ("clippy", rust_tools::clippy),
    ("rustdoc", rust_tools::rustdoc),
    ("parameters", parameter_table::table),
    ("benches", rust_tools::bench_smoke),
    ("package", package::package),
];

/// Makes the checks with these names, or every check; an error when one failed.
pub(crate) fn check(names: &[String], fix: bool) -> Result<()> {
    let known: Vec<_> = CHECKS.iter().map(|(name, _)| *name).collect();
    if let Some(unknown) = names.iter().find(|name| !known.contains(&name.as_str())) {
        bail!("there is no check {unknown:?}, but {}", known.join(", "));
    }
    let wanted = CHECKS.iter().filter(|(name, _)| names.is_empty() || names.iter().any(|wanted| wanted == name));
    let mut failed = Vec::new();
    for (name, run) in wanted.clone() {
        print!("{name:<10} ");
        // The line is seen while the check runs; if it cannot be shown now, it is shown with its end.
        let _ = std::io::stdout().flush();
        let start = Instant::now();
        let result = run(fix);
        let seconds = start.elapsed().as_secs_f64();
        match result {
            Ok(Outcome::Ok) => println!("ok       {seconds:6.1} s"),
            Ok(Outcome::Skipped(reason)) => println!("skipped  {seconds:6.1} s: {reason}"),
            Err(error) => {
                println!("FAILED   {seconds:6.1} s\n{error:#}");
                failed.push(*name);
            }
        }
    }
    if !failed.is_empty() {
        bail!("{} of {} checks failed: {}", failed.len(), wanted.count(), failed.join(", "));
    }
    println!("no check failed");
    Ok(())
}

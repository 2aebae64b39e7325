//! Checks that the Rust tools make.

use anyhow::Result;

use super::Outcome;
use crate::setup;
use crate::shell::{cargo, output_of};

/// The code is formatted.
pub(crate) fn rustfmt(fix: bool) -> Result<Outcome> {
    if fix {
        output_of(&mut cargo(["fmt", "--all"]))?;
    }
    output_of(&mut cargo(["fmt", "--all", "--check"]))?;
    Ok(Outcome::Ok)
}

/// No lint of the workspace fires, in code, tests or benches.
pub(crate) fn clippy(_fix: bool) -> Result<Outcome> {
    let arguments = ["clippy", "--quiet", "--workspace", "--all-targets", "--locked", "--", "--deny", "warnings"];
    output_of(&mut cargo(arguments))?;
    Ok(Outcome::Ok)
}

/// The documentation builds without a warning: no broken link, no undocumented item.
pub(crate) fn rustdoc(_fix: bool) -> Result<Outcome> {
    let mut command = cargo(["doc", "--quiet", "--workspace", "--no-deps", "--locked"]);
    output_of(command.env("RUSTDOCFLAGS", "--deny warnings"))?;
    Ok(Outcome::Ok)
}

/// Every bench runs one tiny iteration, in the profile of the tests.
pub(crate) fn bench_smoke(_fix: bool) -> Result<Outcome> {
    let mut command = cargo(["test", "--quiet", "--benches", "--package", "tyndall-benches", "--locked"]);
    output_of(command.env("TYNDALL_BENCH_SMOKE", "1").envs(setup::software_adapter_variables()))?;
    Ok(Outcome::Ok)
}

//! Checks by tools that come as Python wheels: seconds to install, where building them would take minutes.

use std::path::PathBuf;
use std::process::Command;

use anyhow::Result;

use super::Outcome;
use crate::shell::{in_root, output_of, root};

const ENVIRONMENT: &str = "target/check-venv";

/// No spelling mistakes.
pub(crate) fn typos(_fix: bool) -> Result<Outcome> {
    run("typos", "1.52.0", &[&["--format", "brief"]])
}

/// The TOML files are valid and formatted.
pub(crate) fn taplo(fix: bool) -> Result<Outcome> {
    let format: &[&str] = if fix { &["format"] } else { &["format", "--check", "--diff"] };
    run("taplo", "0.9.3", &[format, &["lint", "--no-schema"]])
}

fn run(tool: &str, version: &str, calls: &[&[&str]]) -> Result<Outcome> {
    let program = match installed(tool, version) {
        Ok(program) => program,
        Err(error) => {
            let reason = error.to_string();
            let first_line = reason.lines().next().unwrap_or_default();
            return Ok(Outcome::Skipped(format!("{tool} {version} could not be installed from PyPI: {first_line}")));
        }
    };
    for arguments in calls {
        output_of(Command::new(&program).args(*arguments).current_dir(root()))?;
    }
    Ok(Outcome::Ok)
}

/// The tool's program in our own Python environment, installed there when it is missing or of another version.
fn installed(tool: &str, version: &str) -> Result<PathBuf> {
    let folder = in_root(ENVIRONMENT).join(if cfg!(windows) { "Scripts" } else { "bin" });
    let program = folder.join(format!("{tool}{}", std::env::consts::EXE_SUFFIX));
    let is_current = || {
        let printed = output_of(Command::new(&program).arg("--version"))?;
        anyhow::Ok(printed.split_whitespace().any(|word| word == version))
    };
    if is_current().unwrap_or(false) {
        return Ok(program);
    }
    let python = if cfg!(windows) { "python" } else { "python3" };
    output_of(Command::new(python).args(["-m", "venv"]).arg(in_root(ENVIRONMENT)))?;
    let requirement = format!("{tool}=={version}");
    output_of(Command::new(folder.join("python")).args(["-m", "pip", "install", "--quiet", &requirement]))?;
    Ok(program)
}

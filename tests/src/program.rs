//! The command line program under test.

use std::ffi::OsString;
use std::path::PathBuf;
use std::process::Command;
use std::sync::OnceLock;

use crate::data::workspace_root;

/// The program `tyndall`, built once a process.
///
/// # Panics
/// When it does not build.
pub fn tyndall_binary() -> PathBuf {
    static PROGRAM: OnceLock<PathBuf> = OnceLock::new();
    PROGRAM.get_or_init(|| build().unwrap_or_else(|error| panic!("building tyndall: {error:#}"))).clone()
}

/// Asks for the tests' package too, so that shared dependencies have the same features and are not compiled twice.
fn build() -> anyhow::Result<PathBuf> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| OsString::from("cargo"));
    let output = Command::new(cargo)
        .current_dir(workspace_root())
        .args(["build", "--locked", "--quiet", "--message-format=json-render-diagnostics"])
        .args(["--package=tyndall-cli", "--package=tyndall-tests", "--bin=tyndall"])
        .output()?;
    anyhow::ensure!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    executable(&String::from_utf8(output.stdout)?)
        .ok_or_else(|| anyhow::anyhow!("cargo named no executable of that name"))
}

/// The executable `tyndall` among cargo's messages, one JSON object a line.
fn executable(messages: &str) -> Option<PathBuf> {
    let artifacts = messages.lines().filter_map(|line| serde_json::from_str::<serde_json::Value>(line).ok());
    artifacts
        .filter(|message| message["target"]["name"] == "tyndall")
        .find_map(|message| message["executable"].as_str().map(PathBuf::from))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_executable_is_found_among_the_messages_of_cargo() {
        let messages = r#"{"reason":"compiler-artifact","target":{"name":"tyndall_core"},"executable":null}
            {"reason":"compiler-artifact","target":{"name":"tyndall"},"executable":"/t/debug/tyndall"}
            {"reason":"build-finished","success":true}"#;
        assert_eq!(executable(messages), Some(PathBuf::from("/t/debug/tyndall")), "the second message");
        assert_eq!(executable("not json\n"), None, "no message, no program");
    }
}

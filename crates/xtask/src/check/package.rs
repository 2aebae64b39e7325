//! Every publishable crate makes a package: its files are all below its own folder, its manifest is complete.

use std::fs;

use anyhow::{Context as _, Result};

use super::Outcome;
use crate::shell::{cargo, in_root, output_of};

/// Packs the publishable crates; they were built by the tests already.
pub(crate) fn package(_fix: bool) -> Result<Outcome> {
    let mut command = cargo(["package", "--quiet", "--workspace", "--no-verify", "--allow-dirty", "--locked"]);
    for name in unpublished()? {
        command.args(["--exclude", &name]);
    }
    output_of(&mut command)?;
    Ok(Outcome::Ok)
}

/// Names of the members that say `publish = false`.
fn unpublished() -> Result<Vec<String>> {
    let listed = super::hygiene::files()?;
    let manifests = listed.iter().filter(|path| path.ends_with("/Cargo.toml"));
    let mut names = Vec::new();
    for path in manifests {
        let text = fs::read_to_string(in_root(path)).with_context(|| format!("cannot read {path}"))?;
        names.extend(unpublished_name(&text).map(str::to_owned));
    }
    Ok(names)
}

fn unpublished_name(manifest: &str) -> Option<&str> {
    let value = |key: &str| {
        manifest.lines().find_map(|line| line.strip_prefix(key)?.trim_start().strip_prefix('=')).map(str::trim)
    };
    (value("publish")? == "false").then(|| value("name").map(|name| name.trim_matches('"'))).flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_members_that_say_so_are_left_out() {
        let private = "[package]\nname = \"tyndall-tests\"\npublish = false\n";
        assert_eq!(unpublished_name(private), Some("tyndall-tests"), "publish = false");
        assert_eq!(unpublished_name("[package]\nname = \"tyndall\"\n"), None, "published");
    }
}

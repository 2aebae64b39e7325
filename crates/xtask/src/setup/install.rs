//! Installs packages on Debian and Ubuntu.

use std::process::Command;

use anyhow::{Context as _, Result, bail};

use crate::shell::{output_of, run_shown, shown};

/// How this user may change the system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Right {
    Root,
    Sudo,
}

/// Installs the packages; each command is shown before it runs.
pub(crate) fn with_apt(packages: &[&str]) -> Result<()> {
    let right = right().with_context(|| {
        format!("neither root nor sudo: ask for `apt-get install --no-install-recommends {}`", packages.join(" "))
    })?;
    let [mut update, mut install] = commands(right, packages);
    if let Err(error) = run_shown(&mut update) {
        // Stale lists or one broken source need not matter for these packages.
        println!("set-up: {error:#}; trying with the package lists that are there");
    }
    run_shown(&mut install).with_context(|| format!("install by hand: `{}`", shown(&install)))
}

fn right() -> Result<Right> {
    if output_of(Command::new("id").arg("-u"))?.trim() == "0" {
        return Ok(Right::Root);
    }
    match output_of(Command::new("sudo").arg("--version")) {
        Ok(_) => Ok(Right::Sudo),
        Err(_) => bail!("no right to install"),
    }
}

fn commands(right: Right, packages: &[&str]) -> [Command; 2] {
    let apt_get = |arguments: &[&str]| {
        let words = ["apt-get", "-q", "-y"];
        let mut command = match right {
            Right::Root => Command::new(words[0]),
            // sudo drops the environment, hence the variable on its command line.
            Right::Sudo => Command::new("sudo"),
        };
        if right == Right::Sudo {
            command.args(["DEBIAN_FRONTEND=noninteractive", words[0]]);
        }
        command.env("DEBIAN_FRONTEND", "noninteractive").args(&words[1..]).args(arguments);
        command
    };
    let install = [&["install", "--no-install-recommends"], packages].concat();
    [apt_get(&["update"]), apt_get(&install)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn root_installs_directly_and_others_through_sudo() {
        let packages = ["libxi6", "libvulkan1"];
        let root = commands(Right::Root, &packages).map(|command| shown(&command));
        let expected = "apt-get -q -y install --no-install-recommends libxi6 libvulkan1";
        assert_eq!(root, ["apt-get -q -y update", expected], "as root");
        let sudo = commands(Right::Sudo, &packages).map(|command| shown(&command));
        assert_eq!(sudo[1], format!("sudo DEBIAN_FRONTEND=noninteractive {expected}"), "as another user");
    }
}

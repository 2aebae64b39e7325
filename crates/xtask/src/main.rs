//! `cargo xtask`: set-up, run, test and checks of the workspace, the same on a developer's machine and in CI.
//!
//! Each command first looks whether the machine has what it needs (`setup`), which takes milliseconds when it has. Only
//! clap and anyhow are used, so that a fresh clone gets here within seconds.
#![expect(clippy::print_stdout, reason = "a program talks to its user")]

mod check;
mod gallery;
mod run;
mod setup;
mod shell;
mod test;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Sets up, runs, tests and checks Tyndall.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct Arguments {
    /// Only name missing system packages, install nothing
    #[arg(long, global = true)]
    no_install: bool,
    #[command(subcommand)]
    task: Task,
}

#[derive(Debug, Subcommand)]
enum Task {
    /// Install the system packages that Tyndall needs (Debian, Ubuntu) or name them (elsewhere)
    Setup,
    /// Open the app; without a display render the gallery instead
    Run {
        /// Arguments for the app; without a scene file among them it opens the noon preset
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        arguments: Vec<String>,
    },
    /// Run all tests, on the software adapter where there is no GPU
    Test {
        /// Arguments for `cargo test` in place of `--workspace`, such as `-p tyndall-io`
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        arguments: Vec<String>,
    },
    /// Run every other check that CI makes
    Check {
        /// Make only these checks, by their names as printed
        names: Vec<String>,
        /// Repair what can be repaired: format the code, regenerate the parameter table
        #[arg(long)]
        fix: bool,
    },
    /// Render every preset into target/gallery
    Gallery {
        /// Also render the small pictures of the README into docs/gallery
        #[arg(long)]
        readme: bool,
    },
}

fn main() -> ExitCode {
    match perform(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            println!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn perform(arguments: &Arguments) -> anyhow::Result<()> {
    let install = !arguments.no_install;
    match &arguments.task {
        Task::Setup => {
            if setup::prepare(setup::Purpose::Window, install)? {
                println!("set-up: this machine has what Tyndall needs from the system");
            }
            Ok(())
        }
        Task::Run { arguments } => run::run(arguments, install),
        Task::Test { arguments } => {
            setup::prepare(setup::Purpose::Headless, install)?;
            test::test(arguments)
        }
        Task::Check { names, fix } => {
            setup::prepare(setup::Purpose::Headless, install)?;
            check::check(names, *fix)
        }
        Task::Gallery { readme } => {
            setup::prepare(setup::Purpose::Headless, install)?;
            gallery::gallery(*readme)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_switch_for_packages_works_before_and_after_the_task_and_is_not_handed_on() {
        for line in [["xtask", "--no-install", "run"], ["xtask", "run", "--no-install"]] {
            let parsed = Arguments::try_parse_from(line).unwrap();
            assert!(parsed.no_install, "{line:?}");
            assert!(matches!(parsed.task, Task::Run { arguments } if arguments.is_empty()), "{line:?}");
        }
        let parsed = Arguments::try_parse_from(["xtask", "test", "-p", "tyndall-io", "--", "--nocapture"]).unwrap();
        let expected = ["-p", "tyndall-io", "--", "--nocapture"];
        assert!(matches!(parsed.task, Task::Test { arguments } if arguments == expected), "the rest goes to cargo");
    }
}

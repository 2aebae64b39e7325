//! Options that every bench takes, and when it runs a single tiny iteration.

use std::path::PathBuf;

/// Set to anything but `0` or nothing: one tiny iteration, for CI.
const SMOKE_VARIABLE: &str = "TYNDALL_BENCH_SMOKE";

/// Options of every bench.
#[derive(Clone, Debug, clap::Args)]
pub struct CommonOptions {
    /// Only what has this text in its name
    #[arg(long, default_value = "", hide_default_value = true)]
    pub filter: String,
    /// Also write the figures to this file, one JSON object a line
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Given by `cargo bench`.
    #[arg(long, hide = true)]
    pub bench: bool,
    /// Given by `cargo test --quiet`.
    #[arg(long, short, hide = true)]
    pub quiet: bool,
}

/// Whether to run one tiny iteration only: when the environment says so, or when `cargo test` runs the bench.
#[must_use]
pub fn is_smoke(options: &CommonOptions) -> bool {
    decide(std::env::var(SMOKE_VARIABLE).ok().as_deref(), options.bench)
}

fn decide(variable: Option<&str>, by_cargo_bench: bool) -> bool {
    !by_cargo_bench || !matches!(variable, None | Some("" | "0"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn full_runs_need_cargo_bench_and_no_variable() {
        for (variable, by_cargo_bench, smoke) in [
            (None, true, false),
            (Some("0"), true, false),
            (Some(""), true, false),
            (Some("1"), true, true),
            (None, false, true),
        ] {
            assert_eq!(decide(variable, by_cargo_bench), smoke, "{variable:?}, cargo bench: {by_cargo_bench}");
        }
    }
}

//! Exit codes, by which scripts and render farms decide what to do next.

use std::process::ExitCode;

/// How the program ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// Done.
    Success = 0,
    /// The picture could not be computed or written.
    Render = 1,
    /// The command line, the scene or the place for the result is wrong.
    Usage = 2,
    /// There is no graphics adapter, or none as asked for.
    NoAdapter = 3,
    /// More memory is needed than allowed, or a size than the device has.
    OverBudget = 4,
    /// `validate` found an error above the limit.
    OverLimit = 5,
    /// The graphics device was lost, and lost again when tried once more.
    DeviceLost = 6,
    /// Terminated from outside; the same command starts over. Slurm takes it as `RequeueExit=75`.
    Resumable = 75,
    /// Ctrl-C.
    Interrupted = 130,
}

impl Exit {
    /// Every code, in ascending order.
    pub const ALL: [Self; 9] = [
        Self::Success,
        Self::Render,
        Self::Usage,
        Self::NoAdapter,
        Self::OverBudget,
        Self::OverLimit,
        Self::DeviceLost,
        Self::Resumable,
        Self::Interrupted,
    ];

    /// The number that the shell sees.
    #[must_use]
    pub fn code(self) -> u8 {
        self as u8
    }

    /// What the code means, in one line.
    #[must_use]
    pub fn meaning(self) -> &'static str {
        match self {
            Self::Success => "done",
            Self::Render => "the picture could not be computed or written",
            Self::Usage => "wrong command line, wrong scene, or no place for the result",
            Self::NoAdapter => "no graphics adapter, or none as asked for",
            Self::OverBudget => "more memory needed than --max-memory or the system allows",
            Self::OverLimit => "validate: an error is above its limit",
            Self::DeviceLost => "graphics device lost twice in a row",
            Self::Resumable => "terminated; nothing half-written, the same command starts over",
            Self::Interrupted => "Ctrl-C; nothing half-written",
        }
    }

    /// The table for `--help`.
    #[must_use]
    pub fn table() -> String {
        let rows = Self::ALL.map(|exit| format!("  {:>3}  {}", exit.code(), exit.meaning()));
        format!("Exit codes:\n{}", rows.join("\n"))
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        exit.code().into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exit_codes_are_those_that_scripts_rely_on() {
        assert_eq!(Exit::ALL.map(Exit::code), [0, 1, 2, 3, 4, 5, 6, 75, 130], "published codes never change");
    }

    #[test]
    fn the_help_names_every_exit_code_once() {
        let table = Exit::table();
        for exit in Exit::ALL {
            assert_eq!(table.matches(&format!(" {}  ", exit.code())).count(), 1, "{exit:?} in {table}");
        }
    }
}

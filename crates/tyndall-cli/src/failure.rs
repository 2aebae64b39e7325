//! Everything that ends the program early: which sentence the user reads, and with which code it ends.

use std::io;

use tyndall_gpu::GpuError;
use tyndall_io::IoError;
use tyndall_render::RenderError;
use tyndall_render::desert_inputs::DesertFileError;
use tyndall_scattering::ScatteringError;
use tyndall_scene::SceneError;

use crate::Exit;
use crate::interrupt::Signal;

/// Why the program ends early.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// Options that do not fit together, or name what does not exist.
    #[error("{0}")]
    Usage(String),
    /// The scene, a `--set` or a `--size` is wrong.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The atmosphere, or what is asked of it, is wrong.
    #[error(transparent)]
    Scattering(#[from] ScatteringError),
    /// An error that was measured is larger than allowed.
    #[error("{0}")]
    OverLimit(String),
    /// The graphics device refuses.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The renderer refuses.
    #[error(transparent)]
    Render(RenderError),
    /// The picture cannot be written.
    #[error(transparent)]
    Io(#[from] IoError),
    /// A signal came.
    #[error("{0}; nothing was written")]
    Interrupted(Signal),
    /// The result cannot be printed.
    #[error("cannot write to standard output: {0}")]
    Stdout(io::Error),
    /// The system does not let the program listen to signals.
    #[error("cannot listen to Ctrl-C: {0}")]
    Signals(io::Error),
}

impl From<RenderError> for Failure {
    fn from(error: RenderError) -> Self {
        match error {
            RenderError::Gpu(error) => Self::Gpu(error),
            RenderError::Scene(error) => Self::Scene(error),
            RenderError::Clouds(error) => Self::Scene(error.into()),
            RenderError::DesertFile(error) => error.into(),
            RenderError::Sand(error) => Self::Scene(error.into()),
            RenderError::Refused(error) => match &*error {
                RenderError::Sand(error) => Self::Scene(error.clone().into()),
                _ => Self::Render(RenderError::Refused(error)),
            },
            other => Self::Render(other),
        }
    }
}

impl From<DesertFileError> for Failure {
    fn from(error: DesertFileError) -> Self {
        Self::Usage(error.to_string())
    }
}

impl Failure {
    /// The code to end with.
    #[must_use]
    pub fn exit(&self) -> Exit {
        match self {
            Self::Usage(_) | Self::Scene(_) | Self::Scattering(_) => Exit::Usage,
            Self::OverLimit(_) => Exit::OverLimit,
            Self::Gpu(error) => exit_of_gpu(error),
            Self::Render(_) | Self::Stdout(_) | Self::Signals(_) => Exit::Render,
            Self::Io(error) => exit_of_io(error),
            Self::Interrupted(signal) => signal.exit(),
        }
    }

    /// Whether another try on a new device may succeed.
    #[must_use]
    pub fn is_lost_device(&self) -> bool {
        matches!(self, Self::Gpu(GpuError::DeviceLost { .. }))
    }

    /// What the terminal shows: one sentence, for scene files with the line and a caret. Ends in a line break.
    #[must_use]
    pub fn report(&self) -> String {
        match self {
            Self::Scene(error) => error.report(),
            other => format!("error: {other}\n"),
        }
    }
}

fn exit_of_gpu(error: &GpuError) -> Exit {
    match error {
        GpuError::NoAdapter { .. } | GpuError::AdapterNotFound { .. } | GpuError::NoDevice { .. } => Exit::NoAdapter,
        GpuError::EmptyAdapterChoice => Exit::Usage,
        GpuError::OverBudget { .. } | GpuError::OverLimit { .. } | GpuError::OutOfMemory { .. } => Exit::OverBudget,
        GpuError::DeviceLost { .. } => Exit::DeviceLost,
        _ => Exit::Render,
    }
}

/// A place that takes no file is a mistake of the command line; a disk that fails while it is written is not.
fn exit_of_io(error: &IoError) -> Exit {
    match error {
        IoError::MissingFolder { .. }
        | IoError::NotAFolder { .. }
        | IoError::IsFolder { .. }
        | IoError::NotAFile { .. }
        | IoError::NotWritable { .. }
        | IoError::Size { .. } => Exit::Usage,
        _ => Exit::Render,
    }
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use super::*;

    #[test]
    fn each_failure_ends_with_its_exit_code() {
        let lost = || GpuError::DeviceLost { reason: "test".to_owned() };
        let over = GpuError::OverBudget { what: "a".to_owned(), needed_bytes: 2, free_bytes: 1, budget_bytes: 1 };
        let cases = [
            (Failure::Usage("no".to_owned()), 2),
            (SceneError::FormatMissing.into(), 2),
            (GpuError::NoAdapter { advice: "install one" }.into(), 3),
            (over.into(), 4),
            (lost().into(), 6),
            (RenderError::Gpu(lost()).into(), 6),
            (RenderError::Scene(SceneError::FormatMissing).into(), 2),
            (IoError::NotWritable { path: PathBuf::from("a/b"), folder: PathBuf::from("a") }.into(), 2),
            (IoError::DiskFull { path: PathBuf::from("a/b") }.into(), 1),
            (Failure::Interrupted(Signal::Interrupt), 130),
            (Failure::Interrupted(Signal::Terminate), 75),
        ];
        for (failure, code) in cases {
            assert_eq!(failure.exit().code(), code, "{failure:?}");
        }
    }

    #[test]
    fn reports_are_one_sentence_after_the_word_error() {
        let report = Failure::Interrupted(Signal::Interrupt).report();
        assert_eq!(report, "error: interrupted by Ctrl-C; nothing was written\n", "no debug text");
    }

    #[test]
    fn only_a_lost_device_is_worth_another_try() {
        assert!(Failure::from(GpuError::DeviceLost { reason: String::new() }).is_lost_device(), "lost");
        assert!(!Failure::from(GpuError::EmptyAdapterChoice).is_lost_device(), "not lost");
    }
}

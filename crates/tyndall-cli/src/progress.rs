//! How far the work is: a bar for people, JSON lines for programs.

use std::io::IsTerminal as _;
use std::sync::mpsc;
use std::thread;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde_json::{Value, json};

use crate::{Failure, output};

/// Work shorter than this shows no bar.
const PATIENCE: Duration = Duration::from_millis(500);

/// Share of the work after which the time that is left can be told.
const TELLING_SHARE: f64 = 0.02;

/// Who reads the progress.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum ProgressFormat {
    /// A bar on stderr when it is a terminal and the work is long; one line at the end
    #[default]
    Human,
    /// One JSON object a line on stdout, with the events progress, frame, finished and error
    Json,
}

/// A part of the work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Opening the graphics device.
    Device,
    /// Compiling shaders into pipelines.
    Pipelines,
    /// Computing the frame.
    Frame,
    /// Fetching the pixels.
    ReadBack,
    /// Packing and writing the file.
    File,
}

impl Stage {
    /// Share of the whole that lies before this stage: rough, but never falling.
    #[must_use]
    pub fn share_done(self) -> f64 {
        match self {
            Self::Device => 0.0,
            Self::Pipelines => 0.1,
            Self::Frame => 0.4,
            Self::ReadBack => 0.7,
            Self::File => 0.8,
        }
    }

    /// What happens, for people and programs.
    #[must_use]
    pub fn text(self) -> &'static str {
        match self {
            Self::Device => "opening the graphics device",
            Self::Pipelines => "compiling shaders",
            Self::Frame => "rendering",
            Self::ReadBack => "reading the picture back",
            Self::File => "writing the file",
        }
    }
}

/// Reports to one reader.
#[derive(Debug)]
pub struct Progress {
    format: ProgressFormat,
    bar: Option<Bar>,
    started: Instant,
}

impl Progress {
    /// Starts the clock.
    #[must_use]
    pub fn start(format: ProgressFormat) -> Self {
        let wanted = format == ProgressFormat::Human && std::io::stderr().is_terminal();
        Self { format, bar: wanted.then(Bar::start), started: Instant::now() }
    }

    /// Seconds since the start.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        self.started.elapsed().as_secs_f64()
    }

    /// A stage begins.
    ///
    /// # Errors
    /// When standard output refuses.
    pub fn stage(&self, stage: Stage) -> Result<(), Failure> {
        tracing::info!(seconds = self.seconds(), "{}", stage.text());
        if let Some(bar) = &self.bar {
            bar.show(stage);
        }
        self.event(&json!({ "event": "progress", "done": stage.share_done(), "stage": stage.text() }))
    }

    /// Long work is done to this share (0 to 1).
    ///
    /// # Errors
    /// When standard output refuses.
    pub fn share(&self, text: &'static str, done: f64) -> Result<(), Failure> {
        if let Some(bar) = &self.bar {
            bar.show_share(text, done);
        }
        self.event(&json!({ "event": "progress", "done": done, "stage": text }))
    }

    /// A part of the result is there: `facts` (an object) for programs.
    ///
    /// # Errors
    /// When standard output refuses.
    pub fn item(&self, event: &str, facts: Value) -> Result<(), Failure> {
        let mut object = facts;
        object["event"] = json!(event);
        self.event(&object)
    }

    /// Something that the user should know, but that stops nothing.
    pub fn warn(&self, text: &str) {
        let warn = || output::warn(&format!("warning: {text}\n"));
        match &self.bar {
            Some(bar) => bar.bar.suspend(warn),
            None => warn(),
        }
    }

    /// The work is done: `sentence` for people, `facts` (an object) for programs.
    ///
    /// # Errors
    /// When standard output refuses.
    pub fn finish(&mut self, sentence: &str, facts: Value) -> Result<(), Failure> {
        self.bar = None;
        if self.format == ProgressFormat::Human {
            output::warn(&format!("{sentence}\n"));
        }
        let mut event = facts;
        event["event"] = json!("finished");
        self.event(&event)
    }

    /// The work has failed. The sentence for people is printed by the program when it ends.
    pub fn fail(&mut self, failure: &Failure) {
        self.bar = None;
        let event = json!({ "event": "error", "message": failure.to_string(), "exit_code": failure.exit().code() });
        // The failure itself matters more than a reader that went away.
        let _ = self.event(&event);
    }

    fn event(&self, event: &Value) -> Result<(), Failure> {
        if self.format == ProgressFormat::Json { output::print(&format!("{event}\n")) } else { Ok(()) }
    }
}

/// A bar that appears only when the work has taken a while, and vanishes in the end.
#[derive(Debug)]
struct Bar {
    bar: ProgressBar,
    /// Dropped with the bar, which tells the waiting thread that it is no longer wanted.
    _wanted: mpsc::Sender<()>,
}

impl Bar {
    fn start() -> Self {
        let bar = ProgressBar::with_draw_target(Some(100), ProgressDrawTarget::hidden());
        if let Ok(style) = ProgressStyle::with_template("{spinner} [{bar:30}] {msg} ({elapsed})") {
            bar.set_style(style.progress_chars("=> "));
        }
        let (wanted, gone) = mpsc::channel();
        let late = bar.clone();
        thread::spawn(move || {
            if gone.recv_timeout(PATIENCE) == Err(mpsc::RecvTimeoutError::Timeout) {
                late.set_draw_target(ProgressDrawTarget::stderr());
                late.enable_steady_tick(Duration::from_millis(100));
            }
        });
        Self { bar, _wanted: wanted }
    }

    fn show(&self, stage: Stage) {
        self.bar.set_message(stage.text());
        self.set_share(stage.share_done());
    }

    /// Shows a share and, once there is something to tell from, the time that is left.
    fn show_share(&self, text: &'static str, done: f64) {
        let elapsed = self.bar.elapsed().as_secs_f64();
        if done > TELLING_SHARE {
            self.bar.set_message(format!("{text}, {:.0} s left", elapsed * (1.0 - done) / done));
        } else {
            self.bar.set_message(text);
        }
        self.set_share(done);
    }

    #[expect(clippy::cast_possible_truncation, reason = "a share of 100")]
    fn set_share(&self, done: f64) {
        self.bar.set_position((100.0 * done).round() as u64);
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stages_never_go_backwards() {
        let stages = [Stage::Device, Stage::Pipelines, Stage::Frame, Stage::ReadBack, Stage::File];
        let shares = stages.map(Stage::share_done);
        assert!(shares.is_sorted() && shares[4] < 1.0, "{shares:?}");
    }

    #[test]
    fn a_bar_that_is_dropped_early_is_never_drawn() {
        let bar = Bar::start();
        let copy = bar.bar.clone();
        drop(bar);
        thread::sleep(PATIENCE + Duration::from_millis(100));
        assert!(copy.is_hidden(), "the waiting thread has left it alone");
    }
}

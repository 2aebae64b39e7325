//! The program's own log: the newest entries, kept for the log panel.

use std::{
    collections::VecDeque,
    fmt::{self, Write as _},
    sync::{Arc, Mutex, MutexGuard, PoisonError},
    time::Instant,
};

use tracing::{
    Event, Level, Subscriber,
    field::{Field, Visit},
};
use tracing_subscriber::{
    EnvFilter, Layer,
    layer::{Context, SubscriberExt as _},
    util::{SubscriberInitExt as _, TryInitError},
};

/// Entries that are kept; older ones are forgotten.
const CAPACITY: usize = 2000;

/// What is logged unless `RUST_LOG` says otherwise: everything of Tyndall from info on, warnings of the rest. A missing
/// driver is told in one sentence at the end, not in the loader's twenty lines.
const FILTER: &str = "warn,wgpu_hal::vulkan::instance=off,tyndall_app=info,tyndall_gpu=info,tyndall_io=info,\
                      tyndall_render=info,tyndall_scene=info";

/// One line of the log.
#[derive(Clone, Debug, PartialEq)]
pub struct LogEntry {
    /// Seconds since the program started.
    pub time_s: f64,
    /// How serious it is.
    pub level: Level,
    /// Message and fields.
    pub text: String,
}

/// The newest entries of the log. Clones share them.
#[derive(Clone, Debug)]
pub struct LogBuffer {
    entries: Arc<Mutex<VecDeque<LogEntry>>>,
    started: Instant,
}

impl Default for LogBuffer {
    fn default() -> Self {
        Self { entries: Arc::default(), started: Instant::now() }
    }
}

impl LogBuffer {
    /// A log to which everything of this process goes that `RUST_LOG` lets through, on stderr as well.
    ///
    /// # Errors
    /// When the process has a log already.
    pub fn install() -> Result<Self, TryInitError> {
        let log = Self::default();
        let filter = EnvFilter::try_from_default_env().unwrap_or_else(|_unset| EnvFilter::new(FILTER));
        let stderr = tracing_subscriber::fmt::layer().with_writer(std::io::stderr).without_time();
        tracing_subscriber::registry().with(filter).with(log.clone()).with(stderr).try_init()?;
        Ok(log)
    }

    /// All entries from `level` up, the oldest first.
    #[must_use]
    pub fn entries(&self, level: Level) -> Vec<LogEntry> {
        self.lock().iter().filter(|entry| entry.level <= level).cloned().collect()
    }

    /// Forgets everything.
    pub fn clear(&self) {
        self.lock().clear();
    }

    fn push(&self, level: Level, text: String) {
        let mut entries = self.lock();
        if entries.len() == CAPACITY {
            entries.pop_front();
        }
        entries.push_back(LogEntry { time_s: self.started.elapsed().as_secs_f64(), level, text });
    }

    /// The list is whole after every statement, so a panic elsewhere does not spoil it.
    fn lock(&self) -> MutexGuard<'_, VecDeque<LogEntry>> {
        self.entries.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<S: Subscriber> Layer<S> for LogBuffer {
    fn on_event(&self, event: &Event<'_>, _context: Context<'_, S>) {
        let mut text = Text::default();
        event.record(&mut text);
        self.push(*event.metadata().level(), text.0);
    }
}

impl fmt::Display for LogEntry {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{:9.3} {:5} {}", self.time_s, self.level.as_str(), self.text)
    }
}

/// Message first, then the fields as `name=value`.
#[derive(Default)]
struct Text(String);

impl Visit for Text {
    fn record_debug(&mut self, field: &Field, value: &dyn fmt::Debug) {
        match field.name() {
            "message" => self.0.insert_str(0, &format!("{value:?}")),
            // Names of the bridge from the `log` crate.
            name if name.starts_with("log.") => {}
            name => {
                // Writing to a String cannot fail.
                let _written = write!(self.0, " {name}={value:?}");
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_come_with_level_message_and_fields_and_are_filtered() {
        let log = LogBuffer::default();
        tracing::subscriber::with_default(tracing_subscriber::registry().with(log.clone()), || {
            tracing::info!(file = "a.png", "saved");
            tracing::error!("lost");
        });
        let texts: Vec<_> = log.entries(Level::INFO).into_iter().map(|entry| entry.text).collect();
        assert_eq!(texts, [r#"saved file="a.png""#, "lost"], "message first");
        assert_eq!(log.entries(Level::WARN).len(), 1, "the error alone");
    }

    #[test]
    fn the_oldest_entries_are_forgotten() {
        let log = LogBuffer::default();
        (0..CAPACITY + 5).for_each(|number| log.push(Level::INFO, number.to_string()));
        let entries = log.entries(Level::TRACE);
        assert_eq!((entries.len(), entries[0].text.as_str()), (CAPACITY, "5"), "the newest ones");
    }
}

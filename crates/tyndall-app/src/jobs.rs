//! Renders to files by the command line program in a process of its own: a crash or a kill for lack of memory does not
//! take the app along, and cancelling is ending the process.

use std::{
    env,
    ffi::OsString,
    io::{self, BufRead as _, BufReader, Read as _, Write as _},
    path::{Path, PathBuf},
    process::{Child, Command, Stdio},
    sync::mpsc::{Receiver, Sender, channel},
    thread,
    time::Instant,
};

use serde_json::Value;
use tempfile::NamedTempFile;

/// Name of the command line program.
const PROGRAM: &str = "tyndall";

/// Lines of the program's error output that are kept; the last ones have the reason.
const MAX_ERROR_CHARS: usize = 4000;

/// What is to be rendered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Order {
    /// Subcommand of the program.
    pub(crate) verb: &'static str,
    /// The scene as a file's text.
    pub(crate) scene_text: String,
    /// Where the picture goes.
    pub(crate) output: PathBuf,
    /// Options of the subcommand besides these.
    pub(crate) options: Vec<String>,
}

/// How a job stands.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Progress {
    /// At work; the share that is done.
    Running(f32),
    /// The file is there.
    Finished {
        /// How long it took.
        seconds: f64,
    },
    /// Ended by the user.
    Cancelled,
    /// Why there is no file.
    Failed(String),
}

/// A render in another process.
#[derive(Debug)]
pub(crate) struct Job {
    child: Child,
    events: Receiver<Event>,
    started: Instant,
    progress: Progress,
    output: PathBuf,
    /// Removed with the job.
    _scene: NamedTempFile,
}

#[derive(Debug)]
enum Event {
    Line(String),
    /// Both outputs have ended; text of the error output.
    Ended(String),
}

impl Job {
    /// Starts a render; `wake` is called from another thread whenever there is news.
    pub(crate) fn start(order: &Order, wake: impl Fn() + Send + 'static) -> io::Result<Self> {
        Self::start_program(&find_program(), order, wake)
    }

    fn start_program(program: &Path, order: &Order, wake: impl Fn() + Send + 'static) -> io::Result<Self> {
        let mut scene = tempfile::Builder::new().prefix("tyndall-").suffix(".toml").tempfile()?;
        scene.write_all(order.scene_text.as_bytes())?;
        scene.flush()?;
        let arguments: Vec<OsString> =
            [order.verb.into(), scene.path().into(), "-o".into(), order.output.clone().into_os_string()].into();
        tracing::info!(program = %program.display(), output = %order.output.display(), "render started");
        let mut child = Command::new(program)
            .args(arguments)
            .args(["--progress", "json"])
            .args(&order.options)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(|error| io::Error::new(error.kind(), format!("{}: {error}", program.display())))?;
        let (sender, events) = channel();
        listen(&mut child, sender, wake);
        let progress = Progress::Running(0.0);
        Ok(Self { child, events, started: Instant::now(), progress, output: order.output.clone(), _scene: scene })
    }

    /// The file being written.
    pub(crate) fn output(&self) -> &Path {
        &self.output
    }

    /// Takes in the news and says how the job stands.
    pub(crate) fn progress(&mut self) -> &Progress {
        while let Ok(event) = self.events.try_recv() {
            match (event, &self.progress) {
                (Event::Line(line), Progress::Running(_)) => self.take_in(&line),
                (Event::Ended(errors), Progress::Running(_) | Progress::Cancelled) => self.end(errors.trim()),
                _ => {}
            }
        }
        &self.progress
    }

    /// Asks the process to end; it removes what it has written so far.
    pub(crate) fn cancel(&mut self) {
        if matches!(self.progress, Progress::Running(_)) {
            self.progress = Progress::Cancelled;
            if let Err(error) = terminate(&mut self.child) {
                tracing::warn!(%error, "the render cannot be ended");
            }
        }
    }

    fn take_in(&mut self, line: &str) {
        let Ok(event) = serde_json::from_str::<Value>(line) else { return };
        match event["event"].as_str() {
            #[expect(clippy::cast_possible_truncation, reason = "a progress bar needs no more")]
            Some("progress") => self.progress = Progress::Running(event["done"].as_f64().unwrap_or(0.0) as f32),
            Some("finished") => {
                let seconds = event["seconds"].as_f64().unwrap_or_else(|| self.started.elapsed().as_secs_f64());
                self.progress = Progress::Finished { seconds };
                tracing::info!(output = %self.output.display(), seconds, "render finished");
            }
            Some("error") => {
                let message = event["message"].as_str().unwrap_or(line).to_owned();
                tracing::error!(message, "render failed");
                self.progress = Progress::Failed(message);
            }
            _ => {}
        }
    }

    /// The process has ended without an event of its own that says how.
    fn end(&mut self, errors: &str) {
        let status = self.child.wait();
        self.progress = match (&self.progress, status) {
            (Progress::Cancelled, _) => Progress::Cancelled,
            (_, Ok(status)) if status.success() => Progress::Finished { seconds: self.started.elapsed().as_secs_f64() },
            (_, Ok(status)) if errors.is_empty() => Progress::Failed(status.to_string()),
            (_, Ok(_)) => Progress::Failed(errors.to_owned()),
            (_, Err(error)) => Progress::Failed(error.to_string()),
        };
    }
}

impl Drop for Job {
    /// A closed app leaves no process behind.
    fn drop(&mut self) {
        self.cancel();
        // The process may have ended by itself; either way it is collected.
        let _status = self.child.wait();
    }
}

/// Sends the lines of the process, and at last what it wrote to its error output.
fn listen(child: &mut Child, sender: Sender<Event>, wake: impl Fn() + Send + 'static) {
    let (output, errors) = (child.stdout.take(), child.stderr.take());
    let errors = thread::spawn(move || {
        let mut text = String::new();
        // What is not UTF-8 is no message for people.
        let _read = errors.map(|mut errors| errors.read_to_string(&mut text));
        let start = text.char_indices().rev().nth(MAX_ERROR_CHARS).map_or(0, |(index, _)| index);
        text.split_off(start)
    });
    thread::spawn(move || {
        // The receiver is gone when the user has closed the job.
        let send = |event| drop(sender.send(event));
        for line in output.into_iter().flat_map(|output| BufReader::new(output).lines()).map_while(Result::ok) {
            send(Event::Line(line));
            wake();
        }
        send(Event::Ended(errors.join().unwrap_or_default()));
        wake();
    });
}

/// The program beside this one, or else in the folders of `PATH`.
pub(crate) fn find_program() -> PathBuf {
    let name = format!("{PROGRAM}{}", env::consts::EXE_SUFFIX);
    let beside = env::current_exe().ok().and_then(|exe| Some(exe.parent()?.join(&name)));
    beside.filter(|path| path.is_file()).unwrap_or_else(|| PathBuf::from(name))
}

/// Asks politely where the system can, as the program then removes its temporary file.
fn terminate(child: &mut Child) -> io::Result<()> {
    if cfg!(unix) {
        let asked = Command::new("kill").args(["-s", "TERM", &child.id().to_string()]).status();
        if asked.is_ok_and(|status| status.success()) {
            return Ok(());
        }
    }
    child.kill()
}

/// A command line for a shell: arguments with special characters in quotes.
pub(crate) fn shell_line(arguments: &[String]) -> String {
    arguments.iter().map(|argument| shell_word(argument)).collect::<Vec<_>>().join(" ")
}

fn shell_word(argument: &str) -> String {
    let harmless = |c: char| c.is_ascii_alphanumeric() || "_-./=:,+@%".contains(c);
    if !argument.is_empty() && argument.chars().all(harmless) {
        return argument.to_owned();
    }
    if cfg!(windows) { format!("\"{argument}\"") } else { format!("'{}'", argument.replace('\'', r"'\''")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(unix)]
    fn words_survive_the_shell() {
        for word in ["plain.toml", "with space", "it's", "$HOME `x` \"q\"", "", "a=b"] {
            let script = format!("printf %s {}", shell_word(word));
            let output = Command::new("sh").args(["-c", &script]).output().unwrap();
            assert_eq!(String::from_utf8_lossy(&output.stdout), word, "{script}");
        }
    }

    /// Runs a shell script in place of the program until it has ended.
    #[cfg(unix)]
    fn outcome(script: &str, cancel: bool) -> Progress {
        use std::os::unix::fs::PermissionsExt as _;
        let folder = tempfile::tempdir().unwrap();
        let program = folder.path().join("program");
        std::fs::write(&program, format!("#!/bin/sh\n{script}\n")).unwrap();
        std::fs::set_permissions(&program, std::fs::Permissions::from_mode(0o755)).unwrap();
        let order = Order {
            verb: "render",
            scene_text: "format = 1\n".to_owned(),
            output: folder.path().join("a.png"),
            options: vec![],
        };
        let (woken, wakes) = channel();
        let wake = move || woken.send(()).unwrap_or_default();
        let mut job = Job::start_program(&program, &order, wake).unwrap();
        if cancel {
            job.cancel();
        }
        while wakes.recv().is_ok() {}
        job.progress().clone()
    }

    #[test]
    #[cfg(unix)]
    fn the_outcome_is_what_the_program_says() {
        let finished =
            outcome(r#"echo '{"event":"progress","done":0.5}'; echo '{"event":"finished","seconds":2.5}'"#, false);
        assert_eq!(finished, Progress::Finished { seconds: 2.5 }, "its own time");
        let failed = outcome(r#"echo '{"event":"error","message":"no room"}'; exit 1"#, false);
        assert_eq!(failed, Progress::Failed("no room".to_owned()), "its own words");
    }

    #[test]
    #[cfg(unix)]
    fn a_program_that_dies_without_a_word_has_failed() {
        let failed = outcome("echo out of luck >&2; exit 3", false);
        assert_eq!(failed, Progress::Failed("out of luck".to_owned()), "its error output");
        assert!(matches!(outcome("kill -9 $$", false), Progress::Failed(_)), "killed");
    }

    #[test]
    #[cfg(unix)]
    fn a_cancelled_program_ends_at_once() {
        let started = Instant::now();
        assert_eq!(outcome("exec sleep 30", true), Progress::Cancelled, "by the user");
        assert!(started.elapsed().as_secs() < 10, "{:?}", started.elapsed());
    }

    #[test]
    fn a_missing_program_is_named() {
        let order =
            Order { verb: "render", scene_text: String::new(), output: PathBuf::from("a.png"), options: vec![] };
        let error = Job::start_program(Path::new("/nowhere/tyndall"), &order, || {}).unwrap_err();
        assert!(error.to_string().contains("/nowhere/tyndall"), "{error}");
    }
}

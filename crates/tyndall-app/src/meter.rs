//! A comparison that runs in a thread, tells how far it is and can be stopped.

use std::{
    sync::{
        Arc,
        atomic::{AtomicBool, AtomicU32, Ordering},
        mpsc::{Receiver, TryRecvError, channel},
    },
    thread,
    time::{Duration, Instant},
};

/// Time between two signs of progress.
const TELL_EVERY: Duration = Duration::from_millis(100);

/// A comparison that has come to its end.
#[derive(Clone, Debug)]
pub(crate) struct Outcome<S, R> {
    /// What was judged.
    pub(crate) subject: S,
    /// What was found.
    pub(crate) report: R,
    /// How long it took.
    pub(crate) seconds: f64,
}

/// A comparison under way.
#[derive(Debug)]
struct Run<S, R> {
    subject: S,
    started: Instant,
    /// Bits of the share that is done.
    done: Arc<AtomicU32>,
    cancelled: Arc<AtomicBool>,
    result: Receiver<Result<Option<R>, String>>,
}

/// The comparison's end of [`Run`].
struct Watch {
    done: Arc<AtomicU32>,
    cancelled: Arc<AtomicBool>,
    /// Signs of progress given so far, in units of [`TELL_EVERY`].
    told: AtomicU32,
}

impl Watch {
    /// Notes the share that is done, and wakes the window now and then; whether to go on.
    fn tell(&self, share: f64, since_start: Duration, wake: &impl Fn()) -> bool {
        #[expect(clippy::cast_possible_truncation, reason = "a progress bar needs no more")]
        self.done.store((share as f32).to_bits(), Ordering::Relaxed);
        let due = u32::try_from(since_start.as_millis() / TELL_EVERY.as_millis()).unwrap_or(u32::MAX);
        if self.told.swap(due, Ordering::Relaxed) < due {
            wake();
        }
        !self.cancelled.load(Ordering::Relaxed)
    }
}

/// Works on all threads but one, which draws the frames meanwhile.
fn with_a_thread_to_spare<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    let threads = thread::available_parallelism().map_or(1, |count| count.get().saturating_sub(1).max(1));
    match rayon::ThreadPoolBuilder::new().num_threads(threads).build() {
        Ok(pool) => pool.install(work),
        Err(_no_threads) => work(),
    }
}

impl<S, R> Drop for Run<S, R> {
    /// A closed window leaves no thread at work.
    fn drop(&mut self) {
        self.cancelled.store(true, Ordering::Relaxed);
    }
}

/// The comparison under way, and the last one that came to its end.
#[derive(Debug)]
pub(crate) struct Meter<S, R> {
    run: Option<Run<S, R>>,
    outcome: Option<Outcome<S, R>>,
    /// Why the last one failed.
    error: Option<String>,
}

impl<S, R> Default for Meter<S, R> {
    fn default() -> Self {
        Self { run: None, outcome: None, error: None }
    }
}

impl<S: Clone + Send + Sync + 'static, R: Send + 'static> Meter<S, R> {
    /// Starts a comparison; `compare` is given what tells the share that is done and whether to go on, and `wake` is called
    /// from its thread whenever there is news.
    pub(crate) fn start(
        &mut self,
        subject: S,
        compare: impl FnOnce(&S, &(dyn Fn(f64) -> bool + Sync)) -> Result<Option<R>, String> + Send + 'static,
        wake: impl Fn() + Send + Sync + 'static,
    ) {
        let (done, cancelled) = (Arc::new(AtomicU32::new(0)), Arc::new(AtomicBool::new(false)));
        let watch = Watch { done: Arc::clone(&done), cancelled: Arc::clone(&cancelled), told: AtomicU32::new(0) };
        let (sender, result) = channel();
        let judged = subject.clone();
        let work = move || {
            let started = Instant::now();
            let progress = |share: f64| watch.tell(share, started.elapsed(), &wake);
            let report = with_a_thread_to_spare(|| compare(&judged, &progress));
            if sender.send(report).is_ok() {
                wake();
            }
        };
        self.error = thread::Builder::new().name("error meter".to_owned()).spawn(work).err().map(|e| e.to_string());
        self.run = Some(Run { subject, started: Instant::now(), done, cancelled, result });
    }

    /// Stops the comparison under way.
    pub(crate) fn cancel(&mut self) {
        self.run = None;
    }

    /// Takes in what has come; the share that is done while a comparison is under way.
    pub(crate) fn progress(&mut self) -> Option<f32> {
        let run = self.run.as_ref()?;
        match run.result.try_recv() {
            Err(TryRecvError::Empty) => return Some(f32::from_bits(run.done.load(Ordering::Relaxed))),
            Ok(Ok(Some(report))) => {
                let (subject, seconds) = (run.subject.clone(), run.started.elapsed().as_secs_f64());
                self.outcome = Some(Outcome { subject, report, seconds });
            }
            Ok(Err(error)) => self.error = Some(error),
            Ok(Ok(None)) | Err(TryRecvError::Disconnected) => {}
        }
        self.run = None;
        None
    }

    /// The last comparison that came to its end.
    pub(crate) fn outcome(&self) -> Option<&Outcome<S, R>> {
        self.outcome.as_ref()
    }

    /// Why the last one failed.
    pub(crate) fn error(&self) -> Option<&str> {
        self.error.as_deref()
    }
}

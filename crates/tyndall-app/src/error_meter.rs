//! The tables of the scene's sky against Monte-Carlo, in a thread that tells how far it is and can be stopped.

use std::{
    sync::{
        Arc,
        atomic::{AtomicBool, AtomicU32, Ordering},
        mpsc::{Receiver, TryRecvError, channel},
    },
    thread,
    time::{Duration, Instant},
};

use tyndall_scattering::{
    Atmosphere,
    orders::OrdersQuality,
    validate::{Report, ValidateOptions, validate},
};
use tyndall_scene::{Orders, OrdersDetail, Scene};

/// Time between two signs of progress.
const TELL_EVERY: Duration = Duration::from_millis(100);

/// How long the user is ready to wait.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Thoroughness {
    #[default]
    Quick,
    Normal,
    Thorough,
}

impl Thoroughness {
    /// All, the quickest first.
    pub(crate) const ALL: [Self; 3] = [Self::Quick, Self::Normal, Self::Thorough];

    /// Name of the choice, and what it takes.
    pub(crate) fn label(self) -> (&'static str, &'static str) {
        match self {
            Self::Quick => ("Quick", "40 directions, 2048 walks each: about two seconds, noise of one per cent."),
            Self::Normal => ("Normal", "60 directions, 8192 walks each: about ten seconds."),
            Self::Thorough => ("Thorough", "200 directions, 65536 walks each: minutes, noise of a few per mille."),
        }
    }

    /// Directions and walks in each.
    fn size(self) -> (usize, u32) {
        match self {
            Self::Quick => (40, 2048),
            Self::Normal => (60, 8192),
            Self::Thorough => (200, 65_536),
        }
    }
}

/// What is judged.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Subject {
    model: Atmosphere,
    quality: OrdersQuality,
    altitude_m: f64,
    mu_sun: f64,
}

impl Subject {
    /// The sky of a scene; `None` when it has no sun.
    pub(crate) fn of(scene: &Scene) -> Option<Self> {
        let quality = match (scene.sky.orders, scene.sky.orders_detail) {
            (Orders::Nishita1996, _) => OrdersQuality::nishita1996(),
            (Orders::Single | Orders::All, OrdersDetail::Preview) => OrdersQuality::preview(),
            (Orders::Single | Orders::All, OrdersDetail::Best) => OrdersQuality::best(),
        };
        let mu_sun = scene.sun_direction().ok()?.elevation_rad.sin();
        Some(Self { model: scene.model(), quality, altitude_m: scene.camera.altitude_m, mu_sun })
    }
}

/// A comparison that has come to its end.
#[derive(Clone, Debug)]
pub(crate) struct Outcome {
    /// What was judged.
    pub(crate) subject: Subject,
    /// Errors by part of the sky.
    pub(crate) report: Report,
    /// How long it took.
    pub(crate) seconds: f64,
}

/// A comparison under way.
#[derive(Debug)]
struct Run {
    subject: Subject,
    started: Instant,
    /// Bits of the share that is done.
    done: Arc<AtomicU32>,
    cancelled: Arc<AtomicBool>,
    result: Receiver<Result<Option<Report>, String>>,
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

impl Drop for Run {
    /// A closed window leaves no thread at work.
    fn drop(&mut self) {
        self.cancelled.store(true, Ordering::Relaxed);
    }
}

/// The comparison under way, and the last one that came to its end.
#[derive(Debug, Default)]
pub(crate) struct ErrorMeter {
    run: Option<Run>,
    outcome: Option<Outcome>,
    /// Why the last one failed.
    error: Option<String>,
}

impl ErrorMeter {
    /// Starts a comparison; `wake` is called from its thread whenever there is news.
    pub(crate) fn start(
        &mut self,
        subject: Subject,
        thoroughness: Thoroughness,
        wake: impl Fn() + Send + Sync + 'static,
    ) {
        let (directions, paths) = thoroughness.size();
        let options = ValidateOptions { directions, paths, quality: subject.quality, ..ValidateOptions::default() };
        let (done, cancelled) = (Arc::new(AtomicU32::new(0)), Arc::new(AtomicBool::new(false)));
        let watch = Watch { done: Arc::clone(&done), cancelled: Arc::clone(&cancelled), told: AtomicU32::new(0) };
        let (sender, result) = channel();
        let judged = subject.clone();
        let work = move || {
            let started = Instant::now();
            let progress = |share: f64| watch.tell(share, started.elapsed(), &wake);
            let observer = (judged.altitude_m, judged.mu_sun);
            let report = with_a_thread_to_spare(|| validate(&judged.model, observer, &options, &progress));
            if sender.send(report.map_err(|error| error.to_string())).is_ok() {
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
    pub(crate) fn outcome(&self) -> Option<&Outcome> {
        self.outcome.as_ref()
    }

    /// Why the last one failed.
    pub(crate) fn error(&self) -> Option<&str> {
        self.error.as_deref()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn subject(change: impl FnOnce(&mut Scene)) -> Subject {
        let mut scene = Scene::default();
        scene.sky.orders_detail = OrdersDetail::Preview;
        change(&mut scene);
        Subject::of(&scene).expect("a scene with a sun")
    }

    #[test]
    fn a_comparison_runs_to_its_end_and_tells_its_progress() {
        let (sender, woken) = channel();
        let mut meter = ErrorMeter::default();
        meter.start(subject(|_| {}), Thoroughness::Quick, move || sender.send(()).unwrap_or_default());
        let mut shares = Vec::new();
        while let Some(share) = meter.progress() {
            shares.push(share);
            woken.recv_timeout(Duration::from_mins(2)).expect("news in time");
        }
        assert!(shares.is_sorted(), "progress never falls: {shares:?}");
        let outcome = meter.outcome().expect("a report");
        assert_eq!(outcome.report.rows.len(), Thoroughness::Quick.size().0, "all directions");
        // The preview's tables are good to a few per cent, and so is the noise of 2048 walks.
        let whole = outcome.report.whole();
        assert!(whole.luminance.median_pct < 5.0, "{whole:?}");
    }

    #[test]
    fn a_cancelled_comparison_leaves_no_report() {
        let mut meter = ErrorMeter::default();
        meter.start(subject(|_| {}), Thoroughness::Thorough, || {});
        meter.cancel();
        assert!(meter.progress().is_none() && meter.outcome().is_none(), "nothing is left");
    }

    #[test]
    fn another_air_is_another_subject_and_another_title_is_not() {
        let subjects = [subject(|_| {}), subject(|scene| scene.title = "Mine".to_owned())];
        assert_eq!(subjects[0], subjects[1], "the title changes no sky");
        assert_ne!(subjects[0], subject(|scene| scene.atmosphere.ozone_du = 100.0), "less ozone");
    }
}

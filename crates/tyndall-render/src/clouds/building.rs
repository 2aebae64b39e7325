//! When the clouds' volume is made: before the frame that shows it, or by a thread beside the frames.
//!
//! A thread works at the newest request only. A simulation that nobody waits for any longer is given up, unless it is done
//! soon: while a slider is dragged, quick ones are shown one after the other.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use tyndall_core::array::NamedArrays;

use super::maker::{Volume, VolumeMaker};
use super::report::CloudReport;
use super::request::VolumeRequest;
use crate::RenderError;
use crate::sky::{TableBuilding, Wake};

/// How long a simulation may go on that has been overtaken by a newer request.
const PATIENCE: Duration = Duration::from_millis(300);

/// How the clouds stand after a frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CloudProgress {
    /// Whether the clouds shown are not yet those of the scene.
    pub building: bool,
    /// Figures of the clouds shown; `None` without any.
    pub report: Option<Arc<CloudReport>>,
}

/// What a thread has made: a request and its volume, or why there is none.
pub(super) type Made = (VolumeRequest, Result<Volume, RenderError>);

/// Who makes volumes.
#[derive(Debug)]
pub(super) enum Making {
    /// The frame waits.
    Blocking(Box<VolumeMaker>),
    /// A thread does.
    Background(Box<Worker>),
}

impl Default for Making {
    fn default() -> Self {
        Self::Blocking(Box::default())
    }
}

impl Making {
    /// One that has made nothing yet.
    pub(super) fn new(building: TableBuilding) -> Self {
        match building {
            TableBuilding::Blocking => Self::default(),
            TableBuilding::Background(wake) => Self::Background(Box::new(Worker::start(wake))),
        }
    }

    /// What has been made since the last call; `wanted` is what the frame lacks.
    pub(super) fn next(&mut self, wanted: Option<&VolumeRequest>) -> Option<Made> {
        match self {
            Self::Blocking(maker) => {
                let request = wanted?;
                maker.make(request, &|| false).transpose().map(|made| (request.clone(), made))
            }
            Self::Background(worker) => {
                // Taken first, so that no frame shows what it has asked for itself: what it shows hangs on no race.
                let made = worker.made.try_iter().last();
                if let Some(request) = wanted {
                    worker.request(request);
                }
                made
            }
        }
    }

    /// Chooses the state from which simulations start.
    pub(super) fn start_from(&mut self, state: Option<NamedArrays>) {
        match self {
            Self::Blocking(maker) => maker.start_from(state),
            Self::Background(worker) => {
                worker.cancel();
                // Without a thread there are no clouds anyway.
                drop(worker.orders.send(Order::Start(state)));
            }
        }
    }

    /// Gives up what is being made.
    pub(super) fn cancel(&mut self) {
        if let Self::Background(worker) = self {
            worker.cancel();
        }
    }
}

/// What a thread is told.
#[derive(Debug)]
enum Order {
    /// To start simulations from a state.
    Start(Option<NamedArrays>),
    /// To make a volume; the number of the request is its place among all.
    Make(u64, Box<VolumeRequest>),
}

/// A thread that makes volumes.
#[derive(Debug)]
pub(super) struct Worker {
    orders: Sender<Order>,
    made: Receiver<Made>,
    asked: Option<VolumeRequest>,
    /// Number of the newest request.
    newest: Arc<AtomicU64>,
}

impl Worker {
    /// Starts the thread; it ends with this value.
    fn start(wake: Wake) -> Self {
        let (orders, received) = channel();
        let (sender, made) = channel();
        let newest = Arc::new(AtomicU64::new(0));
        let current = Arc::clone(&newest);
        let work = move || {
            let mut maker = VolumeMaker::default();
            while let Ok(first) = received.recv() {
                let Some((number, request)) = newest_of(&mut maker, first, &received) else { continue };
                let started = Instant::now();
                let is_stale = || current.load(Ordering::Acquire) != number && started.elapsed() > PATIENCE;
                let Some(volume) = maker.make(&request, &is_stale).transpose() else { continue };
                if sender.send((request, volume)).is_err() {
                    return;
                }
                wake.call();
            }
        };
        // Frames are drawn meanwhile, by the same processor: they keep a thread.
        let threads = thread::available_parallelism().map_or(1, |count| count.get().saturating_sub(1).max(1));
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let work = move || match pool {
            Ok(pool) => pool.install(work),
            Err(_no_threads) => work(),
        };
        // Without a thread the channel is closed, and the scene is shown without clouds.
        drop(thread::Builder::new().name("clouds".to_owned()).spawn(work));
        Self { orders, made, asked: None, newest }
    }

    /// Asks for a volume, unless it was asked for last.
    fn request(&mut self, request: &VolumeRequest) {
        if self.asked.as_ref() == Some(request) {
            return;
        }
        let number = self.newest.fetch_add(1, Ordering::AcqRel) + 1;
        if self.orders.send(Order::Make(number, Box::new(request.clone()))).is_ok() {
            self.asked = Some(request.clone());
        }
    }

    fn cancel(&mut self) {
        self.asked = None;
        self.newest.fetch_add(1, Ordering::AcqRel);
    }
}

/// The newest of the volumes asked for so far; states to start from are passed on.
fn newest_of(maker: &mut VolumeMaker, first: Order, received: &Receiver<Order>) -> Option<(u64, VolumeRequest)> {
    let mut newest = None;
    for order in std::iter::once(first).chain(received.try_iter()) {
        match order {
            Order::Start(state) => maker.start_from(state),
            Order::Make(number, request) => newest = Some((number, *request)),
        }
    }
    newest
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.cancel();
    }
}

//! When the desert is simulated: before the frame that shows it, or by a thread beside the frames.
//!
//! A thread works at the newest request only, gives up what nobody waits for any longer, and shows how far it is while steps
//! go on for long.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use tyndall_core::array::NamedArrays;
use tyndall_core::table_store::TableStore;
use tyndall_dunes::DuneStepper;

use super::maker::{BedMaker, BedRequest, MadeBed};
use crate::RenderError;
use crate::sky::{TableBuilding, Wake};

/// How long a simulation may go on that has been overtaken by a newer request.
const PATIENCE: Duration = Duration::from_millis(300);

/// Least time between two looks at a simulation that is still going on.
const LOOK_EVERY: Duration = Duration::from_millis(500);

/// Least time between two looks in times of what one costs.
const LOOK_COSTS: u32 = 6;

/// What has been made: a request and its bed, or why there is none.
pub(super) type Made = (BedRequest, Result<MadeBed, RenderError>);

/// Who makes beds.
#[derive(Debug)]
pub(super) enum Making {
    /// The frame waits.
    Blocking(Box<BedMaker>),
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

    /// Chooses where fields are kept between runs.
    pub(super) fn set_store(&mut self, store: Option<Arc<dyn TableStore>>) {
        match self {
            Self::Blocking(maker) => maker.set_store(store),
            // Without a thread there is no sand anyway.
            Self::Background(worker) => drop(worker.orders.send(Order::Keep(store))),
        }
    }

    /// Chooses a state that fields start from.
    pub(super) fn start_from(&mut self, state: Option<NamedArrays>) {
        match self {
            Self::Blocking(maker) => maker.start_from(state),
            // Without a thread there is no sand anyway.
            Self::Background(worker) => drop(worker.orders.send(Order::Start(state))),
        }
    }

    /// Chooses who makes steps; the processor unless chosen.
    pub(super) fn set_stepper(&mut self, device: Option<Box<dyn DuneStepper>>) {
        match self {
            Self::Blocking(maker) => maker.set_stepper(device),
            // Without a thread there is no sand anyway.
            Self::Background(worker) => drop(worker.orders.send(Order::Step(device))),
        }
    }

    /// What has been made since the last call; `wanted` is what the frame lacks.
    pub(super) fn next(&mut self, wanted: Option<&BedRequest>) -> Option<Made> {
        match self {
            Self::Blocking(maker) => {
                let request = wanted?;
                maker.make(request, &|_step| false).transpose().map(|made| (request.clone(), made))
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
    /// To keep fields in a store.
    Keep(Option<Arc<dyn TableStore>>),
    /// To start fields from a state.
    Start(Option<NamedArrays>),
    /// To let a device make steps, or the processor.
    Step(Option<Box<dyn DuneStepper>>),
    /// To make a bed; the number of the request is its place among all.
    Make(u64, Box<BedRequest>),
}

/// A thread that makes beds.
#[derive(Debug)]
pub(super) struct Worker {
    orders: Sender<Order>,
    made: Receiver<Made>,
    asked: Option<BedRequest>,
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
            let mut maker = BedMaker::default();
            while let Ok(first) = received.recv() {
                let Some((number, request)) = newest_of(&mut maker, first, &received) else { continue };
                let is_overtaken = || current.load(Ordering::Acquire) != number;
                let send = |made| {
                    let sent = sender.send((BedRequest::clone(&request), made)).is_ok();
                    wake.call();
                    sent
                };
                if !make_with_looks(&mut maker, &request, &is_overtaken, send) {
                    return;
                }
            }
        };
        // Frames are drawn meanwhile, by the same processor: they keep a thread.
        let threads = thread::available_parallelism().map_or(1, |count| count.get().saturating_sub(1).max(1));
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let work = move || match pool {
            Ok(pool) => pool.install(work),
            Err(_no_threads) => work(),
        };
        // Without a thread the channel is closed, and the scene is shown without sand.
        drop(thread::Builder::new().name("desert".to_owned()).spawn(work));
        Self { orders, made, asked: None, newest }
    }

    /// Asks for a bed, unless it was asked for last.
    fn request(&mut self, request: &BedRequest) {
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

/// The newest of the beds asked for so far; what else it is told is passed on.
fn newest_of(maker: &mut BedMaker, first: Order, received: &Receiver<Order>) -> Option<(u64, BedRequest)> {
    let mut newest = None;
    for order in std::iter::once(first).chain(received.try_iter()) {
        match order {
            Order::Keep(store) => maker.set_store(store),
            Order::Start(state) => maker.start_from(state),
            Order::Step(device) => maker.set_stepper(device),
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

/// Makes a bed and sends it, and now and then one on the way there; false when nobody listens any longer.
fn make_with_looks(
    maker: &mut BedMaker,
    request: &BedRequest,
    is_overtaken: &dyn Fn() -> bool,
    send: impl Fn(Result<MadeBed, RenderError>) -> bool,
) -> bool {
    let mut pause = LOOK_EVERY;
    let started = Instant::now();
    loop {
        let looked = Instant::now();
        let gives_up = || is_overtaken() && started.elapsed() > PATIENCE;
        let made = maker.make(request, &|_step| gives_up() || looked.elapsed() > pause).transpose();
        if let Some(made) = made {
            return send(made);
        }
        if gives_up() {
            return true;
        }
        let looking = Instant::now();
        if let Some(look) = maker.look(request, true) {
            if !send(look) {
                return false;
            }
            pause = LOOK_EVERY.max(looking.elapsed() * LOOK_COSTS);
        }
    }
}

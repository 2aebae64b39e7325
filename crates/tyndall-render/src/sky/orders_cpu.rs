//! The orders table made by the CPU, while the caller waits or in threads of their own.

use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Instant;

use tyndall_core::spectrum::WAVELENGTH_COUNT;
use tyndall_core::table_store::TableStore;
use tyndall_scattering::Atmosphere as Model;
use tyndall_scattering::ScatteringError;
use tyndall_scattering::atmosphere::{AEROSOL, AIR, OZONE};
use tyndall_scattering::column_table::ColumnTable;
use tyndall_scattering::march::Marcher;
use tyndall_scattering::medium::Profile;
use tyndall_scattering::orders::basis::harmonic_count;
use tyndall_scattering::orders::{OrdersQuality, SourceTable};

use super::building::Wake;
use super::orders::Wanted;

/// Panels of the f64 march.
const PANELS: usize = 8;

/// Tables that may be under way at a time: a fine one that nobody waits for any longer, and the one that is wanted.
const JOBS: usize = 2;

/// Radius (m), altitude of the top (m) and the density profiles of air, aerosol and ozone: what the table of columns
/// follows from.
type Shape = (f64, f64, [Profile; 3]);

/// One value per wavelength and harmonic or sun, in the layout of `shaders/sky/orders.wgsl`.
pub(super) type Values = Vec<[f32; WAVELENGTH_COUNT]>;

/// A table, ready to be uploaded.
#[derive(Debug)]
pub(super) struct Finished {
    pub(super) wanted: Wanted,
    pub(super) values: Values,
    pub(super) ms: f64,
}

/// Version of the tables' method and layout; raised when either changes, so that no older table is taken for a new one.
const TABLE_VERSION: u32 = 1;

/// Makes tables and remembers the columns of the last atmosphere.
#[derive(Debug, Default)]
pub(super) struct CpuBuilder {
    /// Where tables are kept between runs.
    store: Option<Arc<dyn TableStore>>,
    columns: Arc<Mutex<Option<(Shape, ColumnTable)>>>,
    jobs: Vec<Job>,
    /// Jobs started so far.
    started: u64,
    /// The latest job whose table was handed out.
    taken: u64,
}

#[derive(Debug)]
struct Job {
    number: u64,
    wanted: Wanted,
    result: Receiver<Finished>,
}

impl CpuBuilder {
    /// Chooses where tables are kept between runs.
    pub(super) fn set_store(&mut self, store: Option<Arc<dyn TableStore>>) {
        self.store = store;
    }

    /// Makes a table while the caller waits, on all threads, unless an earlier run has kept it. Tables from threads of
    /// their own are not kept: a slider that is dragged leaves hundreds behind.
    pub(super) fn build(&self, model: &Model, wanted: &Wanted) -> Result<Finished, ScatteringError> {
        let Some(store) = &self.store else { return build(&self.columns, model, wanted) };
        let (started, key) = (Instant::now(), key(model, &wanted.quality));
        if let Some(values) = store.load(&key).and_then(|bytes| values_from(&bytes, &wanted.quality)) {
            return Ok(Finished { wanted: wanted.clone(), values, ms: started.elapsed().as_secs_f64() * 1e3 });
        }
        let table = build(&self.columns, model, wanted)?;
        let bytes: Vec<u8> = table.values.iter().flatten().flat_map(|value| value.to_le_bytes()).collect();
        store.store(&key, &bytes);
        Ok(table)
    }

    /// Sees to it that `wanted` is being made, or will be once there is room for another job.
    pub(super) fn request(&mut self, model: &Model, wanted: &Wanted, wake: &Wake) {
        let is_known = self.jobs.iter().any(|job| job.wanted == *wanted);
        // A second table of the same quality would only delay the first: the newest values come after it.
        let is_busy = self.jobs.iter().any(|job| job.wanted.quality == wanted.quality);
        if is_known || is_busy || self.jobs.len() == JOBS {
            return;
        }
        self.started += 1;
        let (sender, result) = channel();
        let (columns, model, wake) = (Arc::clone(&self.columns), model.clone(), wake.clone());
        let job = Job { number: self.started, wanted: wanted.clone(), result };
        let wanted = wanted.clone();
        let work = move || {
            // Frames are drawn meanwhile, by the same processor: they keep a thread.
            let threads = thread::available_parallelism().map_or(1, |count| count.get().saturating_sub(1).max(1));
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            let table = match pool {
                Ok(pool) => pool.install(|| build(&columns, &model, &wanted)),
                Err(_no_threads) => build(&columns, &model, &wanted),
            };
            // The receiver is gone when the renderer is; wrong atmospheres are refused before a job starts.
            if table.is_ok_and(|table| sender.send(table).is_ok()) {
                wake.call();
            }
        };
        if thread::Builder::new().name("sky tables".to_owned()).spawn(work).is_ok() {
            self.jobs.push(job);
        }
    }

    /// The newest table that has come and is newer than the last one; jobs that have ended make room.
    pub(super) fn take(&mut self) -> Option<Finished> {
        let mut newest: Option<(u64, Finished)> = None;
        self.jobs.retain(|job| match job.result.try_recv() {
            Ok(table) => {
                if job.number > newest.as_ref().map_or(self.taken, |(number, _)| *number) {
                    newest = Some((job.number, table));
                }
                false
            }
            Err(TryRecvError::Empty) => true,
            Err(TryRecvError::Disconnected) => false,
        });
        let (number, table) = newest?;
        self.taken = number;
        Some(table)
    }

    /// Drops the results of everything that was started before.
    pub(super) fn outdate(&mut self) {
        self.taken = self.started;
    }
}

/// Everything that a table follows from. The debug text holds every field with as many digits as tell it from its
/// neighbours, those of later versions too.
fn key(model: &Model, quality: &OrdersQuality) -> String {
    format!("orders {TABLE_VERSION}, {PANELS} panels, {quality:?}, {model:?}")
}

/// The table of kept bytes; `None` if they are not as many as it has.
fn values_from(bytes: &[u8], quality: &OrdersQuality) -> Option<Values> {
    let (spectra, rest) = bytes.as_chunks::<{ 4 * WAVELENGTH_COUNT }>();
    let count = quality.suns() * (quality.altitudes * harmonic_count(quality.degree) + 1);
    if !rest.is_empty() || spectra.len() != count {
        return None;
    }
    let spectrum = |bytes: &[u8; 4 * WAVELENGTH_COUNT]| {
        let values = bytes.as_chunks::<4>().0;
        std::array::from_fn(|k| f32::from_le_bytes(values[k]))
    };
    Some(spectra.iter().map(spectrum).collect())
}

fn build(
    columns: &Mutex<Option<(Shape, ColumnTable)>>,
    model: &Model,
    wanted: &Wanted,
) -> Result<Finished, ScatteringError> {
    let started = Instant::now();
    let source = source(&marcher(columns, model)?, &wanted.quality);
    let ms = started.elapsed().as_secs_f64() * 1e3;
    Ok(Finished { wanted: wanted.clone(), values: source, ms })
}

fn source(marcher: &Marcher, quality: &OrdersQuality) -> Values {
    let source = SourceTable::new(marcher, quality);
    source.field().harmonics.iter().copied().chain(source.irradiance_beyond_first_nodes()).collect()
}

/// The march of an atmosphere. Its columns do not depend on how much of each medium there is: they are kept while the
/// profiles stay the same.
fn marcher(columns: &Mutex<Option<(Shape, ColumnTable)>>, model: &Model) -> Result<Marcher, ScatteringError> {
    let coefficients = model.coefficients()?;
    let profiles = [AIR, AEROSOL, OZONE].map(|medium| model.media[medium].profile);
    let shape = (model.planet_radius_m, model.top_altitude_m, profiles);
    // Another thread's panic leaves whole values behind: they are replaced, never changed.
    let kept = columns.lock().unwrap_or_else(PoisonError::into_inner).clone();
    let columns_here = match kept {
        Some((of, table)) if of == shape => table,
        _ => {
            let table = ColumnTable::new(model);
            *columns.lock().unwrap_or_else(PoisonError::into_inner) = Some((shape, table.clone()));
            table
        }
    };
    let columns = columns_here.with_haze_of(model);
    Ok(Marcher { atmosphere: model.clone(), coefficients, columns, panels: PANELS })
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;
    use std::time::Duration;

    use tyndall_scattering::orders::OrdersMethod;
    use tyndall_scattering::params::{AtmosphereParams, GroundParams};

    use super::*;

    /// Small enough for a test, with every part that a table has.
    const QUALITY: OrdersQuality = OrdersQuality {
        method: OrdersMethod::Harmonics,
        altitudes: 4,
        haze_altitudes: 0,
        suns_above: 4,
        suns_below: 3,
        zeniths: 2,
        azimuths: 2,
        panels: 2,
        orders: 3,
        degree: 2,
    };

    fn atmosphere(ozone_du: f64) -> (Model, Wanted) {
        let params = AtmosphereParams { ozone_du, ..AtmosphereParams::default() };
        let model = Model::new(&params, &GroundParams::default());
        let wanted = Wanted::new(&model, QUALITY).unwrap();
        (model, wanted)
    }

    fn waiting() -> (Wake, Receiver<()>) {
        let (sender, woken) = channel();
        (Wake::new(move || sender.send(()).unwrap_or_default()), woken)
    }

    const PATIENCE: Duration = Duration::from_mins(1);

    #[test]
    fn a_table_from_a_thread_has_the_bits_of_the_one_that_was_waited_for() {
        let (mut builder, (wake, woken)) = (CpuBuilder::default(), waiting());
        let (model, wanted) = atmosphere(300.0);
        builder.request(&model, &wanted, &wake);
        woken.recv_timeout(PATIENCE).expect("a table in time");
        let table = builder.take().expect("the table");
        assert_eq!(table.values, builder.build(&model, &wanted).unwrap().values, "same bits");
        assert!(table.wanted == wanted && builder.jobs.is_empty(), "nothing else is under way");
    }

    #[test]
    fn while_one_is_made_no_second_one_of_its_quality_is_started() {
        let (mut builder, (wake, woken)) = (CpuBuilder::default(), waiting());
        for ozone_du in [300.0, 310.0, 320.0, 330.0] {
            let (model, wanted) = atmosphere(ozone_du);
            builder.request(&model, &wanted, &wake);
        }
        woken.recv_timeout(PATIENCE).expect("a table in time");
        assert!(builder.take().is_some_and(|table| table.wanted == atmosphere(300.0).1), "the first one");
        assert!(woken.recv_timeout(Duration::from_millis(100)).is_err(), "and no other");
    }

    #[test]
    fn an_outdated_table_is_dropped() {
        let (mut builder, (wake, woken)) = (CpuBuilder::default(), waiting());
        let (model, wanted) = atmosphere(300.0);
        builder.request(&model, &wanted, &wake);
        builder.outdate();
        woken.recv_timeout(PATIENCE).expect("a table in time");
        assert!(builder.take().is_none() && builder.jobs.is_empty(), "it is collected and not shown");
    }

    /// Keeps tables in memory, and counts what it is asked for.
    #[derive(Debug, Default)]
    struct Memory(Mutex<BTreeMap<String, Vec<u8>>>);

    impl TableStore for Memory {
        fn load(&self, key: &str) -> Option<Vec<u8>> {
            self.0.lock().expect("no panic").get(key).cloned()
        }

        fn store(&self, key: &str, bytes: &[u8]) {
            self.0.lock().expect("no panic").insert(key.to_owned(), bytes.to_vec());
        }
    }

    fn with_store(store: &Arc<Memory>) -> CpuBuilder {
        let mut builder = CpuBuilder::default();
        builder.set_store(Some(Arc::<Memory>::clone(store)));
        builder
    }

    #[test]
    fn a_kept_table_has_the_bits_of_a_new_one() {
        let store = Arc::new(Memory::default());
        let (model, wanted) = atmosphere(300.0);
        let made = with_store(&store).build(&model, &wanted).unwrap().values;
        assert_eq!(store.0.lock().unwrap().len(), 1, "kept");
        assert_eq!(with_store(&store).build(&model, &wanted).unwrap().values, made, "taken from the store");
        assert_eq!(CpuBuilder::default().build(&model, &wanted).unwrap().values, made, "made without one");
    }

    #[test]
    fn another_atmosphere_or_quality_has_another_key_and_bytes_of_another_size_are_refused() {
        let (model, wanted) = atmosphere(300.0);
        let coarser = OrdersQuality { altitudes: 3, ..QUALITY };
        assert_ne!(key(&model, &QUALITY), key(&atmosphere(300.0000001).0, &QUALITY), "atmospheres");
        assert_ne!(key(&model, &QUALITY), key(&model, &coarser), "qualities");
        let store = Arc::new(Memory::default());
        store.store(&key(&model, &QUALITY), &[0; 64]);
        let values = with_store(&store).build(&model, &wanted).unwrap().values;
        assert_eq!(values, CpuBuilder::default().build(&model, &wanted).unwrap().values, "made anew");
    }
}

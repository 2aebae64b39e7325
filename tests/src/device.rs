//! The adapter that the tests run on.

use std::sync::OnceLock;

use tyndall_gpu::{AdapterChoice, Gpu, GpuError, GpuOptions};

/// Names the adapter to test on, written as `--adapter` takes it.
const ADAPTER_VARIABLE: &str = "TYNDALL_TEST_ADAPTER";

/// The device that all tests of a process share: the software adapter, or without one any other; the environment variable
/// `TYNDALL_TEST_ADAPTER` names another.
///
/// # Panics
/// When there is no adapter, with the sentence that says what to install. Tests are never skipped: a skip looks like
/// success.
pub fn gpu() -> &'static Gpu {
    static GPU: OnceLock<Gpu> = OnceLock::new();
    GPU.get_or_init(own_gpu)
}

/// A device of one's own, for tests that destroy it or fill its memory.
///
/// # Panics
/// As [`gpu`].
pub fn own_gpu() -> Gpu {
    open().unwrap_or_else(|error| panic!("this test needs a graphics adapter: {error}"))
}

fn open() -> Result<Gpu, GpuError> {
    let options = |adapter| GpuOptions { adapter, max_memory_bytes: None };
    if let Ok(named) = std::env::var(ADAPTER_VARIABLE) {
        return Gpu::open(&options(named.parse()?));
    }
    Gpu::open(&options(AdapterChoice::Software)).or_else(|_no_software| Gpu::open(&options(AdapterChoice::Auto)))
}

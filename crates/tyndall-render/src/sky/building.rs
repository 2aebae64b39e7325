//! When slow tables are made: before the frame that needs them, or beside the frames.

use std::{fmt, sync::Arc};

/// Called from another thread when a frame would show more than the last one.
#[derive(Clone)]
pub struct Wake(Arc<dyn Fn() + Send + Sync>);

impl Wake {
    /// Wraps a function; it must return quickly.
    #[must_use]
    pub fn new(wake: impl Fn() + Send + Sync + 'static) -> Self {
        Self(Arc::new(wake))
    }

    /// Calls it.
    pub fn call(&self) {
        (self.0)();
    }
}

impl fmt::Debug for Wake {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("Wake")
    }
}

/// When the table of all orders of scattering is made, and the clouds.
#[derive(Clone, Debug, Default)]
pub enum TableBuilding {
    /// The frame waits for it: a picture follows from its scene alone.
    #[default]
    Blocking,
    /// Frames show the table before, with the new medium's coefficients, until the new one is there; only the very first
    /// one is waited for. A software adapter's table is made by a thread, which calls [`Wake`] at the end; a GPU's is
    /// spread over the frames that follow. Clouds are simulated by a thread, the first ones too.
    Background(Wake),
}

/// How the table stands after a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TableProgress {
    /// Whether the table shown is not yet that of the scene.
    pub building: bool,
    /// Share of the work that is done, where frames do it.
    pub done: Option<f32>,
    /// Whether another frame would bring the table forward now. Otherwise the frame can wait for [`Wake`].
    pub needs_frame: bool,
    /// How long the table shown took to make (ms); `None` before the first.
    pub last_ms: Option<f64>,
}

//! A device that makes steps, passed on from one maker of beds to the next.

use std::error::Error;
use std::sync::{Arc, Mutex, PoisonError};

use tyndall_dunes::DuneStepper;
use tyndall_dunes::slab::DuneField;

/// The same device for all clones.
#[derive(Clone, Debug)]
pub(super) struct SharedStepper(Arc<Mutex<Box<dyn DuneStepper>>>);

impl SharedStepper {
    pub(super) fn new(device: Box<dyn DuneStepper>) -> Self {
        Self(Arc::new(Mutex::new(device)))
    }
}

impl DuneStepper for SharedStepper {
    fn advance(&mut self, field: &DuneField, steps: u32) -> Result<DuneField, Box<dyn Error + Send + Sync>> {
        // A maker that was overtaken ends the few steps that it has begun.
        self.0.lock().unwrap_or_else(PoisonError::into_inner).advance(field, steps)
    }
}

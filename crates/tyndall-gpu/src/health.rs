//! What wgpu reports outside of any call: a lost device and errors that no scope caught.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::GpuError;

/// Shared with wgpu's callbacks, which may run on any thread.
#[derive(Debug, Default)]
pub(crate) struct Health {
    lost: Mutex<Option<String>>,
    uncaught: Mutex<Option<String>>,
}

impl Health {
    /// Health of a device; replaces the callbacks the device has.
    pub(crate) fn watch(device: &wgpu::Device) -> Arc<Self> {
        let health = Arc::new(Self::default());
        let on_lost = Arc::clone(&health);
        device.set_device_lost_callback(move |reason, message| {
            tracing::error!(?reason, message, "graphics device lost");
            let reason = if message.is_empty() { format!("{reason:?}") } else { message };
            lock(&on_lost.lost).get_or_insert(reason);
        });
        let on_error = Arc::clone(&health);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            tracing::error!(%error, "graphics error outside of any scope");
            lock(&on_error.uncaught).get_or_insert(error.to_string());
        }));
        health
    }

    pub(crate) fn check_lost(&self) -> Result<(), GpuError> {
        lock(&self.lost).clone().map_or(Ok(()), |reason| Err(GpuError::DeviceLost { reason }))
    }

    /// A loss stays; an uncaught error is reported once.
    pub(crate) fn check(&self) -> Result<(), GpuError> {
        self.check_lost()?;
        let error = lock(&self.uncaught).take();
        error.map_or(Ok(()), |message| Err(GpuError::Validation { what: "GPU commands".to_owned(), message }))
    }
}

/// The data are whole after every statement, so a panic elsewhere does not spoil them.
fn lock(slot: &Mutex<Option<String>>) -> MutexGuard<'_, Option<String>> {
    slot.lock().unwrap_or_else(PoisonError::into_inner)
}

//! Steps of a scene's dunes on a device of their own, so that frames and steps wait for each other nowhere.

use std::error::Error;

use tyndall_dunes::slab::DuneField;
use tyndall_dunes::{DuneStepper, SandDevice as _};
use tyndall_gpu::{Gpu, GpuOptions};

use crate::{GpuDunes, GpuSimError};

/// Makes the steps of a [`DesertSource`](tyndall_dunes::DesertSource) on an adapter, which is opened at the first step.
#[derive(Debug)]
pub struct GpuStepper {
    options: GpuOptions,
    gpu: Option<Gpu>,
    dunes: Option<GpuDunes>,
}

impl GpuStepper {
    /// On the adapter of these options.
    #[must_use]
    pub fn new(options: GpuOptions) -> Self {
        Self { options, gpu: None, dunes: None }
    }

    fn run(&mut self, field: &DuneField, steps: u32) -> Result<DuneField, GpuSimError> {
        let gpu = match self.gpu.take() {
            Some(gpu) => gpu,
            None => Gpu::open(&self.options)?,
        };
        let gpu = self.gpu.insert(gpu);
        let mut dunes = match self.dunes.take() {
            Some(mut dunes) => {
                dunes.write(field)?;
                dunes
            }
            None => GpuDunes::new(gpu, field)?,
        };
        dunes.run(steps)?;
        self.dunes.insert(dunes).read()
    }
}

impl DuneStepper for GpuStepper {
    fn advance(&mut self, field: &DuneField, steps: u32) -> Result<DuneField, Box<dyn Error + Send + Sync>> {
        self.run(field, steps).map_err(|error| {
            // Whatever it was: the next try begins with a new device.
            (self.gpu, self.dunes) = (None, None);
            error.into()
        })
    }
}

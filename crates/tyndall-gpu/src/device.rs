//! Device and queue with everything that makes their failures visible.

use std::sync::Arc;
use std::time::Duration;

use crate::adapter::{AdapterChoice, AdapterReport, choose};
use crate::budget::{Budget, default_max_bytes};
use crate::health::Health;
use crate::{GpuError, fault};

/// Largest texture side that is asked for; beyond it a single picture exceeds any budget.
const MAX_TEXTURE_SIDE_PX: u32 = 16384;

/// Grain of waiting: how soon a lost device is noticed.
const WAIT_SLICE: Duration = Duration::from_millis(100);

/// What [`Gpu::open`] goes by.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct GpuOptions {
    /// Which adapter.
    pub adapter: AdapterChoice,
    /// Most bytes of textures and buffers at any time. By default what the system has available less 1 GiB where GPU
    /// memory is system memory, 3 GiB on a discrete GPU, 2 GiB otherwise.
    pub max_memory_bytes: Option<u64>,
}

impl From<&AdapterReport> for GpuOptions {
    /// Another device of the same adapter: what two threads submit to one device may be tracked in the wrong order by wgpu.
    fn from(adapter: &AdapterReport) -> Self {
        Self { adapter: AdapterChoice::Name(adapter.name.clone()), max_memory_bytes: None }
    }
}

/// An open device. Clones share device, budget and error state.
#[derive(Clone, Debug)]
pub struct Gpu {
    /// The device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    report: AdapterReport,
    limits: wgpu::Limits,
    pub(crate) budget: Arc<Budget>,
    health: Arc<Health>,
}

impl Gpu {
    /// Opens the adapter that the options choose.
    ///
    /// # Errors
    /// When there is no such adapter, or it gives no device.
    pub fn open(options: &GpuOptions) -> Result<Self, GpuError> {
        let mut adapters = enumerate();
        let reports: Vec<_> = adapters.iter().map(|adapter| AdapterReport::new(adapter.get_info())).collect();
        let adapter = adapters.swap_remove(choose(&options.adapter, &reports)?);
        Self::from_adapter(&adapter, options.max_memory_bytes)
    }

    /// A device without a driver that validates every call and computes nothing.
    ///
    /// # Errors
    /// When wgpu was built without it.
    pub fn noop() -> Result<Self, GpuError> {
        let mut desc = wgpu::InstanceDescriptor::new_without_display_handle();
        desc.backends = wgpu::Backends::NOOP;
        desc.backend_options.noop = wgpu::NoopBackendOptions::enabled();
        let request = wgpu::RequestAdapterOptions::default();
        let adapter = pollster::block_on(wgpu::Instance::new(desc).request_adapter(&request)).map_err(|error| {
            GpuError::AdapterNotFound { wanted: "noop".to_owned(), available: error.to_string(), advice: String::new() }
        })?;
        Self::from_adapter(&adapter, None)
    }

    fn from_adapter(adapter: &wgpu::Adapter, max_memory_bytes: Option<u64>) -> Result<Self, GpuError> {
        let desc = wgpu::DeviceDescriptor {
            label: Some("tyndall"),
            required_features: (wgpu::Features::TIMESTAMP_QUERY | wgpu::Features::FLOAT32_BLENDABLE)
                & adapter.features(),
            required_limits: wanted_limits(&adapter.limits()),
            ..Default::default()
        };
        let (device, queue) =
            pollster::block_on(adapter.request_device(&desc)).map_err(|error| GpuError::NoDevice {
                adapter: AdapterReport::new(adapter.get_info()).to_string(),
                message: error.to_string(),
            })?;
        Ok(Self::from_parts(adapter, device, queue, max_memory_bytes))
    }

    /// Takes over a device that someone else opened, for instance the window's. Its callbacks for errors and loss are
    /// replaced.
    #[must_use]
    pub fn from_parts(
        adapter: &wgpu::Adapter,
        device: wgpu::Device,
        queue: wgpu::Queue,
        max_memory_bytes: Option<u64>,
    ) -> Self {
        let report = AdapterReport::new(adapter.get_info());
        let max_bytes = max_memory_bytes.unwrap_or_else(|| default_max_bytes(report.device_type));
        tracing::info!(adapter = %report, max_bytes, "graphics device opened");
        let limits = device.limits();
        let health = Health::watch(&device);
        Self { device, queue, report, limits, budget: Budget::new(max_bytes), health }
    }

    /// The limits to ask for when someone else opens the device, as [`Gpu::open`] does: wgpu's defaults, with the
    /// adapter's own texture side (up to 16384) and buffer sizes.
    #[must_use]
    pub fn wanted_limits(adapter: &wgpu::Adapter) -> wgpu::Limits {
        wanted_limits(&adapter.limits())
    }

    /// All adapters of the system in the order of [`AdapterChoice::Index`].
    #[must_use]
    pub fn adapters() -> Vec<AdapterReport> {
        enumerate().iter().map(|adapter| AdapterReport::new(adapter.get_info())).collect()
    }

    /// The adapter in use.
    #[must_use]
    pub fn adapter(&self) -> &AdapterReport {
        &self.report
    }

    /// Limits of the device.
    #[must_use]
    pub fn limits(&self) -> &wgpu::Limits {
        &self.limits
    }

    /// Whether passes can be timed on the GPU.
    #[must_use]
    pub fn has_timestamps(&self) -> bool {
        self.device.features().contains(wgpu::Features::TIMESTAMP_QUERY)
    }

    /// Most bytes of textures and buffers at any time.
    #[must_use]
    pub fn max_memory_bytes(&self) -> u64 {
        self.budget.max_bytes()
    }

    /// Bytes of all textures and buffers now.
    #[must_use]
    pub fn used_memory_bytes(&self) -> u64 {
        self.budget.used_bytes()
    }

    /// To be called before the result of a frame is used.
    ///
    /// # Errors
    /// When the device is lost, or with the first error since the last call that no scope caught.
    pub fn check(&self) -> Result<(), GpuError> {
        self.poll()?;
        self.health.check()
    }

    /// Runs a constructor and returns what wgpu has to say against it as an error instead of a panic.
    ///
    /// # Errors
    /// When wgpu refuses a call of `build`, memory runs out, or the device is lost.
    pub fn validated<T>(&self, what: &str, build: impl FnOnce(&wgpu::Device) -> T) -> Result<T, GpuError> {
        let memory = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let internal = self.device.push_error_scope(wgpu::ErrorFilter::Internal);
        let validation = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let value = build(&self.device);
        let errors = [
            pollster::block_on(validation.pop()),
            pollster::block_on(internal.pop()),
            pollster::block_on(memory.pop()),
        ];
        self.poll()?;
        match errors.into_iter().flatten().next() {
            None => Ok(value),
            Some(wgpu::Error::OutOfMemory { .. }) => Err(GpuError::OutOfMemory { what: what.to_owned() }),
            Some(error) => Err(GpuError::Validation { what: what.to_owned(), message: error.to_string() }),
        }
    }

    /// Waits for submitted work, in slices so that a lost device ends the wait.
    ///
    /// # Errors
    /// When the device is lost, or there was no such submission.
    pub fn wait(&self, submission: wgpu::SubmissionIndex) -> Result<(), GpuError> {
        let last = Some(submission);
        while !self.wait_slice(last.as_ref())? {}
        Ok(())
    }

    /// Waits for one slice of time; whether the submission, or without one everything submitted, has finished.
    pub(crate) fn wait_slice(&self, submission: Option<&wgpu::SubmissionIndex>) -> Result<bool, GpuError> {
        let waited = self.poll_for_slice(submission);
        self.health.check_lost()?;
        match waited {
            Ok(_) => Ok(true),
            Err(wgpu::PollError::Timeout) => Ok(false),
            Err(error @ wgpu::PollError::WrongSubmissionIndex(..)) => {
                // A device destroyed while it worked refuses submissions in silence and tells of the loss only when
                // the earlier work has ended.
                while matches!(self.poll_for_slice(None), Err(wgpu::PollError::Timeout)) {}
                self.health.check_lost()?;
                Err(GpuError::Validation { what: "waiting for the GPU".to_owned(), message: error.to_string() })
            }
        }
    }

    fn poll_for_slice(&self, submission: Option<&wgpu::SubmissionIndex>) -> Result<wgpu::PollStatus, wgpu::PollError> {
        let timeout = Some(WAIT_SLICE);
        self.device.poll(wgpu::PollType::Wait { submission_index: submission.cloned(), timeout })
    }

    /// Runs the callbacks that are due, without waiting. wgpu tells of a loss only here.
    ///
    /// # Errors
    /// When the device is lost.
    pub fn poll(&self) -> Result<(), GpuError> {
        // Without a wait there is nothing to time out.
        let _finished = self.device.poll(wgpu::PollType::Poll);
        self.health.check_lost()
    }

    /// Lets a planted fault strike before a read-back.
    pub(crate) fn before_readback(&self) -> Result<(), GpuError> {
        fault::before_readback(&self.device);
        self.poll()
    }
}

fn enumerate() -> Vec<wgpu::Adapter> {
    let mut desc = wgpu::InstanceDescriptor::new_without_display_handle_from_env();
    // Another crate of the program may have compiled OpenGL into wgpu; the adapters and their order must not depend on it.
    desc.backends &= wgpu::Backends::PRIMARY;
    pollster::block_on(wgpu::Instance::new(desc).enumerate_adapters(wgpu::Backends::PRIMARY))
}

fn wanted_limits(available: &wgpu::Limits) -> wgpu::Limits {
    let default = wgpu::Limits::default();
    wgpu::Limits {
        max_texture_dimension_2d: default
            .max_texture_dimension_2d
            .max(available.max_texture_dimension_2d.min(MAX_TEXTURE_SIDE_PX)),
        max_buffer_size: default.max_buffer_size.max(available.max_buffer_size),
        max_storage_buffer_binding_size: default
            .max_storage_buffer_binding_size
            .max(available.max_storage_buffer_binding_size),
        ..default
    }
}

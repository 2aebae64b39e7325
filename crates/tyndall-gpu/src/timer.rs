//! GPU time of each pass of a frame.
//!
//! A ring of query sets: while the timings of one frame travel back, the next frames write into other slots, so that
//! [`PassTimer::poll`] never waits. On a device without timestamps everything here does nothing.

use crate::readback::Mapping;
use crate::{Buffer, Gpu, GpuError};

/// Frames that can be under way at a time.
const FRAMES_IN_FLIGHT: usize = 3;

/// Bytes of a timestamp.
const TICK_BYTES: u64 = 8;

/// How long a pass took on the GPU.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PassTiming {
    /// Name of the pass.
    pub name: &'static str,
    /// Its time in milliseconds.
    pub ms: f64,
}

/// Times the passes of frames: [`begin_frame`](Self::begin_frame), `render_writes` or `compute_writes` into the
/// descriptor of each pass, [`resolve`](Self::resolve) after the last one, submit, then [`read`](Self::read) or
/// [`poll`](Self::poll).
#[derive(Debug)]
pub struct PassTimer {
    frames: Vec<Frame>,
    /// Index of the frame that is being recorded.
    current: usize,
    capacity: u32,
    ms_per_tick: f64,
}

/// Queries and buffers of one frame.
#[derive(Debug)]
struct Frame {
    queries: wgpu::QuerySet,
    resolved: Buffer,
    staging: Buffer,
    names: Vec<&'static str>,
    state: State,
}

#[derive(Debug)]
enum State {
    /// Free, or being recorded.
    Idle,
    /// Resolved into an encoder that the caller submits.
    Resolved,
    /// On its way back.
    Mapping(Mapping),
}

impl PassTimer {
    /// A timer for up to `capacity` passes a frame; further passes are not timed.
    ///
    /// # Errors
    /// When the device refuses the buffers.
    pub fn new(gpu: &Gpu, capacity: u32) -> Result<Self, GpuError> {
        let capacity = capacity.clamp(1, wgpu::QUERY_SET_MAX_QUERIES / 2);
        let count = if gpu.has_timestamps() { FRAMES_IN_FLIGHT } else { 0 };
        Ok(Self {
            frames: (0..count).map(|_| Frame::new(gpu, capacity)).collect::<Result<_, _>>()?,
            current: 0,
            capacity,
            ms_per_tick: f64::from(gpu.queue.get_timestamp_period()) * 1e-6,
        })
    }

    /// Starts a frame. If no slot is free because nobody read the timings, the oldest are given up.
    pub fn begin_frame(&mut self) {
        if self.frames.is_empty() {
            return;
        }
        self.current = (self.current + 1) % self.frames.len();
        let frame = &mut self.frames[self.current];
        if matches!(frame.state, State::Mapping(_)) {
            frame.staging.unmap();
        }
        frame.state = State::Idle;
        frame.names.clear();
    }

    /// Timestamp writes for a render pass; `None` without timestamps or beyond the capacity.
    pub fn render_writes(&mut self, name: &'static str) -> Option<wgpu::RenderPassTimestampWrites<'_>> {
        let (query_set, begin) = self.slot(name)?;
        Some(wgpu::RenderPassTimestampWrites {
            query_set,
            beginning_of_pass_write_index: Some(begin),
            end_of_pass_write_index: Some(begin + 1),
        })
    }

    /// Timestamp writes for a compute pass; `None` without timestamps or beyond the capacity.
    pub fn compute_writes(&mut self, name: &'static str) -> Option<wgpu::ComputePassTimestampWrites<'_>> {
        let (query_set, begin) = self.slot(name)?;
        Some(wgpu::ComputePassTimestampWrites {
            query_set,
            beginning_of_pass_write_index: Some(begin),
            end_of_pass_write_index: Some(begin + 1),
        })
    }

    fn slot(&mut self, name: &'static str) -> Option<(&wgpu::QuerySet, u32)> {
        let frame = self.frames.get_mut(self.current)?;
        let pass = u32::try_from(frame.names.len()).ok().filter(|pass| *pass < self.capacity)?;
        frame.names.push(name);
        Some((&frame.queries, 2 * pass))
    }

    /// Records the copy of the frame's timestamps; call it after the last pass and submit the encoder before reading.
    pub fn resolve(&mut self, encoder: &mut wgpu::CommandEncoder) {
        let Some(frame) = self.frames.get_mut(self.current) else { return };
        let Some(ticks) = u32::try_from(2 * frame.names.len()).ok().filter(|ticks| *ticks > 0) else { return };
        encoder.resolve_query_set(&frame.queries, 0..ticks, &frame.resolved, 0);
        encoder.copy_buffer_to_buffer(&frame.resolved, 0, &frame.staging, 0, u64::from(ticks) * TICK_BYTES);
        frame.state = State::Resolved;
    }

    /// The timings of the frame resolved last, in the order of its passes; waits for them. Empty without timestamps.
    ///
    /// # Errors
    /// When the device is lost or the timestamps cannot be read.
    pub fn read(&mut self, gpu: &Gpu) -> Result<Vec<PassTiming>, GpuError> {
        let ms_per_tick = self.ms_per_tick;
        let Some(frame) = self.frames.get_mut(self.current) else { return Ok(Vec::new()) };
        frame.start_mapping();
        if let State::Mapping(mapping) = &frame.state {
            mapping.wait(gpu)?;
        }
        Ok(frame.take(ms_per_tick)?.unwrap_or_default())
    }

    /// The timings of the newest frame that has come back since the last call, without waiting.
    ///
    /// # Errors
    /// When the timestamps cannot be read.
    pub fn poll(&mut self, gpu: &Gpu) -> Result<Option<Vec<PassTiming>>, GpuError> {
        for frame in &mut self.frames {
            frame.start_mapping();
        }
        gpu.poll()?;
        let mut newest = None;
        let count = self.frames.len();
        for age in (0..count).rev() {
            let frame = &mut self.frames[(self.current + count - age) % count];
            newest = frame.take(self.ms_per_tick)?.or(newest);
        }
        Ok(newest)
    }
}

impl Frame {
    fn new(gpu: &Gpu, capacity: u32) -> Result<Self, GpuError> {
        let ticks = 2 * capacity;
        let bytes = u64::from(ticks) * TICK_BYTES;
        let resolved = wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC;
        let staging = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ;
        let desc =
            wgpu::QuerySetDescriptor { label: Some("pass timings"), ty: wgpu::QueryType::Timestamp, count: ticks };
        Ok(Self {
            queries: gpu.validated("timestamp queries", |device| device.create_query_set(&desc))?,
            resolved: gpu.buffer("pass timings", bytes, resolved)?,
            staging: gpu.buffer("pass timings, read-back", bytes, staging)?,
            names: Vec::new(),
            state: State::Idle,
        })
    }

    fn start_mapping(&mut self) {
        if matches!(self.state, State::Resolved) {
            self.state = State::Mapping(Mapping::start(&self.staging));
        }
    }

    /// The timings, if they have arrived; the frame is then free.
    fn take(&mut self, ms_per_tick: f64) -> Result<Option<Vec<PassTiming>>, GpuError> {
        let State::Mapping(mapping) = &self.state else { return Ok(None) };
        let failure = |message: String| GpuError::Readback { what: "pass timings".to_owned(), message };
        match mapping.result() {
            None => return Ok(None),
            Some(Err(error)) => {
                self.state = State::Idle;
                return Err(failure(error.to_string()));
            }
            Some(Ok(())) => {}
        }
        let bytes = self.staging.get_mapped_range(..).map_err(|error| failure(error.to_string()))?.to_vec();
        self.staging.unmap();
        self.state = State::Idle;
        let ticks: Vec<u64> = bytemuck::pod_collect_to_vec(&bytes);
        let passes = self.names.iter().zip(ticks.chunks_exact(2));
        Ok(Some(
            passes
                .map(|(name, pair)| PassTiming { name, ms: pair[1].saturating_sub(pair[0]) as f64 * ms_per_tick })
                .collect(),
        ))
    }
}

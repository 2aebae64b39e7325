//! From the GPU to bytes.

use std::sync::{Arc, Mutex, PoisonError};

use crate::{Buffer, Gpu, GpuError, Texture};

impl Gpu {
    /// The first mip level, row by row without padding, slice after slice; depth formats give their depth. Waits for the
    /// work submitted before. The texture needs the usage `COPY_SRC`.
    ///
    /// # Errors
    /// When the format has no bytes of its own, the staging buffer does not fit into the budget, or the device is lost.
    pub fn read_texture(&self, texture: &Texture) -> Result<Vec<u8>, GpuError> {
        self.before_readback()?;
        let what = format!("texture `{}`", texture.label());
        let rows = Rows::of(texture, &what)?;
        let staging = self.staging(&what, rows.padded_bytes())?;
        self.copy_and_read(&what, &staging, |encoder| {
            let layout = wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(rows.stride_bytes),
                rows_per_image: Some(rows.per_slice),
            };
            let source = wgpu::TexelCopyTextureInfo { aspect: rows.aspect, ..texture.as_image_copy() };
            let target = wgpu::TexelCopyBufferInfo { buffer: &staging, layout };
            encoder.copy_texture_to_buffer(source, target, texture.size());
        })
        .map(|padded| rows.without_padding(padded))
    }

    /// The bytes of a buffer. Waits for the work submitted before. The buffer needs the usage `COPY_SRC`.
    ///
    /// # Errors
    /// When the staging buffer does not fit into the budget, or the device is lost.
    pub fn read_buffer(&self, buffer: &Buffer) -> Result<Vec<u8>, GpuError> {
        self.before_readback()?;
        let what = format!("buffer `{}`", buffer.label());
        let staging = self.staging(&what, buffer.size())?;
        let mut bytes = self.copy_and_read(&what, &staging, |encoder| {
            encoder.copy_buffer_to_buffer(buffer, 0, &staging, 0, buffer.size());
        })?;
        bytes.truncate(usize::try_from(buffer.bytes()).unwrap_or(usize::MAX));
        Ok(bytes)
    }

    fn staging(&self, what: &str, bytes: u64) -> Result<Buffer, GpuError> {
        let usage = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
        self.buffer(&format!("read-back of {what}"), bytes, usage)
    }

    fn copy_and_read(
        &self,
        what: &str,
        staging: &Buffer,
        record: impl FnOnce(&mut wgpu::CommandEncoder),
    ) -> Result<Vec<u8>, GpuError> {
        let what_copy = format!("copying {what}");
        let submission = self.validated(&what_copy, |device| {
            let desc = wgpu::CommandEncoderDescriptor { label: Some(&what_copy) };
            let mut encoder = device.create_command_encoder(&desc);
            record(&mut encoder);
            self.queue.submit([encoder.finish()])
        })?;
        let bytes = self.map_and_copy(what, staging, submission)?;
        self.check()?;
        Ok(bytes)
    }

    /// Maps a staging buffer, waits, copies the bytes out and unmaps it.
    fn map_and_copy(
        &self,
        what: &str,
        staging: &wgpu::Buffer,
        submission: wgpu::SubmissionIndex,
    ) -> Result<Vec<u8>, GpuError> {
        let failure = |message: String| GpuError::Readback { what: what.to_owned(), message };
        let mapping = Mapping::start(staging);
        self.wait(submission)?;
        mapping.wait(self)?;
        if let Some(Err(error)) = mapping.result() {
            return Err(failure(error.to_string()));
        }
        let bytes = staging.get_mapped_range(..).map_err(|error| failure(error.to_string()))?.to_vec();
        staging.unmap();
        Ok(bytes)
    }
}

/// A mapping under way.
#[derive(Debug)]
pub(crate) struct Mapping(Arc<Mutex<Option<Result<(), wgpu::BufferAsyncError>>>>);

impl Mapping {
    pub(crate) fn start(buffer: &wgpu::Buffer) -> Self {
        let slot = Arc::new(Mutex::new(None));
        let done = Arc::clone(&slot);
        buffer.map_async(wgpu::MapMode::Read, .., move |result| {
            *done.lock().unwrap_or_else(PoisonError::into_inner) = Some(result);
        });
        Self(slot)
    }

    /// Waits until the mapping has succeeded or failed.
    pub(crate) fn wait(&self, gpu: &Gpu) -> Result<(), GpuError> {
        while self.result().is_none() {
            gpu.wait_slice(None)?;
        }
        Ok(())
    }

    /// Nothing while it is under way.
    pub(crate) fn result(&self) -> Option<Result<(), wgpu::BufferAsyncError>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

/// How the rows of a texture lie in a staging buffer.
struct Rows {
    aspect: wgpu::TextureAspect,
    /// Bytes of a row of texels.
    tight_bytes: u32,
    /// Distance of rows in the buffer.
    stride_bytes: u32,
    /// Rows of texel blocks in a slice.
    per_slice: u32,
    slices: u32,
}

impl Rows {
    fn of(texture: &wgpu::Texture, what: &str) -> Result<Self, GpuError> {
        let format = texture.format();
        let aspect = if format.has_depth_aspect() { wgpu::TextureAspect::DepthOnly } else { wgpu::TextureAspect::All };
        let block_bytes = format.block_copy_size(Some(aspect)).ok_or_else(|| GpuError::Readback {
            what: what.to_owned(),
            message: format!("the format {format:?} cannot be copied to a buffer"),
        })?;
        let (block_width, block_height) = format.block_dimensions();
        let tight_bytes = texture.width().div_ceil(block_width) * block_bytes;
        Ok(Self {
            aspect,
            tight_bytes,
            stride_bytes: tight_bytes.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT),
            per_slice: texture.height().div_ceil(block_height),
            slices: texture.depth_or_array_layers(),
        })
    }

    fn padded_bytes(&self) -> u64 {
        u64::from(self.stride_bytes) * u64::from(self.per_slice) * u64::from(self.slices)
    }

    fn without_padding(&self, padded: Vec<u8>) -> Vec<u8> {
        if self.tight_bytes == self.stride_bytes {
            return padded;
        }
        let tight = self.tight_bytes as usize;
        padded.chunks(self.stride_bytes as usize).map(|row| &row[..tight]).collect::<Vec<_>>().concat()
    }
}

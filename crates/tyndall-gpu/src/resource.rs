//! Textures and buffers that are counted against the budget before they are allocated.

use std::ops::Deref;

use crate::budget::Share;
use crate::{Gpu, GpuError};

/// Uniform buffers are padded to this, as WGSL pads structs in the uniform address space.
const UNIFORM_ALIGNMENT_BYTES: u64 = 16;

/// What a texture is to be. [`TextureDesc::new_2d`] and [`TextureDesc::new_3d`] fill in the usual rest.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextureDesc<'a> {
    /// Name in error messages and graphics debuggers.
    pub label: &'a str,
    /// Width, height, and depth or number of layers, in texels.
    pub size_px: [u32; 3],
    /// 1-D, 2-D (with layers) or 3-D.
    pub dimension: wgpu::TextureDimension,
    /// Format of a texel.
    pub format: wgpu::TextureFormat,
    /// What it will be used for.
    pub usage: wgpu::TextureUsages,
    /// Number of mip levels.
    pub mip_levels: u32,
    /// Samples a pixel.
    pub samples: u32,
}

impl<'a> TextureDesc<'a> {
    /// A 2-D texture with one layer, one mip level and one sample a pixel.
    #[must_use]
    pub fn new_2d(
        label: &'a str,
        [width, height]: [u32; 2],
        format: wgpu::TextureFormat,
        usage: wgpu::TextureUsages,
    ) -> Self {
        let dimension = wgpu::TextureDimension::D2;
        Self { label, size_px: [width, height, 1], dimension, format, usage, mip_levels: 1, samples: 1 }
    }

    /// A 3-D texture with one mip level.
    #[must_use]
    pub fn new_3d(label: &'a str, size_px: [u32; 3], format: wgpu::TextureFormat, usage: wgpu::TextureUsages) -> Self {
        let dimension = wgpu::TextureDimension::D3;
        Self { label, size_px, dimension, format, usage, mip_levels: 1, samples: 1 }
    }

    fn extent(&self) -> wgpu::Extent3d {
        let [width, height, depth_or_array_layers] = self.size_px;
        wgpu::Extent3d { width, height, depth_or_array_layers }
    }

    /// Memory of all mip levels without the driver's padding.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        let level = |mip| self.format.theoretical_memory_footprint(self.extent().mip_level_size(mip, self.dimension));
        let levels = (0..self.mip_levels.min(u32::BITS)).map(level).fold(0, u64::saturating_add);
        levels.saturating_mul(u64::from(self.samples))
    }

    fn check_limits(&self, limits: &wgpu::Limits) -> Result<(), GpuError> {
        let side = match self.dimension {
            wgpu::TextureDimension::D1 => limits.max_texture_dimension_1d,
            wgpu::TextureDimension::D2 => limits.max_texture_dimension_2d,
            wgpu::TextureDimension::D3 => limits.max_texture_dimension_3d,
        };
        let is_volume = self.dimension == wgpu::TextureDimension::D3;
        let (third, third_high) =
            if is_volume { ("depth", side) } else { ("number of layers", limits.max_texture_array_layers) };
        let [width, height, depth] = self.size_px;
        for (which, value, unit, high) in [
            ("width", width, " px", side),
            ("height", height, " px", side),
            (third, depth, if is_volume { " px" } else { "" }, third_high),
        ] {
            if !(1..=high).contains(&value) {
                return Err(GpuError::OverLimit {
                    what: format!("the {which} of texture `{}`", self.label),
                    value: value.into(),
                    unit,
                    high: high.into(),
                });
            }
        }
        Ok(())
    }
}

/// A texture; gives its bytes back to the budget when dropped.
#[derive(Debug)]
pub struct Texture {
    raw: wgpu::Texture,
    view: wgpu::TextureView,
    label: String,
    _share: Share,
}

impl Texture {
    /// View of the whole texture: all mip levels and layers.
    #[must_use]
    pub fn view(&self) -> &wgpu::TextureView {
        &self.view
    }

    /// The whole texture as a resource of a bind group.
    #[must_use]
    pub fn as_binding(&self) -> wgpu::BindingResource<'_> {
        wgpu::BindingResource::TextureView(self.view())
    }

    /// Width and height in texels.
    #[must_use]
    pub fn size_px(&self) -> [u32; 2] {
        [self.raw.width(), self.raw.height()]
    }

    /// The name it was made with.
    #[must_use]
    pub fn label(&self) -> &str {
        &self.label
    }
}

impl Deref for Texture {
    type Target = wgpu::Texture;

    fn deref(&self) -> &wgpu::Texture {
        &self.raw
    }
}

/// A buffer; gives its bytes back to the budget when dropped. Its size is that asked for, rounded up to 4 bytes.
#[derive(Debug)]
pub struct Buffer {
    raw: wgpu::Buffer,
    label: String,
    bytes: u64,
    _share: Share,
}

impl Buffer {
    /// Number of bytes asked for.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// The name it was made with.
    #[must_use]
    pub fn label(&self) -> &str {
        &self.label
    }
}

impl Deref for Buffer {
    type Target = wgpu::Buffer;

    fn deref(&self) -> &wgpu::Buffer {
        &self.raw
    }
}

impl Gpu {
    /// Makes a texture; its content is zero.
    ///
    /// # Errors
    /// Before anything is allocated when a side is outside the device's limits or the bytes exceed what is left of the
    /// budget; then when wgpu refuses the format or usage.
    pub fn texture(&self, desc: &TextureDesc<'_>) -> Result<Texture, GpuError> {
        desc.check_limits(self.limits())?;
        let what = format!("texture `{}` of {}", desc.label, size_text(desc.size_px));
        let share = self.budget.reserve(&what, desc.bytes())?;
        let (raw, view) = self.validated(&what, |device| {
            let raw = device.create_texture(&wgpu::TextureDescriptor {
                label: Some(desc.label),
                size: desc.extent(),
                mip_level_count: desc.mip_levels,
                sample_count: desc.samples,
                dimension: desc.dimension,
                format: desc.format,
                usage: desc.usage,
                view_formats: &[],
            });
            let view = raw.create_view(&wgpu::TextureViewDescriptor::default());
            (raw, view)
        })?;
        Ok(Texture { raw, view, label: desc.label.to_owned(), _share: share })
    }

    /// Makes a buffer; its content is zero.
    ///
    /// # Errors
    /// Before anything is allocated when it is empty, larger than the device's limit or than what is left of the budget;
    /// then when wgpu refuses the usage.
    pub fn buffer(&self, label: &str, bytes: u64, usage: wgpu::BufferUsages) -> Result<Buffer, GpuError> {
        let high = self.limits().max_buffer_size;
        let what = format!("buffer `{label}`");
        if !(1..=high).contains(&bytes) {
            return Err(GpuError::OverLimit {
                what: format!("the size of {what}"),
                value: bytes,
                unit: " bytes",
                high,
            });
        }
        let size = bytes.next_multiple_of(wgpu::COPY_BUFFER_ALIGNMENT);
        let share = self.budget.reserve(&what, size)?;
        let desc = wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false };
        let raw = self.validated(&what, |device| device.create_buffer(&desc))?;
        Ok(Buffer { raw, label: label.to_owned(), bytes, _share: share })
    }

    /// Makes a uniform buffer that holds `value`, padded to 16 bytes; it can be written again through the queue.
    ///
    /// # Errors
    /// As [`Gpu::buffer`].
    pub fn uniform<T: bytemuck::Pod>(&self, label: &str, value: &T) -> Result<Buffer, GpuError> {
        let bytes = (size_of::<T>() as u64).next_multiple_of(UNIFORM_ALIGNMENT_BYTES);
        let buffer = self.buffer(label, bytes, wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST)?;
        self.validated(label, |_device| self.queue.write_buffer(&buffer, 0, bytemuck::bytes_of(value)))?;
        Ok(buffer)
    }
}

fn size_text([width, height, depth]: [u32; 3]) -> String {
    if depth == 1 { format!("{width} x {height} px") } else { format!("{width} x {height} x {depth} px") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_count_mip_levels_samples_and_depth() {
        let usage = wgpu::TextureUsages::TEXTURE_BINDING;
        let flat = TextureDesc::new_2d("t", [8, 4], wgpu::TextureFormat::Rgba16Float, usage);
        assert_eq!(flat.bytes(), 8 * 4 * 8, "8 bytes a texel");
        let mips = TextureDesc { mip_levels: 4, ..flat.clone() };
        assert_eq!(mips.bytes(), (32 + 8 + 2 + 1) * 8, "8x4, 4x2, 2x1, 1x1");
        assert_eq!(TextureDesc { samples: 4, ..flat }.bytes(), 4 * 8 * 4 * 8, "four samples");
        let volume = TextureDesc::new_3d("v", [4, 4, 4], wgpu::TextureFormat::R32Float, usage);
        assert_eq!(volume.bytes(), 256, "4 bytes a voxel");
        let depth = TextureDesc::new_2d("d", [2, 2], wgpu::TextureFormat::Depth32Float, usage);
        assert_eq!(depth.bytes(), 16, "4 bytes a texel");
    }
}

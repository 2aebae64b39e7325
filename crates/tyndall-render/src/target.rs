//! What a frame is drawn into: HDR frame, depth and display picture.

use tyndall_gpu::wgpu::{TextureFormat, TextureUsages};
use tyndall_gpu::{Gpu, Texture, TextureDesc};
use tyndall_scene::camera::NEAR_M;

use crate::RenderError;

/// Depth (m) of pixels that show the sky. Not infinity: viewers scale depth by its maximum.
pub const SKY_DEPTH_M: f32 = 1e10;

/// Precision of the HDR frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FrameFormat {
    /// Half floats, for the screen.
    #[default]
    Half,
    /// 32-bit floats, for files: the sun's disc exceeds half floats.
    Float,
}

/// Precision of the display picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PictureFormat {
    /// Eight bits a channel.
    #[default]
    Eight,
    /// Sixteen bits a channel.
    Sixteen,
}

/// Precision of frame and picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RendererConfig {
    /// Of the HDR frame.
    pub frame: FrameFormat,
    /// Of the display picture.
    pub picture: PictureFormat,
}

impl RendererConfig {
    pub(crate) fn frame_format(self) -> TextureFormat {
        match self.frame {
            FrameFormat::Half => TextureFormat::Rgba16Float,
            FrameFormat::Float => TextureFormat::Rgba32Float,
        }
    }

    pub(crate) fn picture_format(self) -> TextureFormat {
        match self.picture {
            PictureFormat::Eight => TextureFormat::Rgba8Unorm,
            PictureFormat::Sixteen => TextureFormat::Rgba32Float,
        }
    }
}

/// Depth format; depth is reversed, near plane / planar distance, so that precision is even over all distances.
pub(crate) const DEPTH_FORMAT: TextureFormat = TextureFormat::Depth32Float;

/// Textures of one picture size.
#[derive(Debug)]
pub struct FrameTarget {
    pub(crate) frame: Texture,
    pub(crate) depth: Texture,
    pub(crate) picture: Texture,
    pub(crate) config: RendererConfig,
    /// Pre-exposure of the frame drawn last, to be taken out of the radiance again.
    pub(crate) pre_exposure: f32,
}

impl FrameTarget {
    /// Textures for pictures of `size_px` = [width, height].
    ///
    /// # Errors
    /// When a side is outside the device's limits or the textures exceed the memory budget.
    pub fn new(gpu: &Gpu, size_px: [u32; 2], config: RendererConfig) -> Result<Self, RenderError> {
        let [frame, depth, picture] = descriptions(size_px, config).map(|desc| gpu.texture(&desc));
        Ok(Self { frame: frame?, depth: depth?, picture: picture?, config, pre_exposure: 1.0 })
    }

    /// Memory that a target needs, for checks before anything is allocated.
    #[must_use]
    pub fn bytes(size_px: [u32; 2], config: RendererConfig) -> u64 {
        descriptions(size_px, config).iter().map(TextureDesc::bytes).fold(0, u64::saturating_add)
    }

    /// Width and height (px).
    #[must_use]
    pub fn size_px(&self) -> [u32; 2] {
        self.frame.size_px()
    }

    /// The display picture: sRGB-encoded values in a plain format, as egui wants them.
    #[must_use]
    pub fn picture(&self) -> &Texture {
        &self.picture
    }

    /// The picture in eight bits, row 0 on top.
    ///
    /// # Errors
    /// When the device is lost or the read-back does not fit into the memory budget.
    pub fn read_picture8(&self, gpu: &Gpu) -> Result<Vec<[u8; 4]>, RenderError> {
        match self.config.picture {
            PictureFormat::Eight => Ok(gpu.read_texture(&self.picture)?.as_chunks::<4>().0.to_vec()),
            PictureFormat::Sixteen => self.read_scaled(gpu, 255.0, to_u8),
        }
    }

    /// The picture in sixteen bits, row 0 on top. From an eight-bit picture the values are multiples of 257.
    ///
    /// # Errors
    /// When the device is lost or the read-back does not fit into the memory budget.
    pub fn read_picture16(&self, gpu: &Gpu) -> Result<Vec<[u16; 4]>, RenderError> {
        match self.config.picture {
            PictureFormat::Eight => {
                Ok(self.read_picture8(gpu)?.into_iter().map(|pixel| pixel.map(|c| u16::from(c) * 257)).collect())
            }
            PictureFormat::Sixteen => self.read_scaled(gpu, 65_535.0, to_u16),
        }
    }

    /// Radiance (cd/m^2), linear Rec.709, row 0 on top; alpha is 1.
    ///
    /// # Errors
    /// When the device is lost or the read-back does not fit into the memory budget.
    pub fn read_radiance(&self, gpu: &Gpu) -> Result<Vec<[f32; 4]>, RenderError> {
        let gain = 1.0 / self.pre_exposure;
        let bytes = gpu.read_texture(&self.frame)?;
        let scale = |[r, g, b, _]: [f32; 4]| [r * gain, g * gain, b * gain, 1.0];
        Ok(match self.config.frame {
            FrameFormat::Float => floats(&bytes).map(scale).collect(),
            FrameFormat::Half => {
                let float = |half: [u8; 2]| half::f16::from_le_bytes(half).to_f32();
                let halves = bytes.as_chunks::<2>().0.iter().map(|half| float(*half)).collect::<Vec<_>>();
                halves.as_chunks::<4>().0.iter().map(|pixel| scale(*pixel)).collect()
            }
        })
    }

    /// Distance (m) along the direction of view, row 0 on top; [`SKY_DEPTH_M`] where the sky is.
    ///
    /// # Errors
    /// When the device is lost or the read-back does not fit into the memory budget.
    #[expect(clippy::cast_possible_truncation, reason = "the near plane is exact enough in f32")]
    pub fn read_depth_m(&self, gpu: &Gpu) -> Result<Vec<f32>, RenderError> {
        let bytes = gpu.read_texture(&self.depth)?;
        let depths = bytes.as_chunks::<4>().0.iter().map(|bytes| f32::from_le_bytes(*bytes));
        Ok(depths
            .map(|depth| if depth > 0.0 { (NEAR_M as f32 / depth).min(SKY_DEPTH_M) } else { SKY_DEPTH_M })
            .collect())
    }

    fn read_scaled<T>(&self, gpu: &Gpu, levels: f32, convert: fn(f32) -> T) -> Result<Vec<[T; 4]>, RenderError> {
        let bytes = gpu.read_texture(&self.picture)?;
        Ok(floats(&bytes).map(|pixel| pixel.map(|c| convert((c * levels).round()))).collect())
    }
}

fn descriptions(size_px: [u32; 2], config: RendererConfig) -> [TextureDesc<'static>; 3] {
    let usage = TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC | TextureUsages::TEXTURE_BINDING;
    [
        TextureDesc::new_2d("frame", size_px, config.frame_format(), usage),
        TextureDesc::new_2d("depth", size_px, DEPTH_FORMAT, usage),
        TextureDesc::new_2d("picture", size_px, config.picture_format(), usage),
    ]
}

fn floats(bytes: &[u8]) -> impl Iterator<Item = [f32; 4]> {
    let float = |bytes: &[u8; 16], i: usize| f32::from_le_bytes(std::array::from_fn(|k| bytes[4 * i + k]));
    bytes.as_chunks::<16>().0.iter().map(move |pixel| std::array::from_fn(|i| float(pixel, i)))
}

#[expect(clippy::cast_possible_truncation, reason = "the shader clamps to the range")]
fn to_u8(level: f32) -> u8 {
    level as u8
}

#[expect(clippy::cast_possible_truncation, reason = "the shader clamps to the range")]
fn to_u16(level: f32) -> u16 {
    level as u16
}

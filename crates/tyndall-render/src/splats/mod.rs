//! Metaballs as billboards: the paper's section 3.3 for any list of balls. WGSL: `shaders/splats`.
//!
//! [`tyndall_clouds::splats`] lights and sorts the balls, on the CPU for every adapter: the sun pass depends on the sun and on
//! the balls alone, and so there is nothing to read back. The billboards are drawn by the GPU, or by the CPU where the adapter is
//! a software one and would be several times slower. Both leave the same two textures of shares of light, from which
//! a frame is coloured pixel by pixel.
//!
//! The targets hold 32-bit floats where the device blends them; half floats otherwise, within 1/1000 of the light.

mod billboards;
pub mod gpu_data;

use tyndall_clouds::splats::{SeenBall, SplatOrders, SplatPlanes, SplatProjection, SplatView, rasterise};
use tyndall_gpu::wgpu::{self, TextureFormat, TextureUsages};
use tyndall_gpu::{Gpu, PassTimer, Texture, TextureDesc};
use tyndall_scene::camera::NEAR_M;

use crate::{FrameTarget, RenderError};
use billboards::Billboards;

/// Who draws the billboards.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SplatRasteriser {
    /// The CPU, from the depth of the scene so far, which is read back for it.
    Cpu,
    /// The GPU.
    Gpu,
}

/// What is drawn.
#[derive(Clone, Copy, Debug)]
pub struct SplatDraw<'a> {
    /// Balls from back to front.
    pub balls: &'a [SeenBall],
    /// The camera, with the size of the target's picture.
    pub view: &'a SplatView,
    /// The orders of scattering.
    pub orders: SplatOrders,
}

/// The billboards' pipeline and the shares of light of a picture.
#[derive(Debug)]
pub struct SplatRenderer {
    rasteriser: SplatRasteriser,
    billboards: Billboards,
    planes: Option<[Texture; 2]>,
}

impl SplatRenderer {
    /// Makes the pipeline; a software adapter leaves the drawing to the CPU.
    ///
    /// # Errors
    /// When the shader is wrong or memory does not suffice.
    pub fn new(gpu: &Gpu) -> Result<Self, RenderError> {
        let rasteriser = if gpu.adapter().is_software { SplatRasteriser::Cpu } else { SplatRasteriser::Gpu };
        Ok(Self { rasteriser, billboards: Billboards::new(gpu)?, planes: None })
    }

    /// Chooses who draws, for tests and timings.
    pub fn set_rasteriser(&mut self, rasteriser: SplatRasteriser) {
        self.rasteriser = rasteriser;
        self.planes = None;
    }

    /// The textures of a picture of that size: light scattered once (direct sunlight, distance, nothing, transmittance) and
    /// often (forward, diffuse, sky, transmittance).
    ///
    /// # Errors
    /// When memory does not suffice.
    pub fn planes(&mut self, gpu: &Gpu, size_px: [u32; 2]) -> Result<&[Texture; 2], RenderError> {
        let last = self.planes.take().filter(|[once, _]| once.size_px() == size_px);
        let planes = match last {
            Some(planes) => planes,
            None => {
                [self.plane(gpu, "light scattered once", size_px)?, self.plane(gpu, "light scattered often", size_px)?]
            }
        };
        Ok(self.planes.insert(planes))
    }

    fn plane(&self, gpu: &Gpu, label: &str, size_px: [u32; 2]) -> Result<Texture, RenderError> {
        let format = match self.rasteriser {
            SplatRasteriser::Cpu => TextureFormat::Rgba32Float,
            SplatRasteriser::Gpu => self.billboards.format(),
        };
        let usage = TextureUsages::RENDER_ATTACHMENT
            | TextureUsages::TEXTURE_BINDING
            | TextureUsages::COPY_DST
            | TextureUsages::COPY_SRC;
        Ok(gpu.texture(&TextureDesc::new_2d(label, size_px, format, usage))?)
    }

    /// Fills the planes, up to the depth of what the target shows when `encoder` has run. The CPU needs that depth now: what
    /// was recorded is submitted, and the encoder begins anew.
    ///
    /// # Errors
    /// When memory does not suffice or the device is lost.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        (encoder, timer): (&mut wgpu::CommandEncoder, &mut PassTimer),
        draw: SplatDraw<'_>,
        target: &FrameTarget,
    ) -> Result<(), RenderError> {
        self.planes(gpu, target.size_px())?;
        let Some(planes) = &self.planes else { return Ok(()) };
        if self.rasteriser == SplatRasteriser::Gpu {
            return self.billboards.draw(gpu, (encoder, timer), draw, (planes, &target.depth));
        }
        let next = wgpu::CommandEncoderDescriptor { label: Some("after the splats") };
        let recorded = std::mem::replace(encoder, gpu.device.create_command_encoder(&next));
        gpu.queue.submit([recorded.finish()]);
        let limits_m = limits_m(&gpu.read_texture(&target.depth)?, draw.view);
        let picture = rasterise(draw.balls, draw.view, draw.orders, Some(&limits_m))?;
        upload(gpu, &picture, planes);
        Ok(())
    }
}

/// Distances (m) along the lines of sight of reversed depths, row by row.
#[expect(clippy::cast_possible_truncation, reason = "the near plane and a camera's opening are exact enough in f32")]
fn limits_m(depths: &[u8], view: &SplatView) -> Vec<f32> {
    let [width, height] = view.size_px;
    let half = match view.projection {
        SplatProjection::Perspective { tan_half } => tan_half,
        SplatProjection::Orthographic { .. } => [0.0; 2],
    };
    let depths = depths.as_chunks::<4>().0.iter().map(|bytes| f32::from_le_bytes(*bytes));
    let limit = |(index, depth): (usize, f32)| {
        let place = |index: usize, count: usize| 2.0 * (index as f64 + 0.5) / count as f64 - 1.0;
        let [x, y] = [half[0] * place(index % width, width), half[1] * place(index / width, height)];
        if depth > 0.0 { NEAR_M as f32 / depth * (1.0 + x * x + y * y).sqrt() as f32 } else { f32::INFINITY }
    };
    depths.enumerate().map(limit).collect()
}

fn upload(gpu: &Gpu, picture: &SplatPlanes, planes: &[Texture; 2]) {
    let [width, height] = picture.size_px();
    let pixels = (0..height).flat_map(|row| (0..width).map(move |column| picture.pixel(column, row)));
    let (once, often): (Vec<_>, Vec<_>) = pixels
        .map(|pixel| {
            let once = [pixel.direct, pixel.distance_m, 0.0, pixel.transmittance];
            (once, [pixel.forward, pixel.diffuse, pixel.sky, pixel.thin])
        })
        .unzip();
    for (texture, texels) in planes.iter().zip([once, often]) {
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(16 * texture.width()), rows_per_image: None };
        gpu.queue.write_texture(texture.as_image_copy(), bytemuck::cast_slice(&texels), layout, texture.size());
    }
}

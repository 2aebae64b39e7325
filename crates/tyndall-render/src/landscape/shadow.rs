//! The map of the terrain's shadows. WGSL: `shaders/landscape/{heights,shadow,shadow_lookup}.wgsl`.

use tyndall_gpu::wgpu::{self, TextureFormat, TextureUsages};
use tyndall_gpu::{Buffer, ComputePipeline, Gpu, PassTimer, Shader, Texture, TextureDesc};

use super::gpu_data::Landscape;
use crate::RenderError;

/// Texels of a side.
const SIDE_PX: u32 = 1024;

/// Passes, each of twice the reach: with the last one shadows cross half the map.
const PASSES: u32 = 10;

/// Heights of the terrain, and the altitudes below which places lie in the shadow of others.
#[derive(Debug)]
pub(super) struct ShadowMap {
    heights: ComputePipeline,
    spread: ComputePipeline,
    /// Heights, and two maps that the passes write in turn.
    maps: Option<[Texture; 3]>,
    reaches: Vec<Buffer>,
    /// The terrain whose heights are held, and the sun whose shadows.
    holds: Option<Landscape>,
}

impl ShadowMap {
    pub(super) fn new(gpu: &Gpu) -> Result<Self, RenderError> {
        let pipeline = |file: &str, entry: &str| ComputePipeline::new(gpu, &Shader::load(gpu, file)?, entry, &[]);
        #[expect(clippy::cast_precision_loss, reason = "small powers of two")]
        let reach = |pass: u32| gpu.uniform("reach of a shadow pass", &[(1_u32 << pass) as f32, 0.0, 0.0, 0.0]);
        Ok(Self {
            heights: pipeline("landscape/heights.wgsl", "landscape_heights")?,
            spread: pipeline("landscape/shadow.wgsl", "landscape_shadow")?,
            maps: None,
            reaches: (0..PASSES).map(reach).collect::<Result<_, _>>()?,
            holds: None,
        })
    }

    /// Records what has changed: the heights for another terrain, the shadows for another sun.
    pub(super) fn update(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        timer: &mut PassTimer,
        (uniform, landscape): (&Buffer, &Landscape),
    ) -> Result<(), RenderError> {
        // The mesh does not matter here.
        let wanted = Landscape {
            columns: 0,
            rings: 0,
            centre_radius_m: 0.0,
            split_radius_m: 0.0,
            far_radius_m: 0.0,
            first_azimuth: 0.0,
            azimuth_step: 0.0,
            ..*landscape
        };
        if self.holds == Some(wanted) {
            return Ok(());
        }
        if self.maps.is_none() {
            self.maps = Some([map(gpu, "heights")?, map(gpu, "shadows, a")?, map(gpu, "shadows, b")?]);
        }
        let Some(maps) = &self.maps else { return Ok(()) };
        let landscape = || ("landscape", uniform.as_entire_binding());
        let texels = |index: usize| ("shadow_texels", maps[index].as_binding());
        let of_sun = |landscape: &Landscape| Landscape {
            sun_tan_low: 0.0,
            sun_tan_high: 0.0,
            sun_heading: [0.0; 2],
            ..*landscape
        };
        if self.holds.as_ref().map(of_sun) != Some(of_sun(&wanted)) {
            let bindings = self.heights.bind(gpu, 2, &[landscape(), texels(0)])?;
            let mut pass = compute_pass(encoder, timer, "landscape heights");
            pass.set_bind_group(2, &bindings, &[]);
            self.heights.dispatch(&mut pass, [SIDE_PX, SIDE_PX, 1]);
        }
        let mut pass = compute_pass(encoder, timer, "landscape shadows");
        for (index, reach) in self.reaches.iter().enumerate() {
            let (from, to) = if index == 0 { (0, 1) } else { (2 - index % 2, 1 + index % 2) };
            let before = ("shadow_before", maps[from].as_binding());
            let resources = [landscape(), texels(to), before, ("shadow_reach", reach.as_entire_binding())];
            pass.set_bind_group(2, &self.spread.bind(gpu, 2, &resources)?, &[]);
            self.spread.dispatch(&mut pass, [SIDE_PX, SIDE_PX, 1]);
        }
        drop(pass);
        self.holds = Some(wanted);
        Ok(())
    }

    /// The finished map.
    pub(super) fn map(&self) -> Option<&Texture> {
        self.maps.as_ref().map(|maps| &maps[1 + (PASSES as usize - 1) % 2])
    }

    /// The heights that shadows are made from, for tests.
    pub(super) fn heights(&self) -> Option<&Texture> {
        self.maps.as_ref().map(|maps| &maps[0])
    }
}

fn map(gpu: &Gpu, label: &str) -> Result<Texture, RenderError> {
    let usage = TextureUsages::STORAGE_BINDING | TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_SRC;
    Ok(gpu.texture(&TextureDesc::new_2d(label, [SIDE_PX, SIDE_PX], TextureFormat::Rgba32Float, usage))?)
}

/// A timed compute pass.
pub(super) fn compute_pass<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    timer: &mut PassTimer,
    name: &'static str,
) -> wgpu::ComputePass<'a> {
    encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
        label: Some(name),
        timestamp_writes: timer.compute_writes(name),
    })
}

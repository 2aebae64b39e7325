//! The moon as a light: its uniform, and the table of the air that it lights. WGSL: `shaders/sky/moon_*.wgsl`.
//!
//! The table of all orders of scattering holds every sun, hence also the moon: one pass more fills the moon's sky.

use std::f64::consts::PI;

use tyndall_core::spectrum::{SOLAR_IRRADIANCE_W_M2_NM, Spectrum, WAVELENGTHS_NM};
use tyndall_gpu::wgpu::{self, BufferUsages, TextureFormat, TextureUsages};
use tyndall_gpu::{Buffer, ComputePipeline, Gpu, PassTimer, Shader, Texture, TextureDesc};
use tyndall_scattering::Atmosphere as Model;
use tyndall_scene::Scene;
use tyndall_scene::astronomy::{FULL_MOON_LUX, MoonState, lommel_seeliger_phase, moon_illuminance_lux};

use super::colour::with_luminance;
use crate::RenderError;
use crate::frame::gpu_data::Frame;
use crate::sky::gpu_data::{Atmosphere, SkyView};

/// The moon reflects red better than blue: its colour index is 0.27 magnitudes above the sun's (Lane and Irvine 1973).
const REDDENING: f64 = 1.1;

/// Light from the earth on the moon's night, full earth, relative to sunlight on its day.
const EARTHSHINE: f64 = 1e-4;

/// A moon dimmer than this (lux) lights nothing.
const DARK_LUX: f64 = 1e-7;

/// Sines of the sun's elevation above which moonlight is less than 1e-4 of the day's, and of the moon's below which its
/// twilight is over.
const DAY_SINE: f64 = 0.07;
const MOONSET_SINE: f64 = -0.21;

/// The air lifts what stands on the horizon by less than this (rad).
const REFRACTION_MAX_RAD: f32 = 0.03;

/// Columns of the moon's table for one of the sun's.
const COLUMNS_PER_COLUMN: u32 = 2;

/// Uniform structs of this file.
pub(super) mod gpu_data {
    /// Twin of `Moon` in `shaders/sky/moon.wgsl`; units and meanings there.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
    #[expect(missing_docs, reason = "documented at the WGSL twin")]
    pub struct Moon {
        pub direction: [f32; 3],
        pub angular_radius: f32,
        pub sunlight: [f32; 3],
        pub disc_per_sr: f32,
        pub north: [f32; 3],
        pub earthshine_per_sr: f32,
        pub light: [f32; 8],
        pub disc: u32,
        pub maria: u32,
        pub skylight: u32,
        pub padding: u32,
    }
}

/// Irradiance of the moon above the atmosphere over that of the sun, for an illuminance (lux).
fn light(lux: f64) -> Spectrum {
    let shape: Spectrum =
        std::array::from_fn(|k| SOLAR_IRRADIANCE_W_M2_NM[k] * (WAVELENGTHS_NM[k] / 550.0).powf(REDDENING));
    let irradiance = with_luminance(&shape, lux);
    std::array::from_fn(|k| irradiance[k] / SOLAR_IRRADIANCE_W_M2_NM[k])
}

impl gpu_data::Moon {
    /// Of a scene's moon beside a sun of this elevation's sine.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "the GPU computes in f32")]
    pub fn new(scene: &Scene, state: &MoonState, sun_sine: f64) -> Self {
        let moon = &scene.moon;
        let radius = moon.angular_radius_deg.to_radians();
        let by_phase = moon_illuminance_lux(state.phase_rad).max(DARK_LUX);
        // The squared chord of the radius: pi times it is the disc's solid angle.
        let chord_squared = (2.0 * (0.5 * radius).sin()).powi(2);
        let lit = 0.5 * PI * chord_squared * lommel_seeliger_phase(state.phase_rad).max(1e-9);
        let earth = EARTHSHINE * 0.5 * (1.0 - state.phase_rad.cos()) * FULL_MOON_LUX / by_phase;
        let shines = by_phase * moon.brightness * scene.sun.brightness > DARK_LUX;
        Self {
            direction: state.direction.as_vec3().to_array(),
            angular_radius: radius as f32,
            sunlight: state.sunlight.as_vec3().to_array(),
            disc_per_sr: (1.0 / lit) as f32,
            north: state.north.as_vec3().to_array(),
            earthshine_per_sr: (earth / (PI * chord_squared)) as f32,
            light: light(by_phase * moon.brightness).map(|value| value as f32),
            disc: u32::from(moon.disc),
            maria: u32::from(moon.maria),
            skylight: u32::from(shines && sun_sine < DAY_SINE && state.direction.z > MOONSET_SINE),
            padding: 0,
        }
    }
}

/// What the table of moonlit air follows from.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Inputs {
    atmosphere: Atmosphere,
    view: SkyView,
    orders: u64,
}

/// The moon's uniform, the table of its sky and the pipeline that fills it.
#[derive(Debug)]
pub(crate) struct MoonLight {
    fill: ComputePipeline,
    pub(super) uniform: Buffer,
    atmosphere: Buffer,
    view: Buffer,
    pub(super) sky: Texture,
    wanted: Option<(Atmosphere, SkyView)>,
    holds: Option<Inputs>,
}

impl MoonLight {
    /// Pipeline and an empty table.
    pub(super) fn new(gpu: &Gpu) -> Result<Self, RenderError> {
        let uniform =
            |label, bytes: usize| gpu.buffer(label, bytes as u64, BufferUsages::UNIFORM | BufferUsages::COPY_DST);
        Ok(Self {
            fill: ComputePipeline::new(gpu, &Shader::load(gpu, "sky/moon_table.wgsl")?, "moon_table", &[])?,
            uniform: uniform("moon", size_of::<gpu_data::Moon>())?,
            atmosphere: uniform("atmosphere of the moon", size_of::<Atmosphere>())?,
            view: uniform("sky view of the moon", size_of::<SkyView>())?,
            sky: table(gpu, [8, 8])?,
            wanted: None,
            holds: None,
        })
    }

    /// Uploads the moon of a scene; gives back whether its disc or its light is drawn in a frame.
    pub(super) fn update(
        &mut self,
        gpu: &Gpu,
        scene: &Scene,
        (model, frame): (&Model, &Frame),
    ) -> Result<bool, RenderError> {
        let sun_sine = scene.sun_direction()?.elevation_rad.sin();
        let moon = scene.moon()?.map(|state| gpu_data::Moon::new(scene, &state, sun_sine));
        let moon = moon.unwrap_or(bytemuck::Zeroable::zeroed());
        gpu.queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&moon));
        self.wanted = None;
        if moon.skylight == 1 {
            let mut atmosphere = Atmosphere::new(model, scene.sun.brightness)?;
            for row in [&mut atmosphere.red, &mut atmosphere.green, &mut atmosphere.blue] {
                for (weight, light) in row.iter_mut().zip(moon.light) {
                    *weight *= light;
                }
            }
            // Only the height of the moon counts, as the table's azimuths start at it.
            let sine = moon.direction[2];
            let sun_direction = [0.0, (1.0 - sine * sine).max(0.0).sqrt(), sine];
            let view = SkyView::new(scene, model)?;
            // This table holds the aureole too, which the sun's adds per pixel.
            let table_size = [view.table_size[0] * COLUMNS_PER_COLUMN, view.table_size[1]];
            self.wanted = Some((atmosphere, SkyView { sun_direction, table_size, ..view }));
        }
        Ok(moon.skylight == 1 || (moon.disc == 1 && may_show(frame, moon.direction, moon.angular_radius)))
    }

    /// Records the filling of the table, when it is needed and its inputs changed: `shared` are the table of columns, and
    /// uniform and table of the orders, of this version.
    pub(in crate::sky) fn record(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        timer: &mut PassTimer,
        (columns, orders, orders_table): (&Texture, &Buffer, &Buffer),
        version: u64,
    ) -> Result<(), RenderError> {
        let Some((atmosphere, view)) = self.wanted else { return Ok(()) };
        let inputs = Some(Inputs { atmosphere, view, orders: version });
        if self.holds == inputs {
            return Ok(());
        }
        if self.sky.size_px() != view.table_size {
            self.sky = table(gpu, view.table_size)?;
        }
        gpu.queue.write_buffer(&self.atmosphere, 0, bytemuck::bytes_of(&atmosphere));
        gpu.queue.write_buffer(&self.view, 0, bytemuck::bytes_of(&view));
        let resources = [
            ("atmosphere", self.atmosphere.as_entire_binding()),
            ("column_table", columns.as_binding()),
            ("sky_view", self.view.as_entire_binding()),
            ("orders", orders.as_entire_binding()),
            ("orders_source", orders_table.as_entire_binding()),
            ("moon_sky_texels", self.sky.as_binding()),
        ];
        let bindings = self.fill.bind(gpu, 0, &resources)?;
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("moon's sky"),
            timestamp_writes: timer.compute_writes("moon's sky"),
        });
        pass.set_bind_group(0, &bindings, &[]);
        self.fill.dispatch(&mut pass, [view.table_size[0], view.table_size[1], 1]);
        self.holds = inputs;
        Ok(())
    }

    /// Forgets what the table holds.
    pub(in crate::sky) fn invalidate(&mut self) {
        self.holds = None;
    }
}

/// Whether a disc around a direction may lie in a picture, the air's refraction included.
fn may_show(frame: &Frame, direction: [f32; 3], radius_rad: f32) -> bool {
    let diagonal = frame.tan_half_width.hypot(frame.tan_half_height).atan();
    let cosine: f32 = frame.forward.iter().zip(direction).map(|(forward, towards)| forward * towards).sum();
    frame.projection != 0 || cosine > (diagonal + radius_rad + REFRACTION_MAX_RAD).cos()
}

fn table(gpu: &Gpu, size_px: [u32; 2]) -> Result<Texture, RenderError> {
    let usage = TextureUsages::STORAGE_BINDING | TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_SRC;
    Ok(gpu.texture(&TextureDesc::new_2d("moon's sky", size_px, TextureFormat::Rgba32Float, usage))?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use tyndall_core::spectrum::xyz_from_spectrum;

    #[test]
    fn moonlight_has_its_illuminance_and_is_redder_than_sunlight() {
        let factor = light(0.25);
        let irradiance: Spectrum = std::array::from_fn(|k| factor[k] * SOLAR_IRRADIANCE_W_M2_NM[k]);
        assert!((xyz_from_spectrum(&irradiance)[1] - 0.25).abs() < 1e-9, "{irradiance:?}");
        // 0.27 magnitudes from 442 to 550 nm.
        let ratio = factor[4] / factor[1];
        assert!((ratio - 1.32).abs() < 0.03, "{ratio}");
    }
}

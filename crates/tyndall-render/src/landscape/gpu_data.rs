//! The landscape's uniform and how it follows from a scene.

use tyndall_scattering::params::GroundParams;
use tyndall_scene::landscape::Landscape as Model;
use tyndall_scene::{LandscapeParams, SunDirection};

use super::mesh::Mesh;

/// Twin of `Landscape` in `shaders/landscape/landscape.wgsl`; units and meanings there.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[expect(missing_docs, reason = "documented at the WGSL twin")]
pub struct Landscape {
    pub base: [f32; 2],
    pub amplitude: [f32; 2],
    pub half_size_m: f32,
    pub height_m: f32,
    pub wavelength_m: f32,
    pub gain: f32,
    pub damping: f32,
    pub ridge: f32,
    pub valley_m: f32,
    pub snow_line_m: f32,
    pub ground_albedo: [f32; 3],
    pub key: u32,
    pub columns: u32,
    pub rings: u32,
    pub far_rings: u32,
    pub centre_radius_m: f32,
    pub split_radius_m: f32,
    pub far_radius_m: f32,
    pub first_azimuth: f32,
    pub azimuth_step: f32,
    pub sun_tan_low: f32,
    pub sun_tan_high: f32,
    pub valley_phase: f32,
    pub padding0: f32,
    pub sun_heading: [f32; 2],
    pub padding1: f32,
    pub padding2: f32,
}

/// Half the width (rad) over which a shadow's edge fades: the sun's radius, and what the air's glow around it adds.
const SUN_EDGE: f64 = 0.008;

/// Lowest elevation (rad) of the sun's upper edge that shadows are computed for; they would be endless below.
const LOWEST_EDGE: f64 = 0.002;

impl Landscape {
    /// From a landscape, its parameters, the ground around it, the sun and the mesh of a view.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "the GPU computes in f32")]
    pub fn new(
        model: &Model,
        (params, ground): (&LandscapeParams, &GroundParams),
        sun: &SunDirection,
        mesh: &Mesh,
    ) -> Self {
        let low = (sun.elevation_rad - SUN_EDGE).max(LOWEST_EDGE);
        let high = (sun.elevation_rad + SUN_EDGE).max(low + LOWEST_EDGE);
        let steep = |angle: f64| angle.min(1.5).tan() as f32;
        let common = Self {
            half_size_m: model.half_size_m() as f32,
            snow_line_m: params.snow_line_m as f32,
            ground_albedo: [ground.red, ground.green, ground.blue].map(|albedo| albedo as f32),
            columns: mesh.columns,
            rings: mesh.rings,
            far_rings: mesh.far_rings,
            centre_radius_m: mesh.centre_radius_m as f32,
            split_radius_m: mesh.split_radius_m as f32,
            far_radius_m: mesh.far_radius_m as f32,
            first_azimuth: mesh.first_azimuth_rad as f32,
            azimuth_step: mesh.azimuth_step_rad as f32,
            sun_tan_low: steep(low),
            sun_tan_high: steep(high),
            sun_heading: [sun.azimuth_rad.sin() as f32, sun.azimuth_rad.cos() as f32],
            ..bytemuck::Zeroable::zeroed()
        };
        match model {
            Model::None => common,
            Model::Relief(relief) => Self {
                base: relief.base.map(|value| value as f32),
                amplitude: relief.amplitude.map(|value| value as f32),
                height_m: relief.height_m as f32,
                wavelength_m: relief.wavelength_m as f32,
                gain: relief.gain as f32,
                damping: relief.damping as f32,
                ridge: relief.ridge as f32,
                valley_m: relief.valley_m as f32,
                valley_phase: relief.valley_phase() as f32,
                key: relief.key,
                ..common
            },
        }
    }
}

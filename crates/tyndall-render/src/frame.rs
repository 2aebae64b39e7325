//! The camera and film of a frame as the shaders see them. WGSL: `shaders/frame/frame.wgsl`.

use tyndall_scene::camera::NEAR_M;
use tyndall_scene::{ExposureMode, Scene, ToneMap};

use crate::exposure::{expected_ev100, gain_from_ev100};
use crate::{FrameFormat, PictureFormat, RenderError, RendererConfig, View};

/// The largest value of a half float, less a margin for rounding.
const LARGEST_HALF: f32 = 65_000.0;

/// Uniform structs of this file.
pub mod gpu_data {
    /// Twin of `Frame` in `shaders/frame/frame.wgsl`; units and meanings there.
    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
    #[expect(missing_docs, reason = "documented at the WGSL twin")]
    pub struct Frame {
        pub right: [f32; 3],
        pub tan_half_width: f32,
        pub up: [f32; 3],
        pub tan_half_height: f32,
        pub forward: [f32; 3],
        pub near_m: f32,
        pub position_m: [f32; 3],
        pub pre_exposure: f32,
        pub size_px: [u32; 2],
        pub tone_map: u32,
        pub dither: u32,
        pub auto_exposure: u32,
        pub manual_gain: f32,
        pub compensation: f32,
        pub levels: f32,
        pub contrast: f32,
        pub saturation: f32,
        pub projection: u32,
        pub largest: f32,
    }
}

/// The uniform of a view of a scene, and of its film.
///
/// # Errors
/// When the scene has no sun position.
#[expect(clippy::cast_possible_truncation, reason = "the GPU computes in f32")]
pub fn frame_uniform(
    scene: &Scene,
    view: View,
    size_px: [u32; 2],
    config: RendererConfig,
) -> Result<gpu_data::Frame, RenderError> {
    let camera = view.frame(&scene.camera);
    let film = &scene.film;
    let expected_gain = gain_from_ev100(expected_ev100(scene.sun_direction()?.elevation_rad));
    let compensation = film.compensation_ev.exp2();
    let aspect = f64::from(size_px[0]) / f64::from(size_px[1]);
    let half_height = camera.orthographic_m.map_or(camera.tan_half_view, |width_m| 0.5 * width_m / aspect);
    Ok(gpu_data::Frame {
        right: camera.right.as_vec3().to_array(),
        tan_half_width: (half_height * aspect) as f32,
        up: camera.up.as_vec3().to_array(),
        tan_half_height: half_height as f32,
        forward: camera.forward.as_vec3().to_array(),
        near_m: NEAR_M as f32,
        position_m: camera.position.as_vec3().to_array(),
        pre_exposure: expected_gain as f32,
        size_px,
        tone_map: match film.tone_map {
            ToneMap::AgX => 0,
            ToneMap::Aces => 1,
            ToneMap::None => 2,
        },
        dither: u32::from(film.dither),
        auto_exposure: u32::from(film.exposure == ExposureMode::Auto),
        manual_gain: (compensation * gain_from_ev100(film.ev100) / expected_gain) as f32,
        compensation: compensation as f32,
        levels: match config.picture {
            PictureFormat::Eight => 255.0,
            PictureFormat::Sixteen => 65_535.0,
        },
        contrast: film.contrast as f32,
        saturation: film.saturation as f32,
        projection: if camera.orthographic_m.is_some() { 2 } else { u32::from(view == View::Panorama) },
        largest: match config.frame {
            FrameFormat::Half => LARGEST_HALF,
            FrameFormat::Float => f32::MAX,
        },
    })
}

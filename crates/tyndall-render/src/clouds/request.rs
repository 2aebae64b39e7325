//! What is asked of those who make clouds.

use tyndall_clouds::splats::SplatLighting;
use tyndall_scene::{CloudMethod, Orders, Scene};

use super::gpu_data::transport;
use super::lamp::Lamp;
use super::source::CloudSourceRequest;
use crate::RenderError;

/// What the textures follow from.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct VolumeRequest {
    /// The clouds.
    pub(super) source: CloudSourceRequest,
    /// Their light.
    pub(super) light: LightRequest,
    /// What lights their balls, for clouds of splats.
    pub(super) splats: Option<SplatLighting>,
}

/// What the light in the clouds follows from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LightRequest {
    /// Sun or moon.
    pub(super) lamp: Lamp,
    /// One less the mean cosine of scattering.
    pub(super) transport: f64,
    /// How deep turbulence cuts into edges, 0 to 1.
    pub(super) detail: f64,
}

impl VolumeRequest {
    /// The clouds of a scene, if it has any.
    ///
    /// # Errors
    /// When the scene has no sun position.
    pub(super) fn of(scene: &Scene) -> Result<Option<Self>, RenderError> {
        let Some(source) = CloudSourceRequest::of(scene) else { return Ok(None) };
        let clouds = &scene.clouds;
        let light = LightRequest { lamp: Lamp::of(scene)?, transport: transport(clouds), detail: clouds.detail };
        let splats = (clouds.method == CloudMethod::Splats).then(|| SplatLighting {
            to_sun: light.lamp.direction,
            transport: (clouds.orders == Orders::All).then_some(light.transport),
        });
        Ok(Some(Self { source, light, splats }))
    }
}

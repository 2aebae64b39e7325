//! What lies beside a file of light: everything that its numbers do not say.

use serde_json::{Value, json};
use tyndall_render::environment::{Environment, LightUnit, SunLight};
use tyndall_scene::Scene;

use super::HdriArguments;
use crate::light::{SunName, convert};

/// Version of the sidecar's form; raised when an entry changes its meaning.
const FORMAT: u32 = 1;

/// Where things are in the file, for people.
const MAPPING: &str = "row 0 is the zenith; the centre is +x (east), columns go on to -y (south); z is up";

/// What the sidecar is made of.
pub(super) struct Sidecar<'a> {
    pub(super) arguments: &'a HdriArguments,
    pub(super) scene: &'a Scene,
    pub(super) light: &'a Environment,
    pub(super) unit: LightUnit,
}

impl Sidecar<'_> {
    /// The sidecar.
    pub(super) fn to_json(&self) -> Value {
        let Self { arguments, scene, light, unit } = self;
        json!({
            "format": FORMAT,
            "software": format!("tyndall {}", env!("CARGO_PKG_VERSION")),
            "file": arguments.output.file_name().map(|name| name.to_string_lossy()),
            "title": scene.title,
            "scene_hash": scene.hash().to_string(),
            "size_px": light.size_px,
            "projection": "equirectangular",
            "mapping": MAPPING,
            "unit": {
                "name": arguments.units.name(),
                "white_luminance_cd_m2": unit.white_luminance_cd_m2(),
                "primaries": arguments.primaries.name(),
            },
            "exposure": { "ev100": light.ev100, "stops": unit.exposure_stops(light.ev100) },
            "sun": light.sun.as_ref().map(|sun| self.sun(sun)),
        })
    }

    fn sun(&self, sun: &SunLight) -> Value {
        let irradiance = convert(sun.irradiance, self.unit, self.arguments.primaries.into());
        let strongest = irradiance.into_iter().fold(f64::MIN_POSITIVE, f64::max);
        json!({
            "in_picture": self.arguments.sun == SunName::Disc && self.scene.sun.disc,
            "lamp_wanted": self.arguments.sun == SunName::Lamp,
            "direction_east_north_up": sun.unit().to_array(),
            "elevation_deg": sun.direction.elevation_rad.to_degrees(),
            "azimuth_deg": sun.direction.azimuth_rad.to_degrees(),
            "angular_radius_deg": sun.angular_radius_rad.to_degrees(),
            "normal_irradiance": irradiance,
            "normal_illuminance_lux": sun.illuminance_lux(),
            "blender_lamp": {
                "rotation_euler_xyz_deg": sun.blender_rotation_rad().map(f64::to_degrees),
                "strength": strongest,
                "color": irradiance.map(|value| value / strongest),
                "angle_deg": 2.0 * sun.angular_radius_rad.to_degrees(),
            },
        })
    }
}

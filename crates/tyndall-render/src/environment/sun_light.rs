//! The light of the sun's disc at the camera: what a lamp in place of the disc must give.
//!
//! The disc is cut into strips of equal elevation, each dimmed by the air in its direction: the light of a strip at the
//! height y of a disc with the limb darkening mu^a is proportional to (1 - y^2)^((a + 1) / 2). Refraction squeezes the strips.

use std::f64::consts::FRAC_PI_2;

use glam::DVec3;
use tyndall_core::spectrum::{Spectrum, rec709_from_spectrum};
use tyndall_scattering::Atmosphere;
use tyndall_scattering::atmosphere::Coefficients;
use tyndall_scattering::geometry::mu_along;
use tyndall_scattering::optical_length::columns_to_top;
use tyndall_scattering::refraction::RefractionTable;
use tyndall_scattering::sky_view_map::horizon_elevation;
use tyndall_scattering::sun_disc::limb_exponents;
use tyndall_scene::{Scene, SunDirection};

use crate::RenderError;

/// Strips of the visible part of the disc; twice as many change the light of no sun by 1e-4.
const STRIPS: u32 = 48;

/// The sun's light at the camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SunLight {
    /// Where the middle of its visible light is seen: refracted where the scene's air refracts.
    pub direction: SunDirection,
    /// Angle (rad) from the centre of the disc to its edge, as outside the air.
    pub angular_radius_rad: f64,
    /// Irradiance of a plane that faces the sun, linear Rec.709 with illuminance in lux.
    pub irradiance: [f64; 3],
}

impl SunLight {
    /// Of a scene; `None` when no part of the disc is above the horizon. Whether the scene draws the disc does not matter,
    /// nor what stands in front of it.
    ///
    /// # Errors
    /// When the scene has no sun position, or its atmosphere not the eight wavelengths.
    pub fn new(scene: &Scene) -> Result<Option<Self>, RenderError> {
        let sun = Disc::new(scene)?;
        let Some(strips) = sun.visible_strips() else { return Ok(None) };
        let (mut light, mut moment, mut weights) = ([0.0; 8], 0.0, 0.0);
        for strip in strips {
            let transmittance = sun.transmittance(strip.elevation);
            for (k, sum) in light.iter_mut().enumerate() {
                *sum += strip.weights[k] * transmittance[k] * sun.coefficients.solar_irradiance_w_m2_nm[k];
            }
            // The middle wavelength stands for all.
            let seen = strip.weights[4] * transmittance[4];
            moment += seen * strip.elevation;
            weights += seen;
        }
        if weights <= 0.0 {
            return Ok(None);
        }
        let bright = light.map(|value: f64| value * scene.sun.brightness);
        let direction = SunDirection { elevation_rad: moment / weights, azimuth_rad: sun.direction.azimuth_rad };
        let irradiance = rec709_from_spectrum(&bright);
        Ok(Some(Self { direction, angular_radius_rad: sun.radius, irradiance }))
    }

    /// Illuminance (lx) of a plane that faces the sun.
    #[must_use]
    pub fn illuminance_lux(&self) -> f64 {
        tyndall_core::spectrum::luminance_from_rec709(self.irradiance)
    }

    /// Rotation (rad, XYZ Euler) of a Blender lamp, which shines along its own -z, so that its light comes from the sun.
    #[must_use]
    pub fn blender_rotation_rad(&self) -> [f64; 3] {
        // Tilted about x by the zenith angle the lamp's z points to the south; about z it turns anticlockwise from there.
        [FRAC_PI_2 - self.direction.elevation_rad, 0.0, std::f64::consts::PI - self.direction.azimuth_rad]
    }

    /// Unit vector towards the sun: x east, y north, z up.
    #[must_use]
    pub fn unit(&self) -> DVec3 {
        self.direction.unit()
    }
}

/// A strip of the disc.
struct Strip {
    /// Where it is seen (rad).
    elevation: f64,
    /// Its share of the light of the whole disc, at each wavelength.
    weights: Spectrum,
}

/// The sun as a scene's camera sees it.
struct Disc {
    atmosphere: Atmosphere,
    coefficients: Coefficients,
    altitude_m: f64,
    horizon_elevation: f64,
    refraction: RefractionTable,
    direction: SunDirection,
    radius: f64,
    exponents: Spectrum,
}

impl Disc {
    fn new(scene: &Scene) -> Result<Self, RenderError> {
        let atmosphere = scene.model();
        let altitude_m = scene.grounded().camera.altitude_m;
        let horizon_elevation = horizon_elevation(atmosphere.planet_radius_m, altitude_m);
        let straight = || RefractionTable::straight(horizon_elevation);
        Ok(Self {
            coefficients: atmosphere.coefficients()?,
            atmosphere,
            altitude_m,
            horizon_elevation,
            refraction: scene.refractive_air().map_or_else(straight, |air| RefractionTable::new(&air, altitude_m)),
            direction: scene.sun_direction()?,
            radius: scene.sun.angular_radius_deg.to_radians(),
            exponents: limb_exponents(scene.sun.limb_darkening),
        })
    }

    /// Strips of the part above the horizon, in the parameter asin(y), which is smooth at the limb.
    fn visible_strips(&self) -> Option<Vec<Strip>> {
        let lowest_true = self.horizon_elevation - self.refraction.lookup(self.horizon_elevation);
        let lowest = ((lowest_true - self.direction.elevation_rad) / self.radius).clamp(-1.0, 1.0).asin();
        if lowest >= FRAC_PI_2 {
            return None;
        }
        let step = (FRAC_PI_2 - lowest) / f64::from(STRIPS);
        let whole = self.exponents.map(limb_integral);
        let strip = |index: u32| {
            let angle = lowest + (f64::from(index) + 0.5) * step;
            let at = |angle: f64| self.refraction.apparent(self.direction.elevation_rad + self.radius * angle.sin());
            // Surface brightness stays, so that a squeezed strip gives less light.
            let squeezed = (at(angle + 0.5 * step) - at(angle - 0.5 * step))
                / (self.radius * ((angle + 0.5 * step).sin() - (angle - 0.5 * step).sin()));
            let weight = |k: usize| squeezed * angle.cos().powf(self.exponents[k] + 2.0) * step / whole[k];
            Strip { elevation: at(angle), weights: std::array::from_fn(weight) }
        };
        Some((0..STRIPS).map(strip).collect())
    }

    /// Transmittance of the air towards something outside it, seen at an elevation (rad) above the horizon.
    fn transmittance(&self, elevation: f64) -> Spectrum {
        let (radius_m, top_m) = (self.atmosphere.planet_radius_m, self.atmosphere.top_altitude_m);
        let (mut h_m, mut mu) = (self.altitude_m, elevation.sin());
        if h_m > top_m {
            // From outside: down to where the ray enters the air, if it does.
            let b = (radius_m + h_m) * mu;
            let q = (h_m - top_m) * (2.0 * radius_m + h_m + top_m);
            if mu >= 0.0 || b * b < q {
                return [1.0; 8];
            }
            let entry_m = -b - (b * b - q).sqrt();
            mu = mu_along(radius_m, h_m, mu, 1.0, entry_m, top_m);
            h_m = top_m;
        }
        self.coefficients.transmittance(&columns_to_top(&self.atmosphere, h_m, mu))
    }
}

/// Integral of cos^(a + 2) over half a turn: what the weights of the strips of a whole disc add up to.
fn limb_integral(exponent: f64) -> f64 {
    let step = 2.0 * FRAC_PI_2 / f64::from(STRIPS);
    let node = |index: u32| (-FRAC_PI_2 + (f64::from(index) + 0.5) * step).cos().powf(exponent + 2.0);
    (0..STRIPS).map(node).sum::<f64>() * step
}

#[cfg(test)]
mod tests {
    use tyndall_core::spectrum::solar_illuminance_lux;

    use super::*;

    /// A scene without air, and with straight light.
    fn airless(elevation_deg: &str) -> Scene {
        let mut scene = Scene::default();
        for (path, value) in [
            ("atmosphere.air_density", "0"),
            ("atmosphere.aerosol_optical_depth", "0"),
            ("atmosphere.ozone_du", "0"),
            ("sun.elevation_deg", elevation_deg),
            ("camera.altitude_m", "0.1"),
        ] {
            scene.set_text(path, value).expect("a parameter");
        }
        scene
    }

    #[test]
    fn without_air_the_sun_gives_its_light_at_the_top() {
        let light = SunLight::new(&airless("40")).expect("valid").expect("above the horizon");
        let ratio = light.illuminance_lux() / solar_illuminance_lux();
        assert!((ratio - 1.0).abs() < 1e-3, "{ratio}: the sun is not quite white, its luminance is that of XYZ");
        assert!((light.direction.elevation_rad.to_degrees() - 40.0).abs() < 1e-6, "{:?}", light.direction);
    }

    #[test]
    fn half_a_disc_gives_half_of_the_light_and_none_none() {
        let light = |elevation_deg: &str| SunLight::new(&airless(elevation_deg)).expect("valid");
        let whole = light("10").expect("above").illuminance_lux();
        // The horizon of a camera 0.1 m up lies 0.6' below 0.
        let half = light("-0.010147").expect("above").illuminance_lux();
        assert!((half / whole - 0.5).abs() < 1e-3, "{}", half / whole);
        assert_eq!(light("-1"), None, "below the horizon");
    }

    #[test]
    fn a_blender_lamp_turned_as_said_shines_from_the_sun() {
        let mut scene = Scene::default();
        for (elevation, azimuth) in [(35.0, 0.0), (10.0, 120.0), (70.0, -60.0)] {
            scene.sun.elevation_deg = elevation;
            scene.sun.azimuth_deg = azimuth;
            let light = SunLight::new(&scene).expect("valid").expect("above");
            let [x, y, z] = light.blender_rotation_rad();
            // Blender's XYZ order turns about x first: columns of Rz Ry Rx.
            let turned = glam::DMat3::from_rotation_z(z)
                * glam::DMat3::from_rotation_y(y)
                * glam::DMat3::from_rotation_x(x)
                * DVec3::Z;
            assert!((turned - light.unit()).length() < 1e-12, "{elevation} {azimuth}: {turned}");
        }
    }
}

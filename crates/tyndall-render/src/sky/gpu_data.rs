//! Uniform structs of the sky and how they follow from a scene.

use tyndall_core::spectrum::{Spectrum, rec709_from_spectrum_matrix};
use tyndall_scattering::Atmosphere as Model;
use tyndall_scattering::ScatteringError;
use tyndall_scattering::atmosphere::{AEROSOL, AIR, HAZE, OZONE};
use tyndall_scattering::medium::Profile;
use tyndall_scattering::orders::basis::MAX_DEGREE;
use tyndall_scattering::orders::directions::gauss_legendre;
use tyndall_scattering::orders::media::ScatteringMedia;
use tyndall_scattering::orders::nodes::Nodes;
use tyndall_scattering::orders::{OrdersMethod, OrdersQuality};
use tyndall_scattering::params::GroundPattern;
use tyndall_scattering::phase::Phase;
use tyndall_scattering::sky_view_map::{ROWS_PER_ROW_BELOW, horizon_elevation};
use tyndall_scattering::sun_disc::limb_exponents;
use tyndall_scene::{Scene, SceneError};

/// Twin of `Atmosphere` in `shaders/sky/atmosphere.wgsl`; units and meanings there.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[expect(missing_docs, reason = "documented at the WGSL twin")]
pub struct Atmosphere {
    pub planet_radius_m: f32,
    pub top_altitude_m: f32,
    pub air_scale_height_m: f32,
    pub aerosol_scale_height_m: f32,
    pub ozone_altitude_m: f32,
    pub ozone_half_width_m: f32,
    pub aerosol_g: f32,
    pub aerosol_phase: u32,
    pub haze_top_m: f32,
    pub haze_scale_height_m: f32,
    pub haze_g: [f32; 2],
    pub haze_forward_weight: f32,
    pub haze_strongest: f32,
    pub haze_zone_m: f32,
    pub padding: u32,
    pub air_extinction: [f32; 8],
    pub aerosol_extinction: [f32; 8],
    pub ozone_extinction: [f32; 8],
    pub air_source: [f32; 8],
    pub aerosol_source: [f32; 8],
    pub haze_extinction: [f32; 8],
    pub haze_source: [f32; 8],
    pub solar_irradiance: [f32; 8],
    pub ground_albedo: [f32; 8],
    pub red: [f32; 8],
    pub green: [f32; 8],
    pub blue: [f32; 8],
}

/// Twin of `SkyView` in `shaders/sky/view.wgsl`; units and meanings there.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[expect(missing_docs, reason = "documented at the WGSL twin")]
pub struct SkyView {
    pub sun_direction: [f32; 3],
    pub observer_altitude_m: f32,
    pub limb_exponents: [f32; 8],
    pub horizon_elevation: f32,
    pub sun_angular_radius: f32,
    pub sun_visible: u32,
    pub panels: u32,
    pub table_size: [u32; 2],
    pub rows_below: u32,
    pub dome_rings: u32,
    pub dome_segments: u32,
    pub ground_pattern: u32,
    pub ground_tile_m: f32,
    pub padding: u32,
}

/// Twin of `Orders` in `shaders/sky/orders.wgsl`; units and meanings there.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[expect(missing_docs, reason = "documented at the WGSL twin")]
pub struct Orders {
    pub air_scattering: [f32; 8],
    pub aerosol_scattering: [f32; 8],
    pub haze_scattering: [f32; 8],
    pub moments: [[f32; 4]; MAX_DEGREE + 1],
    pub zeniths: [[f32; 4]; ORDERS_ZENITHS_MAX],
    pub altitudes: u32,
    pub suns_above: u32,
    pub suns_below: u32,
    pub zenith_count: u32,
    pub azimuths: u32,
    pub panels: u32,
    pub degree: u32,
    pub brightness: f32,
    pub lowest_mu_sun: f32,
    pub haze_even: u32,
    pub haze_thinning: u32,
    pub lights_surfaces: u32,
}

/// Twin of `SkyLight` in `shaders/sky/light.wgsl`; units and meanings there.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[expect(missing_docs, reason = "documented at the WGSL twin")]
pub struct SkyLight {
    pub lowest_mu_sun: f32,
    pub highest_mu_sun: f32,
    pub top_altitude_m: f32,
    pub lux: f32,
}

/// Zenith angles of the quadrature on each side of the horizon that `Orders` in `shaders/sky/orders.wgsl` has room for.
pub const ORDERS_ZENITHS_MAX: usize = 8;

impl Orders {
    /// From the model and the sizes of the table; its light counts `brightness` times. Sizes beyond what the shaders hold
    /// are cut.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "the GPU computes in f32 and u32")]
    pub fn new(model: &Model, quality: &OrdersQuality, brightness: f64) -> Self {
        let media = ScatteringMedia::new(model);
        let quality = quality.for_haze_of(model);
        let nodes = Nodes::new(model, &quality);
        let [air, aerosol, haze] = media.moments;
        let [air_scattering, aerosol_scattering, haze_scattering] = media.scattering_per_m;
        let zenith_count = quality.zeniths.min(ORDERS_ZENITHS_MAX);
        let mut zeniths = [[0.0; 4]; ORDERS_ZENITHS_MAX];
        for (node, (t, weight)) in zeniths.iter_mut().zip(gauss_legendre(zenith_count)) {
            *node = [t as f32, weight as f32, 0.0, 0.0];
        }
        Self {
            air_scattering,
            aerosol_scattering,
            haze_scattering,
            moments: std::array::from_fn(|l| [air[l], aerosol[l], haze[l], 0.0]),
            zeniths,
            altitudes: quality.altitudes as u32,
            suns_above: quality.suns_above as u32,
            suns_below: quality.suns_below as u32,
            zenith_count: zenith_count as u32,
            azimuths: quality.azimuths.min(ORDERS_ZENITHS_MAX) as u32,
            panels: quality.panels as u32,
            degree: quality.degree.min(MAX_DEGREE) as u32,
            brightness: brightness as f32,
            lowest_mu_sun: nodes.lowest_mu_sun() as f32,
            haze_even: nodes.haze().even as u32,
            haze_thinning: nodes.haze().thinning as u32,
            lights_surfaces: u32::from(quality.method == OrdersMethod::Harmonics),
        }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "the GPU computes in f32")]
fn narrow(spectrum: &Spectrum) -> [f32; 8] {
    spectrum.map(|value| value as f32)
}

impl Atmosphere {
    /// From the model; sunlight is multiplied by `brightness`.
    ///
    /// # Errors
    /// When the model does not have the eight wavelengths of the shaders, or profiles that they do not know.
    #[expect(clippy::cast_possible_truncation, reason = "the GPU computes in f32")]
    pub fn new(model: &Model, brightness: f64) -> Result<Self, ScatteringError> {
        let coefficients = model.coefficients()?;
        let [red, green, blue] = rec709_from_spectrum_matrix();
        let bright = |spectrum: &Spectrum| narrow(&spectrum.map(|value| value * brightness));
        let Profile::Tent { centre_m, half_width_m } = model.media[OZONE].profile else {
            return Err(ScatteringError::ProfileOnGpu { medium: "ozone" });
        };
        let (aerosol_phase, aerosol_g) = match model.media[AEROSOL].phase {
            Phase::CornetteShanks { g } => (0, g),
            Phase::HenyeyGreenstein { g } => (1, g),
            // Without a lobe it is Rayleigh's.
            Phase::Rayleigh | Phase::DoubleHenyeyGreenstein { .. } => (0, 0.0),
        };
        let haze = HazeUniform::new(model);
        let [air_source, aerosol_source, haze_source] = coefficients.source_w_m3_nm.each_ref().map(bright);
        Ok(Self {
            planet_radius_m: model.planet_radius_m as f32,
            top_altitude_m: model.top_altitude_m as f32,
            air_scale_height_m: scale_height_m(model, AIR, "air")? as f32,
            aerosol_scale_height_m: scale_height_m(model, AEROSOL, "aerosol")? as f32,
            ozone_altitude_m: centre_m as f32,
            ozone_half_width_m: half_width_m as f32,
            aerosol_g: aerosol_g as f32,
            aerosol_phase,
            haze_top_m: haze.top_m,
            haze_scale_height_m: haze.scale_height_m,
            haze_g: haze.g,
            haze_forward_weight: haze.forward_weight,
            haze_strongest: haze.strongest,
            haze_zone_m: haze.zone_m,
            padding: 0,
            air_extinction: narrow(&coefficients.extinction_per_m[AIR]),
            aerosol_extinction: narrow(&coefficients.extinction_per_m[AEROSOL]),
            ozone_extinction: narrow(&coefficients.extinction_per_m[OZONE]),
            air_source,
            aerosol_source,
            haze_extinction: narrow(&coefficients.extinction_per_m[HAZE]),
            haze_source,
            solar_irradiance: bright(&coefficients.solar_irradiance_w_m2_nm),
            ground_albedo: narrow(&coefficients.ground_albedo),
            red: narrow(&red),
            green: narrow(&green),
            blue: narrow(&blue),
        })
    }
}

/// Scale height (m) of an exponential medium.
fn scale_height_m(model: &Model, medium: usize, name: &'static str) -> Result<f64, ScatteringError> {
    match model.media[medium].profile {
        Profile::Exponential { scale_height_m } => Ok(scale_height_m),
        _ => Err(ScatteringError::ProfileOnGpu { medium: name }),
    }
}

/// The haze of the model as the shaders have it.
struct HazeUniform {
    top_m: f32,
    scale_height_m: f32,
    g: [f32; 2],
    forward_weight: f32,
    strongest: f32,
    zone_m: f32,
}

impl HazeUniform {
    #[expect(clippy::cast_possible_truncation, reason = "the GPU computes in f32")]
    fn new(model: &Model) -> Self {
        let layer = model.haze_layer();
        let (g, forward_weight) = match model.media[HAZE].phase {
            Phase::DoubleHenyeyGreenstein { g, forward_weight } => (g, forward_weight),
            Phase::HenyeyGreenstein { g } => ([g, 0.0], 1.0),
            Phase::Rayleigh | Phase::CornetteShanks { .. } => ([0.0; 2], 1.0),
        };
        Self {
            top_m: layer.map_or(0.0, |layer| layer.top_m) as f32,
            scale_height_m: layer.map_or(1.0, |layer| layer.scale_height_m) as f32,
            g: g.map(|g| g as f32),
            forward_weight: forward_weight as f32,
            strongest: layer.map_or(0.0, |layer| layer.strongest_per_m) as f32,
            zone_m: layer.map_or(0.0, |layer| layer.zone_m) as f32,
        }
    }
}

/// Columns and rows of the sky-view table for one of its diffuse part, and the least that this part may have.
const COLUMNS_PER_DIFFUSE_COLUMN: u32 = 3;
const ROWS_PER_DIFFUSE_ROW: u32 = 4;
const DIFFUSE_AZIMUTHS_MIN: u32 = 16;
const DIFFUSE_ROWS_BELOW_MIN: u32 = 8;

/// Nodes of a panel of the march.
const STEPS_PER_PANEL: u32 = 4;

impl SkyView {
    /// From the scene's camera, sun, sky and ground.
    ///
    /// # Errors
    /// When the scene has no sun position.
    #[expect(clippy::cast_possible_truncation, reason = "the GPU computes in f32")]
    pub fn new(scene: &Scene, model: &Model) -> Result<Self, SceneError> {
        let altitude_m = scene.camera.altitude_m;
        // Rows in multiples of the share below the horizon, so that both parts keep at least two.
        let rows_below = (scene.sky.table_elevations / ROWS_PER_ROW_BELOW as u32).max(2);
        Ok(Self {
            sun_direction: scene.sun_direction()?.unit().as_vec3().to_array(),
            observer_altitude_m: altitude_m as f32,
            limb_exponents: narrow(&limb_exponents(scene.sun.limb_darkening)),
            horizon_elevation: horizon_elevation(model.planet_radius_m, altitude_m) as f32,
            sun_angular_radius: scene.sun.angular_radius_deg.to_radians() as f32,
            sun_visible: u32::from(scene.sun.disc),
            panels: scene.sky.march_steps / STEPS_PER_PANEL,
            table_size: [scene.sky.table_azimuths, rows_below * ROWS_PER_ROW_BELOW as u32],
            rows_below,
            dome_rings: scene.sky.dome_rings,
            dome_segments: scene.sky.dome_segments,
            ground_pattern: u32::from(scene.ground.pattern == GroundPattern::Checker),
            ground_tile_m: scene.ground.tile_m as f32,
            padding: 0,
        })
    }

    /// Texels of the diffuse part of the sky-view table, azimuths and rows. It changes slowly with direction.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "a small constant")]
    pub fn diffuse_size(&self) -> [u32; 2] {
        let rows_below = (self.rows_below / ROWS_PER_DIFFUSE_ROW).max(DIFFUSE_ROWS_BELOW_MIN);
        [
            (self.table_size[0] / COLUMNS_PER_DIFFUSE_COLUMN).max(DIFFUSE_AZIMUTHS_MIN),
            rows_below * ROWS_PER_ROW_BELOW as u32,
        ]
    }

    /// The part that decides what the sky-view table holds.
    pub(super) fn table_key(&self) -> [u32; 8] {
        // Only the sun's height counts: the table's azimuths start at the sun.
        let [azimuths, rows] = self.table_size;
        let bits = [self.sun_direction[2], self.observer_altitude_m, self.horizon_elevation].map(f32::to_bits);
        [bits[0], bits[1], bits[2], azimuths, rows, self.rows_below, self.panels, 0]
    }
}

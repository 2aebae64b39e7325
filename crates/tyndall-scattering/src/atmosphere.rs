//! The atmosphere as one list of media over a spherical planet, with sunlight and ground.

use tyndall_core::spectrum::{SOLAR_IRRADIANCE_W_M2_NM, Spectrum, WAVELENGTH_COUNT, WAVELENGTHS_NM};
use tyndall_core::units::{M_PER_KM, MOLECULES_PER_M2_PER_DOBSON_UNIT};

use crate::ScatteringError;
use crate::aerosol::{aerosol_albedo, aerosol_optical_depth};
use crate::air::{bodhaine_optical_depth, paper_scattering_per_m};
use crate::ground::ground_albedo;
use crate::haze::{HazeParams, haze, no_haze};
use crate::layer_column::HazeLayer;
use crate::medium::{Medium, Profile};
use crate::ozone::ozone_cross_section_m2;
use crate::params::{AerosolPhase, AirModel, AtmosphereParams, GroundParams};
use crate::phase::Phase;

/// Number of media: air, aerosol, ozone, haze, in this order.
pub const MEDIUM_COUNT: usize = 4;

/// Index of the air in [`Atmosphere::media`].
pub const AIR: usize = 0;
/// Index of the aerosol in [`Atmosphere::media`].
pub const AEROSOL: usize = 1;
/// Index of the ozone in [`Atmosphere::media`].
pub const OZONE: usize = 2;
/// Index of the haze or fog in [`Atmosphere::media`].
pub const HAZE: usize = 3;

/// Number of media that scatter.
pub const SCATTERER_COUNT: usize = SCATTERERS.len();
/// Indices in [`Atmosphere::media`] of the media that scatter: air, aerosol, haze. Lists with one entry per scatterer have
/// this order.
pub const SCATTERERS: [usize; 3] = [AIR, AEROSOL, HAZE];

/// A planet's atmosphere at any number of wavelengths.
#[derive(Clone, Debug, PartialEq)]
pub struct Atmosphere {
    /// Radius of the planet at sea level (m).
    pub planet_radius_m: f64,
    /// Altitude of the top (m).
    pub top_altitude_m: f64,
    /// Wavelengths (nm); every spectrum below has as many values.
    pub wavelengths_nm: Vec<f64>,
    /// Sunlight at the top, on a plane facing the sun (W/m^2/nm).
    pub solar_irradiance_w_m2_nm: Vec<f64>,
    /// Air, aerosol, ozone, haze.
    pub media: [Medium; MEDIUM_COUNT],
    /// Share of light that the ground reflects, evenly in all directions.
    pub ground_albedo: Vec<f64>,
}

impl Atmosphere {
    /// The user's atmosphere at the product's eight wavelengths, without haze.
    #[must_use]
    pub fn new(params: &AtmosphereParams, ground: &GroundParams) -> Self {
        let spectrum = |value: &dyn Fn(f64) -> f64| WAVELENGTHS_NM.iter().map(|nm| value(*nm)).collect::<Vec<_>>();
        Self {
            planet_radius_m: params.planet_radius_km * M_PER_KM,
            top_altitude_m: params.top_altitude_km * M_PER_KM,
            wavelengths_nm: WAVELENGTHS_NM.to_vec(),
            solar_irradiance_w_m2_nm: SOLAR_IRRADIANCE_W_M2_NM.to_vec(),
            media: [
                air(params, &spectrum),
                aerosol(params, &spectrum),
                ozone(params, &spectrum),
                no_haze(WAVELENGTH_COUNT),
            ],
            ground_albedo: spectrum(&|nm| ground_albedo(ground, nm)),
        }
    }

    /// The same atmosphere with haze or fog.
    #[must_use]
    pub fn with_haze(mut self, params: &HazeParams) -> Self {
        self.media[HAZE] = haze(params, &self.wavelengths_nm);
        self
    }

    /// The haze as a layer, or `None` without haze.
    #[must_use]
    pub fn haze_layer(&self) -> Option<HazeLayer> {
        let medium = &self.media[HAZE];
        let Profile::Layer { top_m, scale_height_m } = medium.profile else { return None };
        let count = medium.scattering_per_m.len();
        let strongest_per_m = (0..count).map(|index| medium.extinction_per_m(index)).fold(0.0, f64::max);
        (strongest_per_m > 0.0).then(|| HazeLayer::new(self.planet_radius_m, (top_m, scale_height_m), strongest_per_m))
    }

    /// Values of the phase functions of the scatterers for the cosine between ray and sun (1/sr).
    #[must_use]
    pub fn phases(&self, nu: f64) -> [f64; SCATTERER_COUNT] {
        SCATTERERS.map(|medium| self.media[medium].phase.value(nu))
    }

    /// Optical depth at wavelength `index` of a path with these columns (m).
    #[must_use]
    pub fn optical_depth(&self, columns: &[f64; MEDIUM_COUNT], index: usize) -> f64 {
        self.media.iter().zip(columns).map(|(medium, column)| medium.extinction_per_m(index) * column).sum()
    }

    /// The coefficients as fixed-size spectra, for the tables.
    ///
    /// # Errors
    /// When the atmosphere does not have the eight wavelengths of the tables.
    pub fn coefficients(&self) -> Result<Coefficients, ScatteringError> {
        let fixed = |values: &[f64]| {
            Spectrum::try_from(values).map_err(|_wrong_length| ScatteringError::WavelengthCount {
                count: values.len(),
                expected: WAVELENGTH_COUNT,
            })
        };
        let solar = fixed(&self.solar_irradiance_w_m2_nm)?;
        Ok(Coefficients {
            extinction_per_m: self
                .media
                .each_ref()
                .map(|medium| std::array::from_fn(|index| medium.extinction_per_m(index))),
            source_w_m3_nm: SCATTERERS
                .map(|medium| std::array::from_fn(|index| self.media[medium].scattering_per_m[index] * solar[index])),
            solar_irradiance_w_m2_nm: solar,
            ground_albedo: fixed(&self.ground_albedo)?,
        })
    }
}

/// Coefficients of an [`Atmosphere`] at the eight wavelengths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficients {
    /// Extinction of each medium at density 1 (1/m).
    pub extinction_per_m: [Spectrum; MEDIUM_COUNT],
    /// Sunlight scattered by each scatterer at density 1, before the phase function (W/m^3/nm).
    pub source_w_m3_nm: [Spectrum; SCATTERER_COUNT],
    /// Sunlight at the top (W/m^2/nm).
    pub solar_irradiance_w_m2_nm: Spectrum,
    /// Share of light that the ground reflects.
    pub ground_albedo: Spectrum,
}

impl Coefficients {
    /// Transmittance of a path with these columns (m).
    #[must_use]
    pub fn transmittance(&self, columns: &[f64; MEDIUM_COUNT]) -> Spectrum {
        std::array::from_fn(|index| {
            let depth: f64 = self.extinction_per_m.iter().zip(columns).map(|(e, column)| e[index] * column).sum();
            (-depth).exp()
        })
    }
}

type PerWavelength<'a> = dyn Fn(&dyn Fn(f64) -> f64) -> Vec<f64> + 'a;

fn air(params: &AtmosphereParams, spectrum: &PerWavelength<'_>) -> Medium {
    let scale_height_m = params.air_scale_height_km * M_PER_KM;
    let scattering_per_m = spectrum(&|nm| match params.air_model {
        // The published quantity is the optical depth; divided by the scale height it holds for any profile.
        AirModel::Bodhaine1999 => params.air_density * bodhaine_optical_depth(nm) / scale_height_m,
        AirModel::Paper => params.air_density * paper_scattering_per_m(nm),
    });
    Medium {
        profile: Profile::Exponential { scale_height_m },
        scattering_per_m,
        absorption_per_m: spectrum(&|_nm| 0.0),
        phase: Phase::Rayleigh,
    }
}

fn aerosol(params: &AtmosphereParams, spectrum: &PerWavelength<'_>) -> Medium {
    let profile = Profile::Exponential { scale_height_m: params.aerosol_scale_height_km * M_PER_KM };
    let optical_depth = aerosol_optical_depth(params);
    let extinction_per_m =
        |nm: f64| optical_depth * (nm / 550.0).powf(-params.aerosol_angstrom) / profile.vertical_column_m();
    let g = params.aerosol_asymmetry;
    Medium {
        profile,
        scattering_per_m: spectrum(&|nm| aerosol_albedo(params, nm) * extinction_per_m(nm)),
        absorption_per_m: spectrum(&|nm| (1.0 - aerosol_albedo(params, nm)) * extinction_per_m(nm)),
        phase: match params.aerosol_phase {
            AerosolPhase::CornetteShanks => Phase::CornetteShanks { g },
            AerosolPhase::HenyeyGreenstein => Phase::HenyeyGreenstein { g },
        },
    }
}

fn ozone(params: &AtmosphereParams, spectrum: &PerWavelength<'_>) -> Medium {
    let profile = Profile::Tent {
        centre_m: params.ozone_altitude_km * M_PER_KM,
        half_width_m: params.ozone_half_width_km * M_PER_KM,
    };
    let molecules_per_m3 = params.ozone_du * MOLECULES_PER_M2_PER_DOBSON_UNIT / profile.vertical_column_m();
    Medium {
        profile,
        scattering_per_m: spectrum(&|_nm| 0.0),
        absorption_per_m: spectrum(&|nm| molecules_per_m3 * ozone_cross_section_m2(nm)),
        phase: Phase::Rayleigh,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optical_length::columns_to_top;

    fn standard() -> Atmosphere {
        Atmosphere::new(&AtmosphereParams::default(), &GroundParams::default())
    }

    fn zenith_optical_depth(atmosphere: &Atmosphere, medium: usize, index: usize) -> f64 {
        atmosphere.media[medium].extinction_per_m(index) * columns_to_top(atmosphere, 0.0, 1.0)[medium]
    }

    #[test]
    fn the_zenith_optical_depth_of_air_is_bodhaines() {
        let atmosphere = standard();
        for (index, nm) in WAVELENGTHS_NM.into_iter().enumerate() {
            let ratio = zenith_optical_depth(&atmosphere, AIR, index) / bodhaine_optical_depth(nm);
            assert!((ratio - 1.0).abs() < 1e-4, "{nm} nm: {ratio}");
        }
    }

    #[test]
    fn a_shell_twice_as_thick_changes_nothing() {
        let thick = AtmosphereParams { top_altitude_km: 200.0, ..AtmosphereParams::default() };
        let thick = Atmosphere::new(&thick, &GroundParams::default());
        for medium in [AIR, AEROSOL] {
            let ratio = zenith_optical_depth(&thick, medium, 0) / zenith_optical_depth(&standard(), medium, 0);
            assert!((ratio - 1.0).abs() < 1e-5, "medium {medium}: {ratio}");
        }
    }

    #[test]
    fn aerosol_mostly_scatters_and_ozone_only_absorbs() {
        let atmosphere = standard();
        let aerosol = &atmosphere.media[AEROSOL];
        let albedo = aerosol.scattering_per_m[3] / aerosol.extinction_per_m(3);
        assert!((albedo - 0.92).abs() < 1e-12, "{albedo}");
        assert!(atmosphere.media[OZONE].scattering_per_m.iter().all(|s| *s == 0.0), "ozone does not scatter");
        assert!(atmosphere.media[AIR].absorption_per_m.iter().all(|a| *a == 0.0), "air does not absorb");
    }

    #[test]
    fn the_users_optical_depth_and_ozone_column_are_what_a_vertical_ray_meets() {
        let atmosphere = standard();
        let aerosol_at_550: f64 = zenith_optical_depth(&atmosphere, AEROSOL, 3) / (524.0_f64 / 550.0).powf(-1.3);
        assert!((aerosol_at_550 - 0.1).abs() < 1e-9, "{aerosol_at_550}");
        let want = 300.0 * MOLECULES_PER_M2_PER_DOBSON_UNIT * ozone_cross_section_m2(618.0);
        let ozone = zenith_optical_depth(&atmosphere, OZONE, 5);
        assert!((ozone / want - 1.0).abs() < 1e-9, "{ozone} {want}");
    }

    #[test]
    fn the_papers_air_is_five_per_cent_thinner_than_the_best_one() {
        let paper = AtmosphereParams { air_model: AirModel::Paper, ..AtmosphereParams::default() };
        let paper = Atmosphere::new(&paper, &GroundParams::default());
        // Index 4 is 571 nm. The paper's 0.01097/km times 8 km at 550 nm is 0.0878 where Bodhaine has 0.0971: the King
        // factor explains 4.8 % and the paper's scale height of 8 km (the true column is 8.44 km) the rest.
        let ratio = zenith_optical_depth(&paper, AIR, 4) / zenith_optical_depth(&standard(), AIR, 4);
        assert!((ratio - 0.907).abs() < 0.005, "{ratio}");
    }
}

//! How much aerosol there is and what it absorbs, from the numbers that people know.

use tyndall_core::units::M_PER_KM;

use crate::air::{bodhaine_optical_depth, paper_scattering_per_m};
use crate::haze::{VisibilityContrast, extinction_from_visibility};
use crate::params::{AerosolInput, AirModel, AtmosphereParams};

/// Wavelength (nm) at which amounts of aerosol are stated.
const STATED_NM: f64 = 550.0;

/// Angstrom's coefficient (optical depth at 1000 nm) of a turbidity: slope and offset, Preetham et al. 1999, appendix A.1.
const BETA_PER_TURBIDITY: f64 = 0.046_083_658_220_50;
const BETA_OFFSET: f64 = -0.045_860_259_285_22;

/// Angstrom's exponent of the same source.
const PREETHAM_EXPONENT: f64 = 1.3;

/// Vertical optical depth of the aerosol at 550 nm; not below 0.
pub(crate) fn aerosol_optical_depth(params: &AtmosphereParams) -> f64 {
    match params.aerosol_input {
        AerosolInput::OpticalDepth => params.aerosol_optical_depth,
        AerosolInput::Turbidity => optical_depth_from_turbidity(params.aerosol_turbidity),
        AerosolInput::Visibility => {
            let visibility_m = params.aerosol_visibility_km * M_PER_KM;
            let all_per_m = extinction_from_visibility(visibility_m, VisibilityContrast::TwoPercent);
            (all_per_m - air_per_m(params)).max(0.0) * params.aerosol_scale_height_km * M_PER_KM
        }
    }
}

/// Optical depth of the aerosol at 550 nm for a turbidity: beta 0.55^-1.3 with beta = 0.04608 T - 0.04586.
#[must_use]
pub fn optical_depth_from_turbidity(turbidity: f64) -> f64 {
    let beta = BETA_PER_TURBIDITY * turbidity + BETA_OFFSET;
    beta * (STATED_NM * 1e-3).powf(-PREETHAM_EXPONENT)
}

/// Visibility (km) at the ground in air without aerosol; infinite without air.
#[must_use]
pub fn clearest_visibility_km(params: &AtmosphereParams) -> f64 {
    -VisibilityContrast::TwoPercent.share().ln() / (air_per_m(params) * M_PER_KM)
}

/// Extinction of the air alone at the ground at 550 nm (1/m).
fn air_per_m(params: &AtmosphereParams) -> f64 {
    let per_m = match params.air_model {
        AirModel::Bodhaine1999 => bodhaine_optical_depth(STATED_NM) / (params.air_scale_height_km * M_PER_KM),
        AirModel::Paper => paper_scattering_per_m(STATED_NM),
    };
    params.air_density * per_m
}

/// Share of the aerosol's extinction that is scattering: less by the loss at 440 nm and below, the whole from 640 nm on.
pub(crate) fn aerosol_albedo(params: &AtmosphereParams, wavelength_nm: f64) -> f64 {
    let blueness = ((640.0 - wavelength_nm) / 200.0).clamp(0.0, 1.0);
    (params.aerosol_albedo - params.aerosol_blue_loss * blueness).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Atmosphere;
    use crate::atmosphere::{AEROSOL, AIR};
    use crate::params::GroundParams;

    #[test]
    fn at_the_stated_visibility_two_per_cent_pass_along_the_ground() {
        for aerosol_visibility_km in [5.0, 40.0, 200.0] {
            let params = AtmosphereParams {
                aerosol_input: AerosolInput::Visibility,
                aerosol_visibility_km,
                aerosol_angstrom: 0.0,
                ..AtmosphereParams::default()
            };
            let atmosphere = Atmosphere::new(&params, &GroundParams::default());
            let aerosol = atmosphere.media[AEROSOL].extinction_per_m(3);
            let per_m = aerosol + air_per_m(&params);
            let passes = (-per_m * aerosol_visibility_km * M_PER_KM).exp();
            assert!((passes / 0.02 - 1.0).abs() < 1e-9, "{aerosol_visibility_km} km: {passes}");
            // Between 524 and 571 nm lies the air of 550 nm.
            let air = |k: usize| atmosphere.media[AIR].extinction_per_m(k);
            assert!(air(3) > air_per_m(&params) && air_per_m(&params) > air(4), "air at 550 nm");
        }
    }

    #[test]
    fn turbidities_have_preethams_optical_depths() {
        // T = 1 is air alone; Preetham's T = 2 gives beta 0.0463 and T = 6 gives 0.2306.
        assert!(optical_depth_from_turbidity(1.0) < 1e-3, "{}", optical_depth_from_turbidity(1.0));
        for (turbidity, beta) in [(2.0, 0.0463), (6.0, 0.2306)] {
            let got = optical_depth_from_turbidity(turbidity) * 0.55_f64.powf(1.3);
            assert!((got - beta).abs() < 1e-4, "T = {turbidity}: {got}");
        }
    }

    #[test]
    fn dust_that_absorbs_blue_keeps_its_red() {
        let params = AtmosphereParams { aerosol_blue_loss: 0.2, ..AtmosphereParams::default() };
        assert!((aerosol_albedo(&params, 430.0) - 0.72).abs() < 1e-12, "blue");
        assert!((aerosol_albedo(&params, 700.0) - 0.92).abs() < 1e-12, "red");
    }

    #[test]
    fn the_clearest_air_lets_one_see_three_hundred_kilometres() {
        let km = clearest_visibility_km(&AtmosphereParams::default());
        assert!((300.0..330.0).contains(&km), "{km}");
    }
}

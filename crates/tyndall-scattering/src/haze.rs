//! Haze and fog: a layer at the ground that thins out above its top, given by the distance at which things vanish in it.

use tyndall_core::units::M_PER_KM;
use tyndall_core::{choices, params};

use crate::ground::albedo_from_rgb;
use crate::medium::{Medium, Profile};
use crate::phase::Phase;

choices! {
    /// How much contrast is left of a black thing at the distance called visibility.
    pub enum VisibilityContrast {
        /// 2 per cent: extinction = 3.912 / visibility.
        TwoPercent = "2-percent",
        /// 5 per cent, the meteorological optical range: extinction = 2.996 / visibility.
        FivePercent = "5-percent",
    }
}

impl VisibilityContrast {
    /// Share of contrast that is left, and of light that passes.
    #[must_use]
    pub fn share(self) -> f64 {
        match self {
            Self::TwoPercent => 0.02,
            Self::FivePercent => 0.05,
        }
    }
}

params! {
    /// Haze or fog near the ground.
    pub struct HazeParams {
        /// Whether there is haze or fog.
        enabled: bool = false, "design";
        /// Distance at which black things vanish in the layer: below 1 km one speaks of fog. Extinction at 550 nm by the haze alone.
        visibility_km: f64 = 3.0, ["km", 0.02..=300.0, Log], "Koschmieder 1924";
        /// Contrast that is left of a black thing at that distance.
        contrast: VisibilityContrast = VisibilityContrast::TwoPercent, "Koschmieder 1924; WMO-No. 8, chapter 9";
        /// Height up to which the layer is even; 0 for fog that thins out from the ground.
        top_m: f64 = 150.0, ["m", 0.0..=5000.0, Linear], "design";
        /// Height over which it thins out by a factor e above that.
        scale_height_m: f64 = 60.0, ["m", 1.0..=1000.0, Log], "Kaneda et al. 1991";
        /// How fast its extinction falls with wavelength; 0 is grey, as fog, 1.3 fine smoke.
        angstrom: f64 = 0.0, ["1", -0.5..=4.0, Linear], "Angstrom 1929";
        /// Share of red light that it scatters and does not absorb.
        albedo_red: f64 = 0.99, ["1", 0.0..=1.0, Linear], "Dubovik et al. 2002, table 1";
        /// Share of green light that it scatters and does not absorb.
        albedo_green: f64 = 0.99, ["1", 0.0..=1.0, Linear], "Dubovik et al. 2002, table 1";
        /// Share of blue light that it scatters and does not absorb.
        albedo_blue: f64 = 0.99, ["1", 0.0..=1.0, Linear], "Dubovik et al. 2002, table 1";
        /// Mean cosine of the forward lobe; near 1 a narrow, bright aureole.
        forward_asymmetry: f64 = 0.8, ["1", 0.0..=0.95, Linear], "Henyey and Greenstein 1941";
        /// Mean cosine of the backward lobe.
        backward_asymmetry: f64 = -0.3, ["1", -0.95..=0.0, Linear], "Henyey and Greenstein 1941";
        /// Share of the light in the forward lobe.
        forward_weight: f64 = 0.9, ["1", 0.0..=1.0, Linear], "two-term Henyey-Greenstein";
    }
}

/// Extinction (1/m) at which the share `contrast` passes over `visibility_m`, by the law of Koschmieder 1924.
#[must_use]
pub fn extinction_from_visibility(visibility_m: f64, contrast: VisibilityContrast) -> f64 {
    -contrast.share().ln() / visibility_m
}

impl HazeParams {
    /// Extinction in the layer at 550 nm (1/m).
    #[must_use]
    pub fn extinction_per_m(&self) -> f64 {
        if self.enabled { extinction_from_visibility(self.visibility_km * M_PER_KM, self.contrast) } else { 0.0 }
    }
}

/// The medium at some wavelengths.
pub(crate) fn haze(params: &HazeParams, wavelengths_nm: &[f64]) -> Medium {
    let at_550_nm = params.extinction_per_m();
    let rgb = [params.albedo_red, params.albedo_green, params.albedo_blue];
    let spectrum = |share: &dyn Fn(f64) -> f64| {
        let value = |nm: &f64| at_550_nm * (nm / 550.0).powf(-params.angstrom) * share(albedo_from_rgb(rgb, *nm));
        wavelengths_nm.iter().map(value).collect()
    };
    Medium {
        profile: Profile::Layer { top_m: params.top_m, scale_height_m: params.scale_height_m },
        scattering_per_m: spectrum(&|albedo| albedo),
        absorption_per_m: spectrum(&|albedo| 1.0 - albedo),
        phase: Phase::DoubleHenyeyGreenstein {
            g: [params.forward_asymmetry, params.backward_asymmetry],
            forward_weight: params.forward_weight,
        },
    }
}

/// A haze that neither scatters nor absorbs at `count` wavelengths.
pub(crate) fn no_haze(count: usize) -> Medium {
    haze(&HazeParams::default(), &vec![550.0; count])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Atmosphere;
    use crate::atmosphere::HAZE;
    use crate::optical_length::columns_along;
    use crate::params::{AtmosphereParams, GroundParams};

    #[test]
    fn at_the_visibility_the_stated_contrast_is_left() {
        for contrast in [VisibilityContrast::TwoPercent, VisibilityContrast::FivePercent] {
            for visibility_km in [0.1, 1.0, 5.0] {
                let params = HazeParams { enabled: true, visibility_km, contrast, ..HazeParams::default() };
                let atmosphere = Atmosphere::new(&AtmosphereParams::default(), &GroundParams::default());
                let atmosphere = atmosphere.with_haze(&params);
                let columns = columns_along(&atmosphere, 2.0, 0.0, visibility_km * M_PER_KM);
                let left = (-atmosphere.media[HAZE].extinction_per_m(3) * columns[HAZE]).exp();
                assert!((left / contrast.share() - 1.0).abs() < 0.01, "{visibility_km} km: {left}");
            }
        }
    }

    #[test]
    fn without_haze_there_is_none() {
        assert!(no_haze(8).is_absent(), "switched off");
        let on = HazeParams { enabled: true, ..HazeParams::default() };
        assert!(!haze(&on, &[550.0]).is_absent(), "switched on");
    }
}

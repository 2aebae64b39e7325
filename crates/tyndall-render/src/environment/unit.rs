//! Units of light in files for other programs.

use crate::exposure::gain_from_ev100;

/// Luminance (cd/m^2) of one unit of radiance in Blender: its sky textures take 683 lm/W for all light, as at 555 nm.
pub const BLENDER_LUMENS_PER_WATT: f64 = 683.0;

/// What the number 1 in a file means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightUnit {
    /// W/m^2/sr as Blender's own sky textures count it: luminance over 683. Lamps fit: the strength of a sun is in W/m^2.
    Blender,
    /// cd/m^2.
    CandelaPerSquareMetre,
    /// White of a picture of this exposure (EV at ISO 100), for programs that know no units.
    Exposed {
        /// Exposure value at ISO 100.
        ev100: f64,
    },
}

impl LightUnit {
    /// Number in the file for a luminance of 1 cd/m^2 (or an illuminance of 1 lx).
    #[must_use]
    pub fn per_cd_m2(self) -> f64 {
        match self {
            Self::Blender => 1.0 / BLENDER_LUMENS_PER_WATT,
            Self::CandelaPerSquareMetre => 1.0,
            Self::Exposed { ev100 } => gain_from_ev100(ev100),
        }
    }

    /// Luminance (cd/m^2) of the number 1: what `whiteLuminance` in an EXR header says.
    #[must_use]
    pub fn white_luminance_cd_m2(self) -> f64 {
        1.0 / self.per_cd_m2()
    }

    /// Stops that a program must add to files in this unit to show them as a picture of this exposure.
    #[must_use]
    pub fn exposure_stops(self, ev100: f64) -> f64 {
        (gain_from_ev100(ev100) / self.per_cd_m2()).log2()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_in_a_blender_file_is_683_cd_m2() {
        assert!((LightUnit::Blender.white_luminance_cd_m2() - 683.0).abs() < 1e-9, "as in its sky textures");
        assert!((LightUnit::CandelaPerSquareMetre.per_cd_m2() - 1.0).abs() < 1e-12, "itself");
    }

    #[test]
    fn exposed_files_need_no_stops_and_others_those_of_their_unit() {
        for ev100 in [-3.0, 0.0, 14.7] {
            assert!(LightUnit::Exposed { ev100 }.exposure_stops(ev100).abs() < 1e-12, "EV {ev100}");
            // White at EV100 is 1.2 x 2^EV cd/m^2.
            let stops = LightUnit::Blender.exposure_stops(ev100);
            assert!((stops - ((683.0_f64 / 1.2).log2() - ev100)).abs() < 1e-9, "EV {ev100}: {stops}");
        }
    }
}

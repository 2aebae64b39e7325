//! Options that files of light for other programs share: unit, sun, ground, primaries.

use tyndall_core::primaries::RgbPrimaries;
use tyndall_render::environment::{GroundLight, LightUnit};

/// Unit of the numbers in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum UnitName {
    /// Luminance over 683 cd/m2, as Blender's own sky textures count; a Blender sun of the sidecar's strength fits
    Blender,
    /// Luminance in cd/m2
    #[value(name = "cd/m2")]
    CandelaPerSquareMetre,
    /// 1 is white at the exposure of the scene's own picture
    Exposed,
}

impl UnitName {
    /// The unit, for a scene whose picture has this exposure (EV at ISO 100).
    #[must_use]
    pub fn at(self, ev100: f64) -> LightUnit {
        match self {
            Self::Blender => LightUnit::Blender,
            Self::CandelaPerSquareMetre => LightUnit::CandelaPerSquareMetre,
            Self::Exposed => LightUnit::Exposed { ev100 },
        }
    }

    /// Its name on the command line and in sidecars.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Blender => "blender",
            Self::CandelaPerSquareMetre => "cd/m2",
            Self::Exposed => "exposed",
        }
    }
}

/// What becomes of the sun's disc.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum SunName {
    /// Drawn, with all of its light
    Disc,
    /// Left out
    None,
    /// Left out, for a lamp of the light that the sidecar names
    Lamp,
}

/// What lies below the horizon.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum GroundName {
    /// The ground, as sun and sky light it
    True,
    /// Nothing, for scenes with a ground of their own
    Black,
}

impl From<GroundName> for GroundLight {
    fn from(name: GroundName) -> Self {
        match name {
            GroundName::True => Self::True,
            GroundName::Black => Self::Black,
        }
    }
}

/// Primaries of the colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum PrimariesName {
    /// Rec.709 with white D65, Blender's default
    Rec709,
    /// `ACEScg`
    #[value(name = "acescg")]
    AcesCg,
}

impl PrimariesName {
    /// Its name on the command line and in sidecars.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Rec709 => "rec709",
            Self::AcesCg => "acescg",
        }
    }
}

impl From<PrimariesName> for RgbPrimaries {
    fn from(name: PrimariesName) -> Self {
        match name {
            PrimariesName::Rec709 => Self::Rec709,
            PrimariesName::AcesCg => Self::AcesCg,
        }
    }
}

/// Brings light in Rec.709 and cd/m^2 (or lx) into a unit and into primaries.
#[must_use]
pub fn convert(rgb: [f64; 3], unit: LightUnit, primaries: RgbPrimaries) -> [f64; 3] {
    let scale = unit.per_cd_m2();
    primaries.convert_rec709(rgb).map(|value| value * scale)
}

/// [`convert`] for all pixels of a picture.
#[expect(clippy::cast_possible_truncation, reason = "pixels are f32")]
pub fn convert_pixels(rgba: &mut [[f32; 4]], unit: LightUnit, primaries: RgbPrimaries) {
    for pixel in rgba {
        let [red, green, blue, alpha] = *pixel;
        let [red, green, blue] = convert([red, green, blue].map(f64::from), unit, primaries);
        *pixel = [red as f32, green as f32, blue as f32, alpha];
    }
}

#[cfg(test)]
mod tests {
    use clap::ValueEnum as _;

    use super::*;

    #[test]
    fn names_on_the_command_line_are_those_of_the_sidecar() {
        for unit in UnitName::value_variants() {
            assert_eq!(UnitName::from_str(unit.name(), false), Ok(*unit), "{unit:?}");
        }
        for primaries in PrimariesName::value_variants() {
            assert_eq!(PrimariesName::from_str(primaries.name(), false), Ok(*primaries), "{primaries:?}");
        }
    }

    #[test]
    fn a_pixel_of_683_cd_m2_is_one_in_blender() {
        let mut pixels = [[683.0, 1366.0, 0.0, 1.0]];
        convert_pixels(&mut pixels, LightUnit::Blender, RgbPrimaries::Rec709);
        let [red, green, blue, alpha] = pixels[0];
        let apart = (red - 1.0).abs() + (green - 2.0).abs() + blue.abs() + (alpha - 1.0).abs();
        assert!(apart < 1e-6, "{pixels:?}");
    }
}

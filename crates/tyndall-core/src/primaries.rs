//! Colour spaces of linear RGB in files.

/// CIE 1931 chromaticities (x, y) of red, green, blue and white.
pub type Chromaticities = [[f64; 2]; 4];

/// Linear Rec.709 to `ACEScg`, white of D65 to white of ACES by Bradford's adaptation; rows.
const ACES_CG_FROM_REC709: [[f64; 3]; 3] = [
    [0.613_097_402, 0.339_523_146, 0.047_379_451],
    [0.070_193_722, 0.916_353_879, 0.013_452_398],
    [0.020_615_593, 0.109_569_773, 0.869_814_634],
];

/// The primaries of linear RGB.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RgbPrimaries {
    /// Rec. ITU-R BT.709-6 with white D65: what Tyndall computes in.
    #[default]
    Rec709,
    /// `ACEScg` (AP1 with the ACES white), the working space of film productions.
    AcesCg,
}

impl RgbPrimaries {
    /// Chromaticities of red, green, blue and white.
    #[must_use]
    pub fn chromaticities(self) -> Chromaticities {
        match self {
            Self::Rec709 => [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06], [0.3127, 0.3290]],
            Self::AcesCg => [[0.713, 0.293], [0.165, 0.830], [0.128, 0.044], [0.321_68, 0.337_67]],
        }
    }

    /// Name of scene-linear light with these primaries in the ACES colour configurations.
    #[must_use]
    pub fn color_space(self) -> &'static str {
        match self {
            Self::Rec709 => "lin_rec709_scene",
            Self::AcesCg => "lin_ap1_scene",
        }
    }

    /// Linear Rec.709 in these primaries.
    #[must_use]
    pub fn convert_rec709(self, rgb: [f64; 3]) -> [f64; 3] {
        match self {
            Self::Rec709 => rgb,
            Self::AcesCg => {
                ACES_CG_FROM_REC709.map(|row| row.iter().zip(rgb).map(|(weight, value)| weight * value).sum())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bradford's cone responses of XYZ.
    const CONES: [[f64; 3]; 3] = [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]];

    fn multiply(matrix: [[f64; 3]; 3], vector: [f64; 3]) -> [f64; 3] {
        matrix.map(|row| (0..3).map(|i| row[i] * vector[i]).sum())
    }

    fn xyz([x, y]: [f64; 2]) -> [f64; 3] {
        [x / y, 1.0, (1.0 - x - y) / y]
    }

    /// Solves three equations by Cramer's rule; columns.
    fn solve(columns: [[f64; 3]; 3], wanted: [f64; 3]) -> [f64; 3] {
        let triple = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| {
            a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
        };
        let [a, b, c] = columns;
        let whole = triple(a, b, c);
        [triple(wanted, b, c) / whole, triple(a, wanted, c) / whole, triple(a, b, wanted) / whole]
    }

    /// XYZ of an RGB colour, relative to its white.
    fn xyz_of(primaries: RgbPrimaries, rgb: [f64; 3]) -> [f64; 3] {
        let [red, green, blue, white] = primaries.chromaticities().map(xyz);
        let scale = solve([red, green, blue], white);
        std::array::from_fn(|i| rgb[0] * scale[0] * red[i] + rgb[1] * scale[1] * green[i] + rgb[2] * scale[2] * blue[i])
    }

    #[test]
    fn white_stays_white_and_no_light_is_lost() {
        let white = RgbPrimaries::AcesCg.convert_rec709([1.0; 3]);
        assert!(white.iter().all(|value| (value - 1.0).abs() < 1e-6), "{white:?}");
        let colour = [0.2, 0.5, 0.9];
        assert_eq!(RgbPrimaries::Rec709.convert_rec709(colour).map(f64::to_bits), colour.map(f64::to_bits), "itself");
    }

    #[test]
    fn colours_keep_their_cone_responses_relative_to_white() {
        for colour in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.3, 0.5, 0.9]] {
            let relative = |primaries: RgbPrimaries, rgb: [f64; 3]| -> [f64; 3] {
                let (cones, white) = (xyz_of(primaries, rgb), xyz_of(primaries, [1.0; 3]));
                let (cones, white) = (multiply(CONES, cones), multiply(CONES, white));
                std::array::from_fn(|i| cones[i] / white[i])
            };
            let before = relative(RgbPrimaries::Rec709, colour);
            let after = relative(RgbPrimaries::AcesCg, RgbPrimaries::AcesCg.convert_rec709(colour));
            let apart = before.iter().zip(after).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(apart < 1e-6, "{colour:?}: {before:?} {after:?}");
        }
    }
}

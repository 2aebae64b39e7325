//! Spaces in which FLIP compares colours; all of them relative to the white of linear Rec.709, D65.

use std::sync::LazyLock;

use glam::{DMat3, DVec3};
use tyndall_core::spectrum::REC709_FROM_XYZ;

/// From linear Rec.709 to XYZ over that of white, and back.
static RELATIVE_XYZ: LazyLock<[DMat3; 2]> = LazyLock::new(|| {
    let [x, y, z] = REC709_FROM_XYZ.map(DVec3::from_array);
    let xyz = DMat3::from_cols(x, y, z).transpose().inverse();
    let relative = DMat3::from_diagonal((xyz * DVec3::ONE).recip()) * xyz;
    [relative, relative.inverse()]
});

/// `YyCxCz` (Flohr et al. 1993) of linear Rec.709: lightness and two opponent colours, all linear in light, so that they
/// may be blurred.
pub(super) fn ycxcz_from_linear(rgb: [f64; 3]) -> [f64; 3] {
    let [x, y, z] = (RELATIVE_XYZ[0] * DVec3::from_array(rgb)).to_array();
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// The inverse of [`ycxcz_from_linear`].
pub(super) fn linear_from_ycxcz([lightness, cx, cz]: [f64; 3]) -> [f64; 3] {
    let y = (lightness + 16.0) / 116.0;
    (RELATIVE_XYZ[1] * DVec3::new(y + cx / 500.0, y, y - cz / 200.0)).to_array()
}

/// CIELAB of linear Rec.709, where colours fade with the light (Hunt).
pub(super) fn hunt_lab(rgb: [f64; 3]) -> [f64; 3] {
    let threshold: f64 = 6.0 / 29.0;
    let root = |share: f64| {
        if share > threshold.powi(3) { share.cbrt() } else { share / (3.0 * threshold * threshold) + 4.0 / 29.0 }
    };
    let [x, y, z] = (RELATIVE_XYZ[0] * DVec3::from_array(rgb)).to_array().map(root);
    let lightness = 116.0 * y - 16.0;
    let faded = 0.01 * lightness;
    [lightness, faded * 500.0 * (x - y), faded * 200.0 * (y - z)]
}

/// Distance of two colours of CIELAB (Abasi et al. 2020): along the streets in lightness, as the crow flies in colour.
pub(super) fn hyab(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] - b[0]).abs() + (a[1] - b[1]).hypot(a[2] - b[2])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn greys_have_no_colour_and_white_is_100_light() {
        for grey in [0.0, 0.001, 0.18, 1.0] {
            let [_, cx, cz] = ycxcz_from_linear([grey; 3]);
            let [lightness, a, b] = hunt_lab([grey; 3]);
            assert!(cx.hypot(cz) < 1e-9 && a.hypot(b) < 1e-9, "grey {grey}: {cx} {cz} {a} {b}");
            assert!((0.0..=100.0 + 1e-9).contains(&lightness), "grey {grey}: {lightness}");
        }
        assert!((hyab(hunt_lab([1.0; 3]), hunt_lab([0.0; 3])) - 100.0).abs() < 1e-9, "black beside white");
    }

    #[test]
    fn opponent_colours_lead_back_to_where_they_came_from() {
        for rgb in [[0.2, 0.5, 0.9], [1.0, 0.0, 0.3]] {
            let back = linear_from_ycxcz(ycxcz_from_linear(rgb));
            assert!(rgb.iter().zip(back).all(|(a, b)| (a - b).abs() < 1e-12), "{rgb:?} {back:?}");
        }
    }
}

//! Tone mapping. f64 twins of `shaders/common/tone.wgsl`, where each formula has its source.

/// AgX: from linear Rec.709 to the space of its curve; rows.
pub const AGX_INSET: [[f64; 3]; 3] = [
    [0.842479062253094, 0.0784335999999992, 0.0792237451477643],
    [0.0423282422610123, 0.878468636469772, 0.0791661274605434],
    [0.0423756549057051, 0.0784336, 0.879142973793104],
];

/// The inverse of [`AGX_INSET`]; rows.
pub const AGX_OUTSET: [[f64; 3]; 3] = [
    [1.19687900512017, -0.0980208811401368, -0.0990297440797205],
    [-0.0528968517574562, 1.15190312990417, -0.0989611768448433],
    [-0.0529716355144438, -0.0980434501171241, 1.15107367264116],
];

const AGX_LOW_LOG2: f64 = -12.473931188;
const AGX_RANGE_LOG2: f64 = 16.5;

const ACES_TO_RRT: [[f64; 3]; 3] =
    [[0.59719, 0.35458, 0.04823], [0.07600, 0.90834, 0.01566], [0.02840, 0.13383, 0.83777]];
const ACES_FROM_ODT: [[f64; 3]; 3] =
    [[1.60475, -0.53108, -0.07367], [-0.10208, 1.10813, -0.00605], [-0.00327, -0.07276, 1.07602]];

fn multiply(matrix: &[[f64; 3]; 3], vector: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * vector[0] + row[1] * vector[1] + row[2] * vector[2])
}

/// sRGB encoding of a linear channel, IEC 61966-2-1.
#[must_use]
pub fn tone_srgb_encode(linear: f64) -> f64 {
    let x = linear.clamp(0.0, 1.0);
    if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }
}

/// The AgX curve on log-encoded `x` in 0..1.
#[must_use]
pub fn tone_agx_curve(x: f64) -> f64 {
    let (pivot_x, pivot_y, slope) = (0.606_060_6, 0.5, 2.0);
    let shoulder = x >= pivot_x;
    let (power, run, rise) = if shoulder { (3.25, 1.0 - pivot_x, 1.0 - pivot_y) } else { (3.0, pivot_x, pivot_y) };
    let reach: f64 = slope * run;
    let scale = (reach.powf(-power) * ((reach / rise).powf(power) - 1.0)).powf(-1.0 / power);
    let v = slope * (x - pivot_x).abs() / scale;
    let bent = scale * v / (1.0 + v.powf(power)).powf(1.0 / power);
    if shoulder { pivot_y + bent } else { pivot_y - bent }
}

/// AgX of exposed linear Rec.709: display values, encoded.
#[must_use]
pub fn tone_agx(colour: [f64; 3]) -> [f64; 3] {
    let inside = multiply(&AGX_INSET, colour.map(|c| c.max(0.0)));
    let curved =
        inside.map(|c| tone_agx_curve(((c.max(1e-10).log2() - AGX_LOW_LOG2) / AGX_RANGE_LOG2).clamp(0.0, 1.0)));
    multiply(&AGX_OUTSET, curved).map(|c| c.clamp(0.0, 1.0))
}

/// A look on display values: power, then saturation about Rec.709 luma; ASC colour decision list.
#[must_use]
pub fn tone_look(shown: [f64; 3], contrast: f64, saturation: f64) -> [f64; 3] {
    let bent = shown.map(|c| c.max(0.0).powf(contrast));
    let luma = 0.2126 * bent[0] + 0.7152 * bent[1] + 0.0722 * bent[2];
    bent.map(|c| (luma + (c - luma) * saturation).clamp(0.0, 1.0))
}

/// ACES of exposed linear Rec.709: display values, linear.
#[must_use]
pub fn tone_aces(colour: [f64; 3]) -> [f64; 3] {
    let v = multiply(&ACES_TO_RRT, colour.map(|c| c.max(0.0)));
    let curved = v.map(|v| (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081));
    multiply(&ACES_FROM_ODT, curved).map(|c| c.clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_agx_curve_runs_from_black_through_the_pivot_to_white_and_always_rises() {
        assert!(tone_agx_curve(0.0).abs() < 1e-12, "black: {}", tone_agx_curve(0.0));
        assert!((tone_agx_curve(1.0) - 1.0).abs() < 1e-12, "white: {}", tone_agx_curve(1.0));
        assert!((tone_agx_curve(0.606_060_6) - 0.5).abs() < 1e-12, "pivot");
        for i in 0..1000 {
            let (a, b) = (f64::from(i) / 1000.0, f64::from(i + 1) / 1000.0);
            assert!(tone_agx_curve(b) > tone_agx_curve(a), "at {a}");
        }
    }

    #[test]
    fn middle_grey_is_half_and_grey_stays_grey_in_agx() {
        for channel in tone_agx([0.18; 3]) {
            assert!((channel - 0.5).abs() < 2e-4, "{channel}");
        }
        for grey in [0.001, 0.05, 1.0, 8.0] {
            let [r, g, b] = tone_agx([grey; 3]);
            assert!((r - g).abs() < 2e-3 && (g - b).abs() < 2e-3, "{grey}: {r} {g} {b}");
        }
    }

    #[test]
    fn the_agx_matrices_are_inverse_to_each_other() {
        for i in 0..3 {
            let unit = std::array::from_fn(|k| f64::from(u8::from(k == i)));
            for (k, value) in multiply(&AGX_OUTSET, multiply(&AGX_INSET, unit)).into_iter().enumerate() {
                let want = f64::from(u8::from(k == i));
                assert!((value - want).abs() < 1e-6, "({i}, {k}): {value}");
            }
        }
    }

    #[test]
    fn aces_rises_to_white_and_keeps_black() {
        assert!(tone_aces([0.0; 3]).iter().all(|c| *c < 1e-3), "black");
        let mut before = 0.0;
        for i in 1..200 {
            let [r, ..] = tone_aces([0.02 * f64::from(i); 3]);
            assert!(r >= before, "step {i}");
            before = r;
        }
        assert!(before > 0.9, "four times white is nearly white: {before}");
    }

    #[test]
    fn a_neutral_look_changes_nothing_and_no_saturation_is_grey() {
        let colour = [0.2, 0.5, 0.9];
        for (got, want) in tone_look(colour, 1.0, 1.0).into_iter().zip(colour) {
            assert!((got - want).abs() < 1e-12, "{got} {want}");
        }
        let [r, g, b] = tone_look(colour, 1.3, 0.0);
        assert!((r - g).abs() < 1e-12 && (g - b).abs() < 1e-12, "{r} {g} {b}");
    }

    #[test]
    fn srgb_encoding_is_continuous_at_its_knee() {
        let (below, above) = (tone_srgb_encode(0.003_130_7), tone_srgb_encode(0.003_130_9));
        assert!((above - below).abs() < 1e-5, "{below} {above}");
        assert!((tone_srgb_encode(1.0) - 1.0).abs() < 1e-12, "white");
    }
}

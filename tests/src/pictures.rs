//! Differences of pictures.

use std::path::PathBuf;

use crate::data::workspace_root;

/// How far two pictures are apart, in the unit of their values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// Root of the mean square over all values.
    pub rms: f64,
    /// Largest difference of two values; infinite where one is not finite and the other is something else.
    pub max: f64,
    /// Index of the largest difference among the values.
    pub at: usize,
}

/// Difference of two pictures of the same size.
///
/// # Panics
/// When the numbers of values differ, or there are none.
#[must_use]
pub fn picture_difference(a: &[f32], b: &[f32]) -> Difference {
    assert_eq!(a.len(), b.len(), "the pictures have different numbers of values");
    assert!(!a.is_empty(), "the pictures are empty");
    let mut sum = 0.0;
    let mut worst = (0.0, 0);
    for (at, (a, b)) in a.iter().zip(b).enumerate() {
        let distance = distance(*a, *b);
        sum += distance * distance;
        if distance > worst.0 {
            worst = (distance, at);
        }
    }
    Difference { rms: (sum / a.len() as f64).sqrt(), max: worst.0, at: worst.1 }
}

fn distance(a: f32, b: f32) -> f64 {
    if a.to_bits() == b.to_bits() {
        0.0
    } else if a.is_finite() && b.is_finite() {
        (f64::from(a) - f64::from(b)).abs()
    } else {
        f64::INFINITY
    }
}

/// Compares two RGBA pictures; on failure writes `target/test-output/NAME.png` with the first, the second and their
/// difference (scaled to its maximum) side by side.
///
/// # Panics
/// When root mean square or maximum are above the limits, or the sizes do not fit.
pub fn assert_pictures_match(name: &str, size_px: [u32; 2], a: &[f32], b: &[f32], max_rms: f64, max_difference: f64) {
    let values = 4 * size_px[0] as usize * size_px[1] as usize;
    assert_eq!(a.len(), values, "{name}: a picture of {size_px:?} px has {values} values");
    let difference = picture_difference(a, b);
    if difference.rms <= max_rms && difference.max <= max_difference {
        return;
    }
    let written = match write_comparison(name, size_px, a, b, difference.max) {
        Ok(path) => format!("see {}", path.display()),
        Err(error) => format!("the picture of the difference could not be written: {error:#}"),
    };
    let pixel = difference.at / 4;
    let (x, y) = (pixel % size_px[0] as usize, pixel / size_px[0] as usize);
    panic!(
        "{name}: RMS {:.3e} (limit {max_rms:.1e}), maximum {:.3e} (limit {max_difference:.1e}) in channel {} of pixel \
         ({x}, {y}); {written}",
        difference.rms,
        difference.max,
        difference.at % 4
    );
}

fn write_comparison(name: &str, size_px: [u32; 2], a: &[f32], b: &[f32], max: f64) -> anyhow::Result<PathBuf> {
    let largest = a.iter().chain(b).filter(|value| value.is_finite()).fold(1e-30_f32, |m, value| m.max(*value));
    let gap: Vec<f64> = a.iter().zip(b).map(|(a, b)| distance(*a, *b)).collect();
    let [width, height] = size_px;
    let picture = image::RgbImage::from_fn(3 * width, height, |x, y| {
        let first = 4 * (y as usize * width as usize + (x % width) as usize);
        image::Rgb(std::array::from_fn(|channel| match x / width {
            0 => to_srgb(f64::from(a[first + channel] / largest)),
            1 => to_srgb(f64::from(b[first + channel] / largest)),
            _ => to_srgb(gap[first + channel] / max),
        }))
    });
    let folder = workspace_root().join("target/test-output");
    std::fs::create_dir_all(&folder)?;
    let path = folder.join(format!("{}.png", name.replace(['/', ':', ' '], "_")));
    picture.save(&path)?;
    Ok(path)
}

/// Linear 0 to 1 in sRGB's transfer function; what is not finite becomes white.
fn to_srgb(linear: f64) -> u8 {
    let linear = if linear.is_finite() { linear.clamp(0.0, 1.0) } else { 1.0 };
    let encoded = if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
    #[expect(clippy::cast_possible_truncation, reason = "0 to 255 by the clamp above")]
    let byte = (255.0 * encoded).round() as u8;
    byte
}

/// The values of half floats as they are read back from an `Rgba16Float` texture (little-endian).
#[must_use]
pub fn halves_to_f32(bytes: &[u8]) -> Vec<f32> {
    bytes.as_chunks().0.iter().map(|pair| half::f16::from_le_bytes(*pair).to_f32()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn root_mean_square_and_maximum_are_those_of_the_definition() {
        let difference = picture_difference(&[0.0, 1.0, 2.0, 3.0], &[0.0, 1.0, 5.0, 3.0]);
        assert_eq!(difference, Difference { rms: 1.5, max: 3.0, at: 2 }, "sqrt(9 / 4) and 3");
    }

    #[test]
    fn a_value_that_is_not_finite_differs_without_bound_from_one_that_is() {
        let largest = |a: f32, b: f32| picture_difference(&[a], &[b]).max;
        assert!(largest(f32::NAN, 1.0) == f64::INFINITY, "NaN is no small difference");
        assert!(largest(f32::INFINITY, f32::INFINITY).abs() < 1e-300, "the same infinity");
        assert!(largest(f32::NAN, f32::NAN).abs() < 1e-300, "the same bits");
    }

    #[test]
    fn a_mismatch_names_the_pixel_and_writes_the_difference() {
        let a = vec![0.5_f32; 16];
        let mut b = a.clone();
        b[4 * 3 + 1] = 0.75;
        let result = std::panic::catch_unwind(|| assert_pictures_match("harness test", [2, 2], &a, &b, 1e-3, 1e-3));
        let message = *result.expect_err("they differ").downcast::<String>().expect("a formatted message");
        assert!(message.contains("channel 1 of pixel (1, 1)"), "{message}");
        let path = workspace_root().join("target/test-output/harness_test.png");
        let picture = image::open(&path).expect("the difference was written").to_rgb8();
        assert_eq!(picture.dimensions(), (6, 2), "three pictures side by side");
        assert_eq!(picture.get_pixel(5, 1).0, [0, 255, 0], "the one difference, scaled to full");
    }

    #[test]
    fn halves_are_read_as_little_endian() {
        assert_eq!(halves_to_f32(&[0x00, 0x3c, 0x00, 0xc0]), [1.0, -2.0], "1 and -2 as half floats");
    }
}

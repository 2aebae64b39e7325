//! Noise: what hides the steps of 8-bit pictures, and clouds of value noise. f64 twins of `shaders/common/noise.wgsl`.

pub use tyndall_core::rng::noise_pcg;

/// Noise with a triangular distribution over -1..1 and mean 0, for a pixel and a channel.
#[must_use]
pub fn noise_triangular(pixel: [u32; 2], channel: u32) -> f64 {
    let first = noise_pcg(pixel[0].wrapping_add(noise_pcg(pixel[1].wrapping_add(noise_pcg(channel)))));
    let second = noise_pcg(first);
    (f64::from(first >> 8) - f64::from(second >> 8)) / 16_777_216.0
}

/// Smooth noise of 0..1 in space, a new value about every unit; for coordinates above -512.
#[must_use]
#[expect(clippy::cast_possible_truncation, reason = "cells are whole numbers")]
pub fn noise_value(at: [f64; 3]) -> f64 {
    let cell = at.map(f64::floor);
    let smooth: [f64; 3] = std::array::from_fn(|axis| {
        let f = at[axis] - cell[axis];
        f * f * (3.0 - 2.0 * f)
    });
    let corner = |i: u32| {
        let bits = [i & 1, (i >> 1) & 1, i >> 2];
        let c: [u32; 3] = std::array::from_fn(|axis| (cell[axis] + 512.0) as u32 + bits[axis]);
        let weight: f64 = (0..3).map(|axis| if bits[axis] == 1 { smooth[axis] } else { 1.0 - smooth[axis] }).product();
        weight * f64::from(noise_pcg(c[0].wrapping_add(noise_pcg(c[1].wrapping_add(noise_pcg(c[2]))))) >> 8)
    };
    (0..8).map(corner).sum::<f64>() / 16_777_216.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dither_has_mean_zero_and_the_variance_of_a_triangle() {
        let count = 256 * 256;
        let values: Vec<f64> = (0..count).map(|i| noise_triangular([i % 256, i / 256], 1)).collect();
        let mean = values.iter().sum::<f64>() / f64::from(count);
        let variance = values.iter().map(|v| v * v).sum::<f64>() / f64::from(count);
        // Five standard errors: sqrt(1/6) / 256 = 1.6e-3 for the mean, 9e-4 for the variance.
        assert!(mean.abs() < 5.0 * 1.6e-3, "mean {mean}");
        assert!((variance - 1.0 / 6.0).abs() < 5.0 * 9e-4, "variance {variance}");
    }

    #[test]
    fn neighbouring_pixels_and_channels_are_not_correlated() {
        let count = 65_536;
        let correlation = |other: fn(u32) -> f64| {
            let sum: f64 = (0..count).map(|i| noise_triangular([i % 256, i / 256], 0) * other(i)).sum();
            6.0 * sum / f64::from(count)
        };
        let right = correlation(|i| noise_triangular([i % 256 + 1, i / 256], 0));
        let channel = correlation(|i| noise_triangular([i % 256, i / 256], 1));
        assert!(right.abs() < 0.02 && channel.abs() < 0.02, "{right} {channel}");
    }
}

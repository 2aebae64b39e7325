//! The noise that hides the steps of 8-bit pictures. f64 twins of `shaders/common/noise.wgsl`.

pub use tyndall_core::rng::noise_pcg;

/// Noise with a triangular distribution over -1..1 and mean 0, for a pixel and a channel.
#[must_use]
pub fn noise_triangular(pixel: [u32; 2], channel: u32) -> f64 {
    let first = noise_pcg(pixel[0].wrapping_add(noise_pcg(pixel[1].wrapping_add(noise_pcg(channel)))));
    let second = noise_pcg(first);
    (f64::from(first >> 8) - f64::from(second >> 8)) / 16_777_216.0
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

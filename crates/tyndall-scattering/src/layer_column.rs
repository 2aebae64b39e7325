//! Columns of a layer of haze in closed form.
//!
//! Fog may be metres thick and hides things within a few steps, where a table over the whole atmosphere has texels of
//! hundreds of metres. In the even part of a layer the column is a length. Above, the density falls by e over H along
//! altitude = h + mu t + (1 - mu^2) t^2 / (2 r), whose integral is Chapman's function with the scaled complementary error
//! function; relative error about H / r: 2e-4 for 1 km on Earth. WGSL: `shaders/sky/layer_column.wgsl`.

use std::f64::consts::PI;

use crate::geometry::{altitude_along, distance_to_top, mu_along};

/// A layer of haze: density 1 up to `top_m`, exp(-(h - top) / H) above.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(clippy::struct_field_names, reason = "the names end in their units")]
pub struct HazeLayer {
    /// Radius of the planet (m).
    pub radius_m: f64,
    /// Altitude up to which the density is 1 (m).
    pub top_m: f64,
    /// Scale height above (m).
    pub scale_height_m: f64,
    /// Largest extinction over the wavelengths (1/m).
    pub strongest_per_m: f64,
    /// Altitude above which the haze is too thin to be seen (m).
    pub zone_m: f64,
}

impl HazeLayer {
    /// A layer on a planet, with its top and the scale height above (m).
    #[must_use]
    pub fn new(radius_m: f64, (top_m, scale_height_m): (f64, f64), strongest_per_m: f64) -> Self {
        let scale_heights = (6.0 + (strongest_per_m * scale_height_m).ln_1p()).min(12.0);
        let zone_m = top_m + scale_heights * scale_height_m;
        Self { radius_m, top_m, scale_height_m, strongest_per_m, zone_m }
    }

    /// Density at an altitude (m).
    #[must_use]
    pub fn density(&self, altitude_m: f64) -> f64 {
        (-(altitude_m - self.top_m).max(0.0) / self.scale_height_m).exp()
    }

    /// Column (m) from altitude `h_m` in a direction above the horizon to the end of the layer.
    #[must_use]
    pub fn column(&self, h_m: f64, mu: f64) -> f64 {
        if mu >= 0.0 {
            return self.rising(h_m, mu);
        }
        // Down to the lowest point and up again: twice the way up from there, less what lies behind the observer.
        let lowest_m = altitude_along(self.radius_m, h_m, mu, -(self.radius_m + h_m) * mu).max(0.0);
        (2.0 * self.rising(lowest_m, 0.0) - self.rising(h_m, -mu)).max(0.0)
    }

    /// Column of a ray with mu >= 0.
    fn rising(&self, h_m: f64, mu: f64) -> f64 {
        if h_m >= self.top_m {
            return self.density(h_m) * self.thinning(h_m, mu);
        }
        let even_m = distance_to_top(self.radius_m, self.top_m, h_m, mu);
        even_m + self.thinning(self.top_m, mu_along(self.radius_m, h_m, mu, 1.0, even_m, self.top_m))
    }

    /// Column above altitude `h_m` over the density there.
    fn thinning(&self, h_m: f64, mu: f64) -> f64 {
        // Towards the zenith the bend vanishes; the floor keeps its root away from 0.
        let bend = ((1.0 - mu) * (1.0 + mu)).max(1e-6) / (2.0 * (self.radius_m + h_m));
        let root = (bend * self.scale_height_m).sqrt();
        let scaled = 0.5 * PI.sqrt() * scaled_erfc(0.5 * mu / root);
        self.scale_height_m / root * scaled
    }
}

/// Coefficients of ln (e^(x^2) erfc(x) / t) in t = 1 / (1 + x / 2), fitted at Chebyshev nodes.
const SCALED_ERFC: [f64; 8] = [
    -1.265_509_3,
    0.999_604_579,
    0.384_089_844,
    0.004_035_713_61,
    0.248_290_639,
    -0.872_904_148,
    0.668_515_161,
    -0.166_122_112,
];

/// e^(x^2) erfc(x) for x >= 0; relative error 3e-6.
#[must_use]
pub fn scaled_erfc(x: f64) -> f64 {
    let t = 1.0 / (1.0 + 0.5 * x);
    t * SCALED_ERFC.iter().rev().fold(0.0, |sum, coefficient| sum * t + coefficient).exp()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::horizon_mu;
    use crate::quadrature::integrate;

    /// The column by its definition, with nodes dense at the lowest point and at the layer's top.
    fn exact(layer: &HazeLayer, h_m: f64, mu: f64) -> f64 {
        let (r, top_m) = (layer.radius_m + h_m, 100e3);
        let density = |t_m: f64| {
            let altitude_m = altitude_along(layer.radius_m, h_m, mu, t_m);
            (-(altitude_m - layer.top_m).max(0.0) / layer.scale_height_m).exp()
        };
        let end_m = distance_to_top(layer.radius_m, top_m, h_m, mu);
        let lowest_m = (-r * mu).clamp(0.0, end_m);
        let crossing_m = |altitude_m: f64| {
            let q = (h_m - altitude_m) * (2.0 * layer.radius_m + h_m + altitude_m);
            let root = (r * r * mu * mu - q).max(0.0).sqrt();
            [-r * mu - root, -r * mu + root]
        };
        let mut breaks = vec![0.0, lowest_m, end_m];
        for steps in 0..40 {
            let altitude_m = layer.top_m + f64::from(steps) * layer.scale_height_m;
            breaks.extend(crossing_m(altitude_m).into_iter().filter(|t| (0.0..end_m).contains(t)));
        }
        breaks.sort_by(f64::total_cmp);
        breaks.windows(2).map(|pair| integrate(pair[0], pair[1], 40, density)).sum()
    }

    #[test]
    fn the_closed_form_equals_the_integral_in_and_above_the_layer_in_any_direction() {
        let mut worst = 0.0_f64;
        for (top_m, scale_height_m) in [(200.0, 50.0), (0.0, 300.0), (20.0, 2.0), (1500.0, 1000.0)] {
            let layer = HazeLayer::new(6.36e6, (top_m, scale_height_m), 1e-3);
            for h_m in [0.0, 2.0, 15.0, 0.9 * top_m, 1.1 * top_m + scale_height_m, 4000.0] {
                let horizon = horizon_mu(layer.radius_m, h_m);
                let between = [0.0, 0.01, 0.1, 0.5].map(|share| horizon * (1.0 - share));
                for mu in [1.0, 0.9, 0.3, 0.05, 0.004, 2e-4, 0.0].into_iter().chain(between) {
                    let (got, want) = (layer.column(h_m, mu), exact(&layer, h_m, mu));
                    // Relative to a column that could be seen at all: a metre of haze.
                    let error = (got - want).abs() / want.max(1.0);
                    assert!(error < 5e-4, "top {top_m} H {scale_height_m} h {h_m} mu {mu}: {got} {want}");
                    worst = worst.max(error);
                }
            }
        }
        println!("column of a layer, closed form against integral: worst {worst:.1e}");
    }

    #[test]
    fn the_scaled_error_function_has_its_known_values() {
        // e^(x^2) erfc(x), Abramowitz and Stegun, and the leading terms of its asymptotic series.
        for (x, want) in [(0.0, 1.0), (0.5, 0.615_690_344), (1.0, 0.427_583_576), (2.0, 0.255_395_676)] {
            assert!((scaled_erfc(x) / want - 1.0).abs() < 5e-6, "{x}: {}", scaled_erfc(x));
        }
        let x: f64 = 1e4;
        let want = (1.0 - 0.5 / (x * x)) / (x * PI.sqrt());
        assert!((scaled_erfc(x) / want - 1.0).abs() < 5e-6, "{}", scaled_erfc(x));
    }
}

//! Where the integral along a ray breaks in haze.
//!
//! In fog light comes from the next few metres of a ray that is hundreds of kilometres long, and the fog ends at a sharp
//! top. Four Gauss nodes integrate exp(-tau) over a stretch of optical depth 3 to 1e-5, so that a few breaks suffice, each
//! where its neighbour's stretch ends: from the eye, and on both sides of the layer's top, behind which sunlight fades over a
//! free path as the sun sees it; where the haze thins out, one every so many scale heights. WGSL:
//! `shaders/sky/haze_breaks.wgsl`.

use crate::geometry::{Ray, altitude_along, altitude_crossings, mu_along};
use crate::layer_column::HazeLayer;

/// How far apart the breaks lie.
#[derive(Debug)]
pub(crate) struct Spacing {
    /// Optical depths from the eye and from the layer's top.
    pub(crate) depths: &'static [f64],
    /// Scale heights above the layer's top.
    pub(crate) scale_heights: f64,
}

impl Spacing {
    /// For tables.
    pub(crate) const TABLES: Self = Self { depths: &[2.5, 7.0, 18.0], scale_heights: 1.25 };

    /// For the exact integral.
    pub(crate) const EXACT: Self =
        Self { depths: &[0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 11.0, 15.0, 20.0, 30.0, 50.0], scale_heights: 0.5 };
}

/// Zenith cosine of the lowest sun of which breaks take notice: still lower, it lights only the uppermost haze.
const LOWEST_MU_SUN: f64 = 0.02;

/// Breaks closer than this are one (m, and share of the distance).
const CLOSEST_M: f64 = 1e-3;
const CLOSEST_SHARE: f64 = 1e-6;

/// The breaks of one ray, found one after the other.
#[derive(Clone, Debug)]
pub(crate) struct HazeBreaks {
    layer: HazeLayer,
    spacing: &'static Spacing,
    h_m: f64,
    mu: f64,
    lowest_m: f64,
    /// Extinction at the eye (1/m).
    at_eye_per_m: f64,
    /// Where the ray passes the top of the layer, down and up (m), and how fast light fades below it along the ray (1/m).
    top: Option<[(f64, f64); 2]>,
    /// Where the ray passes the end of what can be seen, down and up (m).
    zone_m: Option<[f64; 2]>,
}

impl HazeBreaks {
    pub(crate) fn new(layer: &HazeLayer, ray: &Ray, lowest_m: f64, spacing: &'static Spacing) -> Self {
        let Ray { h_m, mu, mu_sun, nu } = *ray;
        let radius_m = layer.radius_m;
        let fading = |t_m: f64| {
            let steepness = mu_along(radius_m, h_m, mu, 1.0, t_m, layer.top_m).abs();
            let sun = mu_along(radius_m, h_m, mu_sun, nu, t_m, layer.top_m).max(LOWEST_MU_SUN);
            layer.strongest_per_m * steepness / sun
        };
        let top = altitude_crossings(radius_m, h_m, mu, layer.top_m).filter(|_| layer.top_m > 0.0);
        Self {
            layer: *layer,
            spacing,
            h_m,
            mu,
            lowest_m,
            at_eye_per_m: layer.strongest_per_m * layer.density(h_m),
            // On the way down the view fades as well.
            top: top.map(|[down, up]| [(down, fading(down) + layer.strongest_per_m), (up, fading(up))]),
            zone_m: altitude_crossings(radius_m, h_m, mu, layer.zone_m),
        }
    }

    /// The nearest break behind `t_m` (m), infinity when there is none.
    pub(crate) fn next(&self, t_m: f64) -> f64 {
        let behind_m = t_m + CLOSEST_M + CLOSEST_SHARE * t_m;
        let mut next_m = f64::INFINITY;
        let mut consider = |place_m: f64| {
            if place_m > behind_m && place_m < next_m {
                next_m = place_m;
            }
        };
        self.zone_m.into_iter().flatten().for_each(&mut consider);
        consider(self.next_level(t_m));
        for depth in self.spacing.depths {
            consider(depth / self.at_eye_per_m);
        }
        if let Some([(down_m, fading_down), (up_m, fading_up)]) = self.top {
            consider(down_m);
            consider(up_m);
            for depth in self.spacing.depths {
                // Beyond the lowest point the other side's breaks take over.
                consider((down_m + depth / fading_down).min(self.lowest_m.max(down_m)));
                consider((up_m - depth / fading_up).max(self.lowest_m.min(up_m)));
            }
        }
        next_m
    }

    /// The next level where the haze thins out: multiples of the spacing above the layer's top.
    fn next_level(&self, t_m: f64) -> f64 {
        let HazeLayer { radius_m, top_m, scale_height_m, zone_m, .. } = self.layer;
        let step_m = self.spacing.scale_heights * scale_height_m;
        let level = (altitude_along(radius_m, self.h_m, self.mu, t_m) - top_m) / step_m;
        let rises = t_m >= self.lowest_m;
        // A place on a level belongs to what lies behind it.
        let next = if rises { (level + 1e-3).floor().max(-1.0) + 1.0 } else { (level - 1e-3).ceil() - 1.0 };
        let altitude_m = top_m + next * step_m;
        if next < 0.0 || altitude_m >= zone_m {
            return f64::INFINITY;
        }
        let crossings = altitude_crossings(radius_m, self.h_m, self.mu, altitude_m);
        crossings.map_or(f64::INFINITY, |[down, up]| if rises { up } else { down })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn breaks_come_in_order_and_end_above_the_haze() {
        let layer = HazeLayer::new(6.36e6, (200.0, 50.0), 0.04);
        for (h_m, mu) in [(2.0, 0.5), (2.0, 0.0), (1e3, -0.0175), (1e3, -0.7), (220.0, 0.1)] {
            let ray = Ray { h_m, mu, mu_sun: 0.5, nu: 0.2 };
            let lowest_m = (-(6.36e6 + h_m) * mu).max(0.0);
            let breaks = HazeBreaks::new(&layer, &ray, lowest_m, &Spacing::TABLES);
            let (mut t_m, mut count) = (0.0_f64, 0);
            while t_m.is_finite() && count < 100 {
                let next_m = breaks.next(t_m);
                assert!(next_m > t_m, "{ray:?}: {next_m} after {t_m}");
                (t_m, count) = (next_m, count + 1);
            }
            assert!(t_m.is_infinite() && (5..40).contains(&count), "{ray:?}: {count} breaks");
        }
    }

    #[test]
    fn the_top_of_the_layer_is_a_break_and_has_breaks_on_its_lower_side() {
        let layer = HazeLayer::new(6.36e6, (200.0, 50.0), 0.04);
        let ray = Ray { h_m: 0.0, mu: 1.0, mu_sun: 0.25, nu: 0.25 };
        let breaks = HazeBreaks::new(&layer, &ray, 0.0, &Spacing::TABLES);
        let near = |from_m: f64, want_m: f64| (breaks.next(from_m) - want_m).abs() < 0.1;
        // Sunlight fades four times as fast as a vertical view: 2.5 optical depths in 2.5 / 0.16 m.
        assert!(near(184.0, 184.375) && near(190.0, 200.0), "{} {}", breaks.next(184.0), breaks.next(190.0));
        assert!(near(0.0, 62.5), "2.5 optical depths from the eye: {}", breaks.next(0.0));
        assert!(near(200.0, 262.5), "1.25 scale heights above: {}", breaks.next(200.0));
    }
}

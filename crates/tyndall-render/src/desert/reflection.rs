//! How sand reflects, in f64: what `shaders/common/sand.wgsl` computes.

/// `sqrt(2 pi)`.
const SQRT_TAU: f64 = 2.506_628_274_631_000_5;

/// Share of a normal distribution below `x`: Abramowitz and Stegun 1964, 26.2.17, within 7.5e-8.
#[must_use]
pub fn sand_below(x: f64) -> f64 {
    const TERMS: [f64; 5] = [0.319_381_530, -0.356_563_782, 1.781_477_937, -1.821_255_978, 1.330_274_429];
    let t = 1.0 / (1.0 + 0.231_641_9 * x.abs());
    let tail = TERMS.iter().rev().fold(0.0, |sum, term| (sum + term) * t);
    let above = (-0.5 * x * x).exp() / SQRT_TAU * tail;
    if x >= 0.0 { 1.0 - above } else { above }
}

/// Mean of max(c, 0) over normally distributed cosines c: what slopes too small to be seen receive.
#[must_use]
pub fn sand_mean_cosine(mean: f64, variance: f64) -> f64 {
    let deviation = variance.max(1e-10).sqrt();
    let x = mean / deviation;
    (mean * sand_below(x) + deviation / SQRT_TAU * (-0.5 * x * x).exp()).max(0.0)
}

/// Factor of Oren and Nayar 1994 on a Lambertian surface: cosines of light and view to the normal and between the two,
/// variance (rad^2) of the facets' slopes.
#[must_use]
pub fn sand_facets(light: f64, view: f64, between: f64, variance: f64) -> f64 {
    let a = 1.0 - 0.5 * variance / (variance + 0.33);
    let b = 0.45 * variance / (variance + 0.09);
    let s = between - light * view;
    let t = if s > 0.0 { light.max(view).max(1e-3) } else { 1.0 };
    a + b * s / t
}

/// Factor on light that goes back to where it came from (Hapke 1986): cosine between light and view. What goes back is missing
/// in other directions, so that white sand seen from straight above sends out what falls on it.
#[must_use]
pub fn sand_backscatter(between: f64) -> f64 {
    let half_tangent = ((1.0 - between).max(0.0) / (1.0 + between).max(1e-4)).sqrt();
    0.927 + 0.2781 / (1.0 + half_tangent / 0.12)
}

/// Mirror-like reflection (1/sr, times the cosine of the light) of facets whose slopes are normally distributed around a mean
/// with a covariance xx, xy, yy. `halfway` is the direction between light and view, z up; `view` the cosine of the view to
/// the normal, `view_half` that to `halfway`.
#[must_use]
pub fn sand_mirror(halfway: [f64; 3], slope: [f64; 2], covariance: [f64; 3], view: f64, view_half: f64) -> f64 {
    let h = halfway[2].max(0.05);
    let off = [-halfway[0] / h - slope[0], -halfway[1] / h - slope[1]];
    let [xx, xy, yy] = covariance;
    let determinant = (xx * yy - xy * xy).max(1e-8);
    let form = (yy * off[0] * off[0] - 2.0 * xy * off[0] * off[1] + xx * off[1] * off[1]) / determinant;
    let density = (-0.5 * form).exp() / (std::f64::consts::TAU * determinant.sqrt());
    let fresnel = 0.04 + 0.96 * (1.0 - view_half.clamp(0.0, 1.0)).powi(5);
    fresnel * density / (4.0 * h.powi(4) * view.max(0.15))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_normal_distribution_has_its_known_values() {
        for (x, expected) in [(0.0, 0.5), (1.0, 0.841_344_746), (-2.0, 0.022_750_132), (4.0, 0.999_968_329)] {
            assert!((sand_below(x) - expected).abs() < 7.5e-8, "below {x}: {}", sand_below(x));
        }
    }

    #[test]
    fn the_mean_cosine_is_that_of_many_slopes() {
        for (mean, deviation) in [(0.3, 0.1), (0.05, 0.2), (-0.1, 0.15)] {
            // Midpoints over six deviations to each side.
            let steps = 100_000;
            let sum: f64 = (0..steps)
                .map(|k| {
                    let x = 12.0 * ((f64::from(k) + 0.5) / f64::from(steps)) - 6.0;
                    (mean + deviation * x).max(0.0) * (-0.5 * x * x).exp() / SQRT_TAU * 12.0 / f64::from(steps)
                })
                .sum();
            let found = sand_mean_cosine(mean, deviation * deviation);
            assert!((found - sum).abs() < 1e-6, "mean {mean}, deviation {deviation}: {found}, by sum {sum}");
        }
    }

    #[test]
    fn without_facets_sand_is_lambertian_and_facets_brighten_the_way_back() {
        assert!((sand_facets(0.4, 0.7, 0.2, 0.0) - 1.0).abs() < 1e-12, "smooth");
        let [back, forth] = [0.99, -0.3].map(|between| sand_facets(0.4, 0.4, between, 0.15));
        assert!(back > forth + 0.2, "back {back}, forth {forth}");
    }

    #[test]
    fn slopes_of_the_mirror_are_normalised() {
        // The projected area of all facets is that of the ground: the integral of density over slopes is one.
        let (covariance, mut sum) = ([0.04, 0.015, 0.02], 0.0);
        let step = 0.01;
        for k in -200..200 {
            for l in -200..200 {
                let slope = [step * (f64::from(k) + 0.5), step * (f64::from(l) + 0.5)];
                // Straight from above, with Fresnel's 0.04 and 1/4 taken out.
                sum += sand_mirror([0.0, 0.0, 1.0], slope, covariance, 1.0, 1.0) * 100.0 * step * step;
            }
        }
        assert!((sum - 1.0).abs() < 1e-6, "{sum}");
    }

    /// Integral over the hemisphere of what light from a direction (cosines to the normal and to the view) becomes.
    fn over_hemisphere(view: f64, of: impl Fn(f64, f64, [f64; 3]) -> f64) -> f64 {
        let (rings, sectors) = (400, 400);
        let view_sine = (1.0 - view * view).sqrt();
        let mut sum = 0.0;
        for ring in 0..rings {
            let light = (f64::from(ring) + 0.5) / f64::from(rings);
            let light_sine = (1.0 - light * light).sqrt();
            for sector in 0..sectors {
                let azimuth = std::f64::consts::TAU * (f64::from(sector) + 0.5) / f64::from(sectors);
                let direction = [light_sine * azimuth.cos(), light_sine * azimuth.sin(), light];
                sum += of(light, view_sine * direction[0] + view * light, direction);
            }
        }
        sum * std::f64::consts::TAU / f64::from(rings * sectors)
    }

    #[test]
    fn white_sand_sends_out_no_more_light_than_falls_on_it() {
        for view in [0.02, 0.1, 0.3, 0.5, 0.8, 0.95, 1.0] {
            for variance in [0.0, 0.02, 0.07, 0.147, 0.3, 0.62] {
                let lit = |light: f64, between: f64, _| {
                    light * sand_facets(light, view, between, variance) * sand_backscatter(between)
                };
                let out = over_hemisphere(view, lit) / std::f64::consts::PI;
                assert!(out <= 1.0, "view {view}, variance {variance}: {out}");
                assert!(out > 0.6, "view {view}, variance {variance}: {out} is too dark for white sand");
            }
        }
    }

    #[test]
    fn the_mirrors_of_sand_send_out_no_more_light_than_falls_on_it() {
        for view in [0.02, 0.1, 0.3, 0.5, 0.8, 1.0_f64] {
            for variance in [0.04, 0.147, 0.6] {
                let sine = (1.0 - view * view).sqrt();
                let out = over_hemisphere(view, |_, _, light| {
                    let sum = [light[0] + sine, light[1], light[2] + view];
                    let length = (sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]).sqrt();
                    let halfway = sum.map(|part| part / length);
                    let view_half = halfway[0] * sine + halfway[2] * view;
                    sand_mirror(halfway, [0.0; 2], [variance, 0.0, variance], view, view_half)
                });
                assert!(out <= 1.0, "view {view}, variance {variance}: {out}");
            }
        }
    }

    #[test]
    fn light_and_view_may_be_exchanged() {
        for (light, view, between) in [(0.2, 0.9, 0.4), (0.5, 0.7, -0.2), (0.31, 0.3, 0.9), (0.05, 1.0, 0.05)] {
            for variance in [0.0, 0.147, 0.6] {
                let [there, back] = [[light, view], [view, light]].map(|[a, b]| sand_facets(a, b, between, variance));
                assert!((there - back).abs() < 1e-15, "facets, {light} and {view}: {there} and {back}");
            }
            if light.min(view) > 0.15 {
                // What is computed is reflection times the cosine of the light.
                let mirror = |view: f64| sand_mirror([0.3, 0.1, 0.9], [0.1, 0.0], [0.1, 0.02, 0.2], view, 0.8);
                let [there, back] = [mirror(view) / light, mirror(light) / view];
                assert!((there / back - 1.0).abs() < 1e-12, "mirrors, {light} and {view}: {there} and {back}");
            }
        }
    }
}

// How sand reflects: facets, a weak mirror, light thrown back. Twins: tyndall_render::desert::reflection.

/// Share of a normal distribution below x, to 1e-7 (Abramowitz and Stegun 1964, 26.2.17).
fn sand_below(x: f32) -> f32 {
    let a = abs(x);
    let t = 1.0 / (1.0 + 0.2316419 * a);
    let tail = t * (0.319381530 + t * (-0.356563782 + t * (1.781477937 + t * (-1.821255978 + t * 1.330274429))));
    let above = 0.3989422804 * exp(-0.5 * a * a) * tail;
    return select(above, 1.0 - above, x >= 0.0);
}

/// Mean of max(c, 0) over cosines c around a mean with a variance: what slopes too small to be seen receive.
fn sand_mean_cosine(mean: f32, variance: f32) -> f32 {
    let deviation = sqrt(max(variance, 1e-10));
    let x = mean / deviation;
    return max(mean * sand_below(x) + deviation * 0.3989422804 * exp(-0.5 * x * x), 0.0);
}

/// Factor of Oren and Nayar 1994 on a Lambertian surface: cosines of light and view to the normal and between the two,
/// variance of the facets' slopes (rad^2).
fn sand_facets(light: f32, view: f32, between: f32, variance: f32) -> f32 {
    let a = 1.0 - 0.5 * variance / (variance + 0.33);
    let b = 0.45 * variance / (variance + 0.09);
    let s = between - light * view;
    let t = select(1.0, max(max(light, view), 1e-3), s > 0.0);
    return a + b * s / t;
}

/// Factor on light that goes back to where it came from (Hapke 1986), at the cost of other directions: cosine between light
/// and view.
fn sand_backscatter(between: f32) -> f32 {
    let half_tangent = sqrt(max(1.0 - between, 0.0) / max(1.0 + between, 1e-4));
    return 0.927 + 0.2781 / (1.0 + half_tangent / 0.12);
}

/// Mirror-like reflection (1/sr, times the cosine of the light) of facets whose slopes are distributed around a mean with a
/// covariance xx, xy, yy: Gaussian density of slopes with its norm 1 / (2 pi sqrt(det)), Fresnel's law by Schlick.
/// `halfway` is the direction between light and view, z up; `view` the cosine of the view to the normal.
fn sand_mirror(halfway: vec3<f32>, slope: vec2<f32>, covariance: vec3<f32>, view: f32, view_half: f32) -> f32 {
    let h = max(halfway.z, 0.05);
    let off = -halfway.xy / h - slope;
    let determinant = max(covariance.x * covariance.z - covariance.y * covariance.y, 1e-8);
    let form = (covariance.z * off.x * off.x - 2.0 * covariance.y * off.x * off.y + covariance.x * off.y * off.y) / determinant;
    let density = exp(-0.5 * form) / (6.283185307 * sqrt(determinant));
    let c = 1.0 - clamp(view_half, 0.0, 1.0);
    let fresnel = 0.04 + 0.96 * c * c * c * c * c;
    return fresnel * density / (4.0 * h * h * h * h * max(view, 0.15));
}

//! The little geometry that paths need.

pub(crate) type Vec3 = [f64; 3];

pub(crate) fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn along(origin: Vec3, direction: Vec3, distance: f64) -> Vec3 {
    [0, 1, 2].map(|axis| origin[axis] + distance * direction[axis])
}

pub(crate) fn normalised(a: Vec3) -> Vec3 {
    let length = dot(a, a).sqrt();
    a.map(|part| part / length)
}

fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The direction at an angle of the given cosine and an azimuth (radians) around `axis`.
pub(crate) fn turned(axis: Vec3, cosine: f64, azimuth: f64) -> Vec3 {
    let helper = if axis[2].abs() < 0.9 { [0.0, 0.0, 1.0] } else { [1.0, 0.0, 0.0] };
    let side = normalised(cross(axis, helper));
    let other = cross(side, axis);
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    let (sin_azimuth, cos_azimuth) = azimuth.sin_cos();
    let part = |i: usize| cosine * axis[i] + sine * (cos_azimuth * side[i] + sin_azimuth * other[i]);
    normalised([part(0), part(1), part(2)])
}

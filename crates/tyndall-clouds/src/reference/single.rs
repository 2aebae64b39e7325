//! Light scattered once.

use super::medium::Medium;
use super::phase::TabulatedPhase;
use super::ray::Ray;
use super::vector::{along, dot, normalised};

/// Radiance of light that is scattered exactly once on its way from the sun along `ray` to its origin, for albedo 1 and a
/// sun of irradiance 1 in the direction `to_sun`; and the transmittance of the ray. Midpoints `step` apart or less on both
/// ways, energy exact within a step; halve the step to see the error.
#[must_use]
pub fn single_scattering(medium: &Medium, phase: &TabulatedPhase, to_sun: [f64; 3], ray: Ray, step: f64) -> [f64; 2] {
    let (to_sun, direction) = (normalised(to_sun), normalised(ray.direction));
    let Some([near, far]) = medium.crossing(ray.origin, direction) else { return [0.0, 1.0] };
    let count = ((far - near) / step).ceil().max(1.0);
    let length = (far - near) / count;
    // Light travels along -to_sun and leaves along -direction.
    let scattered = phase.value(dot(to_sun, direction));
    let (mut radiance, mut transmittance) = (0.0, 1.0);
    let mut distance = near + 0.5 * length;
    while distance < far {
        let point = along(ray.origin, direction, distance);
        let extinction = medium.extinction(point);
        if extinction > 0.0 {
            let kept = (-extinction * length).exp();
            let sun = (-medium.optical_depth(point, to_sun, step)).exp();
            radiance += transmittance * (1.0 - kept) * sun * scattered;
            transmittance *= kept;
        }
        distance += length;
    }
    [radiance, transmittance]
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use tyndall_core::grid::Grid3;

    use super::*;

    #[test]
    fn a_homogeneous_slab_has_the_analytic_radiance() {
        let medium = Medium::new(Grid3::filled([40, 40, 4], 0.5), 1.0).unwrap();
        let phase = TabulatedPhase::new(|_| 1.0).unwrap();
        // Looking straight down with the sun overhead: (1 - exp(-2 tau)) / (8 pi).
        let ray = Ray { origin: [20.0, 20.0, 9.0], direction: [0.0, 0.0, -1.0] };
        let [radiance, transmittance] = single_scattering(&medium, &phase, [0.0, 0.0, 1.0], ray, 0.02);
        assert!((radiance - (1.0 - (-4.0_f64).exp()) / (8.0 * PI)).abs() < 1e-5, "{radiance}");
        assert!((transmittance - (-2.0_f64).exp()).abs() < 1e-9, "{transmittance}");
        // Looking straight up, away from the ground: tau exp(-tau) / (4 pi).
        let ray = Ray { origin: [20.0, 20.0, -1.0], direction: [0.0, 0.0, 1.0] };
        let [radiance, _] = single_scattering(&medium, &phase, [0.0, 0.0, 1.0], ray, 0.02);
        assert!((radiance - 2.0 * (-2.0_f64).exp() / (4.0 * PI)).abs() < 1e-5, "{radiance}");
    }
}

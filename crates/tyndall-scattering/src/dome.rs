//! The paper's sky: a hemisphere cut into polygons, the colour of the table at each vertex, linear in between.
//!
//! Rings are dense at the horizon, where the sky changes fastest: elevation = horizon + (pi/2 - horizon) (ring / rings)^2.
//! The mesh goes on below the horizon in the same way, so that it covers views from high altitude. WGSL:
//! `shaders/sky/dome.wgsl`.

use std::f64::consts::TAU;

use crate::sky_view_map::sky_view_map_inverse;

/// A dome of `2 * rings` rings of quadrilaterals and `segments` around.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dome {
    /// Rings from the horizon to the zenith, and as many to the nadir.
    pub rings: u32,
    /// Segments around the horizon.
    pub segments: u32,
}

impl Dome {
    /// Vertices of the triangle list without index buffer: six a quadrilateral.
    #[must_use]
    pub fn vertex_count(self) -> u32 {
        2 * self.rings * self.segments * 6
    }

    /// Elevation and azimuth from the sun (rad) of a vertex of the list.
    #[must_use]
    pub fn vertex(self, horizon_elevation: f64, index: u32) -> (f64, f64) {
        let (quad, corner) = (index / 6, index % 6);
        let (ring, segment) = (quad / self.segments, quad % self.segments);
        // Two triangles (0, 1, 2) and (2, 1, 3) over the corners (0,0), (1,0), (0,1), (1,1).
        let corner = [0, 1, 2, 2, 1, 3][corner as usize];
        let above = ring < self.rings;
        let ring = f64::from(if above { ring } else { ring - self.rings } + corner / 2) / f64::from(self.rings);
        let (elevation, _) = sky_view_map_inverse(horizon_elevation, above, [0.0, ring]);
        (elevation, TAU * f64::from(segment + corner % 2) / f64::from(self.segments))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn the_dome_covers_the_whole_sphere_once() {
        let dome = Dome { rings: 24, segments: 48 };
        let solid_angle: f64 = (0..dome.vertex_count() / 3)
            .map(|triangle| {
                let [a, b, c] = [0, 1, 2].map(|k| {
                    let (elevation, azimuth) = dome.vertex(-0.02, 3 * triangle + k);
                    [azimuth.sin() * elevation.cos(), azimuth.cos() * elevation.cos(), elevation.sin()]
                });
                spherical_area(a, b, c)
            })
            .sum();
        assert!((solid_angle / (2.0 * TAU) - 1.0).abs() < 1e-9, "{solid_angle}");
    }

    /// Van Oosterom and Strackee 1983.
    fn spherical_area(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
        let dot = |u: [f64; 3], v: [f64; 3]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
        let cross = [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]];
        2.0 * dot(a, cross).abs().atan2(1.0 + dot(a, b) + dot(b, c) + dot(c, a))
    }

    #[test]
    fn rings_are_dense_at_the_horizon_and_end_at_the_poles() {
        let dome = Dome { rings: 32, segments: 8 };
        let elevation = |ring: u32| dome.vertex(0.0, ring * dome.segments * 6).0;
        assert!(elevation(1) < 0.002, "the first ring lies within 0.1 degrees: {}", elevation(1));
        assert!((dome.vertex(0.0, 31 * 8 * 6 + 2).0 - FRAC_PI_2).abs() < 1e-12, "zenith");
        assert!((dome.vertex(0.0, (63 * 8) * 6 + 2).0 + FRAC_PI_2).abs() < 1e-12, "nadir");
    }
}

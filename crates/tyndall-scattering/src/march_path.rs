//! How a ray is cut into panels of quadrature nodes.
//!
//! Panels are even in a variable x in which t = `t_low` + x |x| s, so that nodes are dense at the lowest point of the ray.
//! They break at the lowest point, where the ray enters and leaves the earth's shadow, because a step inside a panel would
//! cost its order, and at the places of [`crate::haze_breaks`]. WGSL: `shaders/sky/march_path.wgsl`.

use crate::geometry::{Ray, shadow_interval};
use crate::haze_breaks::{HazeBreaks, Spacing};
use crate::layer_column::HazeLayer;

/// The variable x of a ray: t = lowest + x |x| times the distance to the ray's start (x < 0) or end (x > 0).
#[derive(Clone, Debug)]
pub(crate) struct PathMap {
    lowest_m: f64,
    length_m: f64,
    shadow: [f64; 2],
    /// x of start and end.
    ends: [f64; 2],
    haze: Option<HazeBreaks>,
}

/// Breaks closer than this in x are one.
const CLOSEST: f64 = 1e-9;

impl PathMap {
    /// The map of a ray in sunlight.
    pub(crate) fn new(radius_m: f64, haze: Option<&HazeLayer>, ray: &Ray, length_m: f64) -> Self {
        Self::spaced(radius_m, haze, ray, length_m, &Spacing::TABLES)
    }

    /// As [`PathMap::new`], with another spacing of the breaks in haze.
    pub(crate) fn spaced(
        radius_m: f64,
        haze: Option<&HazeLayer>,
        ray: &Ray,
        length_m: f64,
        spacing: &'static Spacing,
    ) -> Self {
        let mut map = Self::without_shadow(radius_m, None, (ray.h_m, ray.mu), length_m);
        if let Some((start_m, end_m)) = shadow_interval(radius_m, ray, length_m) {
            map.shadow = [start_m, end_m].map(|t_m| map.variable(t_m));
        }
        map.haze = haze.map(|layer| HazeBreaks::new(layer, ray, map.lowest_m, spacing));
        map
    }

    /// The map of a ray from altitude `h_m` with zenith cosine `mu` for light from all sides.
    pub(crate) fn without_shadow(
        radius_m: f64,
        haze: Option<&HazeLayer>,
        (h_m, mu): (f64, f64),
        length_m: f64,
    ) -> Self {
        let lowest_m = (-(radius_m + h_m) * mu).clamp(0.0, length_m);
        let ends = [if lowest_m > 0.0 { -1.0 } else { 0.0 }, if length_m > lowest_m { 1.0 } else { 0.0 }];
        // Light from all sides falls off below a layer's top as that of a sun in the zenith.
        let ray = Ray { h_m, mu, mu_sun: 1.0, nu: mu };
        let haze = haze.map(|layer| HazeBreaks::new(layer, &ray, lowest_m, &Spacing::TABLES));
        Self { lowest_m, length_m, shadow: [2.0, 2.0], ends, haze }
    }

    /// Calls `visit` with the start and the width of each panel from the start of the ray on, about `panels` in all and one
    /// for each break in haze.
    pub(crate) fn for_each_panel(&self, panels: usize, mut visit: impl FnMut(f64, f64)) {
        let [mut from, end] = self.ends;
        while from < end {
            let to = self.next_break(from);
            let count = (panels as f64 * self.share(from, to)).ceil().max(1.0);
            let width = (to - from) / count;
            let mut x = from;
            while x < to - 0.5 * width {
                visit(x, width);
                x += width;
            }
            from = to;
        }
    }

    /// The nearest place behind x at which panels break; the end of the ray at last.
    fn next_break(&self, x: f64) -> f64 {
        let [enter, leave] = self.shadow;
        let haze = self.haze.as_ref().map_or(2.0, |breaks| self.variable(breaks.next(self.position(x).0)));
        let places = [enter, leave, 0.0, haze];
        places.into_iter().filter(|place| *place > x + CLOSEST).fold(self.ends[1], f64::min)
    }

    /// Distance (m) along the ray and its derivative by x (m).
    pub(crate) fn position(&self, x: f64) -> (f64, f64) {
        let side_m = if x < 0.0 { self.lowest_m } else { self.length_m - self.lowest_m };
        (self.lowest_m + x * x.abs() * side_m, 2.0 * x.abs() * side_m)
    }

    /// x at a distance (m).
    fn variable(&self, t_m: f64) -> f64 {
        let from_lowest_m = t_m - self.lowest_m;
        if from_lowest_m < 0.0 {
            -(-from_lowest_m / self.lowest_m).min(1.0).sqrt()
        } else if self.length_m > self.lowest_m {
            (from_lowest_m / (self.length_m - self.lowest_m)).min(1.0).sqrt()
        } else {
            0.0
        }
    }

    /// Share of the panels for a piece that does not cross the lowest point. A side's part grows with the root of its
    /// length: seen from a small height just above the horizon one side is 5 km long and the other 1000 km.
    fn share(&self, from: f64, to: f64) -> f64 {
        let (before, after) = (self.lowest_m.sqrt(), (self.length_m - self.lowest_m).sqrt());
        (to - from) * if to <= 0.0 { before } else { after } / (before + after)
    }

    /// Whether x lies in the earth's shadow.
    pub(crate) fn is_shadowed(&self, x: f64) -> bool {
        self.shadow[0] < x && x < self.shadow[1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{distance_to_ground, distance_to_top};

    fn panels(map: &PathMap) -> Vec<(f64, f64)> {
        let mut panels = Vec::new();
        map.for_each_panel(8, |x, width| panels.push((x, width)));
        panels
    }

    fn rays() -> impl Iterator<Item = Ray> {
        let views = [-1.0_f64, -0.3, -0.03, -0.011, -1e-3, 0.0, 1e-3, 0.05, 0.4, 1.0];
        let places = [0.1, 2.0, 180.0, 3e3, 40e3].into_iter().flat_map(move |h_m| views.map(|mu| (h_m, mu)));
        places.flat_map(|(h_m, mu)| [0.02, 0.5, 1.0].map(|mu_sun| Ray { h_m, mu, mu_sun, nu: 0.3 * mu }))
    }

    #[test]
    fn panels_cover_every_ray_once_and_are_few_in_any_haze() {
        let hazes =
            [(50.0, 200.0, 50.0), (300.0, 0.0, 1000.0), (50e3, 1500.0, 300.0), (2e3, 5000.0, 1.0), (20.0, 5.0, 1000.0)];
        let mut most = 0;
        for (visibility_m, top_m, scale_height_m) in hazes {
            let layer = HazeLayer::new(6.36e6, (top_m, scale_height_m), 3.912 / visibility_m);
            for ray in rays() {
                let to_top_m = distance_to_top(6.36e6, 100e3, ray.h_m, ray.mu);
                let length_m = distance_to_ground(6.36e6, ray.h_m, ray.mu).unwrap_or(to_top_m);
                let map = PathMap::new(6.36e6, Some(&layer), &ray, length_m);
                let panels = panels(&map);
                let mut x = map.ends[0];
                for (from, width) in &panels {
                    assert!((from - x).abs() < 1e-9 && *width > 0.0, "gap at {x} of {ray:?}");
                    x = from + width;
                }
                assert!((x - map.ends[1]).abs() < 1e-9, "{ray:?} ends at {x}");
                most = most.max(panels.len());
            }
        }
        println!("panels of a ray in haze: at most {most}");
        // `MARCH_PANELS` of the shaders has room for sixteen where eight are asked for here.
        assert!(most <= 48, "{most} panels");
    }
}

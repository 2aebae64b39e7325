//! Nodes of the source table: altitudes and suns, and the place of values between them. WGSL:
//! `shaders/sky/orders_nodes.wgsl`.

use std::f64::consts::FRAC_PI_2;

use super::OrdersQuality;
use crate::Atmosphere;
use crate::geometry::horizon_mu;
use crate::layer_column::HazeLayer;

/// Powers of e by which twilight falls from the horizon to the lowest sun of the table; on Earth a factor e in 1.1
/// degrees. Between suns below the horizon a value is linear in exp([`TWILIGHT_FALL`] `mu_sun` / lowest), hence exact
/// where the light falls at this rate and where it is constant.
pub const TWILIGHT_FALL: f64 = 17.0;

/// The lowest sun of any table.
const LOWEST_MU_SUN_OF_ALL: f64 = -0.95;

/// Linear part of the suns' spacing at the horizon, of an evenly spaced one.
const HORIZON_SPACING: f64 = 0.3;

/// A place between two neighbouring nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The lower of the two.
    pub index: usize,
    /// Weight of the upper one, 0 to 1.
    pub fraction: f64,
}

/// Altitudes in haze: in the even layer dense at both of its ends, then dense at its top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HazeNodes {
    /// Intervals in the even layer.
    pub even: usize,
    /// Intervals where the haze thins out.
    pub thinning: usize,
    /// Top of the even layer (m).
    pub top_m: f64,
    /// Where these nodes end and the others begin (m); 0 without haze.
    pub end_m: f64,
}

impl HazeNodes {
    fn new(layer: Option<&HazeLayer>, count: usize) -> Self {
        match layer {
            Some(layer) if count >= 2 => {
                let even = if layer.top_m > 0.0 { count / 2 } else { 0 };
                Self { even, thinning: count - even, top_m: layer.top_m, end_m: layer.zone_m }
            }
            _ => Self { even: 0, thinning: 0, top_m: 0.0, end_m: 0.0 },
        }
    }

    /// Nodes below the end.
    fn count(&self) -> usize {
        self.even + self.thinning
    }

    fn altitude_m(&self, index: usize) -> f64 {
        if let Some(above) = index.checked_sub(self.even) {
            let share = above as f64 / self.thinning as f64;
            return self.top_m + (self.end_m - self.top_m) * share * share;
        }
        let share = index as f64 / self.even as f64;
        let from_end = share.min(1.0 - share);
        let part = 2.0 * from_end * from_end;
        self.top_m * if share < 0.5 { part } else { 1.0 - part }
    }

    /// The node at or below an altitude under the end.
    fn index_below(&self, altitude_m: f64) -> usize {
        if altitude_m >= self.top_m {
            let share = ((altitude_m - self.top_m) / (self.end_m - self.top_m)).sqrt();
            return self.even + place(share * self.thinning as f64, self.thinning + 1).index;
        }
        let part = altitude_m / self.top_m;
        let share = if part < 0.5 { (0.5 * part).sqrt() } else { 1.0 - (0.5 * (1.0 - part)).sqrt() };
        place(share * self.even as f64, self.even + 1).index
    }
}

impl Place {
    /// The two nodes and their weights.
    #[must_use]
    pub fn ends(self) -> [(usize, f64); 2] {
        [(self.index, 1.0 - self.fraction), (self.index + 1, self.fraction)]
    }
}

/// The nodes of a source table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nodes {
    top_altitude_m: f64,
    lowest_mu_sun: f64,
    altitudes: usize,
    haze: HazeNodes,
    suns_above: usize,
    suns_below: usize,
}

impl Nodes {
    /// Nodes up to the top of the atmosphere, and down to the sun at which the last sunlit air is out of sight: twice the
    /// dip of the horizon at the top, on Earth 20 degrees.
    #[must_use]
    pub fn new(atmosphere: &Atmosphere, quality: &OrdersQuality) -> Self {
        let Atmosphere { planet_radius_m, top_altitude_m, .. } = *atmosphere;
        let OrdersQuality { altitudes, suns_above, suns_below, .. } = *quality;
        let haze = HazeNodes::new(atmosphere.haze_layer().as_ref(), quality.haze_altitudes);
        let sine = -horizon_mu(planet_radius_m, top_altitude_m);
        let lowest_mu_sun = -(2.0 * sine.asin()).min(FRAC_PI_2).sin();
        let lowest_mu_sun = lowest_mu_sun.max(LOWEST_MU_SUN_OF_ALL);
        Self { top_altitude_m, lowest_mu_sun, altitudes, haze, suns_above, suns_below }
    }

    /// Zenith cosine of the lowest sun.
    #[must_use]
    pub fn lowest_mu_sun(&self) -> f64 {
        self.lowest_mu_sun
    }

    /// The nodes in haze.
    #[must_use]
    pub fn haze(&self) -> HazeNodes {
        self.haze
    }

    /// Altitudes.
    #[must_use]
    pub fn altitude_count(&self) -> usize {
        self.altitudes
    }

    /// Suns, from the lowest to the zenith.
    #[must_use]
    pub fn sun_count(&self) -> usize {
        self.suns_above + self.suns_below
    }

    /// Altitude (m) of a node.
    #[must_use]
    pub fn altitude_m(&self, index: usize) -> f64 {
        let HazeNodes { end_m, .. } = self.haze;
        let Some(above) = index.checked_sub(self.haze.count()) else { return self.haze.altitude_m(index) };
        let share = above as f64 / (self.altitudes - self.haze.count() - 1) as f64;
        end_m + (self.top_altitude_m - end_m) * share * share
    }

    /// Zenith cosine of the sun of a node.
    #[must_use]
    pub fn mu_sun(&self, index: usize) -> f64 {
        if index < self.suns_below {
            return self.lowest_mu_sun * (1.0 - index as f64 / self.suns_below as f64);
        }
        let share = (index - self.suns_below) as f64 / (self.suns_above - 1) as f64;
        share * (HORIZON_SPACING + (1.0 - HORIZON_SPACING) * share)
    }

    /// Place of an altitude (m).
    #[must_use]
    pub fn altitude_place(&self, altitude_m: f64) -> Place {
        let HazeNodes { end_m, .. } = self.haze;
        if altitude_m < end_m {
            let index = self.haze.index_below(altitude_m.max(0.0));
            let [low_m, high_m] = [index, index + 1].map(|index| self.altitude_m(index));
            return Place { index, fraction: ((altitude_m - low_m) / (high_m - low_m)).clamp(0.0, 1.0) };
        }
        let share = ((altitude_m - end_m) / (self.top_altitude_m - end_m)).clamp(0.0, 1.0).sqrt();
        let count = self.altitudes - self.haze.count();
        let Place { index, fraction } = place(share * (count - 1) as f64, count);
        Place { index: index + self.haze.count(), fraction }
    }

    /// Place of a sun's zenith cosine.
    #[must_use]
    pub fn sun_place(&self, mu_sun: f64) -> Place {
        if mu_sun < 0.0 {
            let depth = (mu_sun / self.lowest_mu_sun).min(1.0);
            let Place { index, fraction } = place((1.0 - depth) * self.suns_below as f64, self.suns_below + 1);
            let step = TWILIGHT_FALL / self.suns_below as f64;
            return Place { index, fraction: (fraction * step).exp_m1() / step.exp_m1() };
        }
        // The root of share (a + (1 - a) share) = mu, in the form that does not cancel.
        let a = HORIZON_SPACING;
        let mu = mu_sun.min(1.0);
        let share = 2.0 * mu / (a + (a * a + 4.0 * (1.0 - a) * mu).sqrt());
        let Place { index, fraction } = place(share * (self.suns_above - 1) as f64, self.suns_above);
        Place { index: index + self.suns_below, fraction }
    }
}

/// The node below a position, never the last.
#[expect(clippy::cast_possible_truncation, reason = "0 to the count of nodes")]
fn place(position: f64, count: usize) -> Place {
    let index = (position as usize).min(count - 2);
    Place { index, fraction: position - index as f64 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::haze::HazeParams;
    use crate::params::{AtmosphereParams, GroundParams};

    fn atmosphere(top_altitude_km: f64) -> Atmosphere {
        Atmosphere::new(&AtmosphereParams { top_altitude_km, ..AtmosphereParams::default() }, &GroundParams::default())
    }

    fn hazy_nodes(top_m: f64) -> Nodes {
        let haze = HazeParams { enabled: true, top_m, ..HazeParams::default() };
        let atmosphere = atmosphere(80.0).with_haze(&haze);
        Nodes::new(&atmosphere, &OrdersQuality::preview().for_haze_of(&atmosphere))
    }

    fn nodes() -> Nodes {
        Nodes::new(&atmosphere(80.0), &OrdersQuality::preview())
    }

    #[test]
    fn every_node_is_its_own_place() {
        let nodes = nodes();
        for i in 0..nodes.altitude_count() {
            let Place { index, fraction } = nodes.altitude_place(nodes.altitude_m(i));
            assert!((index as f64 + fraction - i as f64).abs() < 1e-9, "altitude {i}: {index} {fraction}");
        }
        for j in 0..nodes.sun_count() {
            let Place { index, fraction } = nodes.sun_place(nodes.mu_sun(j));
            assert!((index as f64 + fraction - j as f64).abs() < 1e-9, "sun {j}: {index} {fraction}");
        }
    }

    #[test]
    fn nodes_in_haze_ascend_and_are_their_own_places() {
        for nodes in [hazy_nodes(0.0), hazy_nodes(150.0)] {
            for i in 0..nodes.altitude_count() {
                let altitude_m = nodes.altitude_m(i);
                assert!(i == 0 || altitude_m > nodes.altitude_m(i - 1), "node {i}: {altitude_m}");
                let Place { index, fraction } = nodes.altitude_place(altitude_m);
                assert!((index as f64 + fraction - i as f64).abs() < 1e-6, "node {i}: {index} {fraction}");
            }
        }
        // Between the nodes in haze a value is linear in the altitude.
        let nodes = hazy_nodes(150.0);
        let Place { index, fraction } = nodes.altitude_place(70.0);
        let [low_m, high_m] = [index, index + 1].map(|i| nodes.altitude_m(i));
        assert!((low_m + fraction * (high_m - low_m) - 70.0).abs() < 1e-9, "{low_m} {high_m} {fraction}");
    }

    #[test]
    fn the_ends_are_ground_top_zenith_and_horizon() {
        let nodes = nodes();
        let top_m = nodes.altitude_m(nodes.altitude_count() - 1);
        assert!(nodes.altitude_m(0) == 0.0 && (top_m - 80e3).abs() < 1e-6, "{top_m}");
        assert!((nodes.mu_sun(nodes.sun_count() - 1) - 1.0).abs() < 1e-12, "zenith");
        assert!(nodes.mu_sun(20) == 0.0, "the horizon is a node");
    }

    #[test]
    fn values_outside_the_nodes_are_those_of_the_nearest() {
        let nodes = nodes();
        let Place { index, fraction } = nodes.sun_place(-0.9);
        assert!(index == 0 && fraction == 0.0, "deep night: {index} {fraction}");
        let Place { index, fraction } = nodes.altitude_place(1e6);
        assert!(index + 2 == nodes.altitude_count() && (fraction - 1.0).abs() < 1e-12, "space: {index} {fraction}");
    }

    #[test]
    fn the_table_of_the_earth_ends_twenty_degrees_below_the_horizon() {
        let nodes = Nodes::new(&atmosphere(100.0), &OrdersQuality::preview());
        assert!((nodes.lowest_mu_sun().asin().to_degrees() + 20.2).abs() < 0.1, "{}", nodes.lowest_mu_sun());
    }

    #[test]
    fn a_twilight_that_falls_at_the_assumed_rate_is_interpolated_exactly() {
        let nodes = nodes();
        let light = |mu: f64| (-TWILIGHT_FALL * mu / nodes.lowest_mu_sun()).exp() + 0.1;
        for mu in [-0.3, -0.123, -0.05, -0.0031] {
            let Place { index, fraction } = nodes.sun_place(mu);
            let got = light(nodes.mu_sun(index)) * (1.0 - fraction) + light(nodes.mu_sun(index + 1)) * fraction;
            assert!((got / light(mu) - 1.0).abs() < 1e-12, "{mu}: {got} {}", light(mu));
        }
    }
}

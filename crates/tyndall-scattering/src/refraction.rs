//! How the air lifts the sun, the moon and the stars, and flattens their discs at the horizon.
//!
//! The refractive index above one follows the density of air: temperature falls by 6.5 K per kilometre up to 11 km and
//! stays constant above, as in the standard atmosphere (an atmosphere of one temperature would lift a setting sun by 38
//! minutes of arc in place of 34). Light is traced backwards from the observer through that profile.
//!
//! Exact: [`RefractiveAir::bending`]; table: [`RefractionTable::new`]; lookup: [`RefractionTable::lookup`].
//! WGSL: `shaders/sky/refraction.wgsl`. Accuracy: within 0.7' of Bennett 1982 at the horizon, 0.1' above 5 degrees. Not
//! done: dispersion (the green rim), mirages, and the bending of scattered light: the sky itself is computed along
//! straight rays.

use std::f64::consts::FRAC_PI_2;

use rayon::prelude::*;

use crate::sky_view_map::horizon_elevation;

/// Refractive index of air above one at [`REFERENCE_PRESSURE_HPA`] and [`REFERENCE_TEMPERATURE_K`], 574 nm (Ciddor 1996).
const REFRACTIVITY: f64 = 2.773e-4;
const REFERENCE_PRESSURE_HPA: f64 = 1013.25;
const REFERENCE_TEMPERATURE_K: f64 = 288.15;

/// Fall of temperature with altitude in the troposphere (K/m), and the tropopause (m); US Standard Atmosphere 1976.
const LAPSE_K_PER_M: f64 = 0.0065;
const TROPOPAUSE_M: f64 = 11_000.0;

/// Gravity times molar mass over the gas constant (K/m).
const HYDROSTATIC_K_PER_M: f64 = 0.034_163;

/// Scale height of the air of a scene (m) at which the profile is that of the Earth.
const EARTH_SCALE_HEIGHT_M: f64 = 8000.0;

/// Altitude above which light goes straight, for the scale height of the Earth (m): 5e-6 of the air lie above.
const STRAIGHT_ABOVE_M: f64 = 80_000.0;

/// Altitude below which the profile is constant, for the scale height of the Earth (m). Rays towards the geometric
/// horizon bend below it by up to 2 km.
const LOWEST_M: f64 = -5000.0;

/// Longest way of a ray inside the air, in steps; a duct would keep a ray forever.
const STEPS_MAX: usize = 4000;

/// Celsius to kelvin.
const ZERO_CELSIUS_K: f64 = 273.15;

/// Nodes of the table.
pub const REFRACTION_NODES: usize = 256;

/// Air as light sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RefractiveAir {
    /// Radius of the planet (m).
    pub radius_m: f64,
    /// Refractive index above one at sea level.
    pub refractivity: f64,
    /// Temperature at sea level (K).
    pub temperature_k: f64,
    /// Altitudes relative to those of the Earth's air.
    pub stretch: f64,
}

impl RefractiveAir {
    /// Air over a planet: its density relative to the Earth's and its scale height (m) from the atmosphere, pressure (hPa)
    /// and temperature (degrees Celsius) at sea level from the weather.
    #[must_use]
    pub fn new(radius_m: f64, density: f64, scale_height_m: f64, pressure_hpa: f64, temperature_c: f64) -> Self {
        let temperature_k = temperature_c + ZERO_CELSIUS_K;
        let weather = pressure_hpa / REFERENCE_PRESSURE_HPA * REFERENCE_TEMPERATURE_K / temperature_k;
        Self {
            radius_m,
            refractivity: REFRACTIVITY * density * weather,
            temperature_k,
            stretch: scale_height_m / EARTH_SCALE_HEIGHT_M,
        }
    }

    /// Refractive index above one at an altitude (m), and its derivative (1/m). The profile goes on below sea level.
    #[must_use]
    pub fn index(&self, altitude_m: f64) -> (f64, f64) {
        let z_m = (altitude_m / self.stretch).max(LOWEST_M);
        let low_m = z_m.min(TROPOPAUSE_M);
        let temperature_k = self.temperature_k - LAPSE_K_PER_M * low_m;
        let exponent = HYDROSTATIC_K_PER_M / LAPSE_K_PER_M - 1.0;
        let low = self.refractivity * (temperature_k / self.temperature_k).powf(exponent);
        if z_m <= TROPOPAUSE_M {
            return (low, -low * exponent * LAPSE_K_PER_M / temperature_k / self.stretch);
        }
        let fall_per_m = HYDROSTATIC_K_PER_M / temperature_k;
        let high = low * (-(z_m - TROPOPAUSE_M) * fall_per_m).exp();
        (high, -high * fall_per_m / self.stretch)
    }

    /// By how much (rad) light from outside appears higher than it is, seen from `h_m` at an *apparent* elevation (rad). A
    /// ray that meets the ground is followed through it, so that the result is smooth.
    #[must_use]
    pub fn bending(&self, h_m: f64, elevation: f64) -> f64 {
        let end_m = STRAIGHT_ABOVE_M * self.stretch;
        let Some(mut state) = self.enter(h_m.max(0.0), elevation, end_m) else { return 0.0 };
        let mut bent = 0.0;
        for _step in 0..STEPS_MAX {
            if state.altitude_m > end_m && state.elevation > 0.0 {
                break;
            }
            let step_m = self.step_m(&state);
            bent += self.advance(&mut state, step_m);
        }
        bent
    }

    /// The ray where it is first in air that bends: at the observer, or below it at the end of the air.
    fn enter(&self, h_m: f64, elevation: f64, end_m: f64) -> Option<Light> {
        if h_m <= end_m {
            return Some(Light { altitude_m: h_m, elevation });
        }
        // r cos(elevation) is the same along a straight ray.
        let cosine = (self.radius_m + h_m) / (self.radius_m + end_m) * elevation.cos();
        (elevation < 0.0 && cosine < 1.0).then(|| Light { altitude_m: end_m, elevation: -cosine.acos() })
    }

    /// A step in which neither altitude nor direction change by much (m).
    fn step_m(&self, light: &Light) -> f64 {
        let fine_m = 200.0 * self.stretch + 0.02 * light.altitude_m.abs();
        let flat_m = 4000.0 * self.stretch.min(1.0) + 0.05 * light.altitude_m.abs();
        (fine_m / light.elevation.sin().abs().max(1e-9)).min(flat_m)
    }

    /// One step of the classical Runge-Kutta method; returns what it bends (rad).
    fn advance(&self, light: &mut Light, step_m: f64) -> f64 {
        let at = |slopes: [f64; 3], share: f64| Light {
            altitude_m: light.altitude_m + share * step_m * slopes[0],
            elevation: light.elevation + share * step_m * slopes[1],
        };
        let first = self.slopes(light);
        let second = self.slopes(&at(first, 0.5));
        let third = self.slopes(&at(second, 0.5));
        let fourth = self.slopes(&at(third, 1.0));
        let mean = |i: usize| (first[i] + 2.0 * (second[i] + third[i]) + fourth[i]) / 6.0;
        light.altitude_m += step_m * mean(0);
        light.elevation += step_m * mean(1);
        step_m * mean(2)
    }

    /// Derivatives by the length of the ray: altitude (1), local elevation (rad/m) and bending (rad/m). The plane turns
    /// under the ray by cos / r; the ray turns towards denser air by the gradient of ln n across it.
    fn slopes(&self, light: &Light) -> [f64; 3] {
        let (index, slope_per_m) = self.index(light.altitude_m);
        let (sine, cosine) = light.elevation.sin_cos();
        let bend = -slope_per_m / (1.0 + index) * cosine;
        [sine, cosine / (self.radius_m + light.altitude_m) - bend, bend]
    }
}

/// A point of a traced ray.
#[derive(Clone, Copy, Debug)]
struct Light {
    altitude_m: f64,
    /// Above the local horizontal (rad).
    elevation: f64,
}

/// The bending for one observer, over the apparent elevation from the horizon to the zenith.
#[derive(Clone, Debug, PartialEq)]
pub struct RefractionTable {
    horizon_elevation: f64,
    nodes: Vec<f64>,
}

impl RefractionTable {
    /// Traces [`REFRACTION_NODES`] rays from altitude `h_m`.
    #[must_use]
    pub fn new(air: &RefractiveAir, h_m: f64) -> Self {
        let horizon_elevation = horizon_elevation(air.radius_m, h_m);
        let node = |index: usize| {
            let share = index as f64 / (REFRACTION_NODES - 1) as f64;
            air.bending(h_m, horizon_elevation + (FRAC_PI_2 - horizon_elevation) * share * share)
        };
        Self { horizon_elevation, nodes: (0..REFRACTION_NODES).into_par_iter().map(node).collect() }
    }

    /// The table of air that does not bend.
    #[must_use]
    pub fn straight(horizon_elevation: f64) -> Self {
        Self { horizon_elevation, nodes: vec![0.0; REFRACTION_NODES] }
    }

    /// The bending (rad) at an apparent elevation (rad); below the horizon that of the horizon.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "0 to the count of nodes")]
    pub fn lookup(&self, elevation: f64) -> f64 {
        let share = (elevation - self.horizon_elevation) / (FRAC_PI_2 - self.horizon_elevation);
        let position = share.clamp(0.0, 1.0).sqrt() * (REFRACTION_NODES - 1) as f64;
        let first = (position as usize).min(REFRACTION_NODES - 2);
        let fraction = position - first as f64;
        self.nodes[first] * (1.0 - fraction) + self.nodes[first + 1] * fraction
    }

    /// The apparent elevation (rad) of something at a true elevation (rad) above the atmosphere.
    #[must_use]
    pub fn apparent(&self, true_elevation: f64) -> f64 {
        // True elevation grows with the apparent one: bisection cannot fail.
        let (mut low, mut high) = (true_elevation - 1e-3, true_elevation + 0.2);
        for _halving in 0..50 {
            let middle = 0.5 * (low + high);
            if middle - self.lookup(middle) < true_elevation { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    }

    /// The stored bending (rad), from the horizon to the zenith.
    #[must_use]
    pub fn nodes(&self) -> &[f64] {
        &self.nodes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ARC_MINUTE: f64 = std::f64::consts::PI / (180.0 * 60.0);

    /// The weather of Bennett's formula.
    fn earth() -> RefractiveAir {
        RefractiveAir::new(6.36e6, 1.0, 8000.0, 1010.0, 10.0)
    }

    /// Bennett 1982 as in Meeus, 1998, formula 16.3: minutes of arc for an apparent elevation in degrees.
    fn bennett_minutes(apparent_deg: f64) -> f64 {
        1.0 / (apparent_deg + 7.31 / (apparent_deg + 4.4)).to_radians().tan()
    }

    #[test]
    fn the_setting_sun_is_lifted_by_thirty_four_minutes_of_arc() {
        let minutes = earth().bending(0.0, 0.0) / ARC_MINUTE;
        println!("refraction at the horizon: {minutes:.2}'");
        assert!((minutes - 34.0).abs() < 1.0, "{minutes}'");
    }

    #[test]
    fn the_bending_is_bennetts_at_every_elevation() {
        for apparent_deg in [0.0, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 45.0, 70.0, 89.0] {
            let found = earth().bending(0.0, f64::to_radians(apparent_deg)) / ARC_MINUTE;
            let published = bennett_minutes(apparent_deg);
            println!("{apparent_deg} deg: {found:.3}' against {published:.3}'");
            // His own accuracy is 0.07' (at 45 degrees he has 59.7" where Snell's law gives 58.0") against tables that differ
            // by a minute at the horizon.
            let allowed = if apparent_deg < 5.0 { 0.8 } else { 0.12 };
            assert!((found - published).abs() < allowed, "{apparent_deg} deg: {found}' {published}'");
        }
    }

    #[test]
    fn high_up_the_bending_is_that_of_a_flat_plate_of_air() {
        // Snell: n sin(apparent zenith angle) = sin(true one), whatever the profile.
        for zenith_deg in [10.0_f64, 30.0, 45.0] {
            let air = earth();
            let snell = ((1.0 + air.refractivity) * zenith_deg.to_radians().sin()).asin() - zenith_deg.to_radians();
            let found = air.bending(0.0, FRAC_PI_2 - zenith_deg.to_radians());
            // The curvature of the earth takes H / R tan^2 of it.
            assert!((found / snell - 1.0).abs() < 3e-3, "{zenith_deg} deg: {found} {snell}");
        }
        assert!(earth().bending(0.0, FRAC_PI_2).abs() < 1e-9, "none in the zenith");
    }

    #[test]
    fn the_setting_sun_is_a_sixth_flatter_than_wide() {
        let table = RefractionTable::new(&earth(), 0.0);
        let radius = 0.2667_f64.to_radians();
        // The lower limb touches the horizon.
        let lower = -table.lookup(0.0);
        let height = table.apparent(lower + 2.0 * radius) - table.apparent(lower);
        let ratio = height / (2.0 * radius);
        println!("height over width of the sun on the horizon: {ratio:.3}");
        assert!((ratio - 0.83).abs() < 0.03, "{ratio}");
    }

    #[test]
    fn the_bending_falls_with_elevation_and_with_altitude() {
        for h_m in [0.0, 2.0, 1e3, 1e4, 3e4, 4e5, 1e7] {
            let table = RefractionTable::new(&earth(), h_m);
            assert!(
                table.nodes().windows(2).all(|pair| pair[1] <= pair[0] + 1e-7),
                "from {h_m} m: {:?}",
                table.nodes()
            );
            assert!(table.nodes().iter().all(|node| node.is_finite() && *node >= 0.0), "from {h_m} m");
        }
        let level = |h_m: f64| earth().bending(h_m, 0.0);
        assert!(level(0.0) > level(1e3) && level(1e3) > level(1e4), "level rays");
    }

    #[test]
    fn from_space_the_limb_bends_light_twice() {
        // The ray that grazes the ground: n r cos(elevation) is the same along it.
        let (air, h_m) = (earth(), 4e5);
        let grazing = -((1.0 + air.refractivity) * air.radius_m / (air.radius_m + h_m)).acos();
        let ratio = air.bending(h_m, grazing) / air.bending(0.0, 0.0);
        assert!((ratio - 2.0).abs() < 0.01, "{ratio}");
    }

    #[test]
    fn the_table_equals_the_trace_between_its_nodes() {
        for h_m in [2.0, 1e4, 4e5] {
            let (air, table) = (earth(), RefractionTable::new(&earth(), h_m));
            let low = table.horizon_elevation;
            for step in 1..200 {
                let elevation = low + (FRAC_PI_2 - low) * (f64::from(step) / 200.0).powi(3);
                let error = (table.lookup(elevation) - air.bending(h_m, elevation)).abs();
                // From space a ray whose lowest point is the tropopause has a kink: a sixtieth of the sun's disc.
                let allowed = if h_m > 1e5 { 0.5 } else { 0.1 };
                assert!(error < allowed * ARC_MINUTE, "{h_m} m, {elevation}: {} '", error / ARC_MINUTE);
            }
        }
    }

    #[test]
    fn no_air_bends_nothing_and_the_thickest_stays_finite() {
        assert!(RefractiveAir::new(6.36e6, 0.0, 8000.0, 1010.0, 10.0).bending(2.0, 0.0).abs() < 1e-15, "no air");
        let thick = RefractiveAir::new(1e8, 10.0, 500.0, 2000.0, -90.0);
        for elevation in [-0.1, 0.0, 0.01, 0.3] {
            assert!(thick.bending(2.0, elevation).is_finite(), "{elevation}");
        }
    }

    #[test]
    fn apparent_and_true_elevation_are_inverse() {
        let table = RefractionTable::new(&earth(), 2.0);
        for true_elevation in [-0.005, 0.0, 0.1, 1.2] {
            let apparent = table.apparent(true_elevation);
            assert!((apparent - table.lookup(apparent) - true_elevation).abs() < 1e-9, "{true_elevation}");
        }
    }
}

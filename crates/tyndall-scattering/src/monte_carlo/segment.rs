//! A straight stretch of a path, and where on it the light is taken to have been scattered.
//!
//! Two ways of choosing are mixed. *Free flight* is what light itself does, for one wavelength: the distance at which its
//! scattering optical depth reaches an exponential random number, exact by Newton's iteration on the columns. *Towards the
//! sunlit* prefers places where there is light to be found, whatever the wavelength; it is what makes twilight feasible.
//! Their densities are known for every wavelength, so that one path serves all (balance heuristic of Veach 1997 over both
//! ways and over all wavelengths, as in Wilkie et al. 2014, "Hero Wavelength Spectral Sampling").

use crate::atmosphere::MEDIUM_COUNT;
use crate::optical_length::Columns;

use super::layers::{Layers, Line};
use super::path::Place;
use super::sunlight::Sunlight;

/// Share of the places that are chosen by free flight.
const FLIGHT_SHARE: f64 = 0.5;

/// Scattering optical depths below this are too thin for free flight.
const THIN: f64 = 1e-9;

/// Ground counts this much per unit of albedo, light and transmittance; a scattering layer of depth 1 counts 1.
const GROUND_WEIGHT: f64 = 4.0;

/// Cosine that stands for the sky's light on ground.
const SKY_ON_GROUND: f64 = 0.25;

/// Rounds of Newton's iteration; two are the rule.
const NEWTON_ROUNDS: usize = 8;

/// Where a stretch ends and how.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    pub(super) length_m: f64,
    pub(super) on_ground: bool,
}

/// A place on the stretch, with what lies before it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chosen {
    pub(super) t_m: f64,
    pub(super) on_ground: bool,
    /// Columns from the start (m).
    pub(super) columns: Columns,
    /// Densities there; nothing on the ground.
    pub(super) densities: Columns,
    /// Density of choosing this place towards the sunlit (1/m; on the ground 1).
    towards_light: f64,
}

/// The stretch in pieces. Reused from stretch to stretch.
#[derive(Clone, Debug, Default)]
pub(super) struct Segment {
    line: Option<Line>,
    on_ground: bool,
    edges_m: Vec<f64>,
    columns: Vec<Columns>,
    densities: Vec<Columns>,
    /// Preference at the edges (1/m).
    preference: Vec<f64>,
    /// Preference up to each edge, integrated.
    sums: Vec<f64>,
    ground_preference: f64,
}

/// What a segment is laid through.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scenery<'a> {
    pub(super) layers: &'a Layers,
    pub(super) sunlight: &'a Sunlight,
    /// Wavelength by which preferences are judged.
    pub(super) judge: usize,
    /// Ground albedo at that wavelength.
    pub(super) albedo: f64,
}

impl Segment {
    /// Lays the segment from a place along its direction.
    pub(super) fn lay(&mut self, scenery: &Scenery<'_>, place: &Place, stretch: Stretch) {
        let layers = scenery.layers;
        let line = layers.line(place.h_m, place.mu());
        self.line = Some(line);
        self.on_ground = stretch.on_ground;
        for list in [&mut self.edges_m, &mut self.preference, &mut self.sums] {
            list.clear();
        }
        self.columns.clear();
        self.densities.clear();
        self.push(scenery, place, 0.0, [0.0; MEDIUM_COUNT]);
        layers.for_each_piece(&line, stretch.length_m, |from_m, to_m| {
            let before = self.columns[self.columns.len() - 1];
            let piece = layers.piece_columns(&line, from_m, to_m);
            self.push(scenery, place, to_m, std::array::from_fn(|m| before[m] + piece[m]));
        });
        self.ground_preference =
            if stretch.on_ground { self.preference_of_ground(scenery, place, stretch) } else { 0.0 };
    }

    fn push(&mut self, scenery: &Scenery<'_>, place: &Place, t_m: f64, columns: Columns) {
        let Some(line) = self.line else { return };
        let altitude_m = line.altitude_m(t_m).max(0.0);
        let densities = scenery.layers.densities(altitude_m);
        let light = scenery.sunlight.at(altitude_m, place.mu_sun_along(scenery.layers.radius_m, t_m, altitude_m));
        let scattering = scenery.layers.scattering_per_m(&densities, scenery.judge);
        let preference = (scattering * scenery.layers.transmittance(&columns, scenery.judge) * light).max(1e-60);
        if let (Some(from_m), Some(before), Some(sum)) = (self.edges_m.last(), self.preference.last(), self.sums.last())
        {
            self.sums.push(sum + log_linear_integral(*before, preference, t_m - from_m));
        } else {
            self.sums.push(0.0);
        }
        self.edges_m.push(t_m);
        self.columns.push(columns);
        self.densities.push(densities);
        self.preference.push(preference);
    }

    fn preference_of_ground(&self, scenery: &Scenery<'_>, place: &Place, stretch: Stretch) -> f64 {
        let mu_sun = place.mu_sun_along(scenery.layers.radius_m, stretch.length_m, 0.0);
        let cosine = mu_sun.max(SKY_ON_GROUND);
        let transmittance = scenery.layers.transmittance(&self.columns[self.columns.len() - 1], scenery.judge);
        GROUND_WEIGHT * scenery.albedo * transmittance * cosine * scenery.sunlight.at(0.0, mu_sun)
    }

    /// Chooses a place for the wavelength `hero`, with a random number for the way and one for the distance. `None` when
    /// there is nothing to scatter.
    pub(super) fn choose(&self, layers: &Layers, hero: usize, way: f64, distance: f64) -> Option<Chosen> {
        let depth = self.scattering_depth(layers, hero);
        if way < flight_share(depth) {
            let free = if self.on_ground { 1.0 } else { -(-depth).exp_m1() };
            let target = -(-distance * free).ln_1p();
            return if target < depth { self.at_depth(layers, hero, target) } else { self.ground() };
        }
        let total = self.preference_total();
        let target = distance * total;
        let last = *self.sums.last()?;
        if target >= last {
            return if self.on_ground { self.ground() } else { self.inside(layers, self.edges_m.len() - 2, 1.0) };
        }
        let bin = self.sums.partition_point(|sum| *sum <= target).clamp(1, self.edges_m.len() - 1) - 1;
        let share = (target - self.sums[bin]) / (self.sums[bin + 1] - self.sums[bin]);
        self.inside(layers, bin, log_linear_place(self.preference[bin], self.preference[bin + 1], share))
    }

    /// Density (1/m; on the ground a probability) of choosing this place by a path of the wavelength `k`.
    pub(super) fn density(&self, layers: &Layers, chosen: &Chosen, k: usize) -> f64 {
        let depth = self.scattering_depth(layers, k);
        let share = flight_share(depth);
        let flight = if share > 0.0 {
            let before = (-layers.scattering_depth(&chosen.columns, k)).exp();
            let free = if self.on_ground { 1.0 } else { -(-depth).exp_m1() };
            if chosen.on_ground { before } else { layers.scattering_per_m(&chosen.densities, k) * before / free }
        } else {
            0.0
        };
        share * flight + (1.0 - share) * chosen.towards_light
    }

    fn scattering_depth(&self, layers: &Layers, k: usize) -> f64 {
        self.columns.last().map_or(0.0, |columns| layers.scattering_depth(columns, k))
    }

    fn preference_total(&self) -> f64 {
        self.sums.last().copied().unwrap_or(0.0) + self.ground_preference
    }

    fn ground(&self) -> Option<Chosen> {
        let (t_m, columns) = (*self.edges_m.last()?, *self.columns.last()?);
        let towards_light = self.ground_preference / self.preference_total();
        Some(Chosen { t_m, on_ground: true, columns, densities: [0.0; MEDIUM_COUNT], towards_light })
    }

    /// The place at a share of a piece's length.
    fn inside(&self, layers: &Layers, bin: usize, share: f64) -> Option<Chosen> {
        let (from_m, to_m) = (self.edges_m[bin], self.edges_m[bin + 1]);
        self.place(layers, bin, from_m + share * (to_m - from_m))
    }

    fn place(&self, layers: &Layers, bin: usize, t_m: f64) -> Option<Chosen> {
        let line = self.line?;
        let (from_m, to_m) = (self.edges_m[bin], self.edges_m[bin + 1]);
        let part = layers.piece_columns(&line, from_m, t_m);
        let (a, b) = (self.preference[bin], self.preference[bin + 1]);
        let preference = a * (b / a).powf((t_m - from_m) / (to_m - from_m));
        Some(Chosen {
            t_m,
            on_ground: false,
            columns: std::array::from_fn(|m| self.columns[bin][m] + part[m]),
            densities: layers.densities(line.altitude_m(t_m)),
            towards_light: preference / self.preference_total(),
        })
    }

    /// The place at which the scattering optical depth of `hero` reaches `target`.
    fn at_depth(&self, layers: &Layers, hero: usize, target: f64) -> Option<Chosen> {
        let depths = |columns: &Columns| layers.scattering_depth(columns, hero);
        let bin =
            self.columns.partition_point(|columns| depths(columns) <= target).clamp(1, self.edges_m.len() - 1) - 1;
        let (from_m, to_m) = (self.edges_m[bin], self.edges_m[bin + 1]);
        let span = depths(&self.columns[bin + 1]) - depths(&self.columns[bin]);
        let [a, b] = [bin, bin + 1].map(|edge| layers.scattering_per_m(&self.densities[edge], hero).max(1e-60));
        let share = log_linear_place(a, b, ((target - depths(&self.columns[bin])) / span).clamp(0.0, 1.0));
        let mut t_m = from_m + share * (to_m - from_m);
        let mut chosen = self.place(layers, bin, t_m)?;
        for _round in 0..NEWTON_ROUNDS {
            let miss = depths(&chosen.columns) - target;
            let slope = layers.scattering_per_m(&chosen.densities, hero);
            if miss.abs() <= 1e-7 * span || slope <= 0.0 {
                break;
            }
            t_m = (t_m - miss / slope).clamp(from_m, to_m);
            chosen = self.place(layers, bin, t_m)?;
        }
        Some(chosen)
    }
}

/// Chance of choosing a place by free flight through this scattering optical depth.
fn flight_share(depth: f64) -> f64 {
    if depth > THIN { FLIGHT_SHARE } else { 0.0 }
}

/// Integral over `width` of a function that goes from `a` to `b` exponentially.
fn log_linear_integral(a: f64, b: f64, width: f64) -> f64 {
    let fall = (b / a).ln();
    if fall.abs() < 1e-6 { 0.5 * (a + b) * width } else { (b - a) / fall * width }
}

/// Where, as a share of the width, that integral reaches `share` of its whole.
fn log_linear_place(a: f64, b: f64, share: f64) -> f64 {
    let fall = (b / a).ln();
    if fall.abs() < 1e-6 { share } else { (share * fall.exp_m1()).ln_1p() / fall }.clamp(0.0, 1.0)
}

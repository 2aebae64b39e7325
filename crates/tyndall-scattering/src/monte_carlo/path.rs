//! One random walk from the eye back into the atmosphere, for all wavelengths at once.
//!
//! At each scattering or reflection the sun is looked for directly (next-event estimation), then the walk goes on in a
//! direction chosen by the phase functions or by Lambert's law. The walk is chosen for one *hero* wavelength, and carries
//! for every wavelength what light would pass along it and how probable the walk would have been: the quotient of the
//! first to the mean of the second is unbiased for every wavelength, whichever the hero was.

use std::f64::consts::PI;

use crate::geometry::{distance_to_ground, distance_to_top, horizon_mu};
use crate::optical_length::Columns;
use crate::single_scattering::RayEnd;

use super::MonteCarlo;
use super::random::PathRandom;
use super::scatter::{sample_cosine, scattering_pdf};
use super::segment::{Chosen, Scenery, Segment, Stretch};
use super::vector::{Vector, around, combine, dot, normalized};

/// Scatterings after which weak walks may be ended.
const SAFE_ORDERS: usize = 3;

/// Largest and smallest chance of going on.
const SURVIVAL: (f64, f64) = (0.05, 0.97);

/// Density (1/sr) of a direction where a wavelength is not scattered at all.
const EVEN: f64 = 0.25 / PI;

/// No walk is longer; with the largest chance of going on, none in 10^10 gets here.
const LONGEST: usize = 800;

/// A point, and a direction that leads from it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) h_m: f64,
    pub(super) up: Vector,
    pub(super) direction: Vector,
    pub(super) sun: Vector,
}

impl Place {
    /// Zenith cosine of the direction.
    pub(super) fn mu(&self) -> f64 {
        dot(self.up, self.direction).clamp(-1.0, 1.0)
    }

    /// Zenith cosine of the sun at a distance, where the altitude is `altitude_m`.
    pub(super) fn mu_sun_along(&self, radius_m: f64, t_m: f64, altitude_m: f64) -> f64 {
        let ahead = (radius_m + self.h_m) * dot(self.up, self.sun) + t_m * dot(self.direction, self.sun);
        (ahead / (radius_m + altitude_m)).clamp(-1.0, 1.0)
    }

    /// Goes on to a distance, where the altitude is `altitude_m`.
    fn advance(&mut self, radius_m: f64, t_m: f64, altitude_m: f64) {
        self.up = normalized(combine(radius_m + self.h_m, self.up, t_m, self.direction));
        self.h_m = altitude_m;
    }
}

/// The memory of a walk, reused from walk to walk.
#[derive(Clone, Debug)]
pub(super) struct Walker {
    segment: Segment,
    /// What light passes along the walk, over the mean probability of the walk.
    throughput: Vec<f64>,
    /// Probability of the walk for each hero, over their mean.
    probability: Vec<f64>,
}

impl Walker {
    pub(super) fn new(wavelengths: usize) -> Self {
        let ones = vec![1.0; wavelengths];
        Self { segment: Segment::default(), throughput: ones.clone(), probability: ones }
    }

    /// Walks from `place`, and adds to `sum` the radiance (relative to the sun's irradiance) by at least `first_order`
    /// scatterings. The first stretch ends at `first_end`.
    pub(super) fn walk(
        &mut self,
        model: &MonteCarlo,
        mut place: Place,
        (first_end, first_order): (RayEnd, usize),
        random: &mut PathRandom<'_>,
        sum: &mut [f64],
    ) {
        self.throughput.fill(1.0);
        self.probability.fill(1.0);
        let scenery = model.scenery();
        let hero = index_of(random.next(), self.throughput.len());
        for order in 1..LONGEST {
            let end = if order == 1 { first_end } else { model.end(place.h_m, place.mu()) };
            let stretch = Stretch { length_m: end.length_m, on_ground: end.on_ground };
            self.segment.lay(&scenery, &place, stretch);
            let (way, distance) = (random.next(), random.next());
            let Some(chosen) = self.segment.choose(scenery.layers, hero, way, distance) else { return };
            let altitude_m = if chosen.on_ground { 0.0 } else { model.altitude_m(&place, chosen.t_m) };
            let incoming = place.direction;
            place.advance(scenery.layers.radius_m, chosen.t_m, altitude_m);
            self.arrive(model, &scenery, &chosen);
            if order >= first_order {
                self.look_at_the_sun(model, &place, &chosen, incoming, sum);
            }
            let alive = if chosen.on_ground {
                self.reflect(model, &mut place, random)
            } else {
                self.scatter(model, &mut place, &chosen, hero, random)
            };
            if !alive || (order >= SAFE_ORDERS && !self.survives(random)) {
                return;
            }
        }
    }

    /// Takes the way to the chosen place into the weights.
    fn arrive(&mut self, model: &MonteCarlo, scenery: &Scenery<'_>, chosen: &Chosen) {
        for k in 0..self.throughput.len() {
            self.throughput[k] *= scenery.layers.transmittance(&chosen.columns, k)
                * if chosen.on_ground { model.atmosphere.ground_albedo[k] } else { 1.0 };
            self.probability[k] *= self.segment.density(scenery.layers, chosen, k);
        }
        self.normalize();
    }

    /// Adds the sunlight that the place sends back along the walk.
    fn look_at_the_sun(&self, model: &MonteCarlo, place: &Place, chosen: &Chosen, incoming: Vector, sum: &mut [f64]) {
        let layers = &model.layers;
        let mu_sun = dot(place.up, place.sun).clamp(-1.0, 1.0);
        if mu_sun <= horizon_mu(layers.radius_m, place.h_m) {
            return;
        }
        let length_m = distance_to_top(layers.radius_m, model.atmosphere.top_altitude_m, place.h_m, mu_sun);
        let columns = layers.columns(&layers.line(place.h_m, mu_sun), length_m);
        let nu = dot(incoming, place.sun);
        let phases = model.phases(nu);
        for (k, sum) in sum.iter_mut().enumerate() {
            let scattered = if chosen.on_ground { mu_sun / PI } else { model.scattered(&chosen.densities, &phases, k) };
            *sum += self.throughput[k] * scattered * layers.transmittance(&columns, k);
        }
    }

    /// Leaves the ground by Lambert's law; the albedo has been counted on arrival.
    fn reflect(&mut self, model: &MonteCarlo, place: &mut Place, random: &mut PathRandom<'_>) -> bool {
        place.direction = around(place.up, random.next().sqrt(), random.next());
        // Dark ground ends most walks here, where the chance is known to be the albedo.
        let brightest = model.atmosphere.ground_albedo.iter().copied().fold(0.0, f64::max);
        brightest > 0.0 && self.goes_on(brightest.clamp(SURVIVAL.0, 1.0), random)
    }

    /// Leaves a place in the air by one medium's phase function.
    fn scatter(
        &mut self,
        model: &MonteCarlo,
        place: &mut Place,
        chosen: &Chosen,
        hero: usize,
        random: &mut PathRandom<'_>,
    ) -> bool {
        let layers = &model.layers;
        let cosine = model.sample_medium(&chosen.densities, hero, random.next());
        place.direction = around(place.direction, cosine, random.next());
        let (phases, densities) = (model.phases(cosine), model.sampling_densities(cosine));
        for k in 0..self.throughput.len() {
            let scattered = layers.scattering_per_m(&chosen.densities, k);
            self.throughput[k] *= model.scattered(&chosen.densities, &phases, k);
            self.probability[k] *=
                if scattered > 0.0 { model.scattered(&chosen.densities, &densities, k) / scattered } else { EVEN };
        }
        self.normalize()
    }

    fn survives(&mut self, random: &mut PathRandom<'_>) -> bool {
        let strongest = self.throughput.iter().copied().fold(0.0, f64::max);
        strongest > 0.0 && self.goes_on(strongest.clamp(SURVIVAL.0, SURVIVAL.1), random)
    }

    fn goes_on(&mut self, chance: f64, random: &mut PathRandom<'_>) -> bool {
        if random.next() >= chance {
            return false;
        }
        self.throughput.iter_mut().for_each(|value| *value /= chance);
        true
    }

    /// Divides both by the mean probability; false when the walk was impossible.
    fn normalize(&mut self) -> bool {
        let mean = self.probability.iter().sum::<f64>() / self.probability.len() as f64;
        if mean <= 0.0 {
            self.throughput.fill(0.0);
            return false;
        }
        for (throughput, probability) in self.throughput.iter_mut().zip(&mut self.probability) {
            *throughput /= mean;
            *probability /= mean;
        }
        true
    }
}

impl MonteCarlo {
    pub(super) fn scenery(&self) -> Scenery<'_> {
        let albedo = self.atmosphere.ground_albedo[self.judge];
        Scenery { layers: &self.layers, sunlight: &self.sunlight, judge: self.judge, albedo }
    }

    fn end(&self, h_m: f64, mu: f64) -> RayEnd {
        let (radius_m, top_m) = (self.atmosphere.planet_radius_m, self.atmosphere.top_altitude_m);
        match distance_to_ground(radius_m, h_m, mu) {
            Some(length_m) => RayEnd { length_m, on_ground: true },
            None => RayEnd { length_m: distance_to_top(radius_m, top_m, h_m.min(top_m), mu), on_ground: false },
        }
    }

    fn altitude_m(&self, place: &Place, t_m: f64) -> f64 {
        self.layers.line(place.h_m, place.mu()).altitude_m(t_m).max(0.0)
    }

    fn phases(&self, cosine: f64) -> Columns {
        let mut values = Columns::default();
        for (value, medium) in values.iter_mut().zip(&self.layers.media) {
            *value = medium.phase.value(cosine);
        }
        values
    }

    fn sampling_densities(&self, cosine: f64) -> Columns {
        let mut values = Columns::default();
        for (value, medium) in values.iter_mut().zip(&self.layers.media) {
            *value = scattering_pdf(medium.phase, cosine);
        }
        values
    }

    /// Scattering coefficient times a function of each medium (1/m/sr).
    fn scattered(&self, densities: &Columns, functions: &Columns, k: usize) -> f64 {
        let media = self.layers.media.iter().zip(densities).zip(functions);
        media.map(|((medium, density), function)| medium.scattering_per_m[k] * density * function).sum()
    }

    /// Cosine of a scattering angle by one of the media, chosen by its share at the wavelength `hero`.
    fn sample_medium(&self, densities: &Columns, hero: usize, unit: f64) -> f64 {
        let total = self.layers.scattering_per_m(densities, hero);
        let mut target = unit * total;
        let mut last = None;
        for (medium, density) in self.layers.media.iter().zip(densities) {
            let part = medium.scattering_per_m[hero] * density;
            if part > 0.0 {
                last = Some((medium.phase, part));
                if target < part {
                    break;
                }
                target -= part;
            }
        }
        // What is left of the random number is evenly distributed again.
        last.map_or(2.0 * unit - 1.0, |(phase, part)| sample_cosine(phase, (target / part).clamp(0.0, 1.0)))
    }
}

/// One of `count` equal parts of 0..1.
#[expect(clippy::cast_possible_truncation, reason = "0 to 1 times a small count")]
fn index_of(unit: f64, count: usize) -> usize {
    ((unit * count as f64) as usize).min(count - 1)
}

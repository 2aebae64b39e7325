//! The loop over the orders.
//!
//! Order 1 at a node: single scattering with the exact phase functions in every direction of the quadrature, and sunlight
//! from the ground. Order n + 1: what order n scatters into each ray, and its irradiance from the ground. Each order is
//! projected onto the harmonics again. A ray's geometry does not depend on the sun, so that the work is done ray by ray
//! for all suns: the field is contracted with the ray's zenith angles once, and suns and azimuths cost little.

use std::f64::consts::PI;

use rayon::prelude::*;
use tyndall_core::spectrum::WAVELENGTH_COUNT;

use super::OrdersQuality;
use super::basis::{MAX_DEGREE, azimuth_parts, harmonic_count, harmonic_index, zenith_parts};
use super::directions::{Zenith, azimuth_cosine, zeniths};
use super::field::{DARK, Field, Light, add_scaled};
use super::media::ScatteringMedia;
use super::nodes::Nodes;
use super::path::{GroundEnd, Path, narrow, widen};
use crate::geometry::{Ray, distance_to_ground, horizon_mu, mu_along};
use crate::march::Marcher;
use crate::single_scattering::ray_end;

/// Radiance of one ray integrated over the azimuth with cos(m phi) (W/m^2/nm), for every sun.
type Projected = Vec<[Light; MAX_DEGREE + 1]>;

/// Largest ratio of two successive orders that is believed; conservative scattering in an endless cloud has 1.
const LARGEST_RATIO: f32 = 0.95;

/// All orders of scattering in one atmosphere.
pub(crate) struct OrderLoop<'a> {
    marcher: &'a Marcher,
    pub(crate) media: ScatteringMedia,
    quality: OrdersQuality,
    nodes: Nodes,
}

impl<'a> OrderLoop<'a> {
    pub(crate) fn new(marcher: &'a Marcher, quality: &OrdersQuality) -> Self {
        let quality = quality.for_haze_of(&marcher.atmosphere);
        let nodes = Nodes::new(&marcher.atmosphere, &quality);
        Self { marcher, media: ScatteringMedia::new(&marcher.atmosphere), quality, nodes }
    }

    /// Light scattered once, and sunlight from the ground.
    pub(crate) fn first(&self) -> Field {
        let Once { marcher: coarse, dark, .. } = self.once();
        self.project(|h_m, zenith| {
            let path = self.path(&dark, h_m, zenith.mu);
            self.around(h_m, zenith, |ray| self.single(&coarse, path.ground, ray))
        })
    }

    /// Light scattered once, ray by ray.
    pub(crate) fn once(&self) -> Once<'_> {
        let marcher = Marcher { panels: self.quality.panels, ..self.marcher.clone() };
        Once { orders: self, marcher, dark: Field::dark(self.nodes, 0) }
    }

    /// Nodes of the table.
    pub(crate) fn nodes(&self) -> &Nodes {
        &self.nodes
    }

    /// The order after `field`.
    pub(crate) fn next(&self, field: &Field) -> Field {
        self.project(|h_m, zenith| {
            let path = self.path(field, h_m, zenith.mu);
            let contracted = path.contract(field);
            self.around(h_m, zenith, |ray| {
                let mut light = path.gather(&self.nodes, &contracted, ray);
                if let Some(end) = path.ground {
                    let irradiance = field.irradiance_at(self.mu_sun_at_ground(ray, &end));
                    add_scaled(&mut light, &self.reflected(&end, &irradiance), 1.0);
                }
                light
            })
        })
    }

    /// The sum of all orders from the first, the later ones as a geometric series.
    pub(crate) fn sum(&self, first: &Field) -> Field {
        let (mut total, mut last) = (first.clone(), first.clone());
        for _order in 2..self.quality.orders {
            last = self.next(&last);
            total.add(&last);
        }
        let end = with_tail(self.next(&last), &last);
        total.add(&end);
        total
    }

    fn path(&self, field: &Field, h_m: f64, mu: f64) -> Path {
        let end = ray_end(&self.marcher.atmosphere, h_m, mu);
        Path::new(self.marcher, &self.media, field, (h_m, mu, end), self.quality.panels)
    }

    fn single(&self, coarse: &Marcher, ground: Option<GroundEnd>, ray: &Ray) -> Light {
        let parts = coarse.scattered_parts(ray);
        let phases = self.marcher.atmosphere.phases(ray.nu);
        let mut light = narrow(std::array::from_fn::<f64, WAVELENGTH_COUNT, _>(|k| {
            phases.iter().zip(&parts).map(|(phase, part)| phase * part[k]).sum()
        }));
        if let Some(end) = ground {
            let mu_sun = self.mu_sun_at_ground(ray, &end);
            let irradiance = self.marcher.sun_on_ground(mu_sun);
            add_scaled(&mut light, &self.reflected(&end, &narrow(irradiance)), 1.0);
        }
        light
    }

    fn mu_sun_at_ground(&self, ray: &Ray, end: &GroundEnd) -> f64 {
        mu_along(self.marcher.atmosphere.planet_radius_m, ray.h_m, ray.mu_sun, ray.nu, end.length_m, 0.0)
    }

    /// Radiance at the start of a ray of ground with this irradiance.
    fn reflected(&self, end: &GroundEnd, irradiance: &Light) -> Light {
        let albedo = &self.marcher.coefficients.ground_albedo;
        let light = widen(irradiance);
        narrow(std::array::from_fn(|k| albedo[k] / PI * end.transmittance[k] * light[k]))
    }

    /// The azimuth projections of `radiance` around one zenith angle, for every sun.
    fn around(&self, h_m: f64, zenith: &Zenith, radiance: impl Fn(&Ray) -> Light) -> Projected {
        let mu = zenith.mu;
        let project = |sun: usize| {
            let mu_sun = self.nodes.mu_sun(sun);
            let sines = ((1.0 - mu * mu) * (1.0 - mu_sun * mu_sun)).max(0.0).sqrt();
            let mut projected = [DARK; MAX_DEGREE + 1];
            for azimuth in 0..self.quality.azimuths {
                let cos_phi = azimuth_cosine(azimuth, self.quality.azimuths);
                let nu = (mu * mu_sun + sines * cos_phi).clamp(-1.0, 1.0);
                let light = radiance(&Ray { h_m, mu, mu_sun, nu });
                let cosines = narrow(azimuth_parts(cos_phi).map(|cosine| cosine * zenith.solid_angle));
                for (sum, cosine) in projected.iter_mut().zip(cosines).take(self.quality.degree + 1) {
                    add_scaled(sum, &light, cosine);
                }
            }
            projected
        };
        (0..self.nodes.sun_count()).map(project).collect()
    }

    /// A field from the azimuth projections at each altitude (m) and zenith angle. Sums run in a fixed order, so that any
    /// number of threads gives the same bits.
    fn project(&self, around: impl Fn(f64, &Zenith) -> Projected + Sync) -> Field {
        let radius_m = self.marcher.atmosphere.planet_radius_m;
        let rays: Vec<(usize, Zenith)> = (0..self.nodes.altitude_count())
            .flat_map(|i| {
                let horizon = horizon_mu(radius_m, self.nodes.altitude_m(i));
                zeniths(horizon, self.quality.zeniths, self.quality.azimuths).into_iter().map(move |zenith| (i, zenith))
            })
            .collect();
        let projections: Vec<Projected> =
            rays.par_iter().map(|(i, zenith)| around(self.nodes.altitude_m(*i), zenith)).collect();
        let mut field = Field::dark(self.nodes, self.quality.degree);
        for ((altitude, zenith), projected) in rays.iter().zip(&projections) {
            field.add_zenith(*altitude, zenith.mu, projected);
        }
        field
    }
}

/// Light scattered once, and sunlight from the ground, along single rays.
pub(crate) struct Once<'a> {
    orders: &'a OrderLoop<'a>,
    /// With the panels of the table.
    pub(crate) marcher: Marcher,
    dark: Field,
}

impl Once<'_> {
    /// Radiance (W/m^2/sr/nm) at the start of a ray inside the atmosphere.
    pub(crate) fn radiance(&self, ray: &Ray) -> Light {
        let meets_ground = distance_to_ground(self.marcher.atmosphere.planet_radius_m, ray.h_m, ray.mu).is_some();
        let ground = meets_ground.then(|| self.orders.path(&self.dark, ray.h_m, ray.mu)).and_then(|path| path.ground);
        self.orders.single(&self.marcher, ground, ray)
    }
}

impl Field {
    /// Adds one zenith angle of one altitude.
    fn add_zenith(&mut self, altitude: usize, mu: f64, projected: &Projected) {
        let parts = narrow(zenith_parts(mu, self.degree));
        let count = harmonic_count(self.degree);
        for (sun, lights) in projected.iter().enumerate() {
            let first = (sun * self.nodes.altitude_count() + altitude) * count;
            for l in 0..=self.degree {
                for (m, light) in lights.iter().enumerate().take(l + 1) {
                    let k = harmonic_index(l, m);
                    add_scaled(&mut self.harmonics[first + k], light, parts[k]);
                }
            }
            if altitude == 0 && mu > 0.0 {
                add_scaled(&mut self.irradiance[sun], &lights[0], narrow([mu])[0]);
            }
        }
    }

    /// Adds another field.
    pub(crate) fn add(&mut self, other: &Self) {
        let add = |sums: &mut [Light], values: &[Light]| {
            for (sum, value) in sums.iter_mut().zip(values) {
                add_scaled(sum, value, 1.0);
            }
        };
        add(&mut self.harmonics, &other.harmonics);
        add(&mut self.irradiance, &other.irradiance);
    }
}

/// The last order with all that follow it, as the geometric series that it and the order before begin.
fn with_tail(mut last: Field, before: &Field) -> Field {
    let count = harmonic_count(last.degree);
    for (node, before) in last.harmonics.chunks_mut(count).zip(before.harmonics.chunks(count)) {
        let factor = series(&node[0], &before[0]);
        for light in node {
            *light = std::array::from_fn(|k| light[k] * factor[k]);
        }
    }
    for (light, before) in last.irradiance.iter_mut().zip(&before.irradiance) {
        let factor = series(light, before);
        *light = std::array::from_fn(|k| light[k] * factor[k]);
    }
    last
}

/// 1 / (1 - ratio).
fn series(last: &Light, before: &Light) -> Light {
    std::array::from_fn(|k| {
        let ratio = if before[k] > 0.0 { (last[k] / before[k]).clamp(0.0, LARGEST_RATIO) } else { 0.0 };
        1.0 / (1.0 - ratio)
    })
}

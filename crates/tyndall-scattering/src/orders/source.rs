//! The table that all views of an atmosphere share, whatever the sun.

use std::f64::consts::PI;

use tyndall_core::spectrum::{Spectrum, WAVELENGTH_COUNT};

use super::basis::{azimuth_parts, harmonic_index, zenith_parts};
use super::build::OrderLoop;
use super::field::{DARK, Field, Light, mix};
use super::media::ScatteringMedia;
use super::nishita1996;
use super::nodes::Place;
use super::path::{Path, azimuth_between, widen};
use super::{OrdersMethod, OrdersQuality};
use crate::atmosphere::SCATTERER_COUNT;
use crate::geometry::{Ray, mu_along};
use crate::march::Marcher;
use crate::single_scattering::{RayEnd, ray_end};

/// Diffuse light of all orders at all altitudes for all suns.
#[derive(Clone, Debug)]
pub struct SourceTable {
    media: ScatteringMedia,
    all: Field,
    beyond_first: Vec<Light>,
}

impl SourceTable {
    /// Computes all orders of scattering, or those that the method knows.
    #[must_use]
    pub fn new(marcher: &Marcher, quality: &OrdersQuality) -> Self {
        let orders = OrderLoop::new(marcher, quality);
        if quality.method == OrdersMethod::Nishita1996 {
            let all = nishita1996::first_order(&orders);
            // The ground is lit by the sun and by light scattered once, which is in all.
            return Self { media: orders.media, beyond_first: vec![DARK; all.irradiance.len()], all };
        }
        let first = orders.first();
        let all = orders.sum(&first);
        let pairs = all.irradiance.iter().zip(&first.irradiance);
        let beyond_first = pairs.map(|(all, first)| std::array::from_fn(|k| all[k] - first[k])).collect();
        Self { media: orders.media, all, beyond_first }
    }

    /// The stored light of all orders.
    #[must_use]
    pub fn field(&self) -> &Field {
        &self.all
    }

    /// Irradiance of the sky on horizontal ground at sea level by all orders, without direct sunlight (W/m^2/nm).
    #[must_use]
    pub fn irradiance(&self, mu_sun: f64) -> Spectrum {
        widen(&self.all.irradiance_at(mu_sun))
    }

    /// Mean light around a point (W/m^2/sr/nm), weighted by each medium's phase function towards a ray: altitude (m), zenith
    /// cosines of ray and sun there, cosine between them.
    #[must_use]
    pub fn scattered_at(&self, h_m: f64, (mu, mu_sun): (f64, f64), nu: f64) -> [Spectrum; SCATTERER_COUNT] {
        let field = &self.all;
        let (zenith, azimuth) = (zenith_parts(mu, field.degree), azimuth_parts(azimuth_between(mu, mu_sun, nu)));
        let (altitude, sun) = (field.nodes.altitude_place(h_m), field.nodes.sun_place(mu_sun));
        let mut sums = [[0.0; WAVELENGTH_COUNT]; SCATTERER_COUNT];
        for (sun, to_sun) in sun.ends() {
            for (altitude, to_altitude) in altitude.ends() {
                let harmonics = field.at(sun, altitude);
                for (l, m) in (0..=field.degree).flat_map(|l| (0..=l).map(move |m| (l, m))) {
                    let index = harmonic_index(l, m);
                    let weight = to_sun * to_altitude * zenith[index] * azimuth[m];
                    add_to_media(&mut sums, &self.media, l, &harmonics[index], weight);
                }
            }
        }
        sums
    }

    /// The part of [`SourceTable::irradiance`] that was scattered or reflected at least twice: what is to be added to
    /// [`crate::irradiance_table`].
    #[must_use]
    pub fn irradiance_beyond_first(&self, mu_sun: f64) -> Spectrum {
        let Place { index, fraction } = self.all.nodes.sun_place(mu_sun);
        widen(&mix(&self.beyond_first[index], &self.beyond_first[index + 1], fraction))
    }

    /// [`SourceTable::irradiance_beyond_first`] at the suns of the table.
    pub fn irradiance_beyond_first_nodes(&self) -> impl Iterator<Item = Light> {
        self.beyond_first.iter().copied()
    }
}

/// Adds a harmonic of degree `l` to what each medium scatters.
fn add_to_media(sums: &mut [Spectrum; SCATTERER_COUNT], media: &ScatteringMedia, l: usize, light: &Light, weight: f64) {
    for (sum, moments) in sums.iter_mut().zip(&media.moments) {
        let weight = weight * f64::from(moments[l]);
        for (sum, light) in sum.iter_mut().zip(light) {
            *sum += weight * f64::from(*light);
        }
    }
}

/// Radiance (W/m^2/sr/nm) by light that was scattered into a ray after it had been scattered or reflected before: all
/// that [`crate::single_scattering`] leaves out, but the ground itself. The ray starts inside the atmosphere and ends at
/// `end`.
#[must_use]
pub fn diffuse_scattered(marcher: &Marcher, source: &SourceTable, ray: &Ray, end: RayEnd) -> Spectrum {
    let path = Path::new(marcher, &source.media, &source.all, (ray.h_m, ray.mu, end), marcher.panels);
    widen(&path.gather_once(&source.all, ray))
}

/// Radiance (W/m^2/sr/nm) by the tables: what was scattered or reflected once, and all else. The ray starts inside the
/// atmosphere and ends at `end`; ground there is seen in the light of sun and sky.
#[must_use]
pub fn radiance_by_order(marcher: &Marcher, source: &SourceTable, ray: &Ray, end: RayEnd) -> [Spectrum; 2] {
    let parts = marcher.scattered_parts_to(ray, end.length_m);
    let phases = marcher.atmosphere.phases(ray.nu);
    let path = Path::new(marcher, &source.media, &source.all, (ray.h_m, ray.mu, end), marcher.panels);
    let mut first: Spectrum =
        std::array::from_fn(|k| parts.iter().zip(phases).map(|(part, phase)| phase * part[k]).sum());
    let mut beyond = widen(&path.gather_once(&source.all, ray));
    if let Some(end) = path.ground {
        let radius_m = marcher.atmosphere.planet_radius_m;
        let mu_sun = mu_along(radius_m, ray.h_m, ray.mu_sun, ray.nu, end.length_m, 0.0);
        let (sun, sky) = (marcher.sun_on_ground(mu_sun), source.irradiance(mu_sun));
        for k in 0..WAVELENGTH_COUNT {
            let reflected = marcher.coefficients.ground_albedo[k] / PI * end.transmittance[k];
            first[k] += reflected * sun[k];
            beyond[k] += reflected * sky[k];
        }
    }
    [first, beyond]
}

/// Radiance (W/m^2/sr/nm) of everything that [`crate::single_scattering::single_scattering`] leaves out: diffuse light
/// scattered into the ray, and diffuse light that the ground reflects behind the air in front of it. The sum of the two
/// is the radiance by all orders.
#[must_use]
pub fn diffuse_radiance(marcher: &Marcher, source: &SourceTable, ray: &Ray) -> Spectrum {
    let end = ray_end(&marcher.atmosphere, ray.h_m, ray.mu);
    let path = Path::new(marcher, &source.media, &source.all, (ray.h_m, ray.mu, end), marcher.panels);
    let scattered = widen(&path.gather_once(&source.all, ray));
    let Some(end) = path.ground else { return scattered };
    let radius_m = marcher.atmosphere.planet_radius_m;
    let irradiance = source.irradiance(mu_along(radius_m, ray.h_m, ray.mu_sun, ray.nu, end.length_m, 0.0));
    let ground = |k: usize| marcher.coefficients.ground_albedo[k] / PI * end.transmittance[k] * irradiance[k];
    std::array::from_fn::<f64, WAVELENGTH_COUNT, _>(|k| scattered[k] + ground(k))
}

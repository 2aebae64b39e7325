//! A ray as the list of places where diffuse light is scattered into it. It does not depend on the sun.

use tyndall_core::spectrum::Spectrum;

use super::basis::{MAX_DEGREE, azimuth_parts, zenith_parts};
use super::field::{DARK, Field, Light, ScatteringPlace, add_scaled};
use super::media::ScatteringMedia;
use super::nodes::{Nodes, Place};
use crate::atmosphere::{MEDIUM_COUNT, SCATTERER_COUNT, SCATTERERS};
use crate::geometry::{Ray, altitude_along, mu_along};
use crate::march::Marcher;
use crate::march_path::PathMap;
use crate::optical_length::Columns;
use crate::quadrature::{NODES, RUNNING, WEIGHTS};
use crate::single_scattering::RayEnd;

/// Nodes of the quadrature along a ray, and where it ends.
#[derive(Clone, Debug)]
pub(crate) struct Path {
    radius_m: f64,
    h_m: f64,
    places: Vec<PathPlace>,
    /// Where the ray meets the ground, if it does.
    pub(crate) ground: Option<GroundEnd>,
}

#[derive(Clone, Debug)]
struct PathPlace {
    t_m: f64,
    altitude_m: f64,
    mu: f64,
    scattering: ScatteringPlace,
}

/// The end of a ray on the ground.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GroundEnd {
    pub(crate) length_m: f64,
    /// Of the air in front of it.
    pub(crate) transmittance: Spectrum,
}

impl Path {
    /// A ray from altitude `h_m` with zenith cosine `mu` to its end, in about `panels` panels of four nodes.
    pub(crate) fn new(
        marcher: &Marcher,
        media: &ScatteringMedia,
        field: &Field,
        (h_m, mu, end): (f64, f64, RayEnd),
        panels: usize,
    ) -> Self {
        let radius_m = marcher.atmosphere.planet_radius_m;
        let map = PathMap::without_shadow(radius_m, marcher.columns.haze(), (h_m, mu), end.length_m);
        let mut path = Self { radius_m, h_m, places: Vec::with_capacity(4 * panels + 4), ground: None };
        let mut columns = [0.0; MEDIUM_COUNT];
        map.for_each_panel(panels, |x0, width| {
            path.add_panel((marcher, media, field), &map, mu, (x0, width), &mut columns);
        });
        path.ground = end
            .on_ground
            .then(|| GroundEnd { length_m: end.length_m, transmittance: marcher.coefficients.transmittance(&columns) });
        path
    }

    fn add_panel(
        &mut self,
        (marcher, media, field): (&Marcher, &ScatteringMedia, &Field),
        map: &PathMap,
        mu: f64,
        (x0, width): (f64, f64),
        columns: &mut Columns,
    ) {
        let nodes = NODES.map(|node| {
            let (t_m, speed_m) = map.position(x0 + node * width);
            (t_m, altitude_along(self.radius_m, self.h_m, mu, t_m).max(0.0), speed_m * width)
        });
        let steps: [Columns; 4] = nodes.map(|(_, altitude_m, step_m)| {
            marcher.atmosphere.media.each_ref().map(|medium| medium.profile.density(altitude_m) * step_m)
        });
        for (i, (t_m, altitude_m, _)) in nodes.into_iter().enumerate() {
            let view: Columns =
                std::array::from_fn(|m| columns[m] + (0..4).map(|j| RUNNING[i][j] * steps[j][m]).sum::<f64>());
            let transmittance = marcher.coefficients.transmittance(&view);
            let mu = mu_along(self.radius_m, self.h_m, mu, 1.0, t_m, altitude_m);
            let steps = SCATTERERS.map(|medium| WEIGHTS[i] * steps[i][medium]);
            let scattering = ScatteringPlace {
                altitude: field.nodes.altitude_place(altitude_m),
                zenith: narrow(zenith_parts(mu, field.degree)),
                weights: degree_weights(media, steps, &transmittance),
            };
            self.places.push(PathPlace { t_m, altitude_m, mu, scattering });
        }
        for (m, column) in columns.iter_mut().enumerate() {
            *column += (0..4).map(|j| WEIGHTS[j] * steps[j][m]).sum::<f64>();
        }
    }

    /// What the field scatters into the ray for every sun node: place, sun, then m (fastest).
    pub(crate) fn contract(&self, field: &Field) -> Vec<[Light; MAX_DEGREE + 1]> {
        let suns = 0..field.nodes.sun_count();
        let places = self.places.iter();
        places.flat_map(|place| suns.clone().map(|sun| field.scattered(&place.scattering, sun))).collect()
    }

    /// Light scattered into the ray, from the contracted field.
    pub(crate) fn gather(&self, nodes: &Nodes, contracted: &[[Light; MAX_DEGREE + 1]], ray: &Ray) -> Light {
        let mut sum = DARK;
        for (place, suns) in self.places.iter().zip(contracted.chunks(nodes.sun_count())) {
            let (Place { index, fraction }, azimuth) = self.sun_at(nodes, place, ray);
            add_azimuths(&mut sum, &suns[index], &azimuth, 1.0 - fraction);
            add_azimuths(&mut sum, &suns[index + 1], &azimuth, fraction);
        }
        sum
    }

    /// Light scattered into the ray, straight from the field: for one ray only.
    pub(crate) fn gather_once(&self, field: &Field, ray: &Ray) -> Light {
        let mut sum = DARK;
        for place in &self.places {
            let (Place { index, fraction }, azimuth) = self.sun_at(&field.nodes, place, ray);
            add_azimuths(&mut sum, &field.scattered(&place.scattering, index), &azimuth, 1.0 - fraction);
            add_azimuths(&mut sum, &field.scattered(&place.scattering, index + 1), &azimuth, fraction);
        }
        sum
    }

    /// The sun at a place of the ray: among the nodes, and cos(m phi) of the azimuth between ray and sun.
    fn sun_at(&self, nodes: &Nodes, place: &PathPlace, ray: &Ray) -> (Place, [f64; MAX_DEGREE + 1]) {
        let mu_sun = mu_along(self.radius_m, self.h_m, ray.mu_sun, ray.nu, place.t_m, place.altitude_m);
        (nodes.sun_place(mu_sun), azimuth_parts(azimuth_between(place.mu, mu_sun, ray.nu)))
    }
}

/// Cosine of the azimuth between two directions of zenith cosines `mu` and `mu_sun` and cosine `nu` between them.
pub(crate) fn azimuth_between(mu: f64, mu_sun: f64, nu: f64) -> f64 {
    // With one of the two in the zenith any azimuth will do: the harmonics with m > 0 vanish there.
    let sines = ((1.0 - mu * mu) * (1.0 - mu_sun * mu_sun)).max(1e-12).sqrt();
    ((nu - mu * mu_sun) / sines).clamp(-1.0, 1.0)
}

#[expect(clippy::cast_possible_truncation, reason = "tables are f32")]
fn add_azimuths(sum: &mut Light, parts: &[Light; MAX_DEGREE + 1], azimuth: &[f64; MAX_DEGREE + 1], weight: f64) {
    for (part, cosine) in parts.iter().zip(azimuth) {
        add_scaled(sum, part, (cosine * weight) as f32);
    }
}

/// Sum over media of `chi_l` times scattering coefficient, steps (m) of density 1 and transmittance, for each degree l.
#[expect(clippy::cast_possible_truncation, reason = "tables are f32")]
fn degree_weights(
    media: &ScatteringMedia,
    steps_m: [f64; SCATTERER_COUNT],
    transmittance: &Spectrum,
) -> [Light; MAX_DEGREE + 1] {
    std::array::from_fn(|l| {
        std::array::from_fn(|k| {
            let scattered =
                |medium: usize| media.moments[medium][l] * media.scattering_per_m[medium][k] * steps_m[medium] as f32;
            (0..SCATTERER_COUNT).map(scattered).sum::<f32>() * transmittance[k] as f32
        })
    })
}

/// f32 of f64.
#[expect(clippy::cast_possible_truncation, reason = "tables are f32")]
pub(crate) fn narrow<const N: usize>(values: [f64; N]) -> [f32; N] {
    values.map(|value| value as f32)
}

/// f64 of f32.
pub(crate) fn widen(light: &Light) -> Spectrum {
    light.map(f64::from)
}

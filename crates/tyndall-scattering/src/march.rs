//! The fast quadrature of equation (1) that fills the tables, at the eight wavelengths.
//!
//! Same integral as [`crate::single_scattering`], with the columns towards the sun from the [`ColumnTable`] and few
//! nodes: the panels of `march_path`. The column from the observer comes from the same four densities through the Gauss running integral.
//! Eight panels (32 nodes) stay within 0.3 % of the exact integral. WGSL: `shaders/sky/march.wgsl`.

use tyndall_core::spectrum::{Spectrum, WAVELENGTH_COUNT};

use crate::atmosphere::{Coefficients, MEDIUM_COUNT, SCATTERER_COUNT, SCATTERERS};
use crate::column_table::ColumnTable;
use crate::geometry::{Ray, altitude_along, mu_along};
use crate::march_path::PathMap;
use crate::optical_length::Columns;
use crate::quadrature::{NODES, RUNNING, WEIGHTS};
use crate::single_scattering::ray_end;
use crate::{Atmosphere, ScatteringError};

/// An atmosphere with its columns, ready to march.
#[derive(Clone, Debug)]
pub struct Marcher {
    /// The atmosphere at the eight wavelengths.
    pub atmosphere: Atmosphere,
    /// Its coefficients.
    pub coefficients: Coefficients,
    /// Its columns.
    pub columns: ColumnTable,
    /// Panels of four nodes along a whole ray.
    pub panels: usize,
}

impl Marcher {
    /// Prepares an atmosphere; `panels` from 2 to 16.
    ///
    /// # Errors
    /// When the atmosphere does not have the eight wavelengths of the tables.
    pub fn new(atmosphere: Atmosphere, panels: usize) -> Result<Self, ScatteringError> {
        let coefficients = atmosphere.coefficients()?;
        let columns = ColumnTable::new(&atmosphere);
        Ok(Self { atmosphere, coefficients, columns, panels })
    }

    /// Light scattered once towards the observer along the whole ray, before the phase functions (W/m^2/nm): by each
    /// scatterer. The ray starts inside the atmosphere.
    #[must_use]
    pub fn scattered_parts(&self, ray: &Ray) -> [Spectrum; SCATTERER_COUNT] {
        self.scattered_parts_to(ray, ray_end(&self.atmosphere, ray.h_m, ray.mu).length_m)
    }

    /// As [`Marcher::scattered_parts`], up to a distance.
    #[must_use]
    pub fn scattered_parts_to(&self, ray: &Ray, length_m: f64) -> [Spectrum; SCATTERER_COUNT] {
        let path = PathMap::new(self.atmosphere.planet_radius_m, self.columns.haze(), ray, length_m);
        let mut sum = Sum { columns: [0.0; MEDIUM_COUNT], parts: [[0.0; WAVELENGTH_COUNT]; SCATTERER_COUNT] };
        path.for_each_panel(self.panels, |x, width| {
            let lit = !path.is_shadowed(x + 0.5 * width);
            self.add_panel(ray, &path, (x, width), lit, &mut sum);
        });
        sum.parts
    }

    /// Irradiance of the sun on horizontal ground at sea level (W/m^2/nm); none while its centre is below the horizon.
    #[must_use]
    pub fn sun_on_ground(&self, mu_sun: f64) -> Spectrum {
        if mu_sun <= 0.0 {
            return [0.0; WAVELENGTH_COUNT];
        }
        let transmittance = self.coefficients.transmittance(&self.columns.lookup(0.0, mu_sun));
        std::array::from_fn(|k| transmittance[k] * mu_sun * self.coefficients.solar_irradiance_w_m2_nm[k])
    }

    fn add_panel(&self, ray: &Ray, path: &PathMap, (x0, width): (f64, f64), lit: bool, sum: &mut Sum) {
        let radius_m = self.atmosphere.planet_radius_m;
        let nodes = NODES.map(|node| {
            let (t_m, speed_m) = path.position(x0 + node * width);
            (t_m, altitude_along(radius_m, ray.h_m, ray.mu, t_m).max(0.0), speed_m * width)
        });
        let densities: [Columns; 4] = nodes.map(|(_, altitude_m, step_m)| {
            self.atmosphere.media.each_ref().map(|medium| medium.profile.density(altitude_m) * step_m)
        });
        if lit {
            for i in 0..4 {
                let (t_m, altitude_m, _) = nodes[i];
                let mu_sun = mu_along(radius_m, ray.h_m, ray.mu_sun, ray.nu, t_m, altitude_m);
                let sun = self.columns.lookup(altitude_m, mu_sun);
                let path: Columns = std::array::from_fn(|m| {
                    sum.columns[m] + sun[m] + (0..4).map(|j| RUNNING[i][j] * densities[j][m]).sum::<f64>()
                });
                let lit_densities = SCATTERERS.map(|medium| WEIGHTS[i] * densities[i][medium]);
                self.add_light(&self.coefficients.transmittance(&path), lit_densities, &mut sum.parts);
            }
        }
        for (m, column) in sum.columns.iter_mut().enumerate() {
            *column += (0..4).map(|j| WEIGHTS[j] * densities[j][m]).sum::<f64>();
        }
    }

    fn add_light(
        &self,
        transmittance: &Spectrum,
        densities_m: [f64; SCATTERER_COUNT],
        parts: &mut [Spectrum; SCATTERER_COUNT],
    ) {
        for (medium, part) in parts.iter_mut().enumerate() {
            for (k, value) in part.iter_mut().enumerate() {
                *value += densities_m[medium] * self.coefficients.source_w_m3_nm[medium][k] * transmittance[k];
            }
        }
    }
}

/// What a march has collected.
struct Sum {
    columns: Columns,
    parts: [Spectrum; SCATTERER_COUNT],
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::haze::HazeParams;
    use crate::params::{AtmosphereParams, GroundParams};
    use crate::single_scattering::scattered_parts;

    /// Fogs and hazes: visibility (km), top (m), scale height above (m).
    const HAZES: [(f64, f64, f64); 7] = [
        (0.1, 150.0, 60.0),
        (0.1, 0.0, 100.0),
        (0.3, 400.0, 20.0),
        (1.0, 150.0, 60.0),
        (5.0, 0.0, 300.0),
        (20.0, 1500.0, 500.0),
        (50.0, 500.0, 200.0),
    ];

    #[test]
    fn the_march_through_fog_equals_the_exact_integral_within_one_per_cent() {
        let black = GroundParams { red: 0.0, green: 0.0, blue: 0.0, ..GroundParams::default() };
        let clear = Atmosphere::new(&AtmosphereParams::default(), &black);
        for (visibility_km, top_m, scale_height_m) in HAZES {
            let params = HazeParams { enabled: true, visibility_km, top_m, scale_height_m, ..HazeParams::default() };
            let marcher = Marcher::new(clear.clone().with_haze(&params), 8).expect("eight wavelengths");
            let mut worst = 0.0_f64;
            for ray in rays() {
                let error = error_of_the_march(&marcher, &ray);
                assert!(error < 0.01, "{params:?} {ray:?}: {error:.1e}");
                worst = worst.max(error);
            }
            println!("march in haze of {visibility_km} km, {top_m} m + {scale_height_m} m: worst {worst:.1e}");
        }
    }

    fn rays() -> impl Iterator<Item = Ray> {
        let views = [0.0_f64, 50.0, 80.0, 88.0, 89.7, 90.5, 95.0, 130.0];
        let places = [2.0, 100.0, 800.0].into_iter().flat_map(move |h_m| views.map(|view| (h_m, view)));
        places.flat_map(|(h_m, view)| {
            [10.0_f64, 60.0, 85.0].map(|sun| Ray::from_angles(h_m, view.to_radians(), sun.to_radians(), 0.8))
        })
    }

    /// Largest relative error of three wavelengths.
    fn error_of_the_march(marcher: &Marcher, ray: &Ray) -> f64 {
        let length_m = ray_end(&marcher.atmosphere, ray.h_m, ray.mu).length_m;
        let (want, got) = (scattered_parts(&marcher.atmosphere, ray, length_m), marcher.scattered_parts(ray));
        let phases = marcher.atmosphere.phases(ray.nu);
        let sum = |values: [f64; SCATTERER_COUNT]| values.iter().zip(phases).map(|(v, phase)| v * phase).sum::<f64>();
        let error = |k: usize| {
            let want = sum(std::array::from_fn(|part| want[part][k]));
            // Light below 1e-4 of a day's sky cannot be seen in it: multiple scattering fills it.
            (sum(std::array::from_fn(|part| got[part][k])) - want).abs() / want.max(1e-5)
        };
        [0, 3, 7].map(error).into_iter().fold(0.0, f64::max)
    }
}

//! The fast quadrature of equation (1) that fills the tables, at the eight wavelengths.
//!
//! Same integral as [`crate::single_scattering`], with the columns towards the sun from the [`ColumnTable`] and few
//! nodes: panels of four Gauss nodes in a variable x in which t = `t_low` + x |x| s, dense at the lowest point of the ray,
//! broken at the lowest point and where the ray enters and leaves the earth's shadow, because a step inside a panel would
//! cost its order. The column from the observer comes from the same four densities through the Gauss running integral.
//! Eight panels (32 nodes) stay within 0.3 % of the exact integral. WGSL: `shaders/sky/march.wgsl`.

use tyndall_core::spectrum::{Spectrum, WAVELENGTH_COUNT};

use crate::atmosphere::{Coefficients, MEDIUM_COUNT, SCATTERER_COUNT, SCATTERERS};
use crate::column_table::ColumnTable;
use crate::geometry::{Ray, altitude_along, mu_along, shadow_interval};
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
        let path = PathMap::new(self.atmosphere.planet_radius_m, ray, length_m);
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

/// The variable x of a ray: t = lowest + x |x| times the distance to the ray's start (x < 0) or end (x > 0).
pub(crate) struct PathMap {
    lowest_m: f64,
    length_m: f64,
    shadow: [f64; 2],
    /// Start, shadow edges, lowest point and end in x, ascending.
    breaks: [f64; Self::BREAKS],
}

impl PathMap {
    const BREAKS: usize = 5;

    fn new(radius_m: f64, ray: &Ray, length_m: f64) -> Self {
        let mut map = Self::without_shadow(radius_m, (ray.h_m, ray.mu), length_m);
        if let Some((start_m, end_m)) = shadow_interval(radius_m, ray, length_m) {
            map.shadow = [start_m, end_m].map(|t_m| map.variable(t_m));
        }
        let [start, .., end] = map.breaks;
        let [enter, leave] = map.shadow.map(|x: f64| x.clamp(start, end));
        map.breaks[1..4].copy_from_slice(&[enter, leave, 0.0_f64.clamp(start, end)]);
        map.breaks[1..4].sort_by(f64::total_cmp);
        map
    }

    /// The map of a ray from altitude `h_m` with zenith cosine `mu`, broken at its lowest point alone.
    pub(crate) fn without_shadow(radius_m: f64, (h_m, mu): (f64, f64), length_m: f64) -> Self {
        let lowest_m = (-(radius_m + h_m) * mu).clamp(0.0, length_m);
        let start = if lowest_m > 0.0 { -1.0 } else { 0.0 };
        let end = if length_m > lowest_m { 1.0 } else { 0.0 };
        let lowest = 0.0_f64.clamp(start, end);
        Self { lowest_m, length_m, shadow: [2.0, 2.0], breaks: [start, lowest, lowest, lowest, end] }
    }

    /// Calls `visit` with the start and the width of each panel from the start of the ray on, about `panels` in all.
    pub(crate) fn for_each_panel(&self, panels: usize, mut visit: impl FnMut(f64, f64)) {
        for piece in self.breaks.windows(2) {
            let [from, to] = [piece[0], piece[1]];
            if to <= from {
                continue;
            }
            let count = (panels as f64 * self.share(from, to)).ceil().max(1.0);
            let width = (to - from) / count;
            let mut x = from;
            while x < to - 0.5 * width {
                visit(x, width);
                x += width;
            }
        }
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

    fn is_shadowed(&self, x: f64) -> bool {
        self.shadow[0] < x && x < self.shadow[1]
    }
}

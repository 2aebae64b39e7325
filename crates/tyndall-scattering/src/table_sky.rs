//! The sky by the tables at any number of wavelengths.
//!
//! Tables and marches carry eight wavelengths; longer lists are computed in groups of eight that share the column table.
//! This is the arithmetic of the pictures (column table, march, all orders) without their last step, the interpolation over
//! directions. Cost: the column table (0.1 s), 0.7 s a group at [`OrdersQuality::best`], then 20 microseconds a group and
//! direction.

use tyndall_core::spectrum::WAVELENGTH_COUNT;

use crate::column_table::ColumnTable;
use crate::geometry::{Ray, enter_atmosphere};
use crate::march::Marcher;
use crate::medium::Medium;
use crate::orders::{OrdersQuality, SourceTable, radiance_by_order};
use crate::single_scattering::{RayEnd, ray_end};
use crate::{Atmosphere, ScatteringError};

/// Panels of four nodes along each ray, as in the pictures.
const PANELS: usize = 8;

/// The tables of one atmosphere for all suns.
#[derive(Clone, Debug)]
pub struct TableSky {
    atmosphere: Atmosphere,
    groups: Vec<(Marcher, SourceTable)>,
}

/// Radiance in one direction (W/m^2/sr/nm), one value per wavelength.
#[derive(Clone, Debug, PartialEq)]
pub struct SkyRadiance {
    /// By all orders.
    pub all: Vec<f64>,
    /// The part that was scattered or reflected once.
    pub single: Vec<f64>,
}

impl TableSky {
    /// Builds the tables.
    ///
    /// # Errors
    /// When the atmosphere has no wavelength.
    pub fn new(atmosphere: &Atmosphere, quality: &OrdersQuality) -> Result<Self, ScatteringError> {
        let count = atmosphere.wavelengths_nm.len();
        if count == 0 {
            return Err(ScatteringError::WavelengthCount { count, expected: WAVELENGTH_COUNT });
        }
        let columns = ColumnTable::new(atmosphere);
        let firsts = (0..count).step_by(WAVELENGTH_COUNT);
        let groups = firsts.map(|first| {
            let group = eight_wavelengths(atmosphere, first);
            let coefficients = group.coefficients()?;
            let marcher = Marcher { atmosphere: group, coefficients, columns: columns.clone(), panels: PANELS };
            let source = SourceTable::new(&marcher, quality);
            Ok((marcher, source))
        });
        Ok(Self { atmosphere: atmosphere.clone(), groups: groups.collect::<Result<_, ScatteringError>>()? })
    }

    /// The atmosphere with all its wavelengths.
    #[must_use]
    pub fn atmosphere(&self) -> &Atmosphere {
        &self.atmosphere
    }

    /// Radiance along a ray from any altitude, up to `stop_m` (m, from where the ray enters the atmosphere) if given: then
    /// what lies behind is left out, ground included.
    #[must_use]
    pub fn radiance(&self, ray: &Ray, stop_m: Option<f64>) -> SkyRadiance {
        let Atmosphere { planet_radius_m, top_altitude_m, .. } = self.atmosphere;
        let count = self.atmosphere.wavelengths_nm.len();
        let Some((ray, _)) = enter_atmosphere(planet_radius_m, top_altitude_m, ray) else {
            return SkyRadiance { all: vec![0.0; count], single: vec![0.0; count] };
        };
        let end = ray_end(&self.atmosphere, ray.h_m, ray.mu);
        let stopped = stop_m.filter(|stop_m| *stop_m < end.length_m);
        let end = stopped.map_or(end, |length_m| RayEnd { length_m, on_ground: false });
        let (mut all, mut single) = (Vec::with_capacity(count + WAVELENGTH_COUNT), Vec::with_capacity(count));
        for (marcher, source) in &self.groups {
            let [first, beyond] = radiance_by_order(marcher, source, &ray, end);
            single.extend(first);
            all.extend(first.iter().zip(beyond).map(|(first, beyond)| first + beyond));
        }
        all.truncate(count);
        single.truncate(count);
        SkyRadiance { all, single }
    }

    /// Irradiance of the sky (W/m^2/nm) on horizontal ground at sea level by all orders, without direct sunlight.
    #[must_use]
    pub fn irradiance(&self, mu_sun: f64) -> Vec<f64> {
        let groups = self.groups.iter().flat_map(|(_, source)| source.irradiance(mu_sun));
        groups.take(self.atmosphere.wavelengths_nm.len()).collect()
    }
}

/// The atmosphere at eight wavelengths from `first` on; the last one is repeated where there are fewer.
fn eight_wavelengths(atmosphere: &Atmosphere, first: usize) -> Atmosphere {
    let last = atmosphere.wavelengths_nm.len() - 1;
    let pick = |values: &[f64]| (first..first + WAVELENGTH_COUNT).map(|k| values[k.min(last)]).collect::<Vec<_>>();
    let mut group = atmosphere.clone();
    group.wavelengths_nm = pick(&atmosphere.wavelengths_nm);
    group.solar_irradiance_w_m2_nm = pick(&atmosphere.solar_irradiance_w_m2_nm);
    group.ground_albedo = pick(&atmosphere.ground_albedo);
    group.media = atmosphere.media.each_ref().map(|medium| Medium {
        scattering_per_m: pick(&medium.scattering_per_m),
        absorption_per_m: pick(&medium.absorption_per_m),
        ..medium.clone()
    });
    group
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::{AtmosphereParams, GroundParams};
    use crate::single_scattering::single_scattering;

    fn quality() -> OrdersQuality {
        OrdersQuality { altitudes: 8, suns_above: 8, suns_below: 8, ..OrdersQuality::preview() }
    }

    #[test]
    fn a_wavelength_has_the_same_light_in_any_group() {
        let eight = Atmosphere::new(&AtmosphereParams::default(), &GroundParams::default());
        // Eleven wavelengths: two groups, the second one padded.
        let order = [7, 0, 1, 2, 3, 4, 5, 6, 5, 2, 0];
        let mut eleven = eight.clone();
        let pick = |values: &[f64]| order.map(|k: usize| values[k]).to_vec();
        eleven.wavelengths_nm = pick(&eight.wavelengths_nm);
        eleven.solar_irradiance_w_m2_nm = pick(&eight.solar_irradiance_w_m2_nm);
        eleven.ground_albedo = pick(&eight.ground_albedo);
        for (to, from) in eleven.media.iter_mut().zip(&eight.media) {
            to.scattering_per_m = pick(&from.scattering_per_m);
            to.absorption_per_m = pick(&from.absorption_per_m);
        }
        let [short, long] = [&eight, &eleven].map(|a| TableSky::new(a, &quality()).expect("wavelengths"));
        let ray = Ray::from_angles(2.0, 1.2, 1.0, 0.4);
        let (want, got) = (short.radiance(&ray, None), long.radiance(&ray, None));
        assert_eq!(got.all.len(), 11, "one value per wavelength");
        for (k, from) in order.into_iter().enumerate() {
            assert!((got.all[k] / want.all[from] - 1.0).abs() < 1e-6, "{k}: {} {}", got.all[k], want.all[from]);
        }
        assert_eq!(long.irradiance(0.5).len(), 11, "one value per wavelength");
    }

    #[test]
    fn the_single_part_is_the_exact_integral_for_sky_ground_and_space() {
        let atmosphere = Atmosphere::new(&AtmosphereParams::default(), &GroundParams::default());
        let sky = TableSky::new(&atmosphere, &quality()).expect("wavelengths");
        for (h_m, view) in [(2.0, 1.2), (2.0, 1.7), (9e3, 1.6), (99e3, 2.5)] {
            let ray = Ray::from_angles(h_m, view, 1.0, 0.4);
            let want = single_scattering(&atmosphere, &ray);
            let got = sky.radiance(&ray, None).single;
            for (got, want) in got.iter().zip(&want) {
                assert!((got / want - 1.0).abs() < 4e-3, "altitude {h_m} view {view}: {got} {want}");
            }
        }
        let away = sky.radiance(&Ray::from_angles(400e3, 1.0, 0.5, 0.0), None);
        assert!(away.all.iter().all(|value| *value == 0.0), "a ray that misses the atmosphere is black");
    }
}

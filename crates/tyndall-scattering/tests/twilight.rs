//! The zenith through the whole twilight.

use std::f64::consts::FRAC_PI_2;

use tyndall_core::spectrum::luminance_from_rec709;
use tyndall_scattering::Atmosphere;
use tyndall_scattering::march::Marcher;
use tyndall_scattering::orders::{OrdersQuality, SourceTable};
use tyndall_scattering::params::{AtmosphereParams, GroundParams};
use tyndall_scattering::sky_view_table::SkyViewTable;

const EYE_M: f64 = 2.0;

/// Luminance (cd/m^2) of the zenith; the smallest table has a texel there.
fn zenith(marcher: &Marcher, source: &SourceTable, sun_deg: f64) -> f64 {
    let mu_sun = sun_deg.to_radians().sin();
    let table = SkyViewTable::new(marcher, EYE_M, mu_sun, [8, 32]);
    let table = table.with_orders((marcher, source), (EYE_M, mu_sun), [8, 16]);
    luminance_from_rec709(table.radiance(marcher, FRAC_PI_2, 0.0, mu_sun))
}

#[test]
fn the_zenith_darkens_steadily_from_sunset_to_the_end_of_twilight() {
    let atmosphere = Atmosphere::new(&AtmosphereParams::default(), &GroundParams::default());
    let marcher = Marcher::new(atmosphere, 8).expect("eight wavelengths");
    for (name, quality) in [("best", OrdersQuality::best()), ("preview", OrdersQuality::preview())] {
        let source = SourceTable::new(&marcher, &quality);
        let sweep: Vec<f64> = (0..=180).map(|i| zenith(&marcher, &source, -0.1 * f64::from(i))).collect();
        for (i, pair) in sweep.windows(2).enumerate() {
            let fall = 1.0 - pair[1] / pair[0];
            // The light itself falls by 11 % in a tenth of a degree where it falls fastest, 6 degrees down.
            assert!(fall > 0.0 && fall < 0.15, "{name}, from -{:.1} deg: {fall}", 0.1 * i as f64);
        }
        println!("{name}: zenith {:.0} cd/m^2, {:.2e} at -6, {:.2e} at -12 deg", sweep[0], sweep[60], sweep[120]);
        println!("{name}: {:.2e} cd/m^2 at -18 deg", sweep[180]);
    }
}

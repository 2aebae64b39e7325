//! The tables seen from high altitudes and from space, against random walks.

use tyndall_scattering::atmosphere_file::parse_atmosphere;
use tyndall_scattering::geometry::Ray;
use tyndall_scattering::monte_carlo::{MonteCarlo, Sampling};
use tyndall_scattering::orders::OrdersQuality;
use tyndall_scattering::table_sky::TableSky;

const RADIUS_M: f64 = 6.36e6;

/// Zenith angle (deg) of a ray from `h_m` that passes the planet at `tangent_m`.
fn limb_deg(h_m: f64, tangent_m: f64) -> f64 {
    180.0 - ((RADIUS_M + tangent_m) / (RADIUS_M + h_m)).asin().to_degrees()
}

#[test]
fn the_tables_are_right_from_ten_kilometres_and_from_space() {
    let atmosphere = parse_atmosphere(include_str!("data/atmosphere_csm8.txt")).expect("a valid file");
    let tables = TableSky::new(&atmosphere, &OrdersQuality::best()).expect("eight wavelengths");
    let model = MonteCarlo::new(&atmosphere);
    let limb = [5e3, 20e3, 45e3].map(|tangent_m| (400e3, limb_deg(400e3, tangent_m), 0.05));
    let down = [180.0, 150.0, 125.0].map(|view_deg| (400e3, view_deg, 0.02));
    let high = [20.0, 88.0, 91.0, 93.0].map(|view_deg| (10e3, view_deg, 0.03));
    let views = down.into_iter().chain(limb).chain(high);
    let mut direction = 0;
    for (h_m, view_deg, allowed) in views {
        for sun_deg in [30.0_f64, 75.0] {
            let ray = Ray::from_angles(h_m, f64::to_radians(view_deg), sun_deg.to_radians(), 1.0);
            let want = model.radiance(&ray, None, Sampling { paths: 4096, seed: 1, direction });
            let got = tables.radiance(&ray, None).all;
            // All wavelengths together, in which the noise is least.
            let sum = |values: &[f64]| values.iter().sum::<f64>();
            let (error, noise) = (sum(&got) / sum(&want.mean) - 1.0, sum(&want.standard_error) / sum(&want.mean));
            println!("{h_m} m, view {view_deg:.2}, sun {sun_deg}: {:+.2} +- {:.2} %", 100.0 * error, 100.0 * noise);
            assert!(error.abs() < allowed + 3.0 * noise, "{h_m} m, view {view_deg}, sun {sun_deg}: {error} +- {noise}");
            direction += 1;
        }
    }
}

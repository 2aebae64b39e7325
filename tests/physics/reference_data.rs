//! The exact integral of equation (1) against quadratures and Monte-Carlo results that other programs made.

use std::path::Path;

use tyndall_scattering::Atmosphere;
use tyndall_scattering::atmosphere_file::parse_atmosphere;
use tyndall_scattering::geometry::Ray;
use tyndall_scattering::single_scattering::single_scattering;
use tyndall_tests::shared_data;

use crate::table::data_rows;

const ATMOSPHERE: &str = include_str!("../data/atmosphere_csm8.txt");
const ROWS: &str = include_str!("../data/single_scattering_csm8.csv");

/// The observer of the data stands this far above the ground.
const EYE_M: f64 = 1e-3;

/// CIE 1931 2-degree luminosity at 360 to 818.25 nm in steps of 11.75 nm, as the data's README defines its luminance.
const LUMINOSITY: [f64; 40] = [
    3.9170e-6, 1.5140e-5, 5.4383e-5, 2.2448e-4, 8.2550e-4, 3.4242e-3, 1.2087e-2, 2.5947e-2, 4.5843e-2, 7.6237e-2,
    1.2533e-1, 2.0157e-1, 3.3840e-1, 5.6040e-1, 7.8552e-1, 9.2582e-1, 9.9031e-1, 9.9547e-1, 9.4197e-1, 8.3586e-1,
    6.9490e-1, 5.4434e-1, 3.9903e-1, 2.6244e-1, 1.5965e-1, 8.7479e-2, 4.3169e-2, 2.0196e-2, 8.8462e-3, 3.9043e-3,
    1.7641e-3, 7.7993e-4, 3.3538e-4, 1.4088e-4, 6.2151e-5, 2.7522e-5, 1.2178e-5, 5.3532e-6, 2.3489e-6, 1.0303e-6,
];

fn spectrum(atmosphere: &Atmosphere, row: &[f64]) -> Vec<f64> {
    let [sun, view, azimuth] = [row[0], row[1], row[2]].map(f64::to_radians);
    single_scattering(atmosphere, &Ray::from_angles(EYE_M, view, sun, azimuth))
}

#[test]
fn single_scattering_equals_an_independent_quadrature_for_every_sun_from_zenith_to_horizon() {
    let atmosphere = parse_atmosphere(ATMOSPHERE).expect("the committed atmosphere is valid");
    let (mut worst, mut rows) = (0.0_f64, 0);
    for row in data_rows(ROWS) {
        let got = spectrum(&atmosphere, &row);
        let strongest = row[3..].iter().copied().fold(0.0, f64::max);
        for (got, want) in got.iter().zip(&row[3..]) {
            // Relative to the direction's strongest wavelength; the target of the single-scattering mode is 0.3 %.
            let error = (got - want).abs() / strongest;
            assert!(error < 3e-3, "{:?}: {got} {want} ({error:.1e})", &row[..3]);
            worst = worst.max(error);
        }
        rows += 1;
    }
    assert_eq!(rows, 203, "every row of the data was read");
    println!("single scattering against an independent quadrature, {rows} directions: worst {:.2} %", worst * 100.0);
}

#[test]
fn the_luminance_of_the_single_scattered_part_is_the_monte_carlo_tables_share() {
    let (Some(atmosphere), Some(rows)) = (shared_data("sky/atm_csm.txt"), shared_data("sky/mc_csm_photometric.csv"))
    else {
        return;
    };
    let read = |path: &Path| std::fs::read_to_string(path).expect("reference data can be read");
    let atmosphere = parse_atmosphere(&read(&atmosphere)).expect("the reference atmosphere is valid");
    let mut worst = 0.0_f64;
    for row in data_rows(&read(&rows)) {
        let got: f64 = spectrum(&atmosphere, &row).iter().zip(LUMINOSITY).map(|(l, y)| 683.0 * l * y * 11.75).sum();
        let (total, fraction, stderr_pct) = (row[3], row[9], row[10]);
        // The share has three decimals; the standard error is that of the total.
        let allowed = 3.0 * stderr_pct / 100.0 + 0.0006 / fraction + 0.002;
        let error = (got / (total * fraction) - 1.0).abs();
        assert!(error < allowed, "{:?}: {got} {} ({error:.1e})", &row[..3], total * fraction);
        worst = worst.max(error);
    }
    println!("single-scattered luminance against the Monte-Carlo table: worst {:.2} %", worst * 100.0);
}

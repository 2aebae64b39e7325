//! The random walks in the box against those of another program, which shares no code with them.

use tyndall_scattering::atmosphere_file::parse_atmosphere;
use tyndall_scattering::geometry::Ray;
use tyndall_scattering::monte_carlo::{MonteCarlo, Sampling};
use tyndall_tests::shared_data;

use crate::table::{data_rows, numbers};

const ATMOSPHERE: &str = include_str!("../data/atmosphere_csm8.txt");
const ROWS: &str = include_str!("../data/random_walks_csm8.csv");

/// The observer of the data stands this far above the ground.
const EYE_M: f64 = 1e-3;

/// Deviations in units of the standard error of a difference.
#[derive(Debug, Default)]
struct Deviations {
    sum: f64,
    squares: f64,
    count: f64,
}

impl Deviations {
    fn add(&mut self, difference: f64, errors: [f64; 2]) {
        let deviation = difference / errors[0].hypot(errors[1]);
        self.sum += deviation;
        self.squares += deviation * deviation;
        self.count += 1.0;
    }

    fn root_mean_square(&self) -> f64 {
        (self.squares / self.count).sqrt()
    }
}

#[test]
fn two_independent_monte_carlo_programs_agree_within_their_errors_down_to_twilight() {
    let atmosphere = parse_atmosphere(ATMOSPHERE).expect("the committed atmosphere is valid");
    let model = MonteCarlo::new(&atmosphere);
    let (mut deviations, mut rows, mut bias) = (Deviations::default(), 0, 0.0);
    for row in data_rows(ROWS) {
        let [sun, view, azimuth] = [row[0], row[1], row[2]].map(f64::to_radians);
        let sampling = Sampling { paths: 4096, seed: 5, direction: rows };
        let estimate = model.radiance(&Ray::from_angles(EYE_M, view, sun, azimuth), None, sampling);
        for k in 0..8 {
            let (want, error) = (row[3 + k], row[11 + k]);
            deviations.add(estimate.mean[k] - want, [estimate.standard_error[k], error]);
            bias += estimate.mean[k] / want - 1.0;
        }
        rows += 1;
    }
    assert_eq!(rows, 56, "every row of the data was read");
    let (scatter, bias) = (deviations.root_mean_square(), bias / deviations.count);
    println!("two Monte-Carlo programs: deviation {scatter:.2} standard errors, bias {:+.2} %", 100.0 * bias);
    // One standard error is expected. A direction's eight wavelengths share their walks, so that the mean square of 56
    // directions has itself an error of sqrt(2 / 56) = 0.19; 4096 walks leave a median error of 1 % a direction, hence 0.2 %
    // of bias.
    assert!((0.7..1.35).contains(&scatter), "{scatter} standard errors");
    assert!(bias.abs() < 6e-3, "bias {bias}");
}

#[test]
fn the_skys_irradiance_and_the_light_of_a_stretch_of_air_are_those_of_the_reference_tables() {
    let (Some(file), Some(irradiance), Some(aerial)) = (
        shared_data("sky/atm_csm.txt"),
        shared_data("sky/mc_diffuse_irradiance.csv"),
        shared_data("sky/mc_aerial_5km.csv"),
    ) else {
        return;
    };
    let read = |path: &std::path::Path| std::fs::read_to_string(path).expect("reference data can be read");
    let model = MonteCarlo::new(&parse_atmosphere(&read(&file)).expect("the reference atmosphere is valid"));
    // W/m2 over 360 to 720 nm: the first 31 wavelengths, 11.75 nm apart.
    for row in data_rows(&read(&irradiance)).filter(|row| row[0] <= 93.0) {
        let sampling = Sampling { paths: 4096, seed: 3, direction: 0 };
        let got = model.irradiance(EYE_M, row[0].to_radians().cos(), sampling);
        let sum: f64 = got.mean[..31].iter().sum::<f64>() * 11.75;
        let error: f64 = got.standard_error[..31].iter().sum::<f64>() * 11.75;
        // Four significant digits, and the edges of the band.
        let allowed = 4.0 * error.hypot(row[3] / 100.0 * row[2]) + 2e-3 * row[2];
        assert!((sum - row[2]).abs() < allowed, "sun {}: {sum} {} +- {error}", row[0], row[2]);
    }
    let text = read(&aerial);
    let header = text.lines().find(|line| line.starts_with("sun_zenith")).expect("a header");
    let named = header.split(',').filter_map(|name| name.strip_prefix('L').map(numbers));
    let nanometres: Vec<f64> = named.flatten().collect();
    for (index, row) in (0..).zip(data_rows(&text)) {
        let ray = Ray::from_angles(50.0, row[1].to_radians(), row[0].to_radians(), row[2].to_radians());
        let got = model.radiance(&ray, Some(5e3), Sampling { paths: 4096, seed: 3, direction: index });
        for (column, nm) in nanometres.iter().enumerate() {
            let near = |wavelength: &f64| (wavelength - nm).abs() < 0.6;
            let k = model.atmosphere().wavelengths_nm.iter().position(near).expect("one of the forty");
            let want = row[6 + column];
            let allowed = 4.0 * got.standard_error[k].hypot(row[13] / 100.0 * want) + 1e-3 * want;
            assert!((got.mean[k] - want).abs() < allowed, "{:?} {nm} nm: {} {want}", &row[..3], got.mean[k]);
        }
    }
}

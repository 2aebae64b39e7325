//! All orders of scattering against an independent spherical Monte-Carlo.

use tyndall_scattering::atmosphere_file::parse_atmosphere;
use tyndall_scattering::geometry::Ray;
use tyndall_scattering::march::Marcher;
use tyndall_scattering::orders::{OrdersQuality, SourceTable, diffuse_radiance};
use tyndall_scattering::single_scattering::single_scattering;

/// A row of the reference: angles (deg) and radiance.
struct Row {
    sun_zenith_deg: f64,
    view_zenith_deg: f64,
    azimuth_deg: f64,
    radiance: Vec<f64>,
}

fn reference() -> Vec<Row> {
    let lines = include_str!("data/monte_carlo_csm8.csv").lines();
    lines
        .filter(|line| line.starts_with(|first: char| first.is_ascii_digit()))
        .map(|line| {
            let values: Vec<f64> = line.split(',').map(|value| value.parse().expect("a number")).collect();
            let [sun_zenith_deg, view_zenith_deg, azimuth_deg] = [values[0], values[1], values[2]];
            Row { sun_zenith_deg, view_zenith_deg, azimuth_deg, radiance: values[3..].to_vec() }
        })
        .collect()
}

/// Errors of every wavelength of the rows with a sun in the range, ascending.
fn errors(marcher: &Marcher, source: &SourceTable, suns_deg: std::ops::RangeInclusive<f64>) -> Vec<f64> {
    let mut errors = Vec::new();
    for row in reference().iter().filter(|row| suns_deg.contains(&row.sun_zenith_deg)) {
        let [view, sun, azimuth] =
            [row.view_zenith_deg, row.sun_zenith_deg, row.azimuth_deg].map(|degrees: f64| degrees.to_radians());
        let ray = Ray::from_angles(0.0, view, sun, azimuth);
        let first = single_scattering(&marcher.atmosphere, &ray);
        let higher = diffuse_radiance(marcher, source, &ray);
        let all = first.iter().zip(higher).map(|(first, higher)| first + higher);
        errors.extend(all.zip(&row.radiance).map(|(got, want)| (got / want - 1.0).abs()));
    }
    errors.sort_by(f64::total_cmp);
    errors
}

fn marcher() -> Marcher {
    let atmosphere = parse_atmosphere(include_str!("data/atmosphere_csm8.txt")).expect("a valid file");
    Marcher::new(atmosphere, 8).expect("eight wavelengths")
}

/// Range of sun zenith angles (deg), allowed median and 95th percentile (1).
type Target = (std::ops::RangeInclusive<f64>, f64, f64);

#[expect(clippy::print_stdout, reason = "a test reports what it measured")]
fn check(quality: &OrdersQuality, targets: &[Target]) {
    let marcher = marcher();
    let source = SourceTable::new(&marcher, quality);
    for (suns, median_target, p95_target) in targets {
        let errors = errors(&marcher, &source, suns.clone());
        let (median, p95) = (errors[errors.len() / 2], errors[errors.len() * 95 / 100]);
        println!("sun {suns:?}: median {:.2} %, 95 % below {:.2} %", 100.0 * median, 100.0 * p95);
        assert!(median <= *median_target && p95 <= *p95_target, "sun {suns:?}: median {median}, p95 {p95}");
    }
}

#[test]
fn the_best_quality_stays_within_a_per_cent_by_day_and_three_in_twilight() {
    // The last row's own standard error is 3 %, up to 14 %.
    check(
        &OrdersQuality::best(),
        &[(0.0..=75.0, 0.01, 0.03), (85.0..=90.0, 0.015, 0.05), (92.0..=93.0, 0.03, 0.12), (95.0..=95.0, 0.12, 0.3)],
    );
}

#[test]
fn the_preview_stays_within_two_per_cent_by_day() {
    check(&OrdersQuality::preview(), &[(0.0..=75.0, 0.02, 0.05), (85.0..=93.0, 0.03, 0.12)]);
}

//! The energy of the sun's disc in files.

use tyndall_core::spectrum::xyz_from_spectrum;
use tyndall_io::{ExrOptions, Picture, PictureMetadata, Precision, read_exr, write_exr};
use tyndall_scattering::column_table::ColumnTable;
use tyndall_scattering::refraction::RefractionTable;
use tyndall_scene::Scene;

use crate::render::{Studio, luminance, scene};

/// Illuminance [lux] of the sun at the observer on a plane facing it: T E0.
fn expected_lux(scene: &Scene) -> f64 {
    let atmosphere = scene.model();
    let mu_sun = scene.sun_direction().expect("a sun").elevation_rad.sin();
    let columns = ColumnTable::new(&atmosphere).lookup(scene.camera.altitude_m, mu_sun);
    let coefficients = atmosphere.coefficients().expect("eight wavelengths");
    let transmittance = coefficients.transmittance(&columns);
    let light = std::array::from_fn(|i| coefficients.solar_irradiance_w_m2_nm[i] * transmittance[i]);
    xyz_from_spectrum(&light)[1]
}

/// Illuminance of a picture: sum of luminance times the solid angle of each pixel.
fn illuminance(pixels: &[[f32; 4]], [width, height]: [u32; 2], scene: &Scene) -> f64 {
    let tan_y = (0.5 * scene.camera.field_of_view_deg.to_radians()).tan();
    let tan_x = tan_y * f64::from(width) / f64::from(height);
    let area = 4.0 * tan_x * tan_y / (f64::from(width) * f64::from(height));
    let plane = |i: u32, n: u32, tan: f64| ((f64::from(i) + 0.5) / f64::from(n) * 2.0 - 1.0) * tan;
    let pixel = |i: usize| {
        let i = u32::try_from(i).expect("small pictures");
        let (x, y) = (plane(i % width, width, tan_x), plane(i / width, height, tan_y));
        luminance(pixels[i as usize]) * area / (1.0 + x * x + y * y).powf(1.5)
    };
    (0..pixels.len()).map(pixel).sum()
}

#[test]
fn the_suns_disc_in_an_exr_holds_the_suns_light_at_every_width_and_subpixel_place() {
    let mut studio = Studio::new();
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("sun.exr");
    let mut worst = 0.0_f64;
    for (width, heading) in
        [(512, 0.0), (512, 0.037), (512, 0.081), (1024, 0.0), (1024, 0.013), (2048, 0.0), (2048, 0.007)]
    {
        let size = [width, width / 4];
        let heading = heading.to_string();
        let at = |disc: &str| {
            let look = [("camera.pitch_deg", "35.02"), ("camera.heading_deg", heading.as_str()), ("sun.disc", disc)];
            let place = [("sun.elevation_deg", "35"), ("sun.azimuth_deg", "0"), ("camera.field_of_view_deg", "20")];
            // Refraction makes the disc 0.1 % flatter here; the sun of this test is round.
            let place = [&place[..], &[("sun.refraction", "false")]].concat();
            // The sky is subtracted: one order of it will do.
            let single = [("sky.orders", "single"), ("sky.table_elevations", "32"), ("sky.table_azimuths", "16")];
            scene("noon", &[&look[..], &place, &single].concat())
        };
        let [with, without] = ["true", "false"].map(|disc| {
            let rgba = studio.radiance(&at(disc), size);
            let picture = Picture { size_px: size, rgba, depth_m: None };
            let options = ExrOptions { precision: Precision::Float, ..ExrOptions::default() };
            write_exr(&path, &picture, &PictureMetadata::default(), &options).unwrap_or_else(|error| panic!("{error}"));
            let back = read_exr(&path).unwrap_or_else(|error| panic!("{error}"));
            illuminance(&back.0.rgba, size, &at(disc))
        });
        let ratio = (with - without) / expected_lux(&at("true"));
        println!("sun's disc at width {width}, heading {heading}: {ratio:.4} of T E0");
        worst = worst.max((ratio - 1.0).abs());
    }
    assert!(worst < 5e-3, "worst {:.2} %", worst * 100.0);
}

#[test]
fn the_disc_is_darker_and_redder_at_its_limb() {
    let mut studio = Studio::new();
    // The sun fills the height of a telescope's field: 0.6 degrees.
    let close = [
        ("camera.pitch_deg", "35"),
        ("camera.field_of_view_deg", "1"),
        ("sun.elevation_deg", "35"),
        ("sun.azimuth_deg", "0"),
        ("camera.heading_deg", "0"),
        ("sun.refraction", "false"),
    ];
    let size = [200, 200];
    let pixels = studio.radiance(&scene("noon", &close), size);
    let pixel = |share: f64| {
        // The radius of 0.2667 degrees is 53.3 pixels.
        let x = 100.0 + share * 0.2667_f64.to_radians().tan() / 0.5_f64.to_radians().tan() * 100.0;
        #[expect(clippy::cast_possible_truncation, reason = "a pixel of the picture")]
        let x = x as usize;
        pixels[100 * 200 + x]
    };
    let (centre, limb) = (pixel(0.0), pixel(0.866));
    // mu = 0.5 there; I = mu^a with a = 0.503 at 550 nm: 0.706.
    let ratio = f64::from(limb[1]) / f64::from(centre[1]);
    assert!((ratio / 0.5_f64.powf(0.503) - 1.0).abs() < 0.03, "{ratio}");
    assert!(limb[0] / limb[2] > 1.05 * centre[0] / centre[2], "{centre:?} {limb:?}");
    assert!(luminance(pixel(1.2)) < 1e-3 * luminance(limb), "sharp edge");
}

/// The lit part of a picture of one degree about a pitch (deg): lowest and highest elevation, and width (deg).
fn extent(pixels: &[[f32; 4]], side: usize, pitch_deg: f64) -> [f64; 3] {
    let lit: Vec<usize> = (0..pixels.len()).filter(|i| luminance(pixels[*i]) > 1e5).collect();
    let degrees = |pixel: usize| (pixel as f64 + 0.5 - 0.5 * side as f64) / side as f64;
    let range = |of: &dyn Fn(usize) -> f64| {
        let half_pixel = 0.5 / side as f64;
        lit.iter().fold((9.0, -9.0), |(low, high): (f64, f64), i| {
            (low.min(of(*i) - half_pixel), high.max(of(*i) + half_pixel))
        })
    };
    let ((low, high), (left, right)) = (range(&|i| pitch_deg - degrees(i / side)), range(&|i| degrees(i % side)));
    [low, high, right - left]
}

#[test]
fn the_rising_sun_is_lifted_by_half_a_degree_and_flattened_by_a_sixth() {
    let mut studio = Studio::new();
    // A telescope at the horizon in thin air that bends light as ours does: what shines is the disc.
    let at = |refraction: &str| {
        let sun = [("sun.elevation_deg", "-0.3"), ("sun.azimuth_deg", "0"), ("sun.limb_darkening", "false")];
        let camera = [("camera.pitch_deg", "0.35"), ("camera.heading_deg", "0"), ("camera.field_of_view_deg", "1")];
        let air = [("atmosphere.aerosol_optical_depth", "0"), ("sun.refraction", refraction), ("sky.orders", "single")];
        scene("noon", &[&sun[..], &camera, &air, &[("camera.altitude_m", "0.1")]].concat())
    };
    let bent = at("true");
    let [low, high, width] = extent(&studio.radiance(&bent, [200, 200]), 200, 0.35);
    let table = RefractionTable::new(&bent.refractive_air().expect("refraction is on"), 0.1);
    let [lower, upper] = [-0.5667, -0.0333].map(|deg: f64| table.apparent(deg.to_radians()).to_degrees());
    println!("the sun at -0.3 deg is seen from {low:.3} to {high:.3} deg, {:.3} as high as wide", (high - low) / width);
    // A pixel is 0.005 deg.
    assert!((low - lower).abs() < 0.008 && (high - upper).abs() < 0.008, "{low} {high}, by the table {lower} {upper}");
    assert!(((high - low) / width - 0.845).abs() < 0.025, "{low} {high} {width}");

    // Without refraction the upper limb is all below the level line.
    let [_, high, _] = extent(&studio.radiance(&at("false"), [200, 200]), 200, 0.35);
    assert!(high < 0.0, "{high}");
}

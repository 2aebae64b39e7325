//! Exposure, tone and reproducibility of pictures.

use tyndall_render::exposure::{ev100_from_gain, expected_ev100, gain_from_ev100};
use tyndall_render::tone::{tone_agx, tone_srgb_encode};
use tyndall_render::{FrameFormat, FrameTarget, PictureFormat, Renderer, RendererConfig};
use tyndall_scene::{Scene, presets};

use crate::render::{Studio, luminance, scene};

const SIZE: [u32; 2] = [96, 64];

fn picture(studio: &mut Studio, scene: &Scene) -> Vec<[u8; 4]> {
    studio.shoot(scene, SIZE).read_picture8(studio.gpu).unwrap_or_else(|error| panic!("{error}"))
}

/// The picture in sixteen bits.
fn picture16(studio: &Studio, scene: &Scene) -> Vec<[u16; 4]> {
    let config = RendererConfig { frame: FrameFormat::Float, picture: PictureFormat::Sixteen };
    let mut renderer = Renderer::new(studio.gpu, config).expect("a renderer");
    let mut target = FrameTarget::new(studio.gpu, SIZE, config).expect("a target");
    renderer.render(studio.gpu, scene, &mut target).expect("a frame");
    target.read_picture16(studio.gpu).expect("a picture")
}

#[test]
fn the_same_scene_twice_gives_the_same_bytes() {
    let mut studio = Studio::new();
    let scene = scene("sunset", &[]);
    let first = picture(&mut studio, &scene);
    assert_eq!(first, picture(&mut studio, &scene), "same renderer");
    studio.renderer.invalidate_tables();
    assert_eq!(first, picture(&mut studio, &scene), "tables filled again");
    assert_eq!(first, picture(&mut Studio::new(), &scene), "another renderer");
}

#[test]
fn a_manual_exposure_develops_each_pixel_by_the_published_formula() {
    let mut studio = Studio::new();
    for (tone_map, tone) in
        [("none", (|v: f64| tone_srgb_encode(v)) as fn(f64) -> f64), ("agx", |v| tone_agx([v; 3])[0])]
    {
        let grey = [
            ("film.exposure", "manual"),
            ("film.ev100", "14"),
            ("film.tone_map", tone_map),
            ("film.dither", "false"),
            ("film.compensation_ev", "0"),
            ("film.contrast", "1"),
            ("film.saturation", "1"),
            ("atmosphere.air_density", "0"),
            ("atmosphere.aerosol_optical_depth", "0"),
            ("atmosphere.ozone_du", "0"),
            ("ground.red", "0.3"),
            ("ground.green", "0.3"),
            ("ground.blue", "0.3"),
        ];
        let scene = scene("noon", &grey);
        let target = studio.shoot(&scene, SIZE);
        let radiance = *target.read_radiance(studio.gpu).expect("radiance").last().expect("pixels");
        let shown = *target.read_picture8(studio.gpu).expect("picture").last().expect("pixels");
        // The sun is not quite white in Rec.709; the green channel is near its luminance.
        let want = 255.0 * tone(f64::from(radiance[1]) * gain_from_ev100(14.0));
        let allowed = if tone_map == "none" { 0.6 } else { 4.0 };
        assert!((f64::from(shown[1]) - want).abs() <= allowed, "{tone_map}: {shown:?} {want}");
    }
}

#[test]
fn the_automatic_exposure_is_that_of_the_metered_mean() {
    let mut studio = Studio::new();
    for preset in presets() {
        let scene =
            scene(preset.name, &[("film.exposure", "auto"), ("film.compensation_ev", "0"), ("sun.disc", "false")]);
        let target = studio.shoot(&scene, [96, 96]);
        let pixels = target.read_radiance(studio.gpu).expect("radiance");
        // The meter's floor, 2^-24 of a pre-exposed value.
        let expected = expected_ev100(scene.sun_direction().expect("a sun").elevation_rad);
        let floor = (-24.0_f64).exp2() / gain_from_ev100(expected);
        // Every pixel is a grid point of the meter at this size.
        let (mut sum, mut weights) = (0.0, 0.0);
        for (i, pixel) in pixels.iter().enumerate() {
            let [x, y] = [i % 96, i / 96].map(|k| (k as f64 + 0.5) / 48.0 - 1.0);
            let weight = 1.0 - 0.35 * (x * x + y * y);
            sum += weight * luminance(pixel.map(|c| c.max(0.0))).max(floor).log2();
            weights += weight;
        }
        let want = ev100_from_gain(0.125 / (1.2 * (sum / weights).exp2()));
        let got = studio.renderer.read_ev100(studio.gpu).expect("exposure");
        assert!((got - want).abs() < 1e-3, "{}: {got} {want}", preset.name);
    }
}

#[test]
fn one_stop_of_compensation_is_one_stop() {
    let mut studio = Studio::new();
    let exposures = ["0", "1"].map(|stops| {
        studio.shoot(&scene("noon", &[("film.compensation_ev", stops)]), SIZE);
        studio.renderer.read_ev100(studio.gpu).expect("exposure")
    });
    assert!((exposures[0] - exposures[1] - 1.0).abs() < 1e-3, "{exposures:?}");
}

#[test]
fn dither_moves_no_channel_by_more_than_a_level_and_keeps_the_mean() {
    let mut studio = Studio::new();
    let [plain, dithered] =
        ["false", "true"].map(|dither| picture(&mut studio, &scene("noon", &[("film.dither", dither)])));
    let exact = picture16(&studio, &scene("noon", &[("film.dither", "false")]));
    let (mut moved, mut bias) = (0, 0.0);
    for ((a, b), exact) in plain.iter().zip(&dithered).zip(&exact) {
        for c in 0..3 {
            assert!(b[c].abs_diff(a[c]) <= 1, "at most one level: {a:?} {b:?}");
            moved += u32::from(a[c] != b[c]);
            bias += f64::from(b[c]) - f64::from(exact[c]) / 257.0;
        }
    }
    let count = 3.0 * plain.len() as f64;
    // Rounding plus triangular noise has a variance of 1/12 + 1/6: five standard errors of the mean.
    let allowed = 5.0 * (0.25 / count).sqrt();
    assert!((bias / count).abs() < allowed, "mean {} of {allowed}", bias / count);
    assert!(f64::from(moved) > 0.2 * count, "{moved} values moved");
}

#[test]
fn sixteen_bits_agree_with_eight() {
    let mut studio = Studio::new();
    let scene = scene("low-sun", &[("film.dither", "false")]);
    let eight = picture(&mut studio, &scene);
    for (a, b) in eight.iter().zip(picture16(&studio, &scene)) {
        for c in 0..3 {
            assert!((f64::from(a[c]) * 257.0 - f64::from(b[c])).abs() <= 140.0, "{a:?} {b:?}");
        }
    }
}

//! Pictures of blowing sand: nothing without wind, the same at the same time, veils over crests and light in them.

use tyndall_scene::Scene;

use crate::render::{Studio, luminance, scene};

/// Transverse dunes against a low sun, seen from the lee, in a wind (m/s) that has blown for some time (s).
fn windy(wind_m_s: &str, time_s: &str) -> Scene {
    let field = [("dunes.side", "128"), ("desert.steps", "1200"), ("film.dither", "false")];
    let camera = [("camera.altitude_m", "4"), ("camera.pitch_deg", "-3"), ("camera.heading_deg", "280")];
    let light = [("sun.elevation_deg", "8"), ("sun.azimuth_deg", "270")];
    let wind = [("sand.wind_m_s", wind_m_s), ("sand.wind_time_s", time_s)];
    scene("desert", &[&field[..], &camera, &light, &wind].concat())
}

const SIZE_PX: [u32; 2] = [96, 64];

fn bits(picture: &[[f32; 4]]) -> Vec<[u32; 4]> {
    picture.iter().map(|pixel| pixel.map(f32::to_bits)).collect()
}

#[test]
fn sand_that_lies_still_changes_no_bit_of_a_picture() {
    let mut studio = Studio::new();
    let still = bits(&studio.radiance(&windy("0", "0"), SIZE_PX));
    let breeze = bits(&studio.radiance(&windy("2.5", "10"), SIZE_PX));
    assert!(still == breeze, "2.5 m/s are below the threshold");
    let storm = bits(&studio.radiance(&windy("14", "10"), SIZE_PX));
    assert!(still != storm, "14 m/s are not");
    let after = bits(&studio.radiance(&windy("0", "10"), SIZE_PX));
    assert!(still == after, "nothing stays behind");
}

#[test]
fn streaks_move_with_time_and_are_the_same_at_the_same_time() {
    let mut studio = Studio::new();
    let [first, later, again] = ["3", "4", "3"].map(|time_s| studio.radiance(&windy("14", time_s), SIZE_PX));
    assert!(bits(&first) == bits(&again), "the same time");
    let gaps = first.iter().zip(&later).map(|(a, b)| (luminance(*a) / luminance(*b) - 1.0).abs());
    let mean = gaps.sum::<f64>() / first.len() as f64;
    assert!((1e-4..0.1).contains(&mean), "a second later pixels are off by {mean} on average");
}

#[test]
fn veils_against_the_sun_light_the_shade_and_hide_no_more_than_they_are_deep() {
    let mut studio = Studio::new();
    let [still, windy] = ["0", "12"].map(|wind| studio.radiance(&windy(wind, "0"), SIZE_PX));
    // Slip faces in the shade make the lower half.
    let lower = (SIZE_PX[0] * SIZE_PX[1] / 2) as usize;
    let [before, after] = [&still, &windy].map(|picture| picture[lower..].iter().map(|p| luminance(*p)).sum::<f64>());
    assert!(after > 1.05 * before, "veils over the shade: {after} from {before}");
    let [sky_before, sky_after] = [&still, &windy].map(|picture| luminance(picture[SIZE_PX[0] as usize / 2]));
    assert!((sky_after / sky_before - 1.0).abs() < 1e-3, "high over the dunes the air is clear");
}

//! The paper's dome of coloured vertices against the sky per pixel.

use crate::render::{Studio, luminance, scene};

#[test]
fn the_dome_of_the_paper_differs_from_the_sky_per_pixel_by_a_known_amount() {
    let mut studio = Studio::new();
    let size = [160, 120];
    for preset in ["noon", "sunset"] {
        let plain = [("sun.disc", "false")];
        let exact = studio.radiance(&scene(preset, &plain), size);
        let mut medians = vec![];
        for (rings, segments) in [("16", "32"), ("48", "96"), ("192", "384")] {
            let dome =
                [plain[0], ("sky.mode", "vertex-dome"), ("sky.dome_rings", rings), ("sky.dome_segments", segments)];
            let got = studio.radiance(&scene(preset, &dome), size);
            let mut errors: Vec<f64> =
                exact.iter().zip(&got).map(|(a, b)| (luminance(*b) / luminance(*a) - 1.0).abs()).collect();
            errors.sort_by(f64::total_cmp);
            let (median, p99) = (errors[errors.len() / 2], errors[errors.len() * 99 / 100]);
            println!(
                "dome {rings} x {segments} against per pixel, {preset}: median {:.3} %, p99 {:.2} %",
                median * 100.0,
                p99 * 100.0
            );
            medians.push(p99);
        }
        // Linear interpolation: four times as many rings and segments, a sixteenth of the error; tables add a floor.
        assert!(medians[2] < 0.25 * medians[0], "{preset}: {medians:?}");
        assert!(medians[1] < 0.05, "{preset}: the default dome stays within 5 %: {medians:?}");
        assert!(medians[0] > 1e-4, "{preset}: the coarse dome is not the sky per pixel: {medians:?}");
    }
}

//! The air before clouds: frames against walks through cloud and air, which use no table.

use tyndall_render::clouds::reference::CloudReference;
use tyndall_render::reference::{left_out, render_reference};
use tyndall_scene::Scene;

use crate::render::{Studio, scene};

const SIZE: [u32; 2] = [48, 24];

/// A lone cloud 30 km to the north over grey ground, through a long lens; the grid does not repeat and has no turbulence.
fn far_cloud(changes: &[(&str, &str)]) -> Scene {
    let fixed = [
        ("image.width_px", "48"),
        ("image.height_px", "24"),
        ("sky.orders_detail", "best"),
        ("sun.disc", "false"),
        ("sun.elevation_deg", "40"),
        ("sun.azimuth_deg", "200"),
        ("stars.visible", "false"),
        ("landscape.kind", "none"),
        ("ground.pattern", "plain"),
        ("camera.altitude_m", "300"),
        ("camera.y_m", "-30000"),
        ("camera.heading_deg", "0"),
        ("camera.pitch_deg", "2.2"),
        ("camera.field_of_view_deg", "2"),
        ("clouds.kind", "automaton"),
        ("clouds.detail", "0"),
        // Scattered evenly, walks have little noise and diffusion is at its best: what differs is the air's.
        ("clouds.forward_asymmetry", "0"),
        ("clouds.backward_asymmetry", "0"),
        ("cloud_grid.cells_east", "32"),
        ("cloud_grid.cells_north", "32"),
        ("cloud_grid.cells_up", "20"),
        ("cloud_grid.edges", "open"),
        ("cloud_grid.warm_up_steps", "25"),
        ("cloud_vapour.cover", "0.6"),
        ("cloud_matter.extinction_per_m", "0.05"),
    ];
    scene("noon", &[&fixed[..], changes].concat())
}

/// Mean radiance of frame and walks in three channels over the pixels that are cloud, and the same of the sky there without
/// the cloud.
fn means(studio: &mut Studio, scene: &Scene, paths: u32) -> [[f64; 3]; 4] {
    let reference = CloudReference::new(scene).expect("a scene").expect("clouds");
    let opacity: Vec<f64> = (0..SIZE[1]).flat_map(|y| reference.row(y, (16, 1))).map(|pixel| pixel.opacity).collect();
    let cloudy: Vec<usize> = (0..opacity.len()).filter(|&pixel| opacity[pixel] > 0.9).collect();
    assert!(cloudy.len() > 60, "there is a cloud in view: {} pixels", cloudy.len());
    let walked =
        |scene: &Scene| render_reference(scene, (paths, 1), &mut |_| true).expect("a scene").expect("all of it").rgba;
    let mean = |picture: &[[f32; 4]]| {
        [0, 1, 2].map(|channel: usize| {
            cloudy.iter().map(|&pixel| f64::from(picture[pixel][channel])).sum::<f64>() / cloudy.len() as f64
        })
    };
    let mut clear = scene.clone();
    clear.set_text("clouds.kind", "none").expect("the parameter exists");
    let [frame, open] = [scene, &clear].map(|scene| mean(&studio.radiance(scene, SIZE)));
    [frame, mean(&walked(scene)), open, mean(&walked(&clear))]
}

#[test]
fn a_cumulus_at_thirty_kilometres_is_as_far_from_the_walks_as_the_sky_beside_it() {
    let mut studio = Studio::new();
    for haze in ["0.05", "0.3"] {
        let scene = far_cloud(&[("atmosphere.aerosol_optical_depth", haze)]);
        assert_eq!(left_out(&scene), ["the clouds' shade on ground and air"], "all else is walked");
        let [frame, walks, frame_sky, walked_sky] = means(&mut studio, &scene, 32);
        let ratio = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|channel: usize| a[channel] / b[channel]);
        let (cloud, sky) = (ratio(frame, walks), ratio(frame_sky, walked_sky));
        println!(
            "haze {haze}: frame over walks: cloud {cloud:.3?}, sky {sky:.3?}; walks {walks:.0?}, sky {walked_sky:.0?}"
        );
        // Two degrees over the horizon in haze the sky's own tables are 8 % too dark.
        assert!(sky.iter().all(|ratio| (ratio - 1.0).abs() < 0.1), "sky, haze {haze}: {sky:?}");
        // Beside the sky's error, which the air before the cloud shares, there is that of light scattered often in the cloud, which shows where haze is thin.
        let off = ratio(cloud, sky);
        assert!(off.iter().all(|off| (off - 1.0).abs() < 0.1), "cloud over sky, haze {haze}: {off:?}");
    }
}

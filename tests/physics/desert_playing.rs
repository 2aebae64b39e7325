//! Sand that is under way from one picture to the next.

use tyndall_scene::Scene;

use crate::render::{Studio, scene};

const SIZE_PX: [u32; 2] = [48, 32];

/// Dunes after some steps, the camera on them.
fn dunes(steps: u32) -> Scene {
    let steps = steps.to_string();
    scene("desert", &[("dunes.side", "64"), ("desert.steps", &steps), ("sky.orders", "single")])
}

#[test]
fn pictures_of_sand_under_way_keep_the_air_and_the_first_at_rest_is_exact() {
    let mut studio = Studio::new();
    studio.renderer.set_sand_under_way(true);
    let names = |studio: &mut Studio, steps| {
        studio.shoot(&dunes(steps), SIZE_PX);
        let passes = studio.renderer.timings(studio.gpu).unwrap_or_else(|error| panic!("{error}"));
        passes.into_iter().map(|pass| pass.name).collect::<Vec<_>>()
    };
    let first = names(&mut studio, 100);
    assert!(first.contains(&"aerial volume"), "the air is made once: {first:?}");
    let second = names(&mut studio, 101);
    assert!(second.contains(&"desert mesh"), "the sand has moved: {second:?}");
    assert!(!second.contains(&"aerial volume"), "the air stays as it was: {second:?}");
    studio.renderer.set_sand_under_way(false);
    let rested = studio.radiance(&dunes(101), SIZE_PX);
    assert_eq!(rested, Studio::new().radiance(&dunes(101), SIZE_PX), "at rest nothing is left of what was held");
}

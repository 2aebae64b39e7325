//! Glints of single grains: they move light about, and add none.

use tyndall_tests::evaluate;

/// Spots of pixels 2 mm wide on ground seen at a slant, for a direction halfway between sun and view.
const GLINTS: &str = "glints_at(x.xy, 0.002, vec2<f32>(0.8, 0.6), 0.5, normalize(vec3<f32>(x.z, x.w, 1.0)))";

fn glints(places: impl Fn(f32) -> [f32; 2], halfway: [f32; 2], count: u16) -> Vec<f32> {
    let input = |index: u16| {
        let [x, y] = places(f32::from(index));
        [x, y, halfway[0], halfway[1]]
    };
    evaluate(GLINTS, &["desert/glints.wgsl"], &(0..count).map(input).collect::<Vec<_>>())
}

#[test]
fn glints_of_many_grains_have_the_mean_light() {
    for halfway in [[0.1, 0.2], [-0.4, 0.05]] {
        let found = glints(|index| [0.0137 * (index % 200.0), 0.0173 * (index / 200.0).floor()], halfway, 40_000);
        let mean = found.iter().map(|value| f64::from(*value)).sum::<f64>() / found.len() as f64;
        // Spots are at most ten times the mean; 40,000 of them in 10,000 cells leave a standard error of 1.5 per cent.
        assert!((mean - 1.0).abs() < 0.05, "mean {mean} for {halfway:?}");
        let brightest = found.iter().fold(0.0_f32, |most, value| most.max(*value));
        assert!((2.0..=11.0).contains(&brightest), "the brightest spot is {brightest} times the mean");
    }
}

#[test]
fn a_glint_is_a_pixel_wide_and_follows_its_grain() {
    let found = glints(|index| [0.000_2 * index, 0.3], [0.1, 0.2], 20_000);
    let jump = found.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0_f32, f32::max);
    // A tenth of a pixel: a tent of ten times the mean, a pixel to each side, falls by one mean at most, and twice so at
    // the corner of two tents.
    assert!(jump < 2.0, "light jumps by {jump} means within a tenth of a pixel");
}

// Relief of ripples near the camera: a short march of the view's ray through the tile's heights and one secant step (Policarpo,
// Oliveira and Comba 2005) finds what a pixel shows, another one towards the lamp what shades it. Heights and rays are over the
// plane that touches the smooth sand. Far away nothing is marched; loops skip work where software adapters run both sides of
// a branch.
// @import desert/ripples.wgsl

@group(2) @binding(11) var ripple_heights: texture_2d<f32>; // shares of the highest crest

/// Steps of a ripple's length, at least; the least and the most steps of the view's ray; those towards the lamp.
const RELIEF_STEPS_A_RIPPLE: f32 = 16.0;
const RELIEF_STEPS_LEAST: f32 = 4.0;
const RELIEF_STEPS_MOST: f32 = 20.0;
const RELIEF_SHADE_STEPS: i32 = 10;

/// Lowest rise of a ray over the sand, for a height of 1 along it.
const RELIEF_LOWEST_RISE: f32 = 0.08;

/// Heights of ripples around a place.
struct Relief {
    parts: array<RipplePatch, 3>,
    seen: f32,     // 0 to 1, as the ripples are large enough
    height: f32,   // 1, factor on the tile's heights; 0 without relief
    top_m: f32,    // highest that a crest can be
    level: f32,    // mip level of the heights
    ripple_m: f32, // length of a ripple
}

/// Pixels of a ripple's length from which relief shows, 0 to 1.
fn relief_seen(pixels: f32) -> f32 {
    return smoothstep(4.0, 10.0, pixels);
}

/// Around a place (m) where ripples have a height of 0 to 1, under a pixel `width_m` wide and 1 / `facing` times as long.
fn relief_around(place: vec2<f32>, height: f32, width_m: f32, facing: f32) -> Relief {
    let parts = ripple_patches(place);
    let ripple_m = desert.hexagon_m / 14.0;
    let seen = relief_seen(ripple_m * facing / width_m);
    let factor = desert.relief * height * seen;
    let shares = vec3<f32>(parts[0].share * parts[0].tile_m, parts[1].share * parts[1].tile_m, parts[2].share * parts[2].tile_m);
    let top_m = factor * (shares.x + shares.y + shares.z);
    let level = max(log2(width_m * desert.tile_texels / desert.tile_m), 0.0);
    return Relief(parts, seen, select(0.0, factor, top_m > 1e-5), top_m, level, ripple_m);
}

/// Part of a patch in the height (m) of ripples as high as the tile is wide.
fn relief_of_patch(part: RipplePatch, place: vec2<f32>, level: f32) -> f32 {
    let at = ripple_tile_place(part, place);
    return part.share * part.tile_m * textureSampleLevel(ripple_heights, ripple_sampler, at, level).x;
}

/// Height (m) of ripples over the smooth sand.
fn relief_height(relief: Relief, place: vec2<f32>) -> f32 {
    let first = relief_of_patch(relief.parts[0], place, relief.level);
    let second = relief_of_patch(relief.parts[1], place, relief.level);
    let third = relief_of_patch(relief.parts[2], place, relief.level);
    return relief.height * (first + second + third);
}

/// What a ray sees of ripples that meets smooth sand of a slope at a place (m): place and height (m). `view` points to the
/// camera, `reach_m` away.
fn relief_hit(relief: Relief, place: vec2<f32>, slope: vec2<f32>, view: vec3<f32>, reach_m: f32) -> vec3<f32> {
    let rise = max(view.z - dot(slope, view.xy), RELIEF_LOWEST_RISE);
    let above_m = min(relief.top_m / rise, 0.5 * reach_m);
    let wanted = 2.0 * above_m * length(view.xy) / relief.ripple_m * RELIEF_STEPS_A_RIPPLE;
    let steps = ceil(clamp(wanted, RELIEF_STEPS_LEAST, RELIEF_STEPS_MOST));
    let step_m = (above_m + relief.top_m / rise) / steps;
    let count = select(0, i32(steps), relief.height > 0.0);
    var gap_m = 1.0;
    var hit_m = 0.0;
    for (var step = 0; step <= count; step++) { // loops: 21
        if (count == 0) { break; }
        let here_m = above_m - f32(step) * step_m;
        let here_gap_m = here_m * rise - relief_height(relief, place + here_m * view.xy);
        if (here_gap_m <= 0.0 || step == count) {
            // The secant; a crest that is over the first place is hit there.
            let back = select(here_gap_m / (here_gap_m - gap_m), 0.0, step == 0 || here_gap_m > 0.0);
            hit_m = here_m + back * step_m;
            break;
        }
        gap_m = here_gap_m;
    }
    return vec3<f32>(place + hit_m * view.xy, hit_m * rise);
}

/// Share of a lamp's light that ripples let through to a place (m) and height (m) on them.
fn relief_shade(relief: Relief, place: vec2<f32>, height_m: f32, slope: vec2<f32>, lamp: vec3<f32>) -> f32 {
    let flat_m = max(length(lamp.xy), 1e-3);
    let toward = lamp.xy / flat_m;
    let rise = lamp.z / flat_m - dot(slope, toward);
    let highest_m = max(relief.top_m - height_m, 0.0);
    let reach_m = min(highest_m / max(rise, 0.02), 1.5 * relief.ripple_m);
    let count = select(0, RELIEF_SHADE_STEPS, relief.height > 0.0 && rise < 1.0);
    var horizon = -1.0;
    for (var step = 1; step <= count; step++) { // loops: 10
        // Within a texel slopes jump.
        let away_m = max(reach_m * f32(step) / f32(count), 1.5 * desert.tile_m / desert.tile_texels);
        horizon = max(horizon, (relief_height(relief, place + away_m * toward) - height_m) / away_m);
    }
    // As wide as the steps leave it uncertain.
    let shade = smoothstep(-1.0, 1.0, (atan(rise) - atan(horizon)) / (3.0 * desert.sun_half_width));
    return mix(1.0, shade, select(0.0, relief.seen, count > 0));
}

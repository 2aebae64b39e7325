// Ripples on the sand as slopes. The mip levels of their tile hold mean slopes B and second moments M (Olano and Baker 2010),
// so that ripples smaller than a pixel widen the spread of its slopes. Twin of the tile: tyndall_render::desert::ripple_tile.
// @import desert/ripple_patches.wgsl

@group(2) @binding(6) var ripple_tile: texture_2d<f32>;    // B.x, B.y, M.xx, M.yy
@group(2) @binding(7) var ripple_cross: texture_2d<f32>;   // M.xy
@group(2) @binding(10) var ripple_sampler: sampler;        // of the tile

/// Slopes of what is under a pixel.
struct Ripples {
    slope: vec2<f32>,      // 1, mean, to the east and the north
    covariance: vec3<f32>, // 1, xx, xy, yy
}

/// Those of one patch, along 4 places on the long axis of the footprint.
fn ripples_of_patch(part: RipplePatch, place: vec2<f32>, long: vec2<f32>, short_m: f32) -> Ripples {
    let paper = clamp(floor(log2(max(short_m * desert.tile_texels / part.tile_m, 1.0))), 1.0, 4.0);
    let best = max(log2(max(short_m, 0.25 * length(long)) * desert.tile_texels / part.tile_m), 0.0);
    let level = select(best, paper, desert.ripples == 1u);
    var slope = vec2<f32>(0.0);
    var moments = vec3<f32>(0.0);
    for (var tap = 0; tap < 4; tap++) { // loops: 4
        let share = select(0.25 * f32(tap) - 0.375, 0.0, desert.ripples == 1u);
        let at = ripple_tile_place(part, place + share * long);
        let texel = textureSampleLevel(ripple_tile, ripple_sampler, at, level);
        slope += 0.25 * texel.xy;
        moments += 0.25 * vec3<f32>(texel.z, textureSampleLevel(ripple_cross, ripple_sampler, at, level).x, texel.w);
    }
    let narrow = moments - vec3<f32>(slope.x * slope.x, slope.x * slope.y, slope.y * slope.y);
    // From the axes of the wind to east and north.
    let c = part.along.x;
    let s = part.along.y;
    let turned = vec3<f32>(
        c * c * narrow.x - 2.0 * c * s * narrow.y + s * s * narrow.z,
        c * s * (narrow.x - narrow.z) + (c * c - s * s) * narrow.y,
        s * s * narrow.x + 2.0 * c * s * narrow.y + c * c * narrow.z,
    );
    return Ripples(vec2<f32>(c * slope.x - s * slope.y, s * slope.x + c * slope.y), turned);
}

/// Ripples at a place (m) under a footprint: its long axis as a vector and its width (m). `height` is theirs, 0 to 1.
fn ripples_at(place: vec2<f32>, long: vec2<f32>, short_m: f32, height: f32) -> Ripples {
    let gain = select(desert.ripple_gain * height, 0.0, desert.ripples == 0u);
    var sum = Ripples(vec2<f32>(0.0), vec3<f32>(0.0));
    if (gain < 1e-4) {
        return sum;
    }
    var parts = ripple_patches(place);
    for (var index = 0; index < 3; index++) { // loops: 3
        let share = parts[index].share;
        if (share > 0.02) {
            let one = ripples_of_patch(parts[index], place, long, short_m);
            sum.slope += share * one.slope;
            sum.covariance += share * share * one.covariance;
        }
    }
    let spread = select(gain * gain, 0.0, desert.ripples == 1u);
    return Ripples(gain * sum.slope, spread * max(sum.covariance, vec3<f32>(0.0, -1.0, 0.0)));
}

// Ripples on the sand: a tile of simulated ripples, laid in patches that are turned into the local wind and blended, so that
// no repetition shows. The tile's mip levels hold mean slopes B and their second moments M (Olano and Baker 2010), so that
// ripples smaller than a pixel widen the spread of its slopes. Twin of the tile: tyndall_render::desert::ripple_tile.
// @import common/noise.wgsl
// @import desert/desert.wgsl

@group(2) @binding(6) var ripple_tile: texture_2d<f32>;    // B.x, B.y, M.xx, M.yy
@group(2) @binding(7) var ripple_cross: texture_2d<f32>;   // M.xy
@group(2) @binding(8) var ripple_winds: texture_2d<f32>;   // direction times height of ripples, scale, sand
@group(2) @binding(9) var desert_sampler: sampler;         // of the field
@group(2) @binding(10) var ripple_sampler: sampler;        // of the tile

/// Slopes of what is under a pixel.
struct Ripples {
    slope: vec2<f32>,      // 1, mean, to the east and the north
    covariance: vec3<f32>, // 1, xx, xy, yy
}

/// What the ripples depend on at a place: direction they travel in, times their height; their scale; cover of sand.
fn ripple_wind(place: vec2<f32>, footprint_m: f32) -> vec4<f32> {
    let level = log2(max(footprint_m / desert.cell_m, 1.0));
    return textureSampleLevel(ripple_winds, desert_sampler, desert_map_place(place), level);
}

/// One patch around a corner of the lattice, along 4 places on the long axis of the footprint.
fn ripple_patch(place: vec2<f32>, corner: vec2<i32>, long: vec2<f32>, short_m: f32) -> Ripples {
    let centre = desert.hexagon_m * vec2<f32>(f32(corner.x) + 0.5 * f32(corner.y), 0.8660254 * f32(corner.y));
    let wind = ripple_wind(centre, desert.hexagon_m);
    let along = wind.xy / max(length(wind.xy), 1e-4);
    let scale = max(wind.z, 0.25);
    let word = noise_pcg(bitcast<u32>(corner.x) + noise_pcg(bitcast<u32>(corner.y)));
    let start = vec2<f32>(f32(word & 0xffffu), f32(word >> 16u)) / 65536.0;
    let tile_m = desert.tile_m * scale;
    let paper = clamp(floor(log2(max(short_m * desert.tile_texels / tile_m, 1.0))), 1.0, 4.0);
    let best = max(log2(max(short_m, 0.25 * length(long)) * desert.tile_texels / tile_m), 0.0);
    let level = select(best, paper, desert.ripples == 1u);
    var slope = vec2<f32>(0.0);
    var moments = vec3<f32>(0.0);
    for (var tap = 0; tap < 4; tap++) { // loops: 4
        let share = select(0.25 * f32(tap) - 0.375, 0.0, desert.ripples == 1u);
        let off = place + share * long - centre;
        let at = vec2<f32>(dot(off, along), dot(off, vec2<f32>(-along.y, along.x))) / tile_m + start;
        let texel = textureSampleLevel(ripple_tile, ripple_sampler, at, level);
        slope += 0.25 * texel.xy;
        moments += 0.25 * vec3<f32>(texel.z, textureSampleLevel(ripple_cross, ripple_sampler, at, level).x, texel.w);
    }
    let narrow = moments - vec3<f32>(slope.x * slope.x, slope.x * slope.y, slope.y * slope.y);
    // From the axes of the wind to east and north.
    let c = along.x;
    let s = along.y;
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
    let unit = place / desert.hexagon_m;
    let skewed = vec2<f32>(unit.x - 0.57735027 * unit.y, 1.15470054 * unit.y);
    let cell = floor(skewed);
    let corner = vec2<i32>(cell);
    let f = skewed - cell;
    let upper = f.x + f.y > 1.0;
    let opposite = select(vec2<i32>(0, 0), vec2<i32>(1, 1), upper);
    var weights = select(vec3<f32>(1.0 - f.x - f.y, f.x, f.y), vec3<f32>(f.x + f.y - 1.0, 1.0 - f.y, 1.0 - f.x), upper);
    weights = weights * weights * weights;
    weights /= weights.x + weights.y + weights.z;
    // Patches do not know of each other: their sum keeps the variance, not the mean of their slopes.
    let norm = inverseSqrt(dot(weights, weights));
    for (var index = 0; index < 3; index++) { // loops: 3
        let share = norm * weights[index];
        if (share > 0.02) {
            let step = select(vec2<i32>(select(0, 1, index == 1), select(0, 1, index == 2)), opposite, index == 0);
            let one = ripple_patch(place, corner + step, long, short_m);
            sum.slope += share * one.slope;
            sum.covariance += share * share * one.covariance;
        }
    }
    let spread = select(gain * gain, 0.0, desert.ripples == 1u);
    return Ripples(gain * sum.slope, spread * max(sum.covariance, vec3<f32>(0.0, -1.0, 0.0)));
}

// The patches of ripples around a place: the tile, turned into the wind at three corners of a lattice of triangles. Each patch
// starts elsewhere on the tile, so that no repetition shows.
// @import common/noise.wgsl
// @import desert/desert.wgsl

@group(2) @binding(8) var ripple_winds: texture_2d<f32>; // direction times height of ripples, scale, sand
@group(2) @binding(9) var desert_sampler: sampler;       // of the field

/// A patch of the tile.
struct RipplePatch {
    centre: vec2<f32>, // m
    along: vec2<f32>,  // unit vector along the wind
    start: vec2<f32>,  // place on the tile of the centre
    tile_m: f32,       // side of the tile
    share: f32,        // 1, in the sum of the three
}

/// What the ripples depend on at a place: direction they travel in, times their height; their scale; cover of sand.
fn ripple_wind(place: vec2<f32>, footprint_m: f32) -> vec4<f32> {
    let level = log2(max(footprint_m / desert.cell_m, 1.0));
    return textureSampleLevel(ripple_winds, desert_sampler, desert_map_place(place), level);
}

/// The patch around a corner of the lattice.
fn ripple_patch(corner: vec2<i32>, share: f32) -> RipplePatch {
    let centre = desert.hexagon_m * vec2<f32>(f32(corner.x) + 0.5 * f32(corner.y), 0.8660254 * f32(corner.y));
    let wind = ripple_wind(centre, desert.hexagon_m);
    let along = wind.xy / max(length(wind.xy), 1e-4);
    let word = noise_pcg(bitcast<u32>(corner.x) + noise_pcg(bitcast<u32>(corner.y)));
    let start = vec2<f32>(f32(word & 0xffffu), f32(word >> 16u)) / 65536.0;
    return RipplePatch(centre, along, start, desert.tile_m * max(wind.z, 0.25), share);
}

/// The three patches around a place (m).
fn ripple_patches(place: vec2<f32>) -> array<RipplePatch, 3> {
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
    let shares = weights * inverseSqrt(dot(weights, weights));
    return array<RipplePatch, 3>(
        ripple_patch(corner + opposite, shares.x),
        ripple_patch(corner + vec2<i32>(1, 0), shares.y),
        ripple_patch(corner + vec2<i32>(0, 1), shares.z),
    );
}

/// Place on the tile, 1 a side, of a place (m) on a patch.
fn ripple_tile_place(part: RipplePatch, place: vec2<f32>) -> vec2<f32> {
    let off = place - part.centre;
    return vec2<f32>(dot(off, part.along), dot(off, vec2<f32>(-part.along.y, part.along.x))) / part.tile_m + part.start;
}

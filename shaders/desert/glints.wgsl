// Single grains that mirror the sun. Each square cell of the ground, some pixels wide, has one grain at a place and with a tilt
// drawn from the cell's number, so that grains stay where they are while the camera moves. A grain that is turned right shows
// as a spot as wide as a pixel. The mean over places and tilts is 1, so that glints add no light to the mirror-like part.
// @import common/noise.wgsl

const GLINT_GRAIN_M: f32 = 0.0004;
const GLINT_RARITY: f32 = 20000.0; // grains to one that mirrors
const GLINT_PEAK: f32 = 10.0;      // most of a spot, in times of the mean

/// A pixel's outline on the ground: unit vector along its long axis, half its length and width (m).
struct GlintPixel {
    along: vec2<f32>,
    half_m: vec2<f32>,
}

/// Tilts at which one of a cell's grains is turned right, as a share of all.
fn glints_chance(width: f32) -> f32 {
    return clamp(width * width / (GLINT_GRAIN_M * GLINT_GRAIN_M) / GLINT_RARITY, 0.02, 0.5);
}

/// Light of the grain in a cell of a width (m) on a pixel around a place, in times of a spot's most.
fn glints_cell(place: vec2<f32>, cell: vec2<i32>, width: f32, pixel: GlintPixel, halfway: vec3<f32>) -> f32 {
    let word = noise_pcg(bitcast<u32>(cell.x) + noise_pcg(bitcast<u32>(cell.y) + noise_pcg(bitcast<u32>(i32(64.0 * log2(width))))));
    let at = (vec2<f32>(cell) + vec2<f32>(f32(word & 0xffu), f32((word >> 8u) & 0xffu)) / 256.0) * width;
    let across = vec2<f32>(-pixel.along.y, pixel.along.x);
    let off = abs(vec2<f32>(dot(place - at, pixel.along), dot(place - at, across)));
    let near = max(1.0 - off / (2.0 * pixel.half_m), vec2<f32>(0.0));
    let tilt = vec2<f32>(f32((word >> 16u) & 0xffu), f32(word >> 24u)) / 128.0 - 1.0;
    let turn = fract(7.0 * dot(tilt, halfway.xy) + 11.0 * tilt.x + 5.0 * tilt.y);
    return near.x * near.y * max(1.0 - abs(turn - 0.5) / glints_chance(width), 0.0);
}

/// Light of the grains of one octave of widths (m), relative to its mean. Where few spots would have to be very bright, the
/// rest of the light is spread evenly.
fn glints_octave(place: vec2<f32>, width: f32, pixel: GlintPixel, halfway: vec3<f32>) -> f32 {
    let first = vec2<i32>(floor(place / width - 0.5));
    var sum = 0.0;
    for (var index = 0; index < 4; index++) { // loops: 4
        sum += glints_cell(place, first + vec2<i32>(index & 1, index >> 1u), width, pixel, halfway);
    }
    // A spot is two tents, 2 half_m to each side; half of the tilts within the chance.
    let mean = 4.0 * pixel.half_m.x * pixel.half_m.y / (width * width) * glints_chance(width);
    let share = clamp(GLINT_PEAK * mean, 0.0, 1.0);
    return 1.0 + share * (sum / mean - 1.0);
}

/// Brightness of the mirror-like part relative to its mean for a pixel on level ground around a place (m): its width (m), unit
/// vector away from the camera, and the cosine of the view to the ground's normal.
fn glints_at(place: vec2<f32>, width_m: f32, along: vec2<f32>, facing: f32, halfway: vec3<f32>) -> f32 {
    let pixel = GlintPixel(along, 0.5 * vec2<f32>(width_m / max(facing, 0.1), width_m));
    let level = log2(4.0 * pixel.half_m.x);
    let octave = floor(level);
    let finer = glints_octave(place, exp2(octave + 1.0), pixel, halfway);
    let coarser = glints_octave(place, exp2(octave + 2.0), pixel, halfway);
    let seen = (1.0 - smoothstep(0.01, 0.06, width_m)) * smoothstep(0.1, 0.3, facing);
    return mix(1.0, mix(finer, coarser, level - octave), seen);
}

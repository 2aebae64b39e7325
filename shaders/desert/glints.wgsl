// Single grains that mirror the sun. Grains lie in square cells as wide as a pixel; a cell's few mirrors are drawn from a hash
// of its place, so that they stay where they are, and fade where a pixel holds so many that they no longer show one by one.
// @import common/noise.wgsl
// @import desert/desert.wgsl

/// Grains of one octave: relative brightness, mean 1, of the cell of a width (m) around a place for a direction halfway between
/// sun and view.
fn glints_octave(place: vec2<f32>, octave: f32, halfway: vec3<f32>) -> f32 {
    let width = exp2(octave);
    let cell = vec2<i32>(floor(place / width));
    let word = noise_pcg(bitcast<u32>(cell.x) + noise_pcg(bitcast<u32>(cell.y) + noise_pcg(bitcast<u32>(i32(octave)))));
    let tilt = vec2<f32>(f32(word & 0xffffu), f32(word >> 16u)) / 32768.0 - 1.0;
    // Chance that one of the grains in the cell is turned right; one grain of 0.4 mm in 20,000.
    let chance = min(width * width / (0.0004 * 0.0004) / 20000.0, 1.0);
    let turn = fract(7.0 * dot(tilt, halfway.xy) + 11.0 * tilt.x + 5.0 * tilt.y);
    return select(0.0, 1.0 / chance, turn < chance);
}

/// Brightness of the mirror-like part relative to its mean, for a pixel that is `footprint_m` wide.
fn glints_at(place: vec2<f32>, footprint_m: f32, halfway: vec3<f32>) -> f32 {
    let level = log2(max(footprint_m, 1e-4));
    let octave = floor(level);
    let share = level - octave;
    let both = mix(glints_octave(place, octave, halfway), glints_octave(place, octave + 1.0, halfway), share);
    let seen = 1.0 - smoothstep(0.01, 0.06, footprint_m);
    return mix(1.0, min(both, 40.0), seen);
}

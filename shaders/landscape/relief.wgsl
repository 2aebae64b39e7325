// Heights of the terrain. Twin: tyndall_scene::landscape::relief.
// @import common/lattice.wgsl
// @import landscape/landscape.wgsl

const RELIEF_OCTAVES: u32 = 13u;
const RELIEF_CREST: f32 = 0.06;
const RELIEF_FLOOR: f32 = 0.06;
const RELIEF_SINK_M: f32 = 60.0;
const RELIEF_MARGIN: f32 = 0.3;
const RELIEF_TAU: f32 = 6.283185307;

/// 3t^2 - 2t^3 between 0 and 1, and its derivative.
fn relief_smooth(at: f32) -> vec2<f32> {
    let t = clamp(at, 0.0, 1.0);
    return vec2<f32>(t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t));
}

/// 1 inside, 0 at the edge of the square and outside (x), and its derivatives (1/m).
fn relief_mask(point: vec2<f32>) -> vec3<f32> {
    let margin = RELIEF_MARGIN * landscape.half_size_m;
    let x = relief_smooth((landscape.half_size_m - abs(point.x)) / margin);
    let y = relief_smooth((landscape.half_size_m - abs(point.y)) / margin);
    return vec3<f32>(x.x * y.x, -sign(point.x) * x.y * y.x / margin, -sign(point.y) * y.y * x.x / margin);
}

/// 0 on the floor of the valley, 1 on its crests (x), and its derivatives (1/m).
fn relief_crest(point: vec2<f32>) -> vec3<f32> {
    if (landscape.valley_m <= 0.0) {
        return vec3<f32>(0.0);
    }
    let bend = 0.5 * landscape.valley_m;
    let angle = RELIEF_TAU * (point.y / (8.0 * landscape.valley_m) + landscape.valley_phase);
    let from_axis = point.x - bend * (sin(angle) - sin(RELIEF_TAU * landscape.valley_phase));
    let turn = -bend * RELIEF_TAU / (8.0 * landscape.valley_m) * cos(angle);
    let crest = relief_smooth((abs(from_axis) / landscape.valley_m - 0.22) / 0.78);
    let slope = crest.y * sign(from_axis) / (0.78 * landscape.valley_m);
    return vec3<f32>(crest.x, slope, slope * turn);
}

/// Sum of the octaves (x) and its derivatives (1/m); octaves finer than twice the footprint are left out gently.
fn relief_octaves(place: vec2<f32>, footprint_m: f32) -> vec3<f32> {
    var point = place / landscape.wavelength_m;
    var frame_x = vec2<f32>(1.0, 0.0); // derivatives of the octave's x
    var frame_y = vec2<f32>(0.0, 1.0);
    var amplitude = 1.0;
    var wavelength = landscape.wavelength_m;
    var sum = vec3<f32>(0.0);
    var slope = vec2<f32>(0.0);
    var bend = vec3<f32>(0.0);
    for (var octave = 0u; octave < RELIEF_OCTAVES; octave++) { // loops: RELIEF_OCTAVES
        let seen = clamp(0.5 * wavelength / max(footprint_m, 1e-3) - 1.0, 0.0, 1.0);
        if (seen <= 0.0) { break; }
        let noise = lattice_noise(point, landscape.key + octave * 0x9e3779b9u);
        let round = sqrt(noise.value * noise.value + RELIEF_CREST * RELIEF_CREST);
        let value = noise.value + landscape.ridge * (1.0 - 2.0 * round - noise.value);
        let first = 1.0 - landscape.ridge - 2.0 * landscape.ridge * noise.value / round;
        let second = -2.0 * landscape.ridge * RELIEF_CREST * RELIEF_CREST / (round * round * round);
        let strength = amplitude * seen;
        let g = noise.gradient;
        let here = strength * first * (frame_x * g.x + frame_y * g.y);
        let inner = first * noise.hessian + second * vec3<f32>(g.x * g.x, g.x * g.y, g.y * g.y);
        // Rows of the frame's transpose times the inner second derivatives.
        let along_x = inner.x * frame_x + inner.y * frame_y;
        let along_y = inner.y * frame_x + inner.z * frame_y;
        let damped = 1.0 / (1.0 + landscape.damping * dot(slope, slope));
        let change = -2.0 * landscape.damping * damped * damped * strength * value;
        let bent = vec2<f32>(dot(bend.xy, slope), dot(bend.yz, slope));
        sum += vec3<f32>(strength * value * damped, here * damped + change * bent);
        bend += strength * vec3<f32>(frame_x.x * along_x.x + frame_y.x * along_y.x, frame_x.x * along_x.y + frame_y.x * along_y.y, frame_x.y * along_x.y + frame_y.y * along_y.y);
        slope += here;
        point = vec2<f32>(1.6 * point.x + 1.2 * point.y + 0.37, 1.6 * point.y - 1.2 * point.x + 0.71);
        let turned = 1.6 * frame_x + 1.2 * frame_y;
        frame_y = 1.6 * frame_y - 1.2 * frame_x;
        frame_x = turned;
        amplitude *= landscape.gain;
        wavelength *= 0.5;
    }
    return vec3<f32>(sum.x, sum.yz / landscape.wavelength_m);
}

/// Altitude (m) at a place (m), x, and the slopes to the east and the north.
fn relief_at(place: vec2<f32>, footprint_m: f32) -> vec3<f32> {
    let mask = relief_mask(place);
    let crest = relief_crest(place);
    let noise = relief_octaves(place, footprint_m);
    let amplitude = landscape.amplitude.x + landscape.amplitude.y * crest.x;
    let raw = landscape.base.x + landscape.base.y * crest.x + amplitude * noise.x;
    // Sediment levels the floors of valleys.
    let round = sqrt(raw * raw + RELIEF_FLOOR * RELIEF_FLOOR);
    let shape = 0.5 * (raw + round);
    let shape_slope = (landscape.base.y + landscape.amplitude.y * noise.x) * crest.yz + amplitude * noise.yz;
    let slope = landscape.height_m * (mask.yz * shape + mask.x * 0.5 * (1.0 + raw / round) * shape_slope) + mask.yz * RELIEF_SINK_M;
    return vec3<f32>(landscape.height_m * mask.x * shape - (1.0 - mask.x) * RELIEF_SINK_M, slope);
}

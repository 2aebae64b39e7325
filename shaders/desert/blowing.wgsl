// Sand in the air over the desert: columns with an optical depth and a mean and a spread of heights, marched from the camera.
// Within a column density follows the derivative of the logistic function, so that a step between two places has an exact
// integral. Mip levels of the columns take the place of what is smaller than a step. Streaks travel with the wind.
// Twin of the columns: tyndall_dunes::blowing. Twin of the integral and of the phase: tests/shaders/blowing.rs.
// @import common/phase.wgsl
// @import desert/desert.wgsl

// Uniform twin: tyndall_render::desert::gpu_data::Blowing.
struct Blowing {
    albedo: vec3<f32>,    // 1, of single grains
    base_m: f32,          // altitude that heights of the columns count from
    along: vec2<f32>,     // unit vector along the wind
    travelled_m: f32,     // way of the streaks so far
    top_m: f32,           // altitude over which there is no sand
    floor_m: f32,         // lowest altitude of the bed
    streaks_a_metre: f32, // sides of the tile of streaks across the wind
    padding: vec2<f32>,
}
@group(2) @binding(12) var<storage, read> blowing: Blowing;
@group(2) @binding(13) var blowing_columns: texture_2d<f32>; // depth; mean height, its scale, height of the light (m)
@group(2) @binding(14) var blowing_streaks: texture_2d<f32>; // 1 on average
@group(2) @binding(15) var blowing_sampler: sampler;         // of the columns
@group(2) @binding(18) var blowing_repeated: sampler;        // of the streaks

/// Steps of a ray, at most, and how much longer each is than the one before it; with the first length (m) they reach 5 km.
const BLOWING_STEPS: i32 = 96;
const BLOWING_GROWTH: f32 = 1.06;
const BLOWING_FIRST_M: f32 = 1.2;
const BLOWING_FAR_M: f32 = 5000.0;

/// Streaks are longer than wide.
const BLOWING_STRETCH: f32 = 4.0;

/// What sand in the air does to a ray.
struct BlownLight {
    transmittance: f32,
    direct: f32,     // share of the light taken away where the lamp shines
    distance_m: f32, // mean, of what is taken away
}

/// Share of a column that is less than `u` scales over its mean height: the logistic function.
fn blowing_below(u: f32) -> f32 {
    return 1.0 / (1.0 + exp(-clamp(u, -30.0, 30.0)));
}

/// Mean over a step of the density of a column of depth 1 and scale 1, whose mean height changes evenly from one end to the
/// other: `a` and `b` are the scales over it there.
fn blowing_mean_density(a: f32, b: f32) -> f32 {
    let middle = blowing_below(0.5 * (a + b));
    let wide = abs(b - a) > 0.05;
    let exact = (blowing_below(b) - blowing_below(a)) / select(1.0, b - a, wide);
    return select(middle * (1.0 - middle), exact, wide);
}

/// Share of what lies over the height `light` between two ends of a step; all heights in scales over the mean one.
fn blowing_lit(a: f32, b: f32, light: f32) -> f32 {
    // A shadow's edge is at least a tenth of a scale wide.
    let low = min(a, b) - 0.05;
    let high = max(a, b) + 0.05;
    let hidden = blowing_below(clamp(light, low, high));
    return (blowing_below(high) - hidden) / max(blowing_below(high) - blowing_below(low), 1e-9);
}

/// Phase function [1/sr] of large irregular grains without what they diffract by less than half a degree: light that went
/// through grains, and light that they reflect.
fn blowing_phase(cosine: f32) -> f32 {
    return phase_double_henyey_greenstein(cosine, vec2<f32>(0.75, -0.1), 0.65);
}

/// Columns around a place (m), those smaller than a footprint (m) together.
fn blowing_at(place: vec2<f32>, footprint_m: f32) -> vec4<f32> {
    let level = log2(max(footprint_m / desert.cell_m, 1.0));
    return textureSampleLevel(blowing_columns, blowing_sampler, desert_map_place(place), level);
}

/// Factor of the streaks on the depth at a place (m), 1 on average: two tiles that travel at different speeds.
fn blowing_streaked(place: vec2<f32>, footprint_m: f32) -> f32 {
    let sides = blowing.streaks_a_metre;
    let texels = f32(textureDimensions(blowing_streaks).x);
    let level = log2(max(footprint_m * sides * texels, 1.0));
    let across = dot(place, vec2<f32>(-blowing.along.y, blowing.along.x));
    let along = dot(place, blowing.along);
    let fast = vec2<f32>((along - blowing.travelled_m) / BLOWING_STRETCH, across) * sides;
    let slow = vec2<f32>((along - 0.8 * blowing.travelled_m) / BLOWING_STRETCH, across) * (0.618 * sides) + 0.37;
    let one = textureSampleLevel(blowing_streaks, blowing_repeated, fast, level).x;
    return 0.5 * one + 0.5 * textureSampleLevel(blowing_streaks, blowing_repeated, slow, level - 0.7).x;
}

/// Part of a ray (m) that may meet sand: from where and how far, for an eye at an altitude (m) and a direction's rise.
fn blowing_span(altitude: f32, rise: f32, limit_m: f32) -> vec2<f32> {
    let slope = select(rise, select(-1e-6, 1e-6, rise >= 0.0), abs(rise) < 1e-6);
    let to_top = (blowing.top_m - altitude) / slope;
    let to_floor = (blowing.floor_m - altitude) / slope;
    let first = max(min(to_top, to_floor), 0.0);
    return vec2<f32>(first, min(max(to_top, to_floor), min(limit_m, first + BLOWING_FAR_M)));
}

/// March from an eye (m: place and altitude) along a direction, at most so far (m).
fn blowing_march(eye: vec3<f32>, direction: vec3<f32>, limit_m: f32) -> BlownLight {
    let span = blowing_span(eye.z, direction.z, limit_m);
    let flat = max(length(direction.xy), 1e-3);
    var light = BlownLight(1.0, 0.0, 0.0);
    var here_m = span.x;
    var step_m = BLOWING_FIRST_M + (BLOWING_GROWTH - 1.0) * span.x;
    var here = blowing_at(eye.xy + here_m * direction.xy, 0.5 * step_m * flat);
    var over = (eye.z + here_m * direction.z - blowing.base_m - here.y) / here.z;
    for (var step = 0; step < BLOWING_STEPS; step++) { // loops: 96
        if (here_m >= span.y || light.transmittance < 0.003) { break; }
        let next_m = min(here_m + step_m, span.y);
        let footprint_m = 0.5 * step_m * flat;
        let next = blowing_at(eye.xy + next_m * direction.xy, footprint_m);
        let height = eye.z + next_m * direction.z - blowing.base_m;
        let next_over = (height - next.y) / next.z;
        let middle_m = 0.5 * (here_m + next_m);
        let streaks = blowing_streaked(eye.xy + middle_m * direction.xy, 0.3 * footprint_m);
        let per_m = 0.5 * (here.x / here.z + next.x / next.z) * blowing_mean_density(over, next_over);
        let fade = 1.0 - smoothstep(0.5, 1.0, (middle_m - span.x) / BLOWING_FAR_M);
        let taken = light.transmittance * (1.0 - exp(-fade * streaks * per_m * (next_m - here_m)));
        let lit = blowing_lit(over, next_over, 0.5 * ((here.w - here.y) / here.z + (next.w - next.y) / next.z));
        light.transmittance -= taken;
        light.direct += lit * taken;
        light.distance_m += taken * middle_m;
        here_m = next_m;
        here = next;
        over = next_over;
        step_m *= BLOWING_GROWTH;
    }
    light.distance_m /= max(1.0 - light.transmittance, 1e-6);
    return light;
}

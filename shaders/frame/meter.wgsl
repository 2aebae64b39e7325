// Reflected-light metering: the mean logarithm of the luminance over a grid of pixels, heavier towards the centre.
// One workgroup adds up in a fixed order, so that a picture is the same bits each time. Writes the gain from frame values
// to exposed values: 18 % grey of the metered mean becomes 0.125 / 1.2 of white (ISO 2720, K = 12.5; saturation-based
// sensitivity, Lmax = 1.2 x 2^EV).
// @import frame/frame.wgsl

@group(1) @binding(1) var meter_frame: texture_2d<f32>;
@group(1) @binding(2) var<storage, read_write> meter_gain: array<f32, 4>;

const METER_GRID: u32 = 96u;
const METER_THREADS: u32 = 256u;
const METER_SAMPLES_PER_THREAD: u32 = 36u;
// The sun's disc is millions of times brighter than the sky and must not decide alone.
const METER_LOG2_SPAN: f32 = 24.0;

var<workgroup> meter_sums: array<vec2<f32>, METER_THREADS>;

/// Weighted log2 of the luminance of a grid point, and the weight.
fn meter_sample(index: u32) -> vec2<f32> {
    let unit = (vec2<f32>(f32(index % METER_GRID), f32(index / METER_GRID)) + 0.5) / f32(METER_GRID);
    let pixel = min(vec2<u32>(unit * vec2<f32>(frame.size_px)), frame.size_px - 1u);
    let value = max(textureLoad(meter_frame, pixel, 0).rgb, vec3<f32>(0.0));
    let luminance = dot(value, vec3<f32>(0.2126729, 0.7151522, 0.072175));
    let from_centre = unit * 2.0 - 1.0;
    let weight = 1.0 - 0.35 * dot(from_centre, from_centre);
    return vec2<f32>(weight * clamp(log2(max(luminance, 1e-12)), -METER_LOG2_SPAN, METER_LOG2_SPAN), weight);
}

@compute @workgroup_size(256, 1, 1)
fn meter(@builtin(local_invocation_index) thread: u32) {
    if (thread >= METER_THREADS) { return; }
    var sum = vec2<f32>(0.0);
    for (var i = 0u; i < METER_SAMPLES_PER_THREAD; i++) { // loops: METER_SAMPLES_PER_THREAD
        sum += meter_sample(i * METER_THREADS + thread);
    }
    meter_sums[thread] = sum;
    workgroupBarrier();
    if (thread != 0u) { return; }
    for (var i = 1u; i < METER_THREADS; i++) { // loops: METER_THREADS
        sum += meter_sums[i];
    }
    let metered = 0.125 / (1.2 * exp2(sum.x / sum.y)) * frame.compensation;
    meter_gain[0] = select(frame.manual_gain, metered, frame.auto_exposure == 1u);
}

//! Twins of `shaders/common/noise.wgsl`: integers, so equal to the bit.

use tyndall_render::dither;
use tyndall_tests::Tolerance;

use super::NONE;

/// Both sides cut a float to a whole number in the same way.
#[expect(clippy::cast_possible_truncation, reason = "inputs are below 2^24")]
fn whole(x: f64) -> u32 {
    x as u32
}

fn word(x: [f64; 4]) -> u32 {
    whole(x[0]).wrapping_mul(4099).wrapping_add(whole(x[1]))
}

twins! { "common/noise.wgsl";
    // The halves of a word are exact as f32.
    noise_pcg in [0.0..=16_777_215.0, 0.0..=16_777_215.0, NONE, NONE], within Tolerance::absolute(0.0), {
        "f32(noise_pcg(u32(x.x) * 4099u + u32(x.y)) >> 16u)" => |x| f64::from(dither::noise_pcg(word(x)) >> 16),
        "f32(noise_pcg(u32(x.x) * 4099u + u32(x.y)) & 0xffffu)" => |x| f64::from(dither::noise_pcg(word(x)) & 0xffff),
    }
    // Both terms are whole numbers below 2^24 before the exact division.
    noise_triangular in [0.0..=16384.0, 0.0..=16384.0, 0.0..=3.0, NONE], within Tolerance::absolute(0.0), {
        "noise_triangular(vec2<u32>(x.xy), u32(x.z))"
            => |x| dither::noise_triangular([whole(x[0]), whole(x[1])], whole(x[2])),
    }
    // Eight products of weights, with coordinates whose fraction f32 keeps to 4e-6.
    noise_value in [-60.0..=60.0, -60.0..=60.0, -60.0..=60.0, NONE], within Tolerance::absolute(2e-5), {
        "noise_value(x.xyz)" => |x| dither::noise_value([x[0], x[1], x[2]]),
    }
}

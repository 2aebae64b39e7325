//! Twins of `shaders/common/grain.wgsl`: the upper and the lower half of every word, exactly.

use tyndall_dunes::hash::{cell_word, mix, next_word};
use tyndall_tests::Tolerance;

use super::NONE;

#[expect(clippy::cast_possible_truncation, reason = "inputs lie between 0 and 2^24")]
fn whole(x: f64) -> u32 {
    x as u32
}

/// Inputs are spread over all bits, the same way on both sides.
fn spread(x: f64) -> u32 {
    whole(x).wrapping_mul(0x0101_0101)
}

fn halves(word: u32) -> [f64; 2] {
    [word >> 16, word & 0xFFFF].map(f64::from)
}

twins! { "common/grain.wgsl";
    grain_mix in [0.0..=16_777_215.0, NONE, NONE, NONE], within Tolerance::absolute(0.0), {
        "f32(grain_mix(u32(x.x) * 0x01010101u) >> 16u)" => |x| halves(mix(spread(x[0])))[0],
        "f32(grain_mix(u32(x.x) * 0x01010101u) & 0xFFFFu)" => |x| halves(mix(spread(x[0])))[1],
    }
    grain_cell_word in [0.0..=16_777_215.0, 0.0..=16_777_215.0, NONE, NONE], within Tolerance::absolute(0.0), {
        "f32(grain_cell_word(u32(x.x) * 0x01010101u, u32(x.y)) >> 16u)"
            => |x| halves(cell_word(spread(x[0]), whole(x[1])))[0],
        "f32(grain_cell_word(u32(x.x) * 0x01010101u, u32(x.y)) & 0xFFFFu)"
            => |x| halves(cell_word(spread(x[0]), whole(x[1])))[1],
    }
    grain_next_word in [0.0..=16_777_215.0, NONE, NONE, NONE], within Tolerance::absolute(0.0), {
        "f32(grain_next_word(u32(x.x) * 0x01010101u) >> 16u)" => |x| halves(next_word(spread(x[0])))[0],
        "f32(grain_next_word(u32(x.x) * 0x01010101u) & 0xFFFFu)" => |x| halves(next_word(spread(x[0])))[1],
    }
}

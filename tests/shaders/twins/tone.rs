//! Twins of `shaders/common/tone.wgsl`. Display values are steps of 1/255 = 4e-3 in the end; pow is off by 12 units in the
//! last place, and each curve takes a few.

use tyndall_render::tone;
use tyndall_tests::Tolerance;

use super::NONE;

fn rgb(x: [f64; 4]) -> [f64; 3] {
    [x[0], x[1], x[2]]
}

twins! { "common/tone.wgsl";
    tone_srgb_encode in [-0.5..=1.5, NONE, NONE, NONE], within Tolerance::absolute(3e-6), {
        "tone_srgb_encode(x.x)" => |x| tone::tone_srgb_encode(x[0]),
    }
    tone_agx_curve in [0.0..=1.0, NONE, NONE, NONE], within Tolerance::absolute(3e-6), {
        "tone_agx_curve(x.x)" => |x| tone::tone_agx_curve(x[0]),
    }
    tone_agx in [-0.1..=16.0, -0.1..=16.0, -0.1..=16.0, NONE], within Tolerance::absolute(5e-6), {
        "tone_agx(x.xyz).x" => |x| tone::tone_agx(rgb(x))[0],
        "tone_agx(x.xyz).y" => |x| tone::tone_agx(rgb(x))[1],
        "tone_agx(x.xyz).z" => |x| tone::tone_agx(rgb(x))[2],
    }
    tone_look in [-0.1..=1.0, 0.5..=2.0, 0.0..=2.0, NONE], within Tolerance::absolute(3e-6), {
        "tone_look(vec3<f32>(x.x, 0.5, 1.0 - x.x), x.y, x.z).x" => |x| tone::tone_look([x[0], 0.5, 1.0 - x[0]], x[1], x[2])[0],
        "tone_look(vec3<f32>(x.x, 0.5, 1.0 - x.x), x.y, x.z).z" => |x| tone::tone_look([x[0], 0.5, 1.0 - x[0]], x[1], x[2])[2],
    }
    tone_aces in [-0.1..=16.0, -0.1..=16.0, -0.1..=16.0, NONE], within Tolerance::absolute(3e-6), {
        "tone_aces(x.xyz).x" => |x| tone::tone_aces(rgb(x))[0],
        "tone_aces(x.xyz).y" => |x| tone::tone_aces(rgb(x))[1],
        "tone_aces(x.xyz).z" => |x| tone::tone_aces(rgb(x))[2],
    }
}

//! Twins of `shaders/common/lattice.wgsl`.

use tyndall_core::rng::noise_pcg;
use tyndall_scene::landscape::noise;
use tyndall_tests::Tolerance;

use super::NONE;

/// Lattice points: both sides cut a float to a whole number in the same way.
#[expect(clippy::cast_possible_truncation, reason = "inputs are below 2^24")]
fn whole(x: f64) -> i32 {
    x as i32
}

fn at(x: [f64; 4]) -> noise::Noise {
    noise::lattice_noise(x[0], x[1], 7)
}

twins! { "common/lattice.wgsl";
    lattice_value in [-4000.0..=4000.0, -4000.0..=4000.0, NONE, NONE], within Tolerance::absolute(1e-7), {
        "lattice_value(i32(x.x), noise_pcg(bitcast<u32>(i32(x.y)) + 7u))" => |x| noise::lattice_value(whole(x[0]), whole(x[1]), 7),
        "lattice_value(i32(x.x), noise_pcg(9u))" => |x| {
            f64::from(noise_pcg(whole(x[0]).cast_unsigned().wrapping_add(noise_pcg(9))) >> 8) / 8_388_608.0 - 1.0
        },
    }
    lattice_blend in [0.0..=1.0, NONE, NONE, NONE], within Tolerance::absolute(2e-5), {
        "lattice_blend(x.x).x" => |x| noise::lattice_blend(x[0])[0],
        "lattice_blend(x.x).y" => |x| noise::lattice_blend(x[0])[1],
        "lattice_blend(x.x).z" => |x| noise::lattice_blend(x[0])[2],
    }
    // Places of the first few hundred cells, where f32 keeps a fraction to 3e-5; second derivatives change by 60 a cell.
    lattice_noise in [-200.0..=200.0, -200.0..=200.0, NONE, NONE], within Tolerance::absolute(4e-3), {
        "lattice_noise(x.xy, 7u).value" => |x| at(x).value,
        "lattice_noise(x.xy, 7u).gradient.x" => |x| at(x).gradient[0],
        "lattice_noise(x.xy, 7u).gradient.y" => |x| at(x).gradient[1],
        "lattice_noise(x.xy, 7u).hessian.x" => |x| at(x).hessian[0],
        "lattice_noise(x.xy, 7u).hessian.y" => |x| at(x).hessian[1],
        "lattice_noise(x.xy, 7u).hessian.z" => |x| at(x).hessian[2],
    }
}

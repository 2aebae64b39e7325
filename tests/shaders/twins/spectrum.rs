//! Twins of `shaders/common/spectrum.wgsl`: eight numbers, one after the other.

use tyndall_tests::Tolerance;

/// The eight values of `Spectrum(x, x.wzyx)`.
fn eight(x: [f64; 4]) -> [f64; 8] {
    [x[0], x[1], x[2], x[3], x[3], x[2], x[1], x[0]]
}

/// The eight values of `Spectrum(x.yzwx, x)`.
fn other(x: [f64; 4]) -> [f64; 8] {
    [x[1], x[2], x[3], x[0], x[0], x[1], x[2], x[3]]
}

twins! { "common/spectrum.wgsl";
    // One rounding; the values add up to 10 at most.
    spectrum_add in [0.0..=5.0, 0.0..=5.0, 0.0..=5.0, 0.0..=5.0], within Tolerance::absolute(1e-6), {
        "spectrum_add(Spectrum(x, x.wzyx), Spectrum(x.yzwx, x)).lo.y" => |x| eight(x)[1] + other(x)[1],
        "spectrum_add(Spectrum(x, x.wzyx), Spectrum(x.yzwx, x)).hi.w" => |x| eight(x)[7] + other(x)[7],
    }
    spectrum_mul in [0.0..=5.0, 0.0..=5.0, 0.0..=5.0, 0.0..=5.0], within Tolerance::relative(2e-7), {
        "spectrum_mul(Spectrum(x, x.wzyx), Spectrum(x.yzwx, x)).lo.x" => |x| eight(x)[0] * other(x)[0],
        "spectrum_mul(Spectrum(x, x.wzyx), Spectrum(x.yzwx, x)).hi.z" => |x| eight(x)[6] * other(x)[6],
    }
    spectrum_scale in [0.0..=5.0, 0.0..=5.0, 0.0..=5.0, -5.0..=5.0], within Tolerance::relative(2e-7), {
        "spectrum_scale(Spectrum(x, x.wzyx), x.w).lo.z" => |x| eight(x)[2] * x[3],
        "spectrum_scale(Spectrum(x, x.wzyx), x.w).hi.y" => |x| eight(x)[5] * x[3],
    }
    // exp is off by 16 units in the last place near 20.
    spectrum_transmittance in [0.0..=20.0, 0.0..=20.0, 0.0..=20.0, 0.0..=20.0], within Tolerance::relative(2e-6), {
        "spectrum_transmittance(Spectrum(x, x.wzyx)).lo.w" => |x| (-eight(x)[3]).exp(),
        "spectrum_transmittance(Spectrum(x, x.wzyx)).hi.x" => |x| (-eight(x)[4]).exp(),
    }
    // Eight products of up to 25 and their sum.
    spectrum_dot in [-5.0..=5.0, -5.0..=5.0, -5.0..=5.0, -5.0..=5.0], within Tolerance::absolute(5e-5), {
        "spectrum_dot(Spectrum(x, x.wzyx), Spectrum(x.yzwx, x))"
            => |x| eight(x).iter().zip(other(x)).map(|(a, b)| a * b).sum(),
    }
}

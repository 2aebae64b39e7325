//! Twins of `shaders/common/phase.wgsl`.

use tyndall_scattering::phase;
use tyndall_tests::Tolerance;

use super::NONE;

twins! { "common/phase.wgsl";
    // Four roundings.
    phase_rayleigh in [-1.0..=1.0, NONE, NONE, NONE], within Tolerance::relative(5e-7), {
        "phase_rayleigh(x.x)" => |x| phase::phase_rayleigh(x[0]),
    }
    // The denominator cancels in the forward peak: (1 - g)^2 = 0.0025 left of terms of 2, so 1.5 * 2 / 0.0025 roundings.
    phase_cornette_shanks in [-1.0..=1.0, -0.95..=0.95, NONE, NONE], within Tolerance::relative(1.5e-4), {
        "phase_cornette_shanks(x.x, x.y)" => |x| phase::phase_cornette_shanks(x[0], x[1]),
    }
    phase_henyey_greenstein in [-1.0..=1.0, -0.95..=0.95, NONE, NONE], within Tolerance::relative(1.5e-4), {
        "phase_henyey_greenstein(x.x, x.y)" => |x| phase::phase_henyey_greenstein(x[0], x[1]),
    }
    phase_double_henyey_greenstein in [-1.0..=1.0, 0.0..=0.95, -0.95..=0.0, 0.0..=1.0], within Tolerance::relative(1.5e-4), {
        "phase_double_henyey_greenstein(x.x, x.yz, x.w)" => |x| {
            phase::phase_double_henyey_greenstein(x[0], [x[1], x[2]], x[3])
        },
    }
    // Powers of numbers below 1 add some roundings for each order, 20 of them here.
    phase_of_orders in [-1.0..=1.0, 1.5..=20.0, 0.1..=0.95, 0.5..=1.0], within Tolerance::relative(3e-4), {
        "phase_of_orders(x.x, x.y, vec2<f32>(x.z, -0.5 * x.z), x.w)" => |x| {
            phase::phase_of_orders(x[0], x[1], [x[2], -0.5 * x[2]], x[3])
        },
    }
}

//! Twins of `shaders/common/sand.wgsl`. Radiance is wanted to a thousandth; exp and pow are off by units in the last place.

use tyndall_render::desert::reflection;
use tyndall_tests::Tolerance;

use super::NONE;

twins! { "common/sand.wgsl";
    sand_below in [-5.0..=5.0, NONE, NONE, NONE], within Tolerance::absolute(1e-6), {
        "sand_below(x.x)" => |x| reflection::sand_below(x[0]),
    }
    sand_mean_cosine in [-1.0..=1.0, 0.0..=0.2, NONE, NONE], within Tolerance::absolute(2e-6), {
        "sand_mean_cosine(x.x, x.y)" => |x| reflection::sand_mean_cosine(x[0], x[1]),
    }
    sand_facets in [0.0..=1.0, 0.02..=1.0, -1.0..=1.0, 0.0..=0.6], within Tolerance::relative(1e-5), {
        "sand_facets(x.x, x.y, x.z, x.w)" => |x| reflection::sand_facets(x[0], x[1], x[2], x[3]),
    }
    sand_backscatter in [-1.0..=1.0, NONE, NONE, NONE], within Tolerance::relative(1e-5), {
        "sand_backscatter(x.x)" => |x| reflection::sand_backscatter(x[0]),
    }
    sand_mirror in [-0.5..=0.5, 0.5..=1.0, -0.3..=0.3, 0.1..=0.2], within Tolerance::relative(1e-4), {
        "sand_mirror(vec3<f32>(x.x, 0.1, x.y), vec2<f32>(x.z, 0.2), vec3<f32>(x.w, 0.01, 0.1), 0.5, x.y)" => |x| reflection::sand_mirror([x[0], f64::from(0.1_f32), x[1]], [x[2], f64::from(0.2_f32)], [x[3], f64::from(0.01_f32), f64::from(0.1_f32)], 0.5, x[1]),
    }
}

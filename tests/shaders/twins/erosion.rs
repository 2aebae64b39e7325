//! Twins of `shaders/common/erosion.wgsl`.

use tyndall_clouds::turbulence;
use tyndall_tests::Tolerance;

use super::NONE;

twins! { "common/erosion.wgsl";
    // The root has a steep start, and the softest edge of 0.05 magnifies rounding by 20.
    eroded_share in [0.0..=1.0, 0.0..=1.0, 0.05..=1.0, NONE], within Tolerance::absolute(1e-4), {
        "eroded_share(x.x, x.y, x.z)" => |x| turbulence::eroded_share(x[0], x[1], x[2]),
    }
}

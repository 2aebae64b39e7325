// Adds an order to the sum of all. The last one counts for all that follow, as the geometric series that it and the order
// before begin. A thread per node, one more per sun for the irradiance. Twin: tyndall_scattering::orders::build.
// @import sky/orders.wgsl
// @import sky/orders_basis.wgsl

@group(0) @binding(11) var<storage, read> orders_before: array<vec4<f32>>;
@group(0) @binding(12) var<storage, read> orders_last: array<vec4<f32>>;
@group(0) @binding(13) var<storage, read_write> orders_total: array<vec4<f32>>;

override ORDERS_TAIL: u32 = 0u; // 0..=1, 1 for the last order

/// Largest ratio of two successive orders that is believed.
const ORDERS_LARGEST_RATIO: f32 = 0.95;

/// 1 / (1 - ratio) where the order before is not dark.
fn orders_series(last: vec4<f32>, before: vec4<f32>) -> vec4<f32> {
    let ratio = clamp(last / max(before, vec4<f32>(1e-30)), vec4<f32>(0.0), vec4<f32>(ORDERS_LARGEST_RATIO));
    return 1.0 / (1.0 - select(vec4<f32>(0.0), ratio, before > vec4<f32>(1e-30)));
}

@compute @workgroup_size(64, 1, 1)
fn orders_sum(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x >= (orders.suns_above + orders.suns_below) * (orders.altitudes + 1u)) { return; }
    let nodes = orders_suns() * orders.altitudes;
    let on_ground = id.x >= nodes;
    let stride = 2u * orders_harmonics();
    let first = select(id.x * stride, orders_irradiance_start() + 2u * (id.x - min(nodes, id.x)), on_ground);
    let count = select(orders_harmonics(), 1u, on_ground);
    for (var half = 0u; half < 2u; half++) { // loops: 2
        var factor = vec4<f32>(1.0);
        if (ORDERS_TAIL == 1u) {
            factor = orders_series(orders_last[first + half], orders_before[first + half]);
        }
        for (var k = 0u; k < count; k++) { // loops: ORDERS_HARMONICS
            let index = first + 2u * k + half;
            orders_total[index] += factor * orders_last[index];
        }
    }
}

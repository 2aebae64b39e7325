// Altitudes of the orders' table, quadratically dense at the ground. Twin: tyndall_scattering::orders::nodes.
// @import sky/atmosphere.wgsl
// @import sky/orders_suns.wgsl

/// Altitude (m) of a node.
fn orders_altitude(index: u32) -> f32 {
    let share = f32(index) / f32(orders.altitudes - 1u);
    return atmosphere.top_altitude_m * share * share;
}

/// Place of an altitude (m).
fn orders_altitude_place(h: f32) -> OrdersPlace {
    let share = sqrt(clamp(h / atmosphere.top_altitude_m, 0.0, 1.0));
    return orders_place(share * f32(orders.altitudes - 1u), orders.altitudes);
}

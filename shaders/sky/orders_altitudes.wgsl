// Altitudes of the orders' table, quadratically dense at the ground; in haze dense at both ends of its even part and at
// its top. Twin: tyndall_scattering::orders::nodes.
//
// Values are selected, not branched over: with branches on uniforms here, passes that read this beside several other
// uniforms crash lavapipe 22.3 while it specialises them.
// @import sky/atmosphere.wgsl
// @import sky/orders_suns.wgsl

/// Altitudes below the end of the haze.
fn orders_haze_nodes() -> u32 {
    return orders.haze_even + orders.haze_thinning;
}

/// Altitude (m) of a node.
fn orders_altitude(index: u32) -> f32 {
    let below = orders_haze_nodes();
    let top = atmosphere.haze_top_m;
    let in_even = f32(index) / f32(max(orders.haze_even, 1u));
    let from_end = min(in_even, 1.0 - in_even);
    let part = 2.0 * from_end * from_end;
    let even = top * select(1.0 - part, part, in_even < 0.5);
    let in_thinning = f32(index - min(index, orders.haze_even)) / f32(max(orders.haze_thinning, 1u));
    let thinning = top + (atmosphere.haze_zone_m - top) * in_thinning * in_thinning;
    let end = select(0.0, atmosphere.haze_zone_m, below > 0u);
    let in_clear = f32(index - min(index, below)) / f32(orders.altitudes - below - 1u);
    let clear = end + (atmosphere.top_altitude_m - end) * in_clear * in_clear;
    return select(select(clear, thinning, index < below), even, index < orders.haze_even);
}

/// Place of an altitude (m) in haze, where values are linear in the altitude.
fn orders_haze_place(h: f32) -> OrdersPlace {
    let top = atmosphere.haze_top_m;
    let thin = sqrt(max(h - top, 0.0) / max(atmosphere.haze_zone_m - top, 1e-3));
    let thinning = orders.haze_even + min(u32(thin * f32(orders.haze_thinning)), max(orders.haze_thinning, 1u) - 1u);
    let part = clamp(h / max(top, 1e-3), 0.0, 1.0);
    let share = select(1.0 - sqrt(0.5 * (1.0 - part)), sqrt(0.5 * part), part < 0.5);
    let even = min(u32(share * f32(orders.haze_even)), max(orders.haze_even, 1u) - 1u);
    let index = select(even, thinning, h >= top);
    let low = orders_altitude(index);
    return OrdersPlace(index, clamp((h - low) / (orders_altitude(index + 1u) - low), 0.0, 1.0));
}

/// Place of an altitude (m).
fn orders_altitude_place(h: f32) -> OrdersPlace {
    let below = orders_haze_nodes();
    let end = select(0.0, atmosphere.haze_zone_m, below > 0u);
    let haze = orders_haze_place(clamp(h, 0.0, end));
    let share = sqrt(clamp((h - end) / (atmosphere.top_altitude_m - end), 0.0, 1.0));
    let clear = orders_place(share * f32(orders.altitudes - below - 1u), orders.altitudes - below);
    let in_haze = h < end;
    return OrdersPlace(select(clear.index + below, haze.index, in_haze), select(clear.fraction, haze.fraction, in_haze));
}

// Altitudes of the orders' table, quadratically dense at the ground; in haze dense at both ends of its even part and at
// its top. Twin: tyndall_scattering::orders::nodes.
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
    if (index < orders.haze_even) {
        let share = f32(index) / f32(orders.haze_even);
        let from_end = min(share, 1.0 - share);
        let part = 2.0 * from_end * from_end;
        return top * select(1.0 - part, part, share < 0.5);
    }
    if (index < below) {
        let share = f32(index - orders.haze_even) / f32(orders.haze_thinning);
        return top + (atmosphere.haze_zone_m - top) * share * share;
    }
    let end = select(0.0, atmosphere.haze_zone_m, below > 0u);
    let share = f32(index - below) / f32(orders.altitudes - below - 1u);
    return end + (atmosphere.top_altitude_m - end) * share * share;
}

/// Place of an altitude (m) in haze, where values are linear in the altitude.
fn orders_haze_place(h: f32) -> OrdersPlace {
    let top = atmosphere.haze_top_m;
    var index = 0u;
    if (h >= top) {
        let share = sqrt((h - top) / (atmosphere.haze_zone_m - top));
        index = orders.haze_even + min(u32(share * f32(orders.haze_thinning)), orders.haze_thinning - 1u);
    } else {
        let part = h / top;
        let share = select(1.0 - sqrt(0.5 * (1.0 - part)), sqrt(0.5 * part), part < 0.5);
        index = min(u32(share * f32(orders.haze_even)), orders.haze_even - 1u);
    }
    let low = orders_altitude(index);
    return OrdersPlace(index, clamp((h - low) / (orders_altitude(index + 1u) - low), 0.0, 1.0));
}

/// Place of an altitude (m).
fn orders_altitude_place(h: f32) -> OrdersPlace {
    let below = orders_haze_nodes();
    // No branch depends on the uniform alone: see aerial/aerial.wgsl.
    let end = select(0.0, atmosphere.haze_zone_m, below > 0u);
    if (h < end) {
        return orders_haze_place(max(h, 0.0));
    }
    let share = sqrt(clamp((h - end) / (atmosphere.top_altitude_m - end), 0.0, 1.0));
    let place = orders_place(share * f32(orders.altitudes - below - 1u), orders.altitudes - below);
    return OrdersPlace(place.index + below, place.fraction);
}

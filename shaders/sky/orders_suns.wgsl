// Suns of the orders' table: evenly spaced in the cosine below the horizon, dense at the horizon above it.
// Twin: tyndall_scattering::orders::nodes.
// @import sky/orders.wgsl

const ORDERS_TWILIGHT_FALL: f32 = 17.0;
const ORDERS_HORIZON_SPACING: f32 = 0.3;

/// A place between two neighbouring nodes: the lower one, and the weight of the upper one.
struct OrdersPlace {
    index: u32,
    fraction: f32,
}

fn orders_place(position: f32, count: u32) -> OrdersPlace {
    let index = min(u32(position), count - 2u);
    return OrdersPlace(index, position - f32(index));
}

/// Zenith cosine of the sun of a node.
fn orders_mu_sun(index: u32) -> f32 {
    if (index < orders.suns_below) {
        return orders.lowest_mu_sun * (1.0 - f32(index) / f32(orders.suns_below));
    }
    let share = f32(index - orders.suns_below) / f32(orders.suns_above - 1u);
    return share * (ORDERS_HORIZON_SPACING + (1.0 - ORDERS_HORIZON_SPACING) * share);
}

/// Place of a sun's zenith cosine; below the horizon values are linear in exp(ORDERS_TWILIGHT_FALL mu_sun / lowest).
fn orders_sun_place(mu_sun: f32) -> OrdersPlace {
    if (mu_sun < 0.0) {
        let depth = min(mu_sun / orders.lowest_mu_sun, 1.0);
        let place = orders_place((1.0 - depth) * f32(orders.suns_below), orders.suns_below + 1u);
        let step = ORDERS_TWILIGHT_FALL / f32(orders.suns_below);
        return OrdersPlace(place.index, (exp(place.fraction * step) - 1.0) / (exp(step) - 1.0));
    }
    let mu = min(mu_sun, 1.0);
    let a = ORDERS_HORIZON_SPACING;
    let share = 2.0 * mu / (a + sqrt(a * a + 4.0 * (1.0 - a) * mu));
    let place = orders_place(share * f32(orders.suns_above - 1u), orders.suns_above);
    return OrdersPlace(place.index + orders.suns_below, place.fraction);
}

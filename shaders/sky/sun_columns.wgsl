// What lies between the observer and what stands outside the atmosphere.
// @import sky/column_lookup.wgsl
// @import sky/view.wgsl

/// Columns [m] from the observer to the top of the atmosphere at a zenith cosine that misses the ground.
fn sun_columns(mu_view: f32) -> vec4<f32> {
    let radius = atmosphere.planet_radius_m;
    let top = atmosphere.top_altitude_m;
    let h = sky_view.observer_altitude_m;
    let entry = sky_entry_distance(mu_view);
    if (entry < 0.0) {
        return vec4<f32>(0.0);
    }
    let inside = min(h, top);
    let mu = select(mu_along(radius, h, mu_view, 1.0, entry, top), mu_view, entry == 0.0);
    return columns_to_top(inside, max(mu, horizon_mu(radius, inside)));
}

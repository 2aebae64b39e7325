// Rays of the texels of the sky-view table. Twin: tyndall_scattering::sky_view_table.
// @import sky/march_path.wgsl
// @import sky/sky_view_map.wgsl

/// The ray of an elevation and an azimuth (rad) from where it enters the atmosphere; mu above 1 marks a ray that misses it.
fn sky_view_ray(angles: vec2<f32>) -> Ray {
    let mu = sin(angles.x);
    let mu_sun = sky_view.sun_direction.z;
    let sines = cos(angles.x) * sqrt(max((1.0 - mu_sun) * (1.0 + mu_sun), 0.0));
    let nu = clamp(mu * mu_sun + sines * cos(angles.y), -1.0, 1.0);
    let h = sky_view.observer_altitude_m;
    let entry = sky_entry_distance(mu);
    if (entry < 0.0) {
        return Ray(0.0, 2.0, 0.0, 0.0);
    }
    if (entry == 0.0) {
        return Ray(h, mu, mu_sun, nu);
    }
    let radius = atmosphere.planet_radius_m;
    let top = atmosphere.top_altitude_m;
    return Ray(top, mu_along(radius, h, mu, 1.0, entry, top), mu_along(radius, h, mu_sun, nu, entry, top), nu);
}

/// Length of a ray. The row decides on which side of the horizon it ends; at the horizon itself rounding must not.
fn sky_view_length(ray: Ray, above: bool) -> f32 {
    let radius = atmosphere.planet_radius_m;
    if (above) {
        return distance_to_top(radius, atmosphere.top_altitude_m, ray.h, ray.mu);
    }
    let to_ground = distance_to_ground(radius, ray.h, ray.mu);
    return select(to_ground, max(-(radius + ray.h) * ray.mu, 0.0), to_ground < 0.0);
}

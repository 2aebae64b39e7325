// Order 1 of the table: light scattered once, with exact phase functions, and sunlight from the ground. A workgroup per
// altitude (x) and sun (y). Twin: tyndall_scattering::orders::build.
// @import sky/march.wgsl
// @import sky/orders_project.wgsl

/// Radiance in a direction (W/m^2/sr/nm).
fn orders_first_radiance(h: f32, mu_sun: f32, direction: OrdersDirection) -> Spectrum {
    let ray = orders_ray(h, mu_sun, direction);
    let length = orders_length(ray, direction.above);
    let march = march_ray(ray, length, orders.panels);
    let light = march_radiance(march.light, atmosphere_phases(ray.nu));
    let mu_ground = mu_along(atmosphere.planet_radius_m, h, mu_sun, ray.nu, length, 0.0);
    if (direction.above || mu_ground <= 0.0) {
        return light;
    }
    let sun = spectrum_mul(atmosphere.solar_irradiance, atmosphere_transmittance(columns_to_top(0.0, mu_ground)));
    return spectrum_add(light, orders_reflected(spectrum_scale(sun, mu_ground), march.columns));
}

@compute @workgroup_size(64, 1, 1)
fn orders_first(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) thread: u32) {
    if (any(vec2<u32>(group.x, group.y + orders_first_sun.x) >= vec2<u32>(orders.altitudes, orders.suns_above + orders.suns_below))) { return; }
    let sun = group.y + orders_first_sun.x;
    let h = orders_altitude(group.x);
    for (var i = 0u; i < ORDERS_DIRECTIONS_PER_THREAD; i++) { // loops: ORDERS_DIRECTIONS_PER_THREAD
        let index = thread + i * ORDERS_THREADS;
        if (index < orders_directions()) {
            let light = orders_first_radiance(h, orders_mu_sun(sun), orders_direction(h, index));
            orders_lo[index] = light.lo;
            orders_hi[index] = light.hi;
        }
    }
    workgroupBarrier();
    orders_project(thread, group.x, sun);
}

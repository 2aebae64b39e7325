// Fills the table of sunlight and skylight on surfaces. One altitude and sun per invocation.
// Twin: tyndall_scattering::sky_light. Where the table of orders does not serve surfaces the sky is as bright in all directions as its
// irradiance on level ground says, above a ground that is lit by it and the sun.
// @import sky/column_lookup.wgsl
// @import sky/ground_light.wgsl
// @import sky/light.wgsl
// @import sky/orders_altitudes.wgsl
// @import sky/orders_basis.wgsl
// @import sky/orders_source.wgsl

@group(0) @binding(23) var sky_light_texels: texture_storage_2d<rgba16float, write>;

const LIGHT_PI: f32 = 3.1415926535;
/// What the clamped cosine leaves of degrees 0 to 4, and of degree 6 (sr).
const LIGHT_COSINE_MOMENTS = array<f32, 5>(3.1415926535, 2.0943951024, 0.7853981634, 0.0, -0.1308996939);
const LIGHT_COSINE_MOMENT_6: f32 = 0.0490873852;

fn light_store(id: vec2<u32>, layer: u32, light: Spectrum, factor: f32) {
    let lux = factor * atmosphere_rec709(light);
    textureStore(sky_light_texels, vec2<u32>(id.x, layer * SKY_LIGHT_ALTITUDES + id.y), vec4<f32>(lux / sky_light.lux, 1.0));
}

/// Sunlight on a surface that faces the sun (W/m^2/nm).
fn light_of_sun(h: f32, mu_sun: f32) -> Spectrum {
    let horizon = horizon_mu(atmosphere.planet_radius_m, h);
    let visible = clamp(0.5 + 0.5 * (mu_sun - horizon) / sin(sky_view.sun_angular_radius), 0.0, 1.0);
    let columns = columns_to_top(h, max(mu_sun, horizon));
    return spectrum_scale(spectrum_mul(atmosphere.solar_irradiance, atmosphere_transmittance(columns)), visible);
}

/// Factor on the light of the table of orders; 0 where it does not serve surfaces.
fn light_factor() -> f32 {
    return orders.brightness * f32(orders.lights_surfaces);
}

/// A harmonic of the radiance between the table's nodes.
fn light_harmonic(h: f32, sun: OrdersPlace, k: u32) -> Spectrum {
    let altitude = orders_altitude_place(h);
    let stride = 2u * orders_harmonics();
    let first = (sun.index * orders.altitudes + altitude.index) * stride + 2u * k;
    let next = stride * orders.altitudes;
    let low = spectrum_add(spectrum_scale(orders_load(first), 1.0 - altitude.fraction), spectrum_scale(orders_load(first + stride), altitude.fraction));
    let high = spectrum_add(spectrum_scale(orders_load(first + next), 1.0 - altitude.fraction), spectrum_scale(orders_load(first + next + stride), altitude.fraction));
    return spectrum_add(spectrum_scale(low, 1.0 - sun.fraction), spectrum_scale(high, sun.fraction));
}

/// All harmonics of the source table, after the cosine.
fn light_of_orders(id: vec2<u32>, h: f32, mu_sun: f32) {
    let sun = orders_sun_place(mu_sun);
    let sky = ground_sky_irradiance(mu_sun);
    let ground = spectrum_mul(atmosphere.ground_albedo, spectrum_add(sky, ground_sun_irradiance(mu_sun)));
    let zero = Spectrum(vec4<f32>(0.0), vec4<f32>(0.0));
    var third = zero;
    var fourth = zero;
    var layer = 1u;
    for (var l = 0u; l < ORDERS_DEGREES; l++) { // loops: ORDERS_DEGREES
        for (var m = 0u; m <= l; m++) { // loops: ORDERS_DEGREES
            // No branch depends on the uniform alone: see aerial/aerial.wgsl.
            let k = min(l * (l + 1u) / 2u + m, orders_harmonics() - 1u);
            let light = spectrum_scale(light_harmonic(h, sun, k), select(0.0, 1.0, l <= orders.degree));
            let about_sun = spectrum_scale(light, orders_harmonic(l, m, mu_sun, 1.0) * 4.0 * LIGHT_PI / f32(2u * l + 1u));
            if (l == 3u) { third = spectrum_add(third, about_sun); }
            if (l == 4u) { fourth = spectrum_add(fourth, about_sun); }
            if (l != 3u) {
                let scattered = spectrum_scale(light, LIGHT_COSINE_MOMENTS[l] * light_factor());
                light_store(id, layer, spectrum_add(scattered, light_of_uniform_sky(layer, sky, ground)), 1.0);
                layer += 1u;
            }
        }
    }
    let ratio = Spectrum(clamp(fourth.lo / max(third.lo, vec4<f32>(1e-20)), vec4<f32>(0.0), vec4<f32>(1.0)), clamp(fourth.hi / max(third.hi, vec4<f32>(1e-20)), vec4<f32>(0.0), vec4<f32>(1.0)));
    let lobe = spectrum_mul(fourth, spectrum_mul(ratio, ratio));
    light_store(id, layer, lobe, 13.0 / (4.0 * LIGHT_PI) * LIGHT_COSINE_MOMENT_6 * light_factor());
}

/// A uniform sky over a uniform ground, by light scattered once: the harmonic of a layer, 0 where the table of orders serves.
fn light_of_uniform_sky(layer: u32, sky: Spectrum, ground: Spectrum) -> Spectrum {
    let sum = select(0.0, 0.5 / ORDERS_NORMS[0], layer == 1u);
    let difference = select(0.0, 0.5 / ORDERS_NORMS[1], layer == 2u);
    let single = select(1.0, 0.0, light_factor() > 0.0);
    return spectrum_add(spectrum_scale(sky, single * (sum + difference)), spectrum_scale(ground, single * (sum - difference)));
}

@compute @workgroup_size(8, 8, 1)
fn sky_light_table(@builtin(global_invocation_id) id: vec3<u32>) {
    if (any(id.xy >= vec2<u32>(SKY_LIGHT_SUNS, SKY_LIGHT_ALTITUDES))) { return; }
    let h = sky_light.top_altitude_m * f32(id.y) / f32(SKY_LIGHT_ALTITUDES - 1u);
    let mu_sun = mix(sky_light.lowest_mu_sun, sky_light.highest_mu_sun, f32(id.x) / f32(SKY_LIGHT_SUNS - 1u));
    light_store(id.xy, 0u, light_of_sun(h, mu_sun), 1.0);
    light_of_orders(id.xy, h, mu_sun);
}

// What a ray gathers from the table of diffuse light in one march. Twin: tyndall_scattering::orders::path.
// @import sky/march_path.wgsl
// @import sky/orders_altitudes.wgsl
// @import sky/orders_basis.wgsl
// @import sky/orders_source.wgsl

/// Light that a ray has gathered (W/m^2/sr/nm), and the columns (m) of the media along it.
struct OrdersGathered {
    light: Spectrum,
    columns: vec4<f32>,
}

/// One harmonic between four nodes whose first vectors and weights are given.
fn orders_mix(nodes: vec4<u32>, weights: vec4<f32>, offset: u32) -> Spectrum {
    let low = spectrum_add(spectrum_scale(orders_load(nodes.x + offset), weights.x), spectrum_scale(orders_load(nodes.y + offset), weights.y));
    let high = spectrum_add(spectrum_scale(orders_load(nodes.z + offset), weights.z), spectrum_scale(orders_load(nodes.w + offset), weights.w));
    return spectrum_add(low, high);
}

/// Mean light around a point of altitude h, weighted by the phase functions of the media towards a ray with zenith
/// cosine mu and cosine nu to the sun (W/m^2/sr/nm).
fn orders_scattered(h: f32, mu: f32, mu_sun: f32, nu: f32) -> Scattered {
    let altitude = orders_altitude_place(h);
    let sun = orders_sun_place(mu_sun);
    let stride = 2u * orders_harmonics();
    let first = (sun.index * orders.altitudes + altitude.index) * stride;
    let nodes = first + vec4<u32>(0u, stride, stride * orders.altitudes, stride * (orders.altitudes + 1u));
    let u = vec2<f32>(1.0 - altitude.fraction, altitude.fraction);
    let weights = vec4<f32>(u * (1.0 - sun.fraction), u * sun.fraction);
    let sine = sqrt(max((1.0 - mu) * (1.0 + mu), 0.0));
    // With ray or sun in the zenith any azimuth will do: the harmonics with m > 0 vanish there.
    let sines = max(sine * sqrt(max((1.0 - mu_sun) * (1.0 + mu_sun), 0.0)), 1e-6);
    let cos_phi = clamp((nu - mu * mu_sun) / sines, -1.0, 1.0);
    var out = scattered_nothing();
    var azimuth = vec2<f32>(cos_phi, 1.0);
    var diagonal = 1.0;
    // Higher harmonics than the table's have no weight. No branch here depends on the uniform: see
    // aerial/aerial.wgsl.
    let last = orders_harmonics() - 1u;
    for (var m = 0u; m < ORDERS_DEGREES; m++) { // loops: ORDERS_DEGREES
        var legendre = vec2<f32>(0.0, diagonal);
        for (var l = m; l < ORDERS_DEGREES; l++) { // loops: ORDERS_DEGREES
            let k = l * (l + 1u) / 2u + m;
            let harmonic = select(0.0, ORDERS_NORMS[k] * legendre.y * azimuth.y, l <= orders.degree);
            let light = orders_mix(nodes, weights * harmonic, 2u * min(k, last));
            out.air = spectrum_add(out.air, spectrum_scale(light, orders.moments[l].x));
            out.aerosol = spectrum_add(out.aerosol, spectrum_scale(light, orders.moments[l].y));
            out.haze = spectrum_add(out.haze, spectrum_scale(light, orders.moments[l].z));
            legendre = vec2<f32>(legendre.y, orders_legendre_next(l, m, mu, legendre.x, legendre.y));
        }
        azimuth = vec2<f32>(azimuth.y, 2.0 * cos_phi * azimuth.y - azimuth.x);
        diagonal *= f32(2u * m + 1u) * sine;
    }
    return out;
}

/// One panel from x0 of a width in x; `ends` = lowest point and length (m).
fn orders_panel(state: OrdersGathered, ray: Ray, ends: vec2<f32>, x0: f32, width: f32) -> OrdersGathered {
    let radius = atmosphere.planet_radius_m;
    var out = state;
    let nodes = march_nodes(ray, ends, x0, width);
    var running = transpose(march_running(nodes));
    for (var i = 0u; i < 4u; i++) { // loops: 4
        let mu = mu_along(radius, ray.h, ray.mu, 1.0, nodes.t[i], nodes.h[i]);
        let mu_sun = mu_along(radius, ray.h, ray.mu_sun, ray.nu, nodes.t[i], nodes.h[i]);
        let scattered = orders_scattered(nodes.h[i], mu, mu_sun, ray.nu);
        let air = spectrum_scale(spectrum_mul(scattered.air, orders.air_scattering), nodes.air[i]);
        let aerosol = spectrum_scale(spectrum_mul(scattered.aerosol, orders.aerosol_scattering), nodes.aerosol[i]);
        let haze = spectrum_scale(spectrum_mul(scattered.haze, orders.haze_scattering), nodes.haze[i]);
        let source = spectrum_add(spectrum_add(air, aerosol), haze);
        let light = spectrum_mul(source, atmosphere_transmittance(state.columns + running[i]));
        out.light = spectrum_add(out.light, spectrum_scale(light, QUADRATURE_WEIGHTS[i]));
    }
    out.columns += march_columns(nodes);
    return out;
}

/// What is scattered into `length` metres of a ray; `panels` from 2 to 16.
fn orders_gather(ray: Ray, length: f32, panels: u32) -> OrdersGathered {
    // Light from all sides falls off below a layer's top as that of a sun in the zenith.
    let path = march_path(ray.h, ray.mu, 1.0, ray.mu, length);
    var state = OrdersGathered(Spectrum(vec4<f32>(0.0), vec4<f32>(0.0)), vec4<f32>(0.0));
    var now = march_piece(path, ray, panels, path.limits.x);
    for (var i = 0u; i < MARCH_PANELS; i++) { // loops: MARCH_PANELS
        if (now.piece.x >= path.limits.y) { break; }
        let place = march_panel_place(now);
        state = orders_panel(state, ray, path.ends, place.x, place.y);
        now = march_next_panel(path, ray, panels, now);
    }
    return state;
}

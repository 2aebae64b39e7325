// The quadrature of paper eq. (1) that fills the sky tables. Twin: tyndall_scattering::march.
//
// The panels are those of march_path.wgsl. The column from the observer is the running integral of their nodes, the column
// to the sun comes from the table.
// @import sky/column_lookup.wgsl
// @import sky/march_path.wgsl

/// Light of a scattering medium after its phase function, summed over the media (W/m^2/sr/nm).
fn march_radiance(light: Scattered, phases: vec3<f32>) -> Spectrum {
    let clear = spectrum_add(spectrum_scale(light.air, phases.x), spectrum_scale(light.aerosol, phases.y));
    return spectrum_add(clear, spectrum_scale(light.haze, phases.z));
}

struct MarchState {
    columns: vec4<f32>, // m, from the observer to the start of the panel
    light: Scattered,
}

/// Adds what one node scatters, for a path through `columns` to the sun.
fn march_node(light: Scattered, columns: vec4<f32>, densities: vec3<f32>) -> Scattered {
    let transmittance = atmosphere_transmittance(columns);
    let air = spectrum_scale(spectrum_mul(atmosphere.air_source, transmittance), densities.x);
    let aerosol = spectrum_scale(spectrum_mul(atmosphere.aerosol_source, transmittance), densities.y);
    var out = Scattered(spectrum_add(light.air, air), spectrum_add(light.aerosol, aerosol), light.haze);
    if (atmosphere_hazy()) {
        out.haze = spectrum_add(out.haze, spectrum_scale(spectrum_mul(atmosphere.haze_source, transmittance), densities.z));
    }
    return out;
}

/// One panel from x0 of a width in x.
fn march_panel(state: MarchState, ray: Ray, ends: vec2<f32>, x0: f32, width: f32, lit: bool) -> MarchState {
    let radius = atmosphere.planet_radius_m;
    var out = state;
    let nodes = march_nodes(ray, ends, x0, width);
    if (lit) {
        var running = transpose(march_running(nodes));
        for (var i = 0u; i < 4u; i++) { // loops: 4
            let mu_sun = mu_along(radius, ray.h, ray.mu_sun, ray.nu, nodes.t[i], nodes.h[i]);
            let view = state.columns + running[i];
            let densities = vec3<f32>(nodes.air[i], nodes.aerosol[i], nodes.haze[i]) * QUADRATURE_WEIGHTS[i];
            out.light = march_node(out.light, view + columns_to_top(nodes.h[i], mu_sun), densities);
        }
    }
    out.columns += march_columns(nodes);
    return out;
}

/// Light scattered once towards the observer over `length` metres of a ray; `panels` from 2 to 16.
fn march_scattered(ray: Ray, length: f32, panels: u32) -> Scattered {
    return march_ray(ray, length, panels).light;
}

/// The same light, and the columns along the ray.
fn march_ray(ray: Ray, length: f32, panels: u32) -> MarchState {
    let path = march_path_lit(ray, length);
    var state = MarchState(vec4<f32>(0.0), scattered_nothing());
    var now = march_piece(path, ray, panels, path.limits.x);
    for (var i = 0u; i < MARCH_PANELS; i++) { // loops: MARCH_PANELS
        if (now.piece.x >= path.limits.y) { break; }
        let place = march_panel_place(now);
        state = march_panel(state, ray, path.ends, place.x, place.y, march_is_lit(path, now));
        now = march_next_panel(path, ray, panels, now);
    }
    return state;
}

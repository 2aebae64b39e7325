// The quadrature of paper eq. (1) that fills the sky tables. Twin: tyndall_scattering::march.
//
// A ray is cut at its lowest point and where it enters and leaves the earth's shadow; each piece takes panels of four
// Gauss nodes in a variable x with t = lowest + x |x| side, so that nodes are dense at the lowest point. The column from
// the observer is the running integral of the same nodes, the column to the sun comes from the table.
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

/// Light scattered once towards the observer over `length` metres of a ray; `panels` from 2 to MARCH_PANELS_MAX.
fn march_scattered(ray: Ray, length: f32, panels: u32) -> Scattered {
    return march_ray(ray, length, panels).light;
}

/// The same light, and the columns along the ray.
fn march_ray(ray: Ray, length: f32, panels: u32) -> MarchState {
    let radius = atmosphere.planet_radius_m;
    let lowest = clamp(-(radius + ray.h) * ray.mu, 0.0, length);
    let shadow = shadow_interval(radius, ray.h, ray.mu, ray.mu_sun, ray.nu, length);
    let start = select(0.0, -1.0, lowest > 0.0);
    let end = select(0.0, 1.0, length > lowest);
    let enter = clamp(march_variable(shadow.x, lowest, length), start, end);
    let leave = clamp(march_variable(shadow.y, lowest, length), start, end);
    // start, enter, leave, 0 and end in order, knowing enter <= leave.
    let breaks = array<f32, 5>(start, min(enter, 0.0), clamp(0.0, enter, leave), max(leave, 0.0), end);
    let roots = sqrt(vec2<f32>(lowest, length - lowest));
    var state = MarchState(vec4<f32>(0.0), scattered_nothing());
    for (var piece = 0u; piece < 4u; piece++) { // loops: 4
        let low = breaks[piece];
        let high = clamp(breaks[piece + 1u], start, end);
        let extent = max(high - max(low, start), 0.0);
        if (extent <= 0.0) { continue; }
        let middle = 0.5 * (low + high);
        let lit = middle <= enter || middle >= leave;
        let share = extent * select(roots.y, roots.x, high <= 0.0) / (roots.x + roots.y);
        let count = clamp(u32(ceil(f32(panels) * share)), 1u, MARCH_PANELS_MAX);
        for (var panel = 0u; panel < count; panel++) { // loops: MARCH_PANELS_MAX
            let width = extent / f32(count);
            state = march_panel(state, ray, vec2<f32>(lowest, length), low + f32(panel) * width, width, lit);
        }
    }
    return state;
}

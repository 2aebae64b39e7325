// The quadrature of paper eq. (1) that fills the sky tables. Twin: tyndall_scattering::march.
//
// A ray is cut at its lowest point and where it enters and leaves the earth's shadow; each piece takes panels of four
// Gauss nodes in a variable x with t = lowest + x |x| side, so that nodes are dense at the lowest point. The column from
// the observer is the running integral of the same nodes, the column to the sun comes from the table.
// @import common/sphere.wgsl
// @import sky/column_lookup.wgsl
// @import sky/quadrature.wgsl

const MARCH_PANELS_MAX: u32 = 16u;

/// A ray inside the atmosphere: altitude, cosines to zenith, of the sun to the zenith, and between ray and sun.
struct Ray {
    h: f32,
    mu: f32,
    mu_sun: f32,
    nu: f32,
}

/// Light scattered towards the observer before the phase functions [W/m^2/nm].
struct Scattered {
    air: Spectrum,
    aerosol: Spectrum,
}

struct MarchState {
    columns: vec3<f32>, // m, from the observer to the start of the panel
    light: Scattered,
}

/// Distance [m] at x, and its derivative [m].
fn march_position(x: f32, lowest: f32, length: f32) -> vec2<f32> {
    let side = select(length - lowest, lowest, x < 0.0);
    return vec2<f32>(lowest + x * abs(x) * side, 2.0 * abs(x) * side);
}

/// x at a distance [m].
fn march_variable(t: f32, lowest: f32, length: f32) -> f32 {
    let from_lowest = t - lowest;
    let side = max(select(length - lowest, lowest, from_lowest < 0.0), 1e-6);
    return sign(from_lowest) * sqrt(min(abs(from_lowest) / side, 1.0));
}

/// Adds what one node scatters, for a path through `columns` to the sun.
fn march_node(light: Scattered, columns: vec3<f32>, densities: vec2<f32>) -> Scattered {
    let transmittance = atmosphere_transmittance(columns);
    let air = spectrum_scale(spectrum_mul(atmosphere.air_source, transmittance), densities.x);
    let aerosol = spectrum_scale(spectrum_mul(atmosphere.aerosol_source, transmittance), densities.y);
    return Scattered(spectrum_add(light.air, air), spectrum_add(light.aerosol, aerosol));
}

/// One panel from x0 of a width in x.
fn march_panel(state: MarchState, ray: Ray, ends: vec2<f32>, x0: f32, width: f32, lit: bool) -> MarchState {
    let radius = atmosphere.planet_radius_m;
    var out = state;
    var t: vec4<f32>;
    var h: vec4<f32>;
    var air: vec4<f32>;     // m, density times step
    var aerosol: vec4<f32>; // m
    var ozone: vec4<f32>;   // m
    for (var i = 0u; i < 4u; i++) { // loops: 4
        let position = march_position(x0 + QUADRATURE_NODES[i] * width, ends.x, ends.y);
        t[i] = position.x;
        h[i] = min(altitude_along(radius, ray.h, ray.mu, position.x), atmosphere.top_altitude_m);
        let step = atmosphere_density(h[i]) * position.y * width;
        air[i] = step.x;
        aerosol[i] = step.y;
        ozone[i] = step.z;
    }
    if (lit) {
        let air_columns = quadrature_running(air);
        let aerosol_columns = quadrature_running(aerosol);
        let ozone_columns = quadrature_running(ozone);
        for (var i = 0u; i < 4u; i++) { // loops: 4
            let mu_sun = mu_along(radius, ray.h, ray.mu_sun, ray.nu, t[i], h[i]);
            let view = state.columns + vec3<f32>(air_columns[i], aerosol_columns[i], ozone_columns[i]);
            let densities = vec2<f32>(air[i], aerosol[i]) * QUADRATURE_WEIGHTS[i];
            out.light = march_node(out.light, view + columns_to_top(h[i], mu_sun), densities);
        }
    }
    out.columns += vec3<f32>(dot(air, QUADRATURE_WEIGHTS), dot(aerosol, QUADRATURE_WEIGHTS), dot(ozone, QUADRATURE_WEIGHTS));
    return out;
}

/// Light scattered once towards the observer over `length` metres of a ray; `panels` from 2 to MARCH_PANELS_MAX.
fn march_scattered(ray: Ray, length: f32, panels: u32) -> Scattered {
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
    let zero = Spectrum(vec4<f32>(0.0), vec4<f32>(0.0));
    var state = MarchState(vec3<f32>(0.0), Scattered(zero, zero));
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
    return state.light;
}
